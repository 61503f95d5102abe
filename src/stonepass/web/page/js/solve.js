// The finite-element answer beside the instant one: a job with progress that can be cancelled.

import { startJob } from "./jobs.js";
import { fill, h, write } from "./dom.js";
import { sentence, term } from "./glossary.js";
import { partOf, progressBar, setProgress } from "./progress.js";
import { toCase, toQuery } from "./question.js";
import { reportButtons } from "./report.js";
import { clinical, decimals, digits, withError } from "./units.js";
import { outcomeWords } from "./verdict.js";

const MODEL_WORDS = { paper: "model of the paper", direct: "direct model" };

/** Build the reading of the finite elements; `solved()` is called when an answer has come or gone. */
export function solvePanel(changed) {
  const model = h(
    "select",
    { "aria-label": "Model of the finite elements" },
    Object.entries(MODEL_WORDS).map(([value, text]) => h("option", { value }, text)),
  );
  const start = h("button", { type: "button", class: "button first small" }, "Solve");
  const cancel = h("button", { type: "button", class: "button small", hidden: true }, "Cancel");
  const figure = h("p", { class: "figure" });
  const also = h("p", { class: "also" });
  const detail = h("p", { class: "detail", role: "status" });
  const progress = progressBar();
  const element = h(
    "section",
    { class: "reading solve" },
    h("h2", {}, "Solved by finite elements"),
    figure,
    also,
    progress,
    detail,
    h(
      "div",
      { class: "solve-row no-print" },
      h("div", { class: "row" }, model, start, cancel),
      reportButtons(job),
    ),
  );
  let question = null;
  let instant = null;
  let answer = null; // {key, record}
  let failure = null; // {key, text}: why the last solve gave no answer
  let stop = () => {};
  let running = "";

  start.addEventListener("click", run);
  cancel.addEventListener("click", () => stop());
  model.addEventListener("change", draw);

  async function run() {
    const asked = { key: keyOf(question) };
    running = asked.key;
    failure = null;
    working("The solve is waiting for a free worker.", 0);
    let ended = false;
    try {
      const begun = startJob(job(), (state) => {
        ended = told(asked, state);
      });
      stop = begun.stop;
      await begun.accepted;
      if (ended) running = "";
    } catch (error) {
      failed(asked, error.message);
    }
  }

  function job() {
    return {
      kind: "pressure",
      case: toCase(question, model.value),
      stiffness: question.stiffness,
    };
  }
  function told(asked, state) {
    if (state.status === "queued") working("The solve is waiting for a free worker.", 0);
    else if (state.status === "running")
      working(state.progress?.sentence || "The finite elements are being solved.", partOf(state));
    else if (state.status === "done") {
      answer = { key: asked.key, record: state.result };
      rest();
      draw();
      changed(current());
    } else
      failed(
        asked,
        state.status === "cancelled"
          ? "The solve was cancelled."
          : (state.problem?.detail ?? "The solve failed."),
      );
    return ["done", "failed", "cancelled"].includes(state.status);
  }

  function working(text, part) {
    start.hidden = true;
    model.disabled = true;
    cancel.hidden = false;
    setProgress(progress, part);
    write(detail, text);
  }
  function rest() {
    running = "";
    start.hidden = false;
    model.disabled = false;
    cancel.hidden = true;
    setProgress(progress, null);
  }
  function failed(asked, text) {
    failure = { key: asked.key, text };
    rest();
    draw();
  }

  function keyOf(of) {
    return `${toQuery({ ...of, limit: 0, model: model.value })}`;
  }
  function current() {
    return answer && question && answer.key === keyOf(question) ? answer.record : null;
  }

  function draw() {
    const record = current();
    element.dataset.state = record ? "" : "empty";
    if (running) return;
    if (!record) {
      fill(figure, h("span", { class: "words quiet" }, "not solved"));
      write(
        also,
        answer
          ? `Solved for earlier inputs: ${reading(answer.record)}`
          : "A solve takes a few seconds and covers all inputs.",
      );
      if (failure?.key === keyOf(question)) write(detail, failure.text);
      else
        fill(
          detail,
          "The ",
          term("push-through", "direct"),
          " model has no closure and goes beyond the paper’s.",
        );
      return;
    }
    const [value, error] = withError(record.critical_pressure_kPa, record.critical_pressure_error_kPa);
    if (record.critical_pressure_kPa === null)
      fill(figure, h("span", { class: "words" }, outcomeWords(record)));
    else
      fill(
        figure,
        h("span", { class: "big" }, value),
        h("span", { class: "unit" }, "kPa"),
        error && h("span", { class: "error" }, `${error} kPa`),
      );
    write(
      also,
      record.critical_pressure_kPa === null ? record.message : clinical(record.critical_pressure_kPa),
    );
    const warned = record.warnings?.length
      ? ` ${record.warnings.map((each) => sentence(each.sentence)).join(" ")}`
      : "";
    write(detail, `${difference(record)}${warned}`);
  }
  function reading(record) {
    return record.critical_pressure_kPa === null
      ? outcomeWords(record)
      : `${digits(record.critical_pressure_kPa, 4)} kPa`;
  }
  function difference(record) {
    if (!instant || record.critical_pressure_kPa === null) return "";
    const part = (100 * (record.critical_pressure_kPa - instant)) / instant;
    return record.model === question.model
      ? `${decimals(part, 2)} % from the instant answer.`
      : `${decimals(part, 1)} % from the instant answer of the ${MODEL_WORDS[question.model]}.`;
  }

  return {
    element,
    current,
    /** Take the question that a solve would answer, and the instant answer to compare with. */
    asked(next, pressure = null) {
      if (next.model !== question?.model && !running) model.value = next.model;
      question = next;
      instant = pressure;
      draw();
    },
  };
}
