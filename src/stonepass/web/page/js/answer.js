// The answer: two readings, a sentence, and a live region that waits until the sliders rest.

import { fill, h, write } from "./dom.js";
import { sentence as whole, term } from "./glossary.js";
import { clinical, decimals, digits, plain, withError } from "./units.js";
import { outcomeWords, spoken, verdict } from "./verdict.js";

const REST = 700; // ms without a change before a screen reader hears the answer

/** Build the panel of the answer. */
export function answerPanel() {
  const pressure = reading(["This stone starts to move at a ", term("critical pressure"), " of"]);
  const size = reading(["The ", term("critical size", "largest stone"), " that moves at the limit"]);
  const sentence = h("p", { class: "verdict" });
  const heard = h("p", { class: "unseen", role: "status", "aria-live": "polite" });
  const pinned = h("div", { class: "pinned", "aria-hidden": "true" });
  const printed = h("div", { class: "only-print" });
  const warnings = h("ul", { class: "warnings only-print" });
  const readings = h("div", { class: "readings" }, pressure.element, size.element);
  const element = h(
    "section",
    { class: "answer", "aria-label": "Answer" },
    sentence,
    readings,
    heard,
    printed,
    warnings,
  );
  let waiting = 0;

  function show(question, found, problem) {
    element.dataset.state = problem ? "stale" : "";
    const parts = problem ? [problem.message] : verdict(question, found);
    fill(
      sentence,
      parts.map((each) => (each.strong ? h("strong", {}, each.strong) : each)),
    );
    clearTimeout(waiting);
    waiting = setTimeout(() => write(heard, spoken(parts)), REST);
    if (!found) return;
    showPressure(pressure, found.answer);
    showSize(size, question, found.size);
    const [value, error] = withError(
      found.answer?.critical_pressure_kPa ?? null,
      found.answer?.critical_pressure_error_kPa,
    );
    fill(
      pinned,
      h("span", {}, h("b", {}, value === "–" ? outcomeWords(found.answer) : `${value} kPa`), ` ${error}`),
      h("span", { class: "quiet" }, sizeText(found.size)),
    );
    fill(printed, printedInputs(question, found));
    fill(
      warnings,
      found.warnings.map((each) => h("li", {}, whole(each.sentence))),
    );
  }
  new IntersectionObserver(([seen]) => {
    pinned.dataset.state = seen.isIntersecting ? "" : "shown";
  }).observe(element);
  return { element, pinned, show, place: (beside) => readings.append(beside) };
}

function reading(title) {
  const parts = {
    figure: h("p", { class: "figure" }),
    also: h("p", { class: "also" }),
    detail: h("p", { class: "detail" }),
  };
  return {
    ...parts,
    element: h("section", { class: "reading" }, h("h2", {}, title), parts.figure, parts.also, parts.detail),
  };
}

function showPressure({ figure, also, detail }, answer) {
  if (!answer || answer.outside || answer.critical_pressure_kPa === null) {
    fill(figure, h("span", { class: "words" }, outcomeWords(answer)));
    write(also, answer?.lower_bound_kPa ? `more than ${digits(answer.lower_bound_kPa)} kPa` : "");
    write(detail, "");
    return;
  }
  const [value, error] = withError(answer.critical_pressure_kPa, answer.critical_pressure_error_kPa);
  const zero = answer.outcome === "LOOSE";
  fill(
    figure,
    h("span", { class: "big" }, zero ? "0" : value),
    h("span", { class: "unit" }, "kPa"),
    !zero && h("span", { class: "error" }, `${error} kPa`),
  );
  write(also, zero ? "The stone is not held." : clinical(answer.critical_pressure_kPa));
  write(detail, zero ? "" : `± is the claimed difference from a solve.${angle(answer)}`);
}

function angle(answer) {
  return answer.contact_angle_deg
    ? ` Contact begins at α₀\u00a0=\u00a0${decimals(answer.contact_angle_deg, 1)}°.`
    : "";
}

function showSize({ figure, also, detail }, question, size) {
  const diameter = size?.critical_diameter_mm ?? null;
  if (diameter === null) {
    fill(
      figure,
      h(
        "span",
        { class: "words" },
        size?.lower_bound_diameter_mm
          ? `at least ${digits(size.lower_bound_diameter_mm)} mm`
          : outcomeWords(size),
      ),
    );
  } else {
    fill(figure, h("span", { class: "big" }, decimals(diameter, 2)), h("span", { class: "unit" }, "mm"));
  }
  write(also, `at ${plain(question.limit, 2)} kPa, ${clinical(question.limit)}`);
  write(
    detail,
    size === null || size === undefined
      ? ""
      : diameter === null
        ? size.message
        : `Size ratio ξ = ${decimals(size.critical_size_ratio, 3)}; this stone has ξ = ${decimals(question.stone / question.inner, 3)}.`,
  );
}

function sizeText(size) {
  return size?.critical_diameter_mm ? `up to ${decimals(size.critical_diameter_mm, 2)} mm at the limit` : "";
}

function printedInputs(question, found) {
  const wall = `${digits(question.inner)} mm inner, ${digits(question.outer)} mm outer diameter`;
  const rows = [
    [
      "Stone",
      `${digits(question.stone)} mm across, length over width ${plain(question.aspect)}, friction ${plain(question.friction)}`,
    ],
    [
      "Ureter",
      `${wall}, material ${typeof question.material === "string" ? question.material : "own constants"}, stiffness ${plain(question.stiffness)}`,
    ],
    ["Confining pressure", `${plain(question.confining)} kPa`],
    ["Pressure limit", `${plain(question.limit)} kPa`],
    ["Version, fingerprint", `stonepass ${found.version}, ${found.fingerprint}`],
    ["Notice", found.notice],
  ];
  return h(
    "table",
    {},
    h(
      "tbody",
      {},
      rows.map(([name, value]) => h("tr", {}, h("th", { scope: "row" }, name), h("td", {}, value))),
    ),
  );
}
