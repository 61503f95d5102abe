// Faces of the revolved section, their projection, and their colours on a canvas.

const AROUND = 68; // faces around the axis
const CUT = [Math.PI * 0.08, Math.PI * 0.62]; // sector that is cut out, as angles around the axis
const LIGHT = normal([-0.35, 0.8, 0.55]);

/** Return the faces of a shape: corners as [z, y, x] in mm, kind, and pressure from 0 to 1. */
export function faces(shape) {
  const reach = Math.max(...shape.stone.map(([z]) => z)) * 1.9;
  const window = ([z]) => Math.abs(z) <= reach;
  const [inner, outer] = [trimmed(shape.inner, reach), trimmed(shape.outer, reach)];
  const peak = Math.max(1e-9, ...shape.contact.map((each) => each.pressure));
  const pressed = (z) => pressureAt(shape.contact, z) / peak;
  const found = [
    ...revolved(thinned(shape.stone.filter(window), 40), 0, 2 * Math.PI, "stone", pressed),
    ...revolved(inner, CUT[1], CUT[0] + 2 * Math.PI, "inner", pressed),
    ...revolved(outer, CUT[1], CUT[0] + 2 * Math.PI, "outer", () => 0),
  ];
  for (const angle of CUT) {
    for (let k = 1; k < Math.min(inner.length, outer.length); k += 1) {
      found.push({
        kind: "cut",
        pressure: 0,
        corners: [at(inner[k - 1], angle), at(inner[k], angle), at(outer[k], angle), at(outer[k - 1], angle)],
      });
    }
  }
  return { faces: found, size: Math.max(reach, ...outer.map(([, r]) => r)) };
}

/** Return the faces as they are seen, from back to front. */
export function project({ faces: all, size }, { turn, tilt }, canvas) {
  const scale = Math.min(canvas.clientWidth / 2.1, canvas.clientHeight / 1.55) / size;
  const [ct, st, cp, sp] = [Math.cos(turn), Math.sin(turn), Math.cos(tilt), Math.sin(tilt)];
  const seen = ([z, y, x]) => {
    const [u, depth] = [z * ct + x * st, -z * st + x * ct];
    return [u, y * cp - depth * sp, y * sp + depth * cp];
  };
  return all
    .map((face) => {
      const corners = face.corners.map(seen);
      const facing = normal(
        cross(minus(corners[2], corners[0]), minus(corners[3] ?? corners[1], corners[1])),
      );
      const light = Math.abs(facing[0] * LIGHT[0] + facing[1] * LIGHT[1] + facing[2] * LIGHT[2]);
      return {
        ...face,
        light,
        depth: corners.reduce((sum, each) => sum + each[2], 0) / corners.length,
        corners: corners.map(([u, v]) => [
          canvas.clientWidth / 2 + u * scale,
          canvas.clientHeight / 2 - v * scale,
        ]),
      };
    })
    .sort((one, other) => one.depth - other.depth);
}

/** Prepare a canvas for the resolution of the screen and return its empty context. */
export function clear(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
  if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  context.lineJoin = "round";
  return context;
}

/** Return a function from kind, light and pressure to a colour of the present theme. */
export function colours(canvas) {
  const probe = document.createElement("span");
  canvas.after(probe);
  const base = Object.fromEntries(
    [
      ["stone", "--stone"],
      ["inner", "--wall"],
      ["outer", "--wall"],
      ["cut", "--wall-line"],
      ["accent", "--accent"],
    ].map(([kind, name]) => {
      probe.style.color = `var(${name})`;
      return [
        kind,
        getComputedStyle(probe)
          .color.match(/[\d.]+/g)
          .slice(0, 3)
          .map(Number),
      ];
    }),
  );
  probe.remove();
  return (kind, light, pressure) => {
    const strength = kind === "cut" ? 0.9 : 0.55 + 0.5 * light;
    const mixed = base[kind].map(
      (each, k) => (each * (1 - 0.85 * pressure) + base.accent[k] * 0.85 * pressure) * strength,
    );
    return `rgb(${mixed.map((each) => Math.round(Math.min(255, each))).join(" ")})`;
  };
}

function revolved(points, from, to, kind, pressure) {
  const count = Math.ceil((AROUND * (to - from)) / (2 * Math.PI));
  const found = [];
  for (let k = 1; k < points.length; k += 1) {
    for (let j = 0; j < count; j += 1) {
      const [one, other] = [j, j + 1].map((each) => from + ((to - from) * each) / count);
      found.push({
        kind,
        pressure: pressure((points[k - 1][0] + points[k][0]) / 2),
        corners: [at(points[k - 1], one), at(points[k], one), at(points[k], other), at(points[k - 1], other)],
      });
    }
  }
  return found;
}

function at([z, r], angle) {
  return [z, r * Math.sin(angle), r * Math.cos(angle)];
}

function pressureAt(contact, z) {
  if (!contact.length || z < contact[0].z || z > contact[contact.length - 1].z) return 0;
  const k = Math.max(
    1,
    contact.findIndex((each) => each.z >= z),
  );
  const [one, other] = [contact[k - 1], contact[k]];
  return one.pressure + ((z - one.z) / (other.z - one.z || 1)) * (other.pressure - one.pressure);
}

/** Return points at equal distances along z within a window, so that inner and outer wall correspond. */
function trimmed(points, reach) {
  const count = 36;
  return Array.from({ length: count + 1 }, (_, k) => {
    const z = -reach + (2 * reach * k) / count;
    const j = points.findIndex(([each]) => each >= z);
    if (j <= 0) return [z, points[j === 0 ? 0 : points.length - 1][1]];
    const [[z0, r0], [z1, r1]] = [points[j - 1], points[j]];
    return [z, r0 + ((z - z0) / (z1 - z0 || 1)) * (r1 - r0)];
  });
}

function thinned(points, count) {
  const step = Math.max(1, Math.floor(points.length / count));
  return points.filter((_, k) => k % step === 0 || k === points.length - 1);
}

function minus(a, b) {
  return a.map((each, k) => each - b[k]);
}
function cross([a, b, c], [d, e, f]) {
  return [b * f - c * e, c * d - a * f, a * e - b * d];
}
function normal(v) {
  const size = Math.hypot(...v) || 1;
  return v.map((each) => each / size);
}
