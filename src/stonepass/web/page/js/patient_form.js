// The form of a patient: each measurement has its value and its uncertainty.

import { freshId, h } from "./dom.js";
import { term } from "./glossary.js";
import { plain } from "./units.js";

const PLACES = [
  ["", "not known"],
  ["proximal", "proximal"],
  ["mid", "mid"],
  ["distal", "distal"],
  ["UVJ", "ureterovesical junction"],
];

/** Build the form. `sections()` returns the sections of a patient file. */
export function patientForm(limits, materials) {
  const rows = {
    "stone.diameter": pair("Largest diameter across the ureter", "5", "±", "1", "mm"),
    "ureter.inner_diameter": pair("Inner diameter", "4.4", "±", "0.5", "mm"),
    "ureter.wall_thickness": pair("Wall thickness", "0.7", "±", "0.15", "mm"),
    "dilated.inner_diameter": pair("Inner diameter", "5", "±", "0.5", "mm"),
    "stone.friction": pair("Friction coefficient", "0.05", "to", "0.5", "", "friction coefficient"),
    "ureter.stiffness": pair("Stiffness, multiple of the material", "1", "±", "0.3", "", "stiffness"),
  };
  const place = listed("Place in the ureter", PLACES);
  const material = listed(
    "Material of the wall",
    materials.map((each) => [each.name, `${each.name}, ${each.law}`]),
    "ureter",
  );
  const preset = listed(
    "Pressure limit",
    limits.map((each) => [
      `${plain(each.pressure_kPa, 3)} kPa`,
      `${plain(each.pressure_kPa, 3)} kPa · ${each.meaning}`,
    ]),
    "6 kPa",
  );
  const measured = h("input", { type: "checkbox", id: freshId("check"), checked: true });
  const title = h("input", { class: "text", id: freshId("title"), maxlength: "120", autocomplete: "off" });
  measured.addEventListener("change", () => {
    rows["dilated.inner_diameter"].element.hidden = !measured.checked;
  });
  const element = h(
    "form",
    { class: "inputs-form", "aria-label": "Measurements" },
    group("Stone", rows["stone.diameter"].element, place.element, rows["stone.friction"].element),
    group(
      "Ureter where it is not dilated",
      rows["ureter.inner_diameter"].element,
      rows["ureter.wall_thickness"].element,
      material.element,
      rows["ureter.stiffness"].element,
    ),
    group(
      "Dilated segment above the stone",
      h("div", { class: "row check" }, measured, h("label", { for: measured.id }, "was measured")),
      rows["dilated.inner_diameter"].element,
    ),
    group(
      "Assessment",
      preset.element,
      h(
        "div",
        { class: "field" },
        h("label", { for: title.id }, "Title of the report (optional; no name of a person)"),
        title,
      ),
    ),
  );

  function sections() {
    const found = {
      stone: {},
      ureter: { material: material.box.value },
      assessment: { limit: preset.box.value },
    };
    for (const [key, row] of Object.entries(rows)) {
      const [section, name] = key.split(".");
      if (section === "dilated" && !measured.checked) continue;
      found[section] = { ...found[section], [name]: row.text() };
    }
    if (place.box.value) found.stone.place = place.box.value;
    if (title.value.trim()) found.assessment.title = title.value.trim();
    return found;
  }
  function refuse(field, message) {
    for (const [key, row] of Object.entries(rows)) row.warn(key === field ? message : "");
  }
  return { element, sections, refuse };
}

/** Return the text of a patient file with these sections. */
export function fileText(sections) {
  const order = ["stone", "ureter", "dilated", "assessment"];
  return (
    order
      .filter((each) => sections[each])
      .map(
        (each) =>
          `[${each}]\n${Object.entries(sections[each])
            .map(([name, value]) => `${name} = ${JSON.stringify(value)}`)
            .join("\n")}`,
      )
      .join("\n\n") + "\n"
  );
}

function pair(label, first, word, second, unit, glossed = "") {
  const [one, two, note] = [freshId("first"), freshId("second"), freshId("note")];
  const boxes = [
    [one, first],
    [two, second],
  ].map(([id, value]) =>
    h("input", {
      id,
      value,
      type: "text",
      inputmode: "decimal",
      autocomplete: "off",
      "aria-describedby": note,
    }),
  );
  const warning = h("p", { class: "note", id: note, "data-state": "warning", hidden: true }, h("span"));
  const shown = glossed
    ? [h("label", { for: one, class: "unseen" }, label), term(glossed, label)]
    : h("label", { for: one }, label);
  const element = h(
    "div",
    { class: "pair" },
    h("span", { class: "label" }, shown),
    h("span", { class: "box" }, boxes[0], unit && h("span", { class: "unit", "aria-hidden": "true" }, unit)),
    h(
      "label",
      {
        for: two,
        class: "between",
        "aria-label": `${label}, ${word === "±" ? "standard deviation" : "upper end"}`,
      },
      word,
    ),
    h("span", { class: "box" }, boxes[1], unit && h("span", { class: "unit", "aria-hidden": "true" }, unit)),
    warning,
  );
  const number = (box) =>
    box.value.trim().replace(",", ".") + (unit && /^[\d.,\s]*$/.test(box.value) ? ` ${unit}` : "");
  return {
    element,
    text: () => `${number(boxes[0])} ${word} ${number(boxes[1])}`,
    warn: (text) => {
      warning.hidden = !text;
      warning.firstChild.textContent = text;
    },
  };
}

function listed(label, options, chosen = "") {
  const id = freshId("list");
  const box = h(
    "select",
    { id },
    options.map(([value, text]) => h("option", { value, selected: value === chosen }, text)),
  );
  return { box, element: h("div", { class: "field" }, h("label", { for: id }, label), box) };
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
