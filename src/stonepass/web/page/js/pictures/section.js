// The section through stone and wall, to scale, with the contact pressure drawn on the contact.

import { svg } from "../dom.js";
import { term } from "../glossary.js";
import { decimals, digits, plain } from "../units.js";
import { line, roundUp } from "./axes.js";
import { geometry } from "./shape.js";

const BAR = 0.28; // longest bar of the contact pressure, as a fraction of the half height

const APART = 5; // px between bars

/** Draw the section of a question. */
export function sectionPicture(width, height, { question, section }) {
  const shape = geometry(question, section);
  const half = height / 2;
  const widest = Math.max(question.outer / 2, question.stone / 2, ...shape.outer.map(([, r]) => r));
  const perMm = (half - 26) / (roundUp(1.12 * widest) || 1);
  const x = (z) => width / 2 + z * perMm;
  const y = (r) => half - r * perMm;
  const reach = width / 2 / perMm;
  const inner = extended(shape.inner, reach);
  const outer = extended(shape.outer, reach);
  const top = most(shape.contact);
  const sides = [1, -1];
  return svg(
    "svg",
    { role: "img", "aria-label": described(question, shape) },
    svg("path", { class: "urine", d: urine(inner, shape, x, y) }),
    svg("path", {
      class: "stone",
      d: `${line([...shape.stone, ...mirrored(shape.stone)].map(([z, r]) => [x(z), y(r)]))}Z`,
    }),
    sides.map((side) =>
      svg("path", {
        class: "wall",
        d: `${line([...outer, ...inner.toReversed()].map(([z, r]) => [x(z), y(side * r)]))}Z`,
      }),
    ),
    svg("path", { class: "axis-line", d: `M0 ${half}H${width}` }),
    top > 0 &&
      sides.map((side) =>
        pressureBars(shape.contact, side, { x, y, perMm, length: BAR * half, top: roundUp(top) }),
      ),
    top > 0 && peakLabel(shape.contact, x, y, (BAR * half) / roundUp(top)),
    arrow(18, half, "urine"),
    svg(
      "text",
      { class: "halo", x: width - 12, y: half - 8, "text-anchor": "end" },
      width < 420 ? "bladder" : "to the bladder",
    ),
    scaleBar(width, height, perMm),
  );
}

/** Return the words below the picture. */
export function sectionWords({ question, section, exact }) {
  const shape = geometry(question, section);
  const where = ["Urine presses from the left."];
  if (!shape.deformed)
    return [
      ...where,
      " Stone and ureter are drawn without deformation: there is no solved state for these inputs.",
    ];
  if (!shape.contact.length) return [...where, " The stone does not touch the wall all around."];
  const unloaded = question.model === "direct" ? ", which have no urine pressure" : "";
  const source = exact
    ? [" Solved for exactly these inputs: "]
    : [
        " Interpolated between solved ",
        term("seated state", "seated states"),
        ` with friction 0.5${unloaded}: `,
      ];
  return [
    ...where,
    ...source,
    term("contact pressure"),
    ` up to ${digits(most(shape.contact))} kPa, drawn as bars on the contact.`,
  ];
}

function urine(inner, shape, x, y) {
  const edge = shape.contact[0] ?? touching(inner, shape.stone);
  const upper = [...inner.filter(([z]) => z < edge.z), [edge.z, edge.r]];
  const around = shape.stone.filter(([z]) => z <= edge.z).toReversed();
  const outline = [...upper, ...around, ...mirrored(around), ...mirrored(upper)];
  return `${line(outline.map(([z, r]) => [x(z), y(r)]))}Z`;
}

/** Return the upstream point at which a stone would touch a straight wall, or its pole if it is loose. */
function touching(inner, stone) {
  const found = stone.find(([, r]) => r >= inner[0][1]);
  return found ? { z: found[0], r: inner[0][1] } : { z: stone[0][0], r: inner[0][1] };
}

function pressureBars(contact, side, { x, y, length, top }) {
  const foot = contact.map(({ z, r }) => [x(z), y(side * r)]);
  const tip = contact.map(({ z, r, nz, nr, pressure }) => [
    x(z) + (nz * length * pressure) / top,
    y(side * r) - (side * nr * length * pressure) / top,
  ]);
  const bars = spread(foot)
    .map((k) => line([foot[k], tip[k]]))
    .join("");
  return svg(
    "g",
    {},
    svg("path", { class: "pressure-fill", d: `${line([...foot, ...tip.toReversed()])}Z` }),
    svg("path", { class: "pressure-bars", d: bars + line(tip) }),
  );
}

/** Return indices of points that are at least `APART` from one another along their curve. */
function spread(points) {
  let along = 0;
  return points
    .map((_, k) => k)
    .filter((k) => {
      if (k === 0) return true;
      along += Math.hypot(points[k][0] - points[k - 1][0], points[k][1] - points[k - 1][1]);
      if (along < APART) return false;
      along = 0;
      return true;
    });
}

function peakLabel(contact, x, y, perKilopascal) {
  const peak = contact.reduce((best, each) => (each.pressure > best.pressure ? each : best));
  return svg(
    "text",
    {
      class: "accent halo",
      x: x(peak.z),
      y: Math.max(14, y(peak.r) - perKilopascal * peak.pressure - 8),
      "text-anchor": "middle",
    },
    `${digits(peak.pressure)} kPa`,
  );
}

function extended(points, reach) {
  if (points.length < 2) return points;
  const [first, last] = [points[0], points[points.length - 1]];
  return [[Math.min(-reach, first[0]), first[1]], ...points, [Math.max(reach, last[0]), last[1]]];
}

function mirrored(points) {
  return points.map(([z, r]) => [z, -r]).toReversed();
}

function most(contact) {
  return contact.reduce((best, each) => Math.max(best, each.pressure), 0);
}

function arrow(x, y, text) {
  return svg(
    "g",
    {},
    svg("text", { class: "halo", x, y: y - 8 }, text),
    svg("path", { class: "arrow", d: `M${x} ${y}h36m-6 -4l6 4l-6 4` }),
  );
}

function scaleBar(width, height, perMm) {
  const size = [0.5, 1, 2, 5, 10, 20].find((each) => each * perMm >= 44) ?? 20;
  const x = width - 16 - size * perMm;
  return svg(
    "g",
    {},
    svg("path", {
      class: "scale-bar",
      d: `M${x} ${height - 10}h${size * perMm}m0 -4v8M${x} ${height - 14}v8`,
    }),
    svg(
      "text",
      { class: "halo", x: x + (size * perMm) / 2, y: height - 17, "text-anchor": "middle" },
      `${plain(size)} mm`,
    ),
  );
}

function described(question, shape) {
  const size = `A stone of ${plain(question.stone)} mm in a ureter of ${plain(question.inner)} mm inner and ${plain(question.outer)} mm outer diameter.`;
  const peak = most(shape.contact);
  return peak > 0 ? `${size} The wall presses on it with up to ${decimals(peak, 1)} kPa.` : size;
}
