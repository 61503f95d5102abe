// Outlines of stone and wall in mm, from the section of an answer, or without deformation.

const ROUND = 96; // number of points of an outline

/**
 * Return the outlines of a question as lists of [z, r] in mm, z downstream from the stone's centre.
 *
 * `contact` has the points of the contact with their outward normal and the pressure in kPa.
 * `deformed` is false if there is no section, and the wall is then drawn as it is without the stone.
 */
export function geometry(question, section) {
  return section ? deformed(question.inner / 2, section) : undeformed(question);
}

function undeformed({ stone, inner, outer, aspect }) {
  const half = 2 * Math.max(stone * aspect, outer);
  const wall = (radius) => [
    [-half, radius],
    [half, radius],
  ];
  return {
    stone: spheroid(stone / 2, aspect),
    inner: wall(inner / 2),
    outer: wall(outer / 2),
    contact: [],
    deformed: false,
  };
}

function spheroid(radius, aspect) {
  return Array.from({ length: ROUND + 1 }, (_, k) => {
    const angle = (Math.PI * k) / ROUND;
    return [-radius * aspect * Math.cos(angle), radius * Math.sin(angle)];
  });
}

/** The server gives lengths in inner radii. */
function deformed(radius, section) {
  const points = ({ z, r }) => z.map((each, k) => [radius * each, radius * r[k]]);
  return {
    stone: points(section.stone),
    inner: points(section.inner),
    outer: points(section.outer),
    contact: section.contact ? pressed(points(section.contact), section.contact.pressure_kPa) : [],
    deformed: true,
  };
}

/** Return the points of the contact with the normal of the curve through them, away from the axis. */
function pressed(points, pressures) {
  return points.map(([z, r], k) => {
    const [before, after] = [points[Math.max(0, k - 1)], points[Math.min(points.length - 1, k + 1)]];
    const [dz, dr] = [after[0] - before[0], after[1] - before[1]];
    const size = Math.hypot(dz, dr) || 1;
    return { z, r, nz: -dr / size, nr: dz / size, pressure: pressures[k] };
  });
}
