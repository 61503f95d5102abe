// Pictures of an assessment: intervals of pressures, fractions by size, sensitivity.

import { svg } from "../dom.js";
import { decimals, digits, plain } from "../units.js";
import { area, horizontal, line, roundUp, scale, ticks, vertical } from "./axes.js";

/** Draw the intervals of the critical and the present pressure beside the limit. */
export function rangesPicture(width, height, record) {
  const rows = [
    ["critical pressure", record.critical_pressure_kPa],
    ["present pressure", record.present_pressure_kPa],
  ].filter(([, range]) => range);
  const limit = record.inputs.limit_kPa;
  const most = Math.max(2 * limit, ...rows.map(([, range]) => 1.25 * (range.median ?? 0)));
  const ends = rows.map(([, range]) => range.high ?? range.at_least ?? 0);
  const inside = area(width, height, { left: 16, right: 24, top: 28 });
  const x = scale(0, roundUp(Math.min(Math.max(...ends, most), 3 * most)), inside.left, inside.right);
  const step = (inside.bottom - inside.top) / rows.length;
  return svg(
    "svg",
    {
      role: "img",
      "aria-label": rows.map(([name, range]) => `${name}: median ${digits(range.median)} kPa`).join("; "),
    },
    ticks(0, x.high, 6).map((each) =>
      svg(
        "g",
        { class: "tick" },
        svg("line", { x1: x(each), x2: x(each), y1: inside.top, y2: inside.bottom }),
      ),
    ),
    horizontal(x, ticks(0, x.high, width > 520 ? 8 : 5), inside.bottom, { label: "kPa" }),
    rows.map(([name, range], k) => row(name, range, x, inside.top + (k + 0.5) * step)),
    svg("line", { class: "limit", x1: x(limit), x2: x(limit), y1: inside.top - 6, y2: inside.bottom }),
    svg("text", { class: "accent halo", x: x(limit) + 6, y: inside.top - 8 }, `limit ${plain(limit, 2)} kPa`),
  );
}

function row(name, range, x, y) {
  const [low, high] = [range.low ?? 0, range.high ?? x.high];
  const beyond = range.high === null || range.high > x.high;
  const end = Math.min(x(high), x(x.high));
  return svg(
    "g",
    {},
    svg("text", { class: "halo", x: x(0), y: y - 16 }, name),
    svg("line", { class: "range", x1: x(low), x2: end, y1: y, y2: y }),
    beyond && svg("path", { class: "arrow", d: `M${end + 4} ${y - 5}l6 5l-6 5` }),
    range.median !== null &&
      range.median <= x.high &&
      svg("circle", { class: "median", cx: x(range.median), cy: y, r: 6 }),
    range.median !== null &&
      svg(
        "text",
        { class: "strong halo", x: x(Math.min(range.median, x.high)), y: y + 24, "text-anchor": "middle" },
        digits(range.median),
      ),
  );
}

/** Draw the fraction of cases in which a stone moves below the limit, over its diameter. */
export function sizesPicture(width, height, record) {
  const inside = area(width, height, { right: 20 });
  const sizes = record.by_size.map((each) => each.diameter_mm);
  if (!sizes.length) return svg("svg", {});
  const x = scale(0, sizes[sizes.length - 1], inside.left, inside.right);
  const y = scale(0, 1, inside.bottom, inside.top);
  const path = (key) => record.by_size.map((each) => [x(each.diameter_mm), y(each[key])]);
  const measured = record.inputs.measured.stone_diameter.value * 1e3;
  return svg(
    "svg",
    {
      role: "img",
      "aria-label":
        "Fraction of the simulated cases in which a stone moves below the limit, over its diameter.",
    },
    vertical(y, [0, 0.25, 0.5, 0.75, 1], inside.left, {
      label: "fraction of the cases",
      shown: (each) => `${decimals(100 * each, 0)}%`,
      lines: [inside.left, inside.right],
    }),
    horizontal(x, ticks(0, x.high, 5), inside.bottom, { label: "stone diameter, mm" }),
    svg("path", { class: "band", d: `${line([...path("high"), ...path("low").reverse()])}Z` }),
    svg("path", { class: "curve", d: line(path("low")) }),
    svg("path", { class: "curve", d: line(path("high")) }),
    svg("line", { class: "limit", x1: x(measured), x2: x(measured), y1: inside.top, y2: inside.bottom }),
    svg("text", { class: "accent halo", x: x(measured) + 6, y: inside.top + 12 }, "this stone"),
  );
}

/** Draw horizontal bars of numbers by name. */
export function barsPicture(width, height, entries) {
  const inside = area(width, height, { left: 12, right: 44, top: 10, bottom: 10 });
  const step = (inside.bottom - inside.top) / Math.max(1, entries.length);
  const x = scale(0, Math.max(1, ...entries.map(([, value]) => value)), inside.left, inside.right);
  return svg(
    "svg",
    {
      role: "img",
      "aria-label": entries.map(([name, value]) => `${name} ${decimals(100 * value, 0)} %`).join(", "),
    },
    entries.map(([name, value], k) => {
      const y = inside.top + k * step;
      return svg(
        "g",
        {},
        svg("text", { x: inside.left, y: y + 0.38 * step }, name),
        svg("rect", {
          class: "bar",
          x: inside.left,
          y: y + 0.48 * step,
          height: Math.max(4, 0.26 * step),
          width: Math.max(1.5, x(Math.max(0, value)) - inside.left),
          rx: 2,
        }),
        svg(
          "text",
          { class: "strong", x: Math.max(x(Math.max(0, value)), inside.left) + 8, y: y + 0.7 * step },
          `${decimals(100 * value, 0)} %`,
        ),
      );
    }),
  );
}
