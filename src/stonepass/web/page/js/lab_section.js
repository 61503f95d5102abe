// The frame of a part of the laboratory: a form beside its results.

import { fill, h } from "./dom.js";

/**
 * Build the frame.
 *
 * `expected` is the sentence that stands in place of the results until there are any; `start()` is
 * called when the form is submitted.
 */
export function labSection({ title, form, results, expected, start }) {
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    start();
  });
  fill(
    results,
    h(
      "div",
      { class: "card empty" },
      h("h3", {}, "What you will see"),
      h("p", { class: "quiet" }, expected),
    ),
  );
  return h(
    "section",
    { class: "stack", "aria-label": title },
    h("h2", {}, title),
    h("div", { class: "columns" }, form, results),
  );
}
