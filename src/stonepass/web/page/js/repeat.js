// How to repeat the answer without the page: command line, Python, curl, and a link.

import { fill, h, toast } from "./dom.js";

const KINDS = [
  ["command", "Command line"],
  ["python", "Python"],
  ["curl", "curl"],
  ["solve_command", "Finite elements"],
  ["case_file", "Case file"],
];

/** Build the panel. */
export function repeatPanel() {
  let kind = "command";
  let texts = {};
  const code = h("code");
  const copy = h(
    "button",
    { type: "button", class: "button small", onclick: () => copied(code.textContent) },
    "Copy",
  );
  const buttons = KINDS.map(([name, label]) =>
    h(
      "button",
      { type: "button", "aria-pressed": String(name === kind), onclick: () => choose(name) },
      label,
    ),
  );
  const link = h(
    "button",
    { type: "button", class: "button small", onclick: () => copied(window.location.href) },
    "Copy the link",
  );
  const print = h(
    "button",
    { type: "button", class: "button small", onclick: () => window.print() },
    "Print",
  );
  const mark = h("p", { class: "small quiet mark" });
  const element = h(
    "section",
    { class: "more stack-small", "aria-label": "Repeat this answer" },
    h(
      "div",
      { class: "row apart" },
      h("h2", {}, "Repeat this answer"),
      h("div", { class: "row no-print" }, link, print),
    ),
    h(
      "div",
      { class: "row apart no-print" },
      h("div", { class: "choice wrap", role: "group", "aria-label": "Way to repeat the answer" }, buttons),
      copy,
    ),
    h(
      "div",
      { class: "code" },
      h("pre", { tabindex: "0", "aria-label": "Text that repeats the answer" }, code),
    ),
    mark,
  );

  function choose(name) {
    kind = name;
    buttons.forEach((each, k) => each.setAttribute("aria-pressed", String(KINDS[k][0] === name)));
    draw();
  }
  function draw() {
    code.textContent = texts[kind] ?? "There is no instant answer to repeat; choose the finite elements.";
  }
  function show(found) {
    texts = found.repeat ?? {};
    fill(mark, `Fingerprint ${found.fingerprint}, stonepass ${found.version}. ${found.notice}`);
    draw();
  }
  return { element, show };
}

async function copied(text) {
  try {
    await navigator.clipboard.writeText(text);
    toast("Copied.");
  } catch {
    toast("The browser does not allow copying; select the text instead.");
  }
}
