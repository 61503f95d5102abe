// Scales, ticks and the frame that the diagrams share.

import { svg } from "../dom.js";
import { plain } from "../units.js";

const MARGIN = { left: 46, right: 50, top: 26, bottom: 40 };

/** Return a linear scale from values to pixels, with its inverse. */
export function scale(low, high, from, to) {
  const at = (value) => from + ((value - low) / (high - low)) * (to - from);
  at.low = low;
  at.high = high;
  at.inverse = (pixel) => low + ((pixel - from) / (to - from)) * (high - low);
  return at;
}

/** Return a logarithmic scale from values to pixels. */
export function logarithmic(low, high, from, to) {
  const linear = scale(Math.log(low), Math.log(high), from, to);
  const at = (value) => linear(Math.log(value));
  at.low = low;
  at.high = high;
  return at;
}

/** Return round numbers between two values, about `count` of them. */
export function ticks(low, high, count = 5) {
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].map((each) => each * power).find((each) => each >= rough * 0.999);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1)
    found.push(Number((k * step).toPrecision(10)));
  return found;
}

/** Return a round number that is at least the given one, from a coarse series, so that axes stay still. */
export function roundUp(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 1.5, 2, 3, 4, 6, 8, 10].map((each) => each * power).find((each) => each >= value);
}

/** Return the places of the diagram inside a canvas of so many pixels. */
export function area(width, height, margin = {}) {
  const kept = { ...MARGIN, ...margin };
  return { left: kept.left, right: width - kept.right, top: kept.top, bottom: height - kept.bottom };
}

/** Draw the axis at the bottom or the top. */
export function horizontal(x, values, y, { label, shown = plain, above = false }) {
  const down = above ? -1 : 1;
  return svg(
    "g",
    { class: "tick" },
    values.map((value) =>
      svg("text", { x: x(value), y: y + down * (above ? 7 : 17), "text-anchor": "middle" }, shown(value)),
    ),
    label &&
      svg(
        "text",
        {
          class: "axis-label",
          x: above ? x(x.high) : (x(x.low) + x(x.high)) / 2,
          y: y + down * (above ? 20 : 35),
          "text-anchor": above ? "end" : "middle",
        },
        label,
      ),
  );
}

/** Draw the axis at the left or at the right; `lines` continues the ticks through the diagram. */
export function vertical(y, values, x, { label, shown = plain, right = false, lines = null }) {
  const side = right ? 1 : -1;
  return svg(
    "g",
    { class: "tick" },
    lines && values.map((value) => svg("line", { x1: lines[0], x2: lines[1], y1: y(value), y2: y(value) })),
    values.map((value) =>
      svg("text", { x: x + side * 8, y: y(value) + 4, "text-anchor": right ? "start" : "end" }, shown(value)),
    ),
    label &&
      svg(
        "text",
        {
          class: "axis-label",
          x: x + side * (right ? -2 : 40),
          y: y(y.high) - 12,
          "text-anchor": right ? "end" : "start",
        },
        label,
      ),
  );
}

/** Return the path through points, broken where a value is missing. */
export function line(points) {
  let text = "";
  let open = false;
  for (const [x, y] of points) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) {
      open = false;
      continue;
    }
    text += `${open ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`;
    open = true;
  }
  return text;
}

/** Return the pattern of areas without an answer; its name must be unique on the page. */
export function hatch(id) {
  return svg(
    "defs",
    {},
    svg(
      "pattern",
      { id, width: 7, height: 7, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
      svg("line", { class: "hatch-line", x1: 0, x2: 0, y1: 0, y2: 7 }),
    ),
  );
}

/**
 * Return `draw(make)`, which draws `make(width, height)` into a canvas, again whenever its size changes.
 *
 * The size is that of the last observation: asking for it would make the browser lay out the page anew.
 */
export function redrawn(canvas) {
  let make = null;
  let size = null;
  const paint = () => {
    if (!make || !size || size[0] < 40) return;
    const [width, height] = size;
    const made = make(width, height);
    made.setAttribute("viewBox", `0 0 ${width} ${height}`);
    if (canvas.firstChild !== made) canvas.replaceChildren(made);
  };
  new ResizeObserver(([{ contentRect }]) => {
    const seen = [Math.round(contentRect.width), Math.round(contentRect.height)];
    if (size && seen[0] === size[0] && seen[1] === size[1]) return;
    size = seen;
    paint();
  }).observe(canvas);
  return (next) => {
    make = next;
    paint();
  };
}

/** Draw a picture that stays as it is into a canvas, again whenever the size changes. */
export function drawn(canvas, make) {
  redrawn(canvas)(make);
}
