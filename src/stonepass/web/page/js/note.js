// A note of two lines below an input. A longer warning is cut, and a button shows all of it.

import { h, write } from "./dom.js";

const SHORT = 84; // characters that fit into two lines everywhere

/** Build a note; `show(text, warning)` displays the warning if there is one, and else the text. */
export function note(id) {
  const text = h("span", { class: "note-text" });
  const more = h("button", { type: "button", class: "term", "aria-expanded": "false", hidden: true }, "more");
  const element = h("p", { class: "note", id }, text, more);
  more.addEventListener("click", () => open(element.dataset.open !== "true"));

  function open(wide) {
    element.dataset.open = String(wide);
    more.textContent = wide ? "less" : "more";
    more.setAttribute("aria-expanded", String(wide));
  }
  return {
    element,
    show(said, warning = "") {
      element.dataset.state = warning ? "warning" : "";
      more.hidden = warning.length <= SHORT;
      if (more.hidden) open(false);
      write(text, warning || said);
    },
  };
}
