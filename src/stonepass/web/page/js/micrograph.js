// An image with straight paths; their ends are moved with the mouse, a finger, or the arrow keys.

import { fill, h, svg } from "./dom.js";

const COUNT = 6; // paths at the start, evenly spaced, as the server chooses them

/** Build the image. `open(address, width, height, area)` shows a picture of so many pixels, of which the area [left, top, right, bottom] is the surface; `paths()` returns the paths, or null if they are unchanged. */
export function micrograph() {
  const frame = h("div", { class: "micrograph" });
  const said = h("p", { class: "small quiet", role: "status" });
  const add = h("button", { type: "button", class: "button small", onclick: addPath }, "Add a path");
  const reset = h(
    "button",
    {
      type: "button",
      class: "button small",
      onclick: () => {
        even();
        draw();
      },
    },
    "Six even paths",
  );
  const element = h(
    "div",
    { class: "stack-small" },
    frame,
    h("div", { class: "row no-print" }, add, reset),
    said,
  );
  let size = null; // [width, height] in pixels
  let area = null; // [left, top, right, bottom] of the surface; right and bottom are excluded
  let address = "";
  let lines = [];
  let moved = false;

  function open(from, width, height, surface) {
    address = from;
    size = [width, height];
    area = surface;
    even();
    draw();
  }
  function even() {
    moved = false;
    const [left, top, right, bottom] = area ?? [0, 0, 0, 0];
    lines = Array.from({ length: COUNT }, (_, k) => {
      const y = Math.round(top + ((k + 0.5) * (bottom - top)) / COUNT - 0.5);
      return [left, y, right - 1, y];
    });
  }
  function addPath() {
    if (!size) return;
    moved = true;
    const [left, top, right, bottom] = area;
    const at = (part) => [left + part * (right - left), top + part * (bottom - top)];
    lines.push([at(0.1)[0], at(0.2)[1], at(0.9)[0], at(0.8)[1]].map(Math.round));
    draw([lines.length - 1, 0]);
    said.textContent = `Path ${lines.length} was added.`;
  }
  function draw(focus = null) {
    if (!size) {
      fill(frame);
      return;
    }
    const [width, height] = size;
    const picture = svg(
      "svg",
      {
        viewBox: `0 0 ${width} ${height}`,
        role: "group",
        "aria-label": "Image with the paths along which heights are read",
      },
      svg("image", { href: address, width, height }),
      lines.map((each) =>
        [["path-halo"], ["path-line"]].map(([name]) =>
          svg("line", { class: name, x1: each[0], y1: each[1], x2: each[2], y2: each[3] }),
        ),
      ),
      lines.map((_, k) => [0, 1].map((end) => handle(k, end))),
    );
    fill(frame, picture);
    if (focus) frame.querySelector(`[data-path="${focus[0]}"][data-end="${focus[1]}"]`)?.focus();
  }
  function handle(k, end) {
    const [x, y] = lines[k].slice(2 * end, 2 * end + 2);
    const radius = Math.max(4, size[0] / 110);
    const circle = svg("circle", {
      class: "handle",
      cx: x,
      cy: y,
      r: radius,
      tabindex: "0",
      role: "button",
      "data-path": k,
      "data-end": end,
      "aria-label": `Path ${k + 1}, ${end ? "end" : "start"}, at x ${Math.round(x)}, y ${Math.round(y)}. Arrow keys move it, Delete removes the path.`,
    });
    circle.addEventListener("keydown", (event) => pressed(event, k, end));
    circle.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      dragged(k, end);
    });
    return circle;
  }
  function pressed(event, k, end) {
    const step = event.shiftKey ? 1 : Math.max(1, Math.round(size[0] / 100));
    const way = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] }[
      event.key
    ];
    if (way) {
      event.preventDefault();
      move(k, end, lines[k][2 * end] + way[0], lines[k][2 * end + 1] + way[1]);
    } else if (event.key === "Delete" && lines.length > 1) {
      moved = true;
      lines.splice(k, 1);
      draw([Math.min(k, lines.length - 1), 0]);
      said.textContent = `Path ${k + 1} was removed.`;
    }
  }
  function dragged(k, end) {
    const follow = (event) => {
      const box = frame.firstChild.getBoundingClientRect();
      move(
        k,
        end,
        ((event.clientX - box.left) / box.width) * size[0],
        ((event.clientY - box.top) / box.height) * size[1],
      );
    };
    const stop = () => {
      window.removeEventListener("pointermove", follow);
      window.removeEventListener("pointerup", stop);
    };
    window.addEventListener("pointermove", follow);
    window.addEventListener("pointerup", stop);
  }
  function move(k, end, x, y) {
    moved = true;
    const [left, top, right, bottom] = area;
    lines[k][2 * end] = Math.round(Math.max(left, Math.min(right - 1, x)));
    lines[k][2 * end + 1] = Math.round(Math.max(top, Math.min(bottom - 1, y)));
    draw([k, end]);
  }
  return { element, open, paths: () => (size && moved ? lines.map((each) => [...each]) : null) };
}
