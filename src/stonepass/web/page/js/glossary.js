// Definitions on demand: a term is a button, and the definition appears beside it.

import { get } from "./api.js";
import { byId, fill, h } from "./dom.js";

let words = null;

/** Return the glossary: definitions by word. It is asked for once. */
export function glossary() {
  words ??= get("glossary").catch((error) => {
    words = null;
    throw error;
  });
  return words;
}

/** Return a word that shows its definition when it is pressed. */
export function term(word, text = word) {
  const button = h("button", { type: "button", class: "term", "aria-haspopup": "dialog" }, text);
  button.addEventListener("click", () => define(word, button));
  return button;
}

async function define(word, beside) {
  const place = byId("definition");
  let found;
  try {
    found = (await glossary())[word];
  } catch (error) {
    found = error.message;
  }
  fill(
    place,
    h("h3", {}, sentence(word).slice(0, -1)),
    h("p", {}, sentence(found ?? "This word is not in the glossary.")),
  );
  place.showPopover();
  const at = beside.getBoundingClientRect();
  const size = place.getBoundingClientRect();
  const left = Math.max(12, Math.min(at.left, window.innerWidth - size.width - 12));
  const below = at.bottom + 8 + size.height < window.innerHeight;
  place.style.left = `${left}px`;
  place.style.top = `${below ? at.bottom + 8 : Math.max(12, at.top - size.height - 8)}px`;
}

/** Return a text that begins with a capital letter and ends with a period. */
export function sentence(text) {
  const whole = text.trim();
  return whole ? whole[0].toUpperCase() + whole.slice(1) + (/[.!?:]$/.test(whole) ? "" : ".") : "";
}
