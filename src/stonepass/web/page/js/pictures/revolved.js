// The section revolved about the axis, with a sector cut out; it can be turned by mouse, finger and keys.
//
// A canvas draws the faces from back to front. This needs no library: plotly.js writes style elements
// into the page, which the strict policy of the server forbids.

import { clear, colours, faces, project } from "./solid.js";
import { h } from "../dom.js";
import { digits } from "../units.js";
import { geometry } from "./shape.js";

const KEYS = { ArrowLeft: [-0.12, 0], ArrowRight: [0.12, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
const START = { turn: -0.62, tilt: 0.36 };

/** Build the view in a container. `show(state)` draws question and section. */
export function revolvedView(container) {
  const canvas = h("canvas", { tabindex: "0", role: "img" });
  const hint = h("p", { class: "unseen", id: "turn-hint" }, "Turn the view with the arrow keys.");
  canvas.setAttribute("aria-describedby", "turn-hint");
  container.replaceChildren(canvas, hint);
  let view = { ...START };
  let solid = null;
  let waiting = false;
  let held = null;

  canvas.addEventListener("pointerdown", (event) => {
    held = [event.clientX, event.clientY];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    move((event.clientX - held[0]) / 160, (event.clientY - held[1]) / 160);
    held = [event.clientX, event.clientY];
  });
  canvas.addEventListener("pointerup", () => {
    held = null;
  });
  canvas.addEventListener("keydown", (event) => {
    if (event.key === "Home") view = { ...START };
    else if (!KEYS[event.key]) return;
    event.preventDefault();
    move(...(KEYS[event.key] ?? [0, 0]));
  });
  new ResizeObserver(later).observe(canvas);
  new MutationObserver(later).observe(document.documentElement, { attributeFilter: ["data-theme"] });

  function move(turn, tilt) {
    view = { turn: view.turn + turn, tilt: Math.max(-1.5, Math.min(1.5, view.tilt + tilt)) };
    later();
  }
  function later() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      draw();
    });
  }
  function draw() {
    if (!solid || canvas.clientWidth < 40) return;
    const context = clear(canvas);
    const shades = colours(canvas);
    for (const face of project(solid, view, canvas)) {
      context.beginPath();
      face.corners.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
      context.closePath();
      const colour = shades(face.kind, face.light, face.pressure);
      context.fillStyle = colour;
      context.strokeStyle = colour;
      context.lineWidth = 0.8;
      context.fill();
      context.stroke();
    }
  }
  return {
    show({ question, section }) {
      const shape = geometry(question, section);
      solid = faces(shape);
      const peak = Math.max(0, ...shape.contact.map((each) => each.pressure));
      canvas.setAttribute(
        "aria-label",
        `Stone and ureter in three dimensions, cut open${peak ? `; contact pressure up to ${digits(peak)} kPa` : ""}.`,
      );
      later();
    },
  };
}
