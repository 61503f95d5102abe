// A place to drop a file, or to choose one with the keyboard.

import { freshId, h } from "./dom.js";

/** Build the place; `given(file)` receives each file. */
export function dropZone(label, hint, accept, given) {
  const id = freshId("file");
  const input = h("input", { type: "file", id, accept });
  const element = h(
    "div",
    { class: "drop no-print" },
    h("label", { for: id }, h("strong", {}, label)),
    input,
    h("p", { class: "small quiet" }, hint),
  );
  input.addEventListener("change", () => input.files[0] && given(input.files[0]));
  for (const name of ["dragenter", "dragover"]) {
    element.addEventListener(name, (event) => {
      event.preventDefault();
      element.dataset.state = "over";
    });
  }
  element.addEventListener("dragleave", () => {
    element.dataset.state = "";
  });
  element.addEventListener("drop", (event) => {
    event.preventDefault();
    element.dataset.state = "";
    const [file] = event.dataTransfer.files;
    if (file) given(file);
  });
  return element;
}
