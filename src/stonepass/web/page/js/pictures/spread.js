// The friction coefficient for other choices of the analysis.

import { svg } from "../dom.js";
import { decimals } from "../units.js";
import { area, horizontal, scale, ticks } from "./axes.js";

const NAMES = {
  without_one_path: "one path left out",
  baseline_order: "order of the baseline",
  height_range_scaling: "scale of the heights",
  margin: "margin",
};

/** Draw one row of dots for each choice. */
export function spreadPicture(width, height, record) {
  const rows = Object.entries(NAMES)
    .map(([key, name]) => [name, Object.values(record.spread[key] ?? {}).filter((each) => each !== null)])
    .filter(([, values]) => values.length);
  const inside = area(width, height, { left: 16, right: 20, top: 12 });
  const all = [record.friction_coefficient, ...rows.flatMap(([, values]) => values)];
  const room = Math.max(0.02, 0.15 * (Math.max(...all) - Math.min(...all)));
  const x = scale(Math.max(0, Math.min(...all) - room), Math.max(...all) + room, inside.left, inside.right);
  const step = (inside.bottom - inside.top) / Math.max(1, rows.length);
  const here = x(record.friction_coefficient);
  return svg(
    "svg",
    {
      role: "img",
      "aria-label": rows
        .map(
          ([name, values]) =>
            `${name}: ${decimals(Math.min(...values), 3)} to ${decimals(Math.max(...values), 3)}`,
        )
        .join("; "),
    },
    horizontal(x, ticks(x.low, x.high, 5), inside.bottom, { label: "friction coefficient" }),
    svg("line", { class: "limit", x1: here, x2: here, y1: inside.top, y2: inside.bottom }),
    rows.map(([name, values], k) => {
      const y = inside.top + (k + 0.68) * step;
      return svg(
        "g",
        {},
        svg("text", { class: "halo", x: inside.left, y: y - 0.28 * step }, name),
        svg("line", { class: "drop-line", x1: inside.left, x2: inside.right, y1: y, y2: y }),
        values.map((each) => svg("circle", { class: "median", cx: x(each), cy: y, r: 4.5 })),
      );
    }),
  );
}
