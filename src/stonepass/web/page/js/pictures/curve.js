// The critical pressure over the size of the stone, with the operating point, the limit and the error.

import { svg } from "../dom.js";
import { digits, KILOPASCAL_PER, plain } from "../units.js";
import { area, hatch, horizontal, line, roundUp, scale, ticks, vertical } from "./axes.js";

const ABOVE_LABELS = 28; // px above the axis of sizes, where other labels stand

/** Draw the curve; `solved` is the finite-element answer to the same question, if there is one. */
export function curvePicture(width, height, { curve, answer, size, question, solved }) {
  const inside = area(width, height);
  const sizes = curve.size_ratio;
  const pressures = curve.critical_pressure_kPa;
  const errors = curve.critical_pressure_error_kPa;
  const ratio = question.stone / question.inner;
  const here = answer?.critical_pressure_kPa ?? null;
  const top = roundUp(1.25 * Math.max(question.limit, here ?? 0, 4));
  const x = scale(sizes[0], sizes[sizes.length - 1], inside.left, inside.right);
  const y = scale(0, top, inside.bottom, inside.top);
  const end = lastKnown(pressures);
  const critical = size?.critical_size_ratio ?? null;
  const lumen = sizes.findLast((_, k) => curve.outcome[k] === "LOOSE") ?? sizes[0];
  const points = sizes.map((each, k) => [x(each), pressures[k] === null ? NaN : y(pressures[k])]);
  const clip = [
    svg(
      "clipPath",
      { id: "curve-clip" },
      svg("rect", {
        x: inside.left,
        y: inside.top,
        width: inside.right - inside.left,
        height: inside.bottom - inside.top,
      }),
    ),
  ];
  return svg(
    "svg",
    { role: "img", "aria-label": described(question, here, critical) },
    hatch("hatch-curve"),
    svg("defs", {}, clip),
    critical !== null &&
      svg("rect", {
        class: "passes",
        x: inside.left,
        y: inside.top,
        width: x(critical) - inside.left,
        height: inside.bottom - inside.top,
      }),
    end < sizes.length - 1 &&
      svg("rect", {
        class: "unknown",
        fill: "url(#hatch-curve)",
        x: x(sizes[end]),
        y: inside.top,
        width: inside.right - x(sizes[end]),
        height: inside.bottom - inside.top,
      }),
    vertical(y, ticks(0, top, 4), inside.left, {
      label: "critical pressure, kPa",
      lines: [inside.left, inside.right],
    }),
    vertical(
      y,
      ticks(0, top / KILOPASCAL_PER.mmHg, 4).map((each) => each * KILOPASCAL_PER.mmHg),
      inside.right,
      { label: "mmHg", right: true, shown: (each) => plain(each / KILOPASCAL_PER.mmHg, 0) },
    ),
    horizontal(
      scale(x.low * question.inner, x.high * question.inner, inside.left, inside.right),
      ticks(x.low * question.inner, x.high * question.inner, width > 520 ? 8 : 5),
      inside.bottom,
      { label: "stone diameter, mm" },
    ),
    svg("rect", {
      class: "frame",
      x: inside.left,
      y: inside.top,
      width: inside.right - inside.left,
      height: inside.bottom - inside.top,
    }),
    end < sizes.length - 1 &&
      label(Math.min(x(sizes[end]) + 8, inside.right - 74), inside.bottom - 10, "no answer"),
    lumen > sizes[0] && x(lumen) - inside.left > 44 && label(inside.left + 6, inside.bottom - 10, "not held"),
    svg(
      "g",
      { "clip-path": "url(#curve-clip)" },
      svg("path", { class: "band", d: band(x, y, sizes, pressures, errors) }),
      svg("path", { class: "curve", d: line(points) }),
    ),
    svg("line", {
      class: "limit",
      x1: inside.left,
      x2: inside.right,
      y1: y(question.limit),
      y2: y(question.limit),
    }),
    svg(
      "text",
      { class: "accent halo", x: inside.right - 6, y: y(question.limit) - 6, "text-anchor": "end" },
      `limit ${plain(question.limit, 2)} kPa`,
    ),
    critical !== null &&
      svg("line", {
        class: "limit",
        x1: x(critical),
        x2: x(critical),
        y1: y(question.limit),
        y2: inside.bottom,
      }),
    critical !== null &&
      svg(
        "text",
        {
          class: "accent halo",
          x: Math.min(Math.max(x(critical) + 7, inside.left + 50), inside.right - 110),
          y: inside.bottom - 9,
        },
        `${digits(critical * question.inner, 3)} mm`,
      ),
    point(x, y, ratio, here),
    solved &&
      svg("circle", { class: "point solved", cx: x(ratio), cy: y(solved.critical_pressure_kPa), r: 5 }),
  );
}

function label(x, y, text) {
  return svg("text", { class: "halo", x, y }, text);
}

function point(x, y, ratio, pressure) {
  if (pressure === null || ratio < x.low || ratio > x.high) return null;
  const reading = `${digits(pressure, 3)} kPa`;
  const left = x(ratio) > (x(x.low) + x(x.high)) / 2;
  return svg(
    "g",
    {},
    svg("path", { class: "drop-line", d: `M${x(x.low)} ${y(pressure)}H${x(ratio)}` }),
    svg(
      "text",
      {
        class: "strong halo",
        x: x(ratio) + (left ? -12 : 12),
        y: Math.min(y(pressure) - 9, y(0) - ABOVE_LABELS),
        "text-anchor": left ? "end" : "start",
      },
      reading,
    ),
    svg("circle", { class: "point", cx: x(ratio), cy: y(pressure), r: 7 }),
  );
}

function lastKnown(values) {
  return values.findLastIndex((each) => each !== null);
}

function band(x, y, sizes, pressures, errors) {
  const known = sizes.map((_, k) => k).filter((k) => pressures[k] !== null && errors[k] !== null);
  if (known.length < 2) return "";
  const upper = known.map((k) => [x(sizes[k]), y(pressures[k] + errors[k])]);
  const lower = known.map((k) => [x(sizes[k]), y(Math.max(0, pressures[k] - errors[k]))]).reverse();
  return `${line([...upper, ...lower])}Z`;
}

function described(question, here, critical) {
  const parts = ["Critical pressure over the diameter of the stone."];
  if (here !== null) parts.push(`This stone of ${plain(question.stone)} mm is at ${digits(here, 3)} kPa.`);
  if (critical !== null)
    parts.push(
      `The curve meets the limit of ${plain(question.limit, 2)} kPa at ${digits(critical * question.inner, 3)} mm.`,
    );
  return parts.join(" ");
}
