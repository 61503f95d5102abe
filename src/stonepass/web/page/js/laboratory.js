// The laboratory: constants of a wall from a test, friction from a micrograph.

import { fill, h } from "./dom.js";
import { fitSection } from "./lab_fit.js";
import { frictionSection } from "./lab_friction.js";

/** Build the panel; `take(values)` takes values over into the calculator. */
export async function laboratoryPanel(place, take) {
  const [fit, friction] = [await fitSection(take), frictionSection(take)];
  fill(
    place,
    h(
      "div",
      { class: "lead" },
      h("h1", {}, "Which wall and which friction do your own measurements suggest?"),
      h(
        "p",
        {},
        "Fit the constants of a wall to a tensile or inflation test, or estimate the friction coefficient from an image of a stone’s surface, and take the result over into the calculator. The files stay on this computer and are dropped after use.",
      ),
    ),
    h("div", { class: "stack lab" }, fit, friction),
  );
}
