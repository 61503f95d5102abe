// Constants of a wall from a tensile or an inflation test.

import { get, upload } from "./api.js";
import { fill, h } from "./dom.js";
import { dropZone } from "./drop.js";
import { checkField, listField, quantityField } from "./fields.js";
import { sentence } from "./glossary.js";
import { jobRun } from "./job_run.js";
import { labSection } from "./lab_section.js";
import { drawn } from "./pictures/axes.js";
import { fitPicture } from "./pictures/fit.js";
import { decimals, digits } from "./units.js";

const GONE = 410; // the server has dropped an upload that was not used for a while
const TESTS = [
  ["tensile", "tensile test of a strip"],
  ["inflation", "inflation test of a tube"],
];

/** Build the section. */
export async function fitSection(take) {
  const [laws, materials] = await Promise.all([get("laws"), get("materials")]);
  const results = h("div", { class: "stack" });
  const chosen = h("p", { class: "small quiet chosen", role: "status" }, "No file is chosen.");
  const test = listField("Test", TESTS, "tensile", showFields);
  const law = listField(
    "Material law",
    laws.map((each) => [each.name, `${each.name}: ${each.constants.map(({ symbol }) => symbol).join(", ")}`]),
    "neo-hookean",
  );
  const fields = {
    width: quantityField("Width of the strip at rest", "mm"),
    thickness: quantityField("Thickness of the strip at rest", "mm"),
    gauge_length: quantityField("Gauge length at rest (for extensions)", "mm"),
    inner: quantityField("Inner diameter at rest", "mm"),
    outer: quantityField("Outer diameter at rest", "mm"),
  };
  const fix = quantityField("Known constants, e.g. G = 12 kPa, a1122 = 0.1856 (optional)", "");
  const relative = checkField("errors are proportional to the measured values");
  const run = jobRun("Fit", "A fit takes a few seconds.");
  let file = null;
  let held = null; // what the server says about the uploaded file

  const form = h(
    "form",
    { class: "inputs-form", "aria-label": "Test of a wall" },
    dropZone(
      "Drop a CSV file",
      "Columns: stretch or extension_mm with nominal_stress_kPa or force_N; or pressure_kPa with inner_diameter_mm or outer_diameter_mm.",
      ".csv,text/csv",
      choose,
    ),
    chosen,
    test.element,
    law.element,
    ...Object.values(fields).map((each) => each.element),
    fix.element,
    relative.element,
    run.element,
  );
  showFields();
  return labSection({
    title: "Constants of a wall",
    form,
    results,
    expected:
      "The fitted constants with their 95 % intervals, which assume independent errors of the points, the curve beside the data, and what in the data speaks against the law.",
    start,
  });

  async function choose(given) {
    file = given;
    held = null;
    chosen.textContent = `${given.name} is being read.`;
    try {
      held = await upload("fit", given, "text/csv");
    } catch (error) {
      chosen.textContent = error.message;
      return;
    }
    const { summary } = held;
    test.box.value = summary.test;
    showFields();
    chosen.textContent = `${given.name}: ${summary.rows} rows of ${summary.columns.join(", ")}.`;
  }
  function showFields() {
    const inflation = test.box.value === "inflation";
    const needed = held ? held.summary.needs : Object.keys(fields);
    for (const [name, each] of Object.entries(fields))
      each.element.hidden = ["inner", "outer"].includes(name) !== inflation || !needed.includes(name);
  }
  async function start() {
    if (!held) {
      chosen.textContent = file
        ? "This file cannot be used; choose another one."
        : "Choose a CSV file first.";
      return;
    }
    for (const each of Object.values(fields)) each.mark(false);
    const body = { kind: "fit", test: test.box.value, law: law.box.value, relative: relative.box.checked };
    for (const [name, each] of Object.entries(fields))
      if (!each.element.hidden && each.text()) body[name] = each.text();
    const known = fix.box.value.split(/[,;]/).filter((each) => each.trim());
    if (known.length)
      body.fix = Object.fromEntries(
        known.map((each) => [0, 1].map((k) => (each.split("=")[k] ?? "").trim())),
      );
    await run.start({ ...body, upload: held.id }, show, (problem) => {
      fields[problem.field]?.mark(true);
      if (problem.status === GONE) choose(file);
    });
  }

  function show(record) {
    const picture = h("div", { class: "canvas" });
    drawn(picture, (width, height) => fitPicture(width, height, record));
    fill(
      results,
      h(
        "figure",
        { class: "picture card" },
        h("h3", {}, `${record.law} fitted to ${record.points} points`),
        picture,
        h(
          "figcaption",
          {},
          `Root mean square of the residuals ${digits(record.rmse_kPa)} kPa, R² = ${decimals(record.r_squared, 4)}.`,
        ),
      ),
      h("div", { class: "scroll" }, constants(record)),
      record.warnings.length > 0 &&
        h(
          "ul",
          { class: "warnings" },
          record.warnings.map((each) => h("li", {}, sentence(each.sentence))),
        ),
      record.stable
        ? h(
            "div",
            { class: "row" },
            h(
              "button",
              { type: "button", class: "button first", onclick: () => take(wallOf(record, materials)) },
              "Use this wall in the calculator",
            ),
          )
        : h("p", { class: "problem" }, sentence(record.stability)),
    );
  }
}

function constants(record) {
  const shown = (value, unit) =>
    value === null
      ? "open"
      : unit === "Pa"
        ? `${digits(value / 1e3)} kPa`
        : unit === "rad"
          ? `${digits((value * 180) / Math.PI)}°`
          : digits(value, 4);
  return h(
    "table",
    {},
    h(
      "thead",
      {},
      h(
        "tr",
        {},
        ["Constant", "Value", "95 % interval"].map((each, k) =>
          h("th", { scope: "col", class: k ? "number" : "" }, each),
        ),
      ),
    ),
    h(
      "tbody",
      {},
      record.constants.map((each) =>
        h(
          "tr",
          {},
          h("th", { scope: "row" }, each.name),
          h("td", { class: "number" }, shown(each.value, each.unit)),
          h(
            "td",
            { class: "number" },
            each.given ? "given" : `${shown(each.low, each.unit)} to ${shown(each.high, each.unit)}`,
          ),
        ),
      ),
    ),
  );
}

/**
 * Return the wall of a fit as values of the calculator.
 *
 * A law that differs from a material with an instant answer by one factor on all moduli becomes that
 * material with a stiffness, which is the same wall; any other law is taken over with its constants.
 */
function wallOf(record, materials) {
  for (const each of materials.filter(({ instant }) => instant)) {
    if (each.law.toLowerCase() !== record.law.replaceAll("-", "").toLowerCase()) continue;
    const ratios = each.declarations.map(
      (known) => (record.constants.find(({ name }) => name === known.name)?.value ?? NaN) / known.value,
    );
    const moduli = ratios.filter((_, k) => each.declarations[k].unit === "Pa");
    const others = ratios.filter((_, k) => each.declarations[k].unit !== "Pa");
    const alike =
      moduli.every((ratio) => Math.abs(ratio / moduli[0] - 1) < 1e-9) &&
      others.every((ratio) => Math.abs(ratio - 1) < 1e-9);
    if (alike) return { material: each.name, stiffness: Number(moduli[0].toPrecision(6)) };
  }
  return { material: record.material, stiffness: 1 };
}
