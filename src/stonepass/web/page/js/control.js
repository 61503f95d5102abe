// A slider with a box: the range in which the instant answer is valid, and a note or a warning.

import { freshId, h } from "./dom.js";
import { note } from "./note.js";
import { plain, read } from "./units.js";
import { term } from "./glossary.js";

const EDGE = 5; // px by which the valid range is drawn wider, so that a single value is seen

/**
 * Create the control of a field.
 *
 * `given(value)` is called while the slider moves or a readable number is typed. `show(value, range,
 * note, warning)` displays a value; `range` is `{low, high}` in the unit of the field, or null if the
 * instant answer is valid nowhere.
 */
export function control(field, given, { word = "" } = {}) {
  const [boxId, noteId] = [freshId("box"), freshId("note")];
  const box = h("input", {
    id: boxId,
    type: "text",
    inputmode: "decimal",
    autocomplete: "off",
    spellcheck: "false",
    "aria-describedby": noteId,
  });
  const frame = h(
    "span",
    { class: "box" },
    box,
    h("span", { class: "unit", "aria-hidden": "true" }, field.unit),
  );
  const slider = h("input", {
    type: "range",
    class: "slider",
    "aria-label": `${field.label}, slider`,
    "aria-describedby": noteId,
  });
  const below = note(noteId);
  const label = word
    ? h(
        "span",
        { class: "label" },
        h("label", { for: boxId, class: "unseen" }, field.label),
        term(word, field.label),
      )
    : h("label", { for: boxId }, field.label);
  const element = h("div", { class: "control" }, label, frame, slider, below.element);
  let current = field.start;
  let shown = "";

  slider.addEventListener("input", () => given(fromSlider(field, Number(slider.value))));
  box.addEventListener("input", () => {
    const value = read(box.value, field.unit);
    frame.dataset.state = value === null ? "bad" : "";
    if (value !== null) given(value);
  });
  box.addEventListener("focus", () => box.select());
  box.addEventListener("blur", () => {
    frame.dataset.state = "";
    box.value = plain(current);
  });
  box.addEventListener("keydown", (event) => {
    const steps = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
    if (event.key === "Enter") box.select();
    if (!steps) return;
    event.preventDefault();
    given(Math.max(0, Number((current + steps * field.step).toFixed(6))));
    box.value = plain(current);
  });

  function show(value, range, said, warning) {
    current = value;
    const [low, high] = [Math.min(field.low, value), Math.max(field.high, value)];
    const unit = field.logarithmic ? Math.log : (each) => each;
    const from = range ? place(unit(range.low), unit(low), unit(high), -EDGE) : "0%";
    const to = range ? place(unit(range.high), unit(low), unit(high), EDGE) : "0%";
    // Most of the controls stay as they are while one of them moves.
    const state = [value, low, high, from, to, said, warning].join("|");
    if (document.activeElement !== box) box.value = plain(value);
    if (state === shown) return;
    shown = state;
    slider.min = unit(low);
    slider.max = unit(high);
    slider.step = field.logarithmic ? 0.01 : field.step / 5;
    slider.value = unit(value);
    slider.setAttribute("aria-valuetext", `${plain(value)} ${field.unit}`.trim());
    slider.dataset.state = warning ? "outside" : "";
    slider.style.setProperty("--low", from);
    slider.style.setProperty("--high", to);
    below.show(said, warning);
  }
  return { element, show, box, slider };
}

function fromSlider(field, at) {
  const value = field.logarithmic ? Math.exp(at) : at;
  return Number((Math.round(value / field.step) * field.step).toFixed(6));
}

/** Return the place of a value on the track; the centre of the thumb never reaches the ends. */
function place(value, low, high, edge) {
  const part = Math.max(0, Math.min(1, (value - low) / (high - low || 1)));
  return `calc(${10 + edge}px + (100% - 20px) * ${part.toFixed(4)})`;
}
