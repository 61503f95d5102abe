// The critical pressure over wall ratio and size ratio, with the line of the largest stones that move.

import { svg } from "../dom.js";
import { digits, plain } from "../units.js";
import { area, hatch, horizontal, line, logarithmic, scale, ticks, vertical } from "./axes.js";

const WALL_TICKS = [1.1, 1.3, 1.5, 2, 2.5, 3, 4];
const LEVELS = [1, 2, 4, 6, 8, 10, 12, 16, 20, 30, 50]; // kPa

/**
 * Return a function that draws the map of a question.
 *
 * The ground of the picture is kept while map and size of the canvas stay the same, and only the
 * point of the question moves.
 */
export function mapPicture() {
  let kept = null; // {map, width, height, ground, x, y, inside}
  return (width, height, { map, question, answer }) => {
    if (!kept || kept.map !== map || kept.width !== width || kept.height !== height) {
      kept = { map, width, height, ...ground(width, height, map) };
    }
    const point = here(kept, question, answer);
    kept.picture.lastChild.replaceWith(point);
    return kept.picture;
  };
}

/** Return the picture without the point: shades, lines of equal pressure, the passing line, axes. */
function ground(width, height, map) {
  const inside = area(width, height, { right: 18, top: 26 });
  const walls = map.wall_ratio;
  const sizes = map.size_ratio;
  const x = logarithmic(walls[0], walls[walls.length - 1], inside.left, inside.right);
  const y = scale(Math.max(1, sizes[0]), sizes[sizes.length - 1], inside.bottom, inside.top);
  const ends = map.critical_pressure_kPa.map((row) => lastKnown(row, sizes));
  const levels = LEVELS.map((level) => ({
    level,
    crossings: map.critical_pressure_kPa.map((row, k) => crossing(row, sizes, level, ends[k])),
  })).filter(({ crossings }) => crossings.some((each) => each < sizes[sizes.length - 1]));
  const passing =
    map.critical_size_ratio?.map((each, k) => [
      x(walls[k]),
      each === null || each < y.low ? NaN : y(each),
    ]) ?? [];
  // Under a load smaller stones are held too; the picture begins at the size of the unloaded lumen.
  const column = (values) => walls.map((each, k) => [x(each), y(Math.max(y.low, values[k]))]);
  const picture = svg(
    "svg",
    {
      role: "img",
      "aria-label":
        "Critical pressure over the wall ratio and the size ratio, with the line of the largest stones that move at the limit.",
    },
    hatch("hatch-map"),
    svg("rect", {
      x: inside.left,
      y: inside.top,
      width: inside.right - inside.left,
      height: inside.bottom - inside.top,
      fill: shade(0, levels.length),
    }),
    levels.map(({ crossings }, k) =>
      svg("path", { fill: shade(k + 1, levels.length), d: above(column(crossings), inside.top) }),
    ),
    svg("path", { fill: "var(--raised)", d: above(column(ends), inside.top) }),
    svg("path", { fill: "url(#hatch-map)", d: above(column(ends), inside.top) }),
    svg("path", {
      class: "level",
      d: levels
        .map(({ crossings }) => {
          const drawn = (each, j) => (each < ends[j] && each >= y.low ? each : NaN);
          return line(column(crossings.map(drawn)));
        })
        .join(""),
    }),
    svg("path", { class: "passing", d: line(passing) }),
    spaced(levels.map(({ level, crossings }) => levelLabel(level, crossings, ends, walls, x, y))),
    svg("rect", {
      class: "frame",
      x: inside.left,
      y: inside.top,
      width: inside.right - inside.left,
      height: inside.bottom - inside.top,
    }),
    vertical(y, ticks(y.low, y.high, 5), inside.left, {
      label: "size ratio ξ",
      shown: (each) => each.toFixed(1),
    }),
    horizontal(
      x,
      WALL_TICKS.filter((each) => each >= x.low && each <= x.high),
      inside.bottom,
      { label: "wall ratio η" },
    ),
    svg("g"),
  );
  return { picture, x, y, inside };
}

/** Return the point of a question with its lines to the axes. */
function here({ x, y, inside }, question, answer) {
  const [ratio, wall] = [question.stone / question.inner, question.outer / question.inner];
  if (wall < x.low || wall > x.high || ratio < y.low || ratio > y.high) return svg("g");
  const pressure = answer?.critical_pressure_kPa ?? null;
  const left = x(wall) > (inside.left + 2 * inside.right) / 3;
  return svg(
    "g",
    {},
    svg("path", { class: "drop-line", d: `M${inside.left} ${y(ratio)}H${x(wall)}V${inside.bottom}` }),
    svg("circle", { class: "point", cx: x(wall), cy: y(ratio), r: 7 }),
    pressure !== null &&
      svg(
        "text",
        {
          class: "strong halo",
          x: x(wall) + (left ? -12 : 12),
          y: y(ratio) - 9,
          "text-anchor": left ? "end" : "start",
        },
        `${digits(pressure, 3)} kPa`,
      ),
  );
}

/** Return the size ratio at which a row of pressures crosses a level, by linear interpolation. */
function crossing(row, sizes, level, end) {
  for (let k = 0; k < row.length; k += 1) {
    if (row[k] === null) return Math.max(end, sizes[0]);
    if (row[k] >= level) {
      if (k === 0) return sizes[0];
      return sizes[k - 1] + ((level - row[k - 1]) / (row[k] - row[k - 1])) * (sizes[k] - sizes[k - 1]);
    }
  }
  return sizes[sizes.length - 1];
}

function lastKnown(row, sizes) {
  const k = row.findLastIndex((each) => each !== null);
  return k < 0 ? sizes[0] : sizes[k];
}

function above(points, top) {
  return `${line(points)}L${points[points.length - 1][0].toFixed(1)} ${top}L${points[0][0].toFixed(1)} ${top}Z`;
}

function shade(k, count) {
  return `color-mix(in oklab, var(--heat-1) ${Math.round((88 * k) / Math.max(1, count))}%, var(--heat-0))`;
}

function levelLabel(level, crossings, ends, walls, x, y) {
  const at = walls.findIndex((each) => x(each) > x(x.low) + 22);
  if (crossings[at] >= ends[at] - 1e-9 || crossings[at] <= y.low) return null;
  return { level, x: x(walls[at]), y: y(crossings[at]) + 4 };
}

/** Draw the labels that do not cover one another; they stand in one column, from bottom to top. */
function spaced(labels) {
  let last = Infinity;
  return labels.map((each) => {
    if (!each || last - each.y < 16) return null;
    last = each.y;
    return svg("text", { class: "halo", x: each.x, y: each.y, "text-anchor": "middle" }, plain(each.level));
  });
}
