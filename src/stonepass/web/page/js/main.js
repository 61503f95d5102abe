// The start of the page: theme, tabs, and the address that reproduces what is shown.

import { get } from "./api.js";
import { calculator } from "./calculator.js";
import { byId, write } from "./dom.js";

const LATER = {
  patient: () => import("./patient.js").then((each) => each.patientPanel),
  laboratory: () => import("./laboratory.js").then((each) => each.laboratoryPanel),
  about: () => import("./about.js").then((each) => each.aboutPanel),
};
const TABS = ["calculator", ...Object.keys(LATER)];
const opened = new Set(["calculator"]);
let written = ""; // the address that this page has written last, until its event has come

const [firstTab, firstQuery] = address();
const chosen = calculator(firstQuery, (query) => {
  if (address()[0] === "calculator") window.history.replaceState(null, "", `#calculator?${query}`);
});
for (const name of TABS) {
  byId(`tab-${name}`).addEventListener("click", () => go(name));
}
document.querySelector(".tabs").addEventListener("keydown", (event) => {
  const step = { ArrowRight: 1, ArrowLeft: -1, Home: -TABS.length, End: TABS.length }[event.key];
  if (!step) return;
  event.preventDefault();
  const at = TABS.indexOf(address()[0]);
  const next =
    Math.abs(step) > 1 ? (step > 0 ? TABS.length - 1 : 0) : (at + step + TABS.length) % TABS.length;
  go(TABS[next]);
  byId(`tab-${TABS[next]}`).focus();
});
window.addEventListener("hashchange", () => {
  const [tab, query] = address();
  // The event of an address that this page has written comes late: inputs may have changed since.
  if (tab === "calculator" && query && window.location.hash !== written) chosen.open(query);
  written = "";
  show(tab);
});
theme();
show(firstTab);
get("")
  .then((about) => write(byId("version"), `stonepass ${about.version}`))
  .catch(() => {});

/** Return the tab and the query of the address; both stand after "#" and are never sent to a server. */
function address() {
  const [tab, query = ""] = window.location.hash.slice(1).split(/\?(.*)/s);
  return [TABS.includes(tab) ? tab : "calculator", query];
}

function go(name) {
  written = `#${name === "calculator" ? `calculator?${chosen.link()}` : name}`;
  window.location.hash = written;
  show(name);
}

async function show(name) {
  for (const each of TABS) {
    const tab = byId(`tab-${each}`);
    tab.setAttribute("aria-selected", String(each === name));
    tab.tabIndex = each === name ? 0 : -1;
    byId(`panel-${each}`).hidden = each !== name;
  }
  if (opened.has(name)) return;
  opened.add(name);
  const build = await LATER[name]();
  await build(byId(`panel-${name}`), (values) => {
    chosen.take(values);
    go("calculator");
    window.scrollTo(0, 0);
  });
}

function theme() {
  const button = byId("theme");
  const root = document.documentElement;
  const dark = () =>
    root.dataset.theme
      ? root.dataset.theme === "dark"
      : window.matchMedia("(prefers-color-scheme: dark)").matches;
  const tell = () => button.setAttribute("aria-pressed", String(dark()));
  button.addEventListener("click", () => {
    root.dataset.theme = dark() ? "light" : "dark";
    try {
      localStorage.setItem("stonepass-theme", root.dataset.theme);
    } catch {
      // Without storage the choice lasts until the page is closed.
    }
    tell();
  });
  tell();
}
