// Reports to print: self-contained HTML, or PDF, written by the server.

import { send } from "./api.js";
import { h } from "./dom.js";

/** Return buttons that save the report of a question; `question()` returns the body of its job. */
export function reportButtons(question) {
  const said = h("span", { class: "small quiet", role: "status" });
  const button = (kind) =>
    h(
      "button",
      { type: "button", class: "button small", onclick: () => save(kind) },
      `Report as ${kind.toUpperCase()}`,
    );
  const buttons = [button("html"), button("pdf")];
  return h("div", { class: "row no-print" }, buttons, said);

  async function save(kind) {
    said.textContent = "The report is being written.";
    for (const each of buttons) each.disabled = true;
    try {
      const answer = await send("report", { kind, question: question() });
      const address = URL.createObjectURL(await answer.blob());
      h("a", { href: address, download: `stonepass-report.${kind}` }).click();
      setTimeout(() => URL.revokeObjectURL(address), 30_000);
      said.textContent = "The report is saved.";
    } catch (error) {
      said.textContent = error.message;
    } finally {
      for (const each of buttons) each.disabled = false;
    }
  }
}
