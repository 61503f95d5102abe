// Measured points and the fitted law.

import { svg } from "../dom.js";
import { area, horizontal, line, scale, ticks, vertical } from "./axes.js";

/** Draw the points of a fit and the law through them. */
export function fitPicture(width, height, record) {
  const points = record.inputs.data;
  const values = points.flatMap((each) => [each.observed_kPa, each.predicted_kPa]);
  const stretches = points.map((each) => each.stretch);
  const inside = area(width, height, { right: 20 });
  const x = scale(Math.min(1, ...stretches), Math.max(...stretches), inside.left, inside.right);
  const y = scale(Math.min(0, ...values), 1.06 * Math.max(...values), inside.bottom, inside.top);
  const groups = [...new Set(points.map((each) => each.group))];
  return svg(
    "svg",
    { role: "img", "aria-label": `Measured ${record.measured} and the fitted law over the stretch.` },
    vertical(y, ticks(y.low, y.high, 5), inside.left, {
      label: `${record.measured}, kPa`,
      lines: [inside.left, inside.right],
    }),
    horizontal(x, ticks(x.low, x.high, 6), inside.bottom, { label: "stretch" }),
    svg("rect", {
      class: "frame",
      x: inside.left,
      y: inside.top,
      width: inside.right - inside.left,
      height: inside.bottom - inside.top,
    }),
    groups.map((group) => {
      const own = points
        .filter((each) => each.group === group)
        .sort((one, other) => one.stretch - other.stretch);
      return svg("path", {
        class: "fitted",
        d: line(own.map((each) => [x(each.stretch), y(each.predicted_kPa)])),
      });
    }),
    points.map((each) =>
      svg("circle", { class: "datum", cx: x(each.stretch), cy: y(each.observed_kPa), r: 3.2 }),
    ),
  );
}
