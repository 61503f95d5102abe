// The panel "About": what the page computes and how, what it does not, its sources, and its words.

import { get } from "./api.js";
import { fill, h } from "./dom.js";
import { glossary, sentence } from "./glossary.js";

/** Build the panel. */
export async function aboutPanel(place) {
  const [about, words, limits, materials] = await Promise.all([
    get(""),
    glossary(),
    get("pressure-limits"),
    get("materials"),
  ]);
  fill(
    place,
    h("div", { class: "lead" }, h("h1", {}, "What is computed, and what is not")),
    h(
      "div",
      { class: "halves" },
      h(
        "div",
        { class: "prose" },
        h(
          "p",
          {},
          "A stone that is larger than the opening of the ureter is held by the stretched wall and by friction. Urine collects above it. stonepass computes the urine pressure at which the stone starts to move, with the model of Liu et al. 2022 (doi 10.1016/j.jmbbm.2022.105432), and with a direct model that goes beyond it.",
        ),
        h("h2", {}, "What it does not answer"),
        h(
          "ul",
          {},
          [
            "whether or when a stone passes: the model has no peristalsis, muscle tone, swelling, flow or time",
            "stones with dents, edges or a tilt",
            "what to do: this is a tool for research and not a medical device",
          ].map((each) => h("li", {}, sentence(each))),
        ),
        h("h2", {}, "Two ways to an answer"),
        h(
          "p",
          {},
          "The instant answer comes from polynomials that were fitted to cases solved by finite elements; its error is the claimed difference from such a solve. A solve by finite elements takes seconds, covers every input, and states its discretisation error. Both errors leave out the much larger uncertainty of the inputs: friction between stone and ureter has never been measured.",
        ),
        h("h2", {}, "Materials"),
        h(
          "ul",
          {},
          materials
            .filter((each) => each.stable)
            .map((each) => h("li", {}, `${each.name} (${each.law}): ${each.test}. Source: ${each.source}.`)),
        ),
        h("h2", {}, "Pressure limits"),
        h(
          "ul",
          {},
          limits.map((each) =>
            h("li", {}, `${each.pressure_kPa} kPa: ${each.meaning}. Source: ${each.source}.`),
          ),
        ),
        h("h2", {}, "For programs"),
        h(
          "p",
          {},
          "Every number on this page comes from the HTTP API of the same server. Its description is ",
          h("a", { href: about.links.openapi }, "openapi.json"),
          ".",
        ),
        h("h2", {}, "Privacy and licences"),
        h(
          "p",
          {},
          "The server runs on this computer. Nothing is sent to the internet, and nothing that you enter is stored or logged. stonepass has the BSD-3-Clause licence; the typeface is Inter, with the ",
          h("a", { href: "/assets/fonts/OFL.txt" }, "SIL Open Font Licence"),
          ".",
        ),
        h("p", { class: "quiet" }, `stonepass ${about.version}. ${about.notice}`),
      ),
      h(
        "section",
        { class: "stack-small", "aria-label": "Glossary" },
        h("h2", {}, "Words"),
        h(
          "dl",
          { class: "words-list" },
          Object.entries(words).map(([word, meaning]) =>
            h("div", {}, h("dt", {}, word), h("dd", {}, sentence(meaning))),
          ),
        ),
      ),
    ),
  );
}
