// The panel of one patient: measurements with their uncertainty, the assessment, the report.

import { get } from "./api.js";
import { download, fill, h } from "./dom.js";
import { checkField } from "./fields.js";
import { jobRun } from "./job_run.js";
import { fileText, patientForm } from "./patient_form.js";
import { patientResults } from "./patient_results.js";
import { reportButtons } from "./report.js";

/** Build the panel in its place on the page. */
export async function patientPanel(place) {
  const [limits, materials] = await Promise.all([get("pressure-limits"), get("materials")]);
  const results = h("div", { class: "stack" });
  const form = patientForm(
    limits,
    materials.filter((each) => each.stable),
  );
  const run = jobRun(
    "Assess",
    "This takes about a second, or half a minute where about fifty cases must be solved.",
  );
  const solve = checkField("Solve by finite elements, although a surrogate covers the inputs");
  const repeat = h("code");
  const command = h("pre", { tabindex: "0", "aria-label": "Patient file" }, h("code"));
  let asked = null;

  form.element.append(solve.element, run.element);
  form.element.addEventListener("submit", (event) => {
    event.preventDefault();
    form.refuse("", "");
    asked = { kind: "assess", patient: form.sections(), solve: solve.box.checked };
    run.start(asked, done, (problem) =>
      form.refuse(problem.field, problem.message),
    );
  });
  form.element.addEventListener("input", redraw);
  redraw();
  fill(results, nothing());
  fill(
    place,
    h(
      "div",
      { class: "lead" },
      h("h1", {}, "What do the measurements of a patient say about the stone?"),
      h(
        "p",
        {},
        "Every measurement is uncertain, so every answer is an interval or a fraction of simulated cases. A fraction is not the chance that the stone passes. Nothing that you enter is written to a disk or leaves this computer; the server forgets the results after an hour.",
      ),
    ),
    h("div", { class: "columns" }, form.element, results),
    h(
      "section",
      { class: "stack-small file no-print" },
      h(
        "div",
        { class: "row apart" },
        h("h2", {}, "The same on the command line"),
        h(
          "button",
          {
            type: "button",
            class: "button small",
            onclick: () => download("patient.toml", fileText(form.sections()), "text/plain"),
          },
          "Save patient.toml",
        ),
      ),
      h("p", { class: "small quiet" }, repeat),
      h("div", { class: "code" }, command),
    ),
  );

  function redraw() {
    command.firstChild.textContent = fileText(form.sections());
    const option = solve.box.checked ? "--solve " : "";
    repeat.textContent = `stonepass assess patient.toml ${option}--html report.html`;
  }
  function done(record) {
    const answered = asked;
    fill(
      results,
      ...patientResults(record),
      reportButtons(() => answered),
    );
    results.querySelector("h2")?.focus();
  }
}

function nothing() {
  return h(
    "div",
    { class: "card empty" },
    h("h2", {}, "What you will see"),
    h(
      "ul",
      { class: "bullets" },
      [
        "the critical pressure of the stone and the present urine pressure above it, each with its 90 % interval",
        "the fraction of the simulated cases in which the stone moves below the pressure limit, also for other sizes",
        "which measurement matters most",
        "what happened to such stones in published cohorts, and where measurements and model contradict one another",
      ].map((each) => h("li", {}, each)),
    ),
  );
}
