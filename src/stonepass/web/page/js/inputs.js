// The inputs of the calculator: stone, ureter, load, limit, each with its valid range and its note.

import { control } from "./control.js";
import { fill, freshId, h } from "./dom.js";
import { sentence } from "./glossary.js";
import { note } from "./note.js";
import { FIELDS } from "./question.js";
import { clinical, decimals, digits, plain } from "./units.js";

const FRENCH = 3; // 1 mm of diameter is 3 French
// Words of the glossary that belong to a label.
const WORDS = {
  aspect: "aspect",
  friction: "friction coefficient",
  stiffness: "stiffness",
  confining: "confining pressure",
  limit: "pressure limit",
};
// Inputs that a warning may name although no slider has exactly this name.
const ALSO = { "stone.size_ratio": "stone", "ureter.wall_ratio": "thickness", "stone.shape": "aspect" };

const MODEL_NOTES = {
  paper: "The paper’s balance of the seated contact, with its closure",
  direct: "Wall and stone under the urine pressure, without a closure",
};

// Warnings that the verdict explains in full.
const SHORTER = { no_surrogate: "No instant answer for this input. Solve by finite elements instead." };

/** Build the inputs; `given(values)` is called with every change. */
export function inputsPanel(given) {
  const controls = Object.fromEntries(
    Object.entries(FIELDS).map(([key, field]) => [
      key,
      control(field, (value) => given({ [key]: value }), { word: WORDS[key] }),
    ]),
  );
  const wall = choice(
    "Wall is given by",
    [
      ["thickness", "thickness"],
      ["outer", "outer diameter"],
    ],
    (value) => given({ wall: value }),
  );
  const model = choice(
    "Model of the instant answer",
    [
      ["paper", "paper"],
      ["direct", "direct"],
    ],
    (value) => given({ model: value }),
  );
  const modelNote = note(freshId("note"));
  const materials = select("Material of the wall", (value) => given({ material: value }));
  const presets = select("Published limits", (value) => value && given({ limit: Number(value) }));
  const source = note(freshId("note"));
  let known = { materials: [], limits: [] };
  let own = null; // constants taken over from the laboratory

  const element = h(
    "form",
    { class: "inputs", "aria-label": "Inputs" },
    group("Stone", controls.stone.element, controls.aspect.element, controls.friction.element),
    group(
      "Ureter",
      controls.inner.element,
      wall.element,
      controls.thickness.element,
      controls.outer.element,
      materials.element,
      controls.stiffness.element,
    ),
    group("Load", controls.confining.element),
    group("Limit", controls.limit.element, presets.element, source.element),
    group("Model", model.element, modelNote.element),
  );
  element.addEventListener("submit", (event) => event.preventDefault());

  function know(catalogue, limits) {
    known = { materials: catalogue, limits };
    drawMaterials();
    presets.offer([
      ["", "choose a published limit"],
      ...known.limits.map((each) => [
        plain(each.pressure_kPa, 3),
        `${plain(each.pressure_kPa, 2)} kPa · ${each.meaning}`,
      ]),
    ]);
  }
  function drawMaterials() {
    const offered = known.materials
      .filter((each) => each.stable)
      .map((each) => [each.name, `${each.name}, ${each.law}${each.instant ? "" : " (no instant answer)"}`]);
    if (own) offered.push([JSON.stringify(own), `own constants · ${own.law ?? own.name}`]);
    materials.offer(offered);
  }

  function show(question, found, problem) {
    if (typeof question.material !== "string" && question.material !== own) {
      own = question.material;
      drawMaterials();
    }
    const said = notes(question);
    const ranges = validRanges(question, found);
    const warned = warnings(found, problem);
    for (const [key, each] of Object.entries(controls)) {
      const range = ranges[key];
      const outside =
        range && found && (question[key] < range.low * (1 - 1e-9) || question[key] > range.high * (1 + 1e-9));
      const short = outside ? outsideWords(range, FIELDS[key].unit) : "";
      each.show(question[key], range, said[key], short || warned[key] || "");
    }
    controls.thickness.element.hidden = question.wall === "outer";
    controls.outer.element.hidden = question.wall !== "outer";
    wall.show(question.wall);
    model.show(question.model);
    modelNote.show(MODEL_NOTES[question.model], warned.model ?? "");
    materials.show(
      typeof question.material === "string" ? question.material : JSON.stringify(question.material),
    );
    materials.warn(warned.material ?? "");
    const preset = known.limits.find((each) => Math.abs(each.pressure_kPa - question.limit) < 1e-6);
    presets.show(preset ? plain(preset.pressure_kPa, 3) : "");
    source.show(preset ? sentence(preset.source) : "Your own limit, without a published source.");
  }
  return { element, show, know };
}

function notes(question) {
  const { stone, inner, outer, thickness } = question;
  const wall = `Wall ratio η = ${decimals(outer / inner, 3)}`;
  return {
    stone: `Size ratio ξ = ${decimals(stone / inner, 3)}, ${digits(FRENCH * stone)} French`,
    aspect:
      question.aspect === 1
        ? "A sphere"
        : question.aspect > 1
          ? "Longer along the ureter than across it"
          : "Shorter along the ureter than across it",
    friction:
      "Never measured between a stone and a ureter; 0.5 is the paper’s estimate, wet tissue measures less",
    inner: `${digits(FRENCH * inner)} French, without stone and pressure`,
    thickness: `${wall}, outer diameter ${digits(outer)} mm`,
    outer: `${wall}, wall thickness ${digits(thickness)} mm`,
    stiffness: "1 is the material as published; it varies between people",
    confining: `On the outer wall: ${clinical(question.confining) || "0 mmHg"}`,
    limit: clinical(question.limit),
  };
}

/** Return the valid ranges in the units of the fields; null where no value is valid. */
function validRanges(question, found) {
  const ranges = {};
  const given = found?.validity ?? {};
  for (const [key, { input, si }] of Object.entries(FIELDS)) {
    const each = given[input];
    ranges[key] = each
      ? { low: each.low / si, high: each.high / si }
      : found
        ? null
        : { low: FIELDS[key].low, high: FIELDS[key].high };
  }
  const [sizes, walls] = [given["stone.size_ratio"], given["ureter.wall_ratio"]];
  if (sizes && walls) ranges.inner = innerRange(question, sizes.high, walls);
  if (walls) {
    ranges.outer ??= { low: walls.low * question.inner, high: walls.high * question.inner };
    ranges.thickness ??= {
      low: ((walls.low - 1) * question.inner) / 2,
      high: ((walls.high - 1) * question.inner) / 2,
    };
  }
  ranges.aspect = found?.answer || given["stone.aspect"] === undefined ? { low: 1, high: 1 } : ranges.aspect;
  ranges.limit = { low: FIELDS.limit.low, high: FIELDS.limit.high };
  return ranges;
}

function innerRange({ stone, wall, outer, thickness }, largest, walls) {
  const [low, high] =
    wall === "outer"
      ? [outer / walls.high, outer / walls.low]
      : [(2 * thickness) / (walls.high - 1), (2 * thickness) / (walls.low - 1)];
  return { low: Math.max(low, stone / largest), high };
}

/** Return the first warning of each field; a refused input is a warning too. */
function warnings(found, problem) {
  const warned = {};
  const keyOf = (input) =>
    Object.keys(FIELDS).find((key) => FIELDS[key].input === input) ??
    ALSO[input] ??
    { "ureter.material": "material", "method.model": "model" }[input] ??
    "";
  for (const each of found?.warnings ?? [])
    warned[keyOf(each.input)] ??= SHORTER[each.code] ?? sentence(each.sentence);
  if (problem?.field) warned[keyOf(problem.field)] = sentence(problem.message);
  return warned;
}

function outsideWords({ low, high }, unit) {
  const valid = low === high ? digits(low) : `${digits(low)} to ${digits(high)}`;
  return `The instant answer covers ${valid}${space(unit)} only. Solve by finite elements instead.`;
}

function space(unit) {
  return unit ? ` ${unit}` : "";
}

function group(title, ...children) {
  const id = freshId("group");
  return h(
    "div",
    { class: "group", role: "group", "aria-labelledby": id },
    h("h2", { class: "title", id }, title),
    children,
  );
}

function select(label, given) {
  const id = freshId("select");
  const box = h("select", { id });
  const below = note(freshId("note"));
  const element = h("div", { class: "field" }, h("label", { for: id }, label), box, below.element);
  below.element.hidden = true;
  box.addEventListener("change", () => given(box.value));
  return {
    element,
    offer: (options) =>
      fill(
        box,
        options.map(([value, text]) => h("option", { value }, text)),
      ),
    show: (value) => {
      box.value = value;
    },
    warn: (text) => {
      below.element.hidden = !text;
      below.show("", text);
    },
  };
}

function choice(label, options, given) {
  const buttons = options.map(([value, text]) =>
    h("button", { type: "button", "aria-pressed": "false", onclick: () => given(value) }, text),
  );
  const element = h(
    "div",
    { class: "row apart" },
    h("span", { class: "small quiet" }, label),
    h("div", { class: "choice", role: "group", "aria-label": label }, buttons),
  );
  return {
    element,
    show: (value) =>
      buttons.forEach((each, k) => each.setAttribute("aria-pressed", String(options[k][0] === value))),
  };
}
