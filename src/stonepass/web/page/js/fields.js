// Plain fields of a form: text with a unit, a list, a check.

import { freshId, h } from "./dom.js";

/** A field for a quantity; `text()` is the value with its unit, or null if it is empty. */
export function quantityField(label, unit, value = "") {
  const id = freshId("field");
  const box = h("input", { id, value, type: "text", inputmode: "decimal", autocomplete: "off" });
  const frame = h(
    "span",
    { class: "box" },
    box,
    unit && h("span", { class: "unit", "aria-hidden": "true" }, unit),
  );
  const element = h("div", { class: "field" }, h("label", { for: id }, label), frame);
  return {
    element,
    box,
    mark: (bad) => {
      frame.dataset.state = bad ? "bad" : "";
    },
    text: () => {
      const typed = box.value.trim().replace(",", ".");
      if (!typed) return null;
      return unit && /^[\d.eE+-]+$/.test(typed) ? `${typed} ${unit}` : typed;
    },
  };
}

/** A field for text, with an example that is shown while it is empty; `changed` is called when the text has changed. */
export function textField(label, example, changed = () => {}) {
  const id = freshId("text");
  const box = h("input", { id, type: "text", placeholder: example, autocomplete: "off" });
  const frame = h("span", { class: "box" }, box);
  box.addEventListener("change", changed);
  return {
    element: h("div", { class: "field" }, h("label", { for: id }, label), frame),
    mark: (bad) => {
      frame.dataset.state = bad ? "bad" : "";
    },
    text: () => box.value.trim(),
  };
}

/** A field with a list of choices. */
export function listField(label, options, chosen, changed = () => {}) {
  const id = freshId("list");
  const box = h(
    "select",
    { id },
    options.map(([value, text]) => h("option", { value, selected: value === chosen }, text)),
  );
  box.addEventListener("change", () => changed(box.value));
  return { element: h("div", { class: "field" }, h("label", { for: id }, label), box), box };
}

/** A field that is on or off. */
export function checkField(label, on = false) {
  const id = freshId("check");
  const box = h("input", { type: "checkbox", id, checked: on });
  return { element: h("div", { class: "row check" }, box, h("label", { for: id }, label)), box };
}
