// The question of the calculator: its fields, the link that reproduces it, the body of a request.

import { plain, read } from "./units.js";

/**
 * Fields with a slider. `low` to `high` is the range of the slider; the box accepts everything that
 * the server accepts. `input` is the name of the input in case files, `si` the factor to SI units.
 */
export const FIELDS = {
  stone: {
    label: "Diameter across the ureter",
    unit: "mm",
    low: 0.5,
    high: 10,
    step: 0.05,
    input: "stone.diameter",
    si: 1e-3,
    start: 4.2,
  },
  aspect: {
    label: "Length over width",
    unit: "",
    low: 0.5,
    high: 2,
    step: 0.05,
    input: "stone.aspect",
    si: 1,
    start: 1,
  },
  friction: {
    label: "Friction coefficient",
    unit: "",
    low: 0,
    high: 1.2,
    step: 0.01,
    input: "stone.friction",
    si: 1,
    start: 0.5,
  },
  inner: {
    label: "Inner diameter",
    unit: "mm",
    low: 0.5,
    high: 8,
    step: 0.05,
    input: "ureter.inner_diameter",
    si: 1e-3,
    start: 3.5,
  },
  thickness: {
    label: "Wall thickness",
    unit: "mm",
    low: 0.1,
    high: 4,
    step: 0.02,
    input: "ureter.wall_thickness",
    si: 1e-3,
    start: 0.52,
  },
  outer: {
    label: "Outer diameter",
    unit: "mm",
    low: 0.6,
    high: 14,
    step: 0.05,
    input: "ureter.outer_diameter",
    si: 1e-3,
    start: 4.54,
  },
  stiffness: {
    label: "Stiffness, multiple of the material",
    unit: "×",
    low: 0.25,
    high: 4,
    step: 0.01,
    input: "stiffness",
    si: 1,
    start: 1,
    logarithmic: true,
  },
  confining: {
    label: "Confining pressure",
    unit: "kPa",
    low: 0,
    high: 12,
    step: 0.1,
    input: "load.confining_pressure",
    si: 1e3,
    start: 0,
  },
  limit: {
    label: "Pressure limit",
    unit: "kPa",
    low: 0.5,
    high: 20,
    step: 0.1,
    input: "limit",
    si: 1e3,
    start: 6,
  },
};

/** Return the question that is shown first. */
export function firstQuestion() {
  const values = Object.fromEntries(Object.entries(FIELDS).map(([key, field]) => [key, field.start]));
  return { ...values, wall: "thickness", material: "ureter", model: "paper" };
}

/** Return the question with some values changed; both ways to give the wall stay consistent. */
export function changed(question, values) {
  const next = { ...question, ...values };
  if (next.wall === "outer") next.thickness = (next.outer - next.inner) / 2;
  else next.outer = next.inner + 2 * next.thickness;
  return next;
}

/** Return the query of a link that reproduces the question. */
export function toQuery(question) {
  const query = new URLSearchParams();
  for (const [key, field] of Object.entries(FIELDS)) {
    if (key === (question.wall === "outer" ? "thickness" : "outer")) continue;
    query.set(key, plain(question[key], 6) + (field.unit === "×" ? "" : field.unit));
  }
  query.set(
    "material",
    typeof question.material === "string" ? question.material : JSON.stringify(question.material),
  );
  if (question.model !== "paper") query.set("model", question.model);
  return query.toString();
}

/** Return the question of a link; what the link does not have or what cannot be read is as at the start. */
export function fromQuery(text) {
  const query = new URLSearchParams(text);
  const found = {};
  for (const [key, field] of Object.entries(FIELDS)) {
    const value = query.has(key) ? read(query.get(key), field.unit) : null;
    if (value !== null && Number.isFinite(value)) found[key] = value;
  }
  if (query.has("outer")) found.wall = "outer";
  if (query.get("model") === "direct") found.model = "direct";
  if (query.has("material")) found.material = material(query.get("material"));
  return changed(firstQuestion(), found);
}

/** Return the sections of a case file; a solve may have another model than the instant answer. */
export function toCase(question, model = question.model) {
  const wall =
    question.wall === "outer"
      ? { outer_diameter: quantity(question.outer, "mm") }
      : { wall_thickness: quantity(question.thickness, "mm") };
  const found = {
    stone: { diameter: quantity(question.stone, "mm"), friction: question.friction },
    ureter: { inner_diameter: quantity(question.inner, "mm"), ...wall, material: question.material },
    load: { confining_pressure: quantity(question.confining, "kPa") },
  };
  if (question.aspect !== 1) found.stone.aspect = question.aspect;
  if (model !== "paper") found.method = { model };
  return found;
}

/** Return the body of a request for an instant answer. */
export function toInstant(question, include) {
  return {
    case: toCase(question),
    stiffness: question.stiffness,
    limit: quantity(question.limit, "kPa"),
    include,
  };
}

/** Return the text of a number with its unit. */
export function quantity(value, unit) {
  return `${plain(value, 6)} ${unit}`;
}

function material(text) {
  if (!text.startsWith("{")) return text;
  try {
    return JSON.parse(text);
  } catch {
    return "ureter";
  }
}
