// The results of an assessment: pressures, fractions, sizes, sensitivity, cohorts, warnings.

import { h } from "./dom.js";
import { sentence } from "./glossary.js";
import { drawn } from "./pictures/axes.js";
import { barsPicture, rangesPicture, sizesPicture } from "./pictures/assessment.js";
import { clinical, decimals, digits, plain } from "./units.js";

/** Return the elements that show the record of an assessment. */
export function patientResults(record) {
  return [
    h(
      "div",
      { class: "stack-small" },
      h("h2", { tabindex: "-1", class: "result-title" }, record.message),
      h("p", { class: "small quiet" }, record.caution),
    ),
    h(
      "div",
      { class: "readings two" },
      pressure("The stone starts to move at", record.critical_pressure_kPa),
      record.present_pressure_kPa
        ? pressure("Present urine pressure above it", record.present_pressure_kPa)
        : null,
    ),
    statements("Not decided by these measurements", record.cannot_decide),
    statements("Decided", record.decided),
    h(
      "div",
      { class: "pictures pair-of-pictures" },
      figure(
        "Pressures, with 90 % intervals",
        (width, height) => rangesPicture(width, height, record),
        "Bar: 90 % of the simulated cases. Dot: median. Arrow: the interval goes on.",
        "wide",
      ),
      figure(
        "Stones of other sizes",
        (width, height) => sizesPicture(width, height, record),
        `Fraction of the simulated cases in which a stone of this size moves below ${plain(record.inputs.limit_kPa)} kPa.`,
      ),
      figure(
        "What matters most",
        (width, height) => barsPicture(width, height, Object.entries(record.sensitivity)),
        "Total Sobol’ index of each measurement for the critical pressure.",
      ),
    ),
    measurements(record.inputs),
    cohorts(record.cohorts),
    statements(
      "Warnings",
      record.warnings.map((each) => each.sentence),
      "warnings",
    ),
    h(
      "p",
      { class: "small quiet mark" },
      `${record.inputs.samples} simulated cases, seed ${record.inputs.seed}, ${solved(record.accuracy)}, limit ${plain(record.inputs.limit_kPa)} kPa: ${record.inputs.limit_source}. stonepass ${record.version}. ${record.disclaimer}`,
    ),
  ];
}

function solved(accuracy) {
  return accuracy.solves === 0
    ? "pressures by a surrogate of the package"
    : `${accuracy.solves} solved cases`;
}

function pressure(title, range) {
  const median = range?.median ?? null;
  return h(
    "section",
    { class: "reading" },
    h("h3", {}, title),
    h(
      "p",
      { class: "figure" },
      median === null
        ? h(
            "span",
            { class: "words" },
            range?.at_least ? `more than ${digits(range.at_least)} kPa` : "not known",
          )
        : [h("span", { class: "big" }, digits(median)), h("span", { class: "unit" }, "kPa")],
    ),
    h("p", { class: "also" }, median === null ? "" : clinical(median)),
    h(
      "p",
      { class: "detail" },
      range
        ? `90 % interval from ${known(range.low)} to ${range.high === null ? `more than ${digits(range.at_least)}` : digits(range.high)} kPa.`
        : "",
    ),
  );
}

function known(value) {
  return value === null ? "an unknown value" : digits(value);
}

function statements(title, sentences, style = "bullets") {
  if (!sentences?.length) return null;
  return h(
    "section",
    { class: "stack-small" },
    h("h3", {}, title),
    h(
      "ul",
      { class: style },
      sentences.map((each) => h("li", {}, sentence(each))),
    ),
  );
}

function figure(title, make, caption, size = "") {
  const body = h("div", { class: "canvas" });
  drawn(body, make);
  return h(
    "figure",
    { class: `picture card ${size}` },
    h("h3", {}, title),
    body,
    h("figcaption", {}, caption),
  );
}

/** Return the measurements as a table for the printed page, on which the form is not shown. */
function measurements({ measured, material, place }) {
  const shown = ({ value, sd, low, high, unit }) => {
    const [factor, name] = unit === "m" ? [1e3, " mm"] : [1, ""];
    return sd === null
      ? `${digits(factor * low)} to ${digits(factor * high)}${name}`
      : `${digits(factor * value)} ± ${digits(factor * sd, 2)}${name}`;
  };
  const rows = [
    ...Object.entries(measured).map(([name, each]) => [name.replaceAll("_", " "), shown(each)]),
    ["material", material],
    ["place", place ?? "not known"],
  ];
  return h(
    "table",
    { class: "only-print" },
    h(
      "tbody",
      {},
      rows.map(([name, value]) => h("tr", {}, h("th", { scope: "row" }, name), h("td", {}, value))),
    ),
  );
}

function cohorts(rows) {
  if (!rows.length) return null;
  const passed = (row) =>
    row.passed === null
      ? "–"
      : `${decimals(100 * row.passed, 0)} %${row.passed_low === null ? "" : ` (${decimals(100 * row.passed_low, 0)} to ${decimals(100 * row.passed_high, 0)})`}`;
  const model = (row) =>
    row.model === null
      ? "–"
      : row.model.high - row.model.low < 0.005
        ? `${decimals(100 * row.model.low, 0)} %`
        : `${decimals(100 * row.model.low, 0)} to ${decimals(100 * row.model.high, 0)} %`;
  const apart = rows.filter((row) => /^(more|fewer)/.test(row.comparison)).length;
  return h(
    "details",
    {},
    h(
      "summary",
      {},
      `Published cohorts beside it: ${rows.length} groups, of which ${apart} contradict the model`,
    ),
    h(
      "div",
      { class: "scroll", tabindex: "0", role: "region", "aria-label": "Published cohorts" },
      h(
        "table",
        {},
        h(
          "thead",
          {},
          h(
            "tr",
            {},
            ["Cohort", "Stones", "Passed", "Moves below the limit", "Comparison"].map((each) =>
              h("th", { scope: "col" }, each),
            ),
          ),
        ),
        h(
          "tbody",
          {},
          rows.map((row) =>
            h(
              "tr",
              {},
              h("th", { scope: "row" }, row.cohort, h("div", { class: "small quiet" }, row.source)),
              h("td", {}, row.group, h("div", { class: "small quiet" }, row.about)),
              h("td", { class: "number" }, passed(row)),
              h("td", { class: "number" }, model(row)),
              h("td", {}, row.comparison),
            ),
          ),
        ),
      ),
    ),
  );
}
