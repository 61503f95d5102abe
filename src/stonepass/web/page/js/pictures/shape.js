// Outlines of stone and wall in mm, from the section of an answer, or without deformation.

const ROUND = 96; // number of points of an outline

/**
 * Return the outlines of a question as lists of [z, r] in mm, z downstream from the stone's centre.
 *
 * `contact` has the points of the contact with their outward normal and the pressure in kPa.
 * `deformed` is false if there is no section, and the wall is then drawn as it is without the stone.
 */
export function geometry(question, section) {
  if (!section) return undeformed(question);
  return { ...outlines(section), deformed: true };
}

function undeformed({ stone, inner, outer, aspect }) {
  const half = 2 * Math.max(stone * aspect, outer);
  const wall = (radius) => [[-half, radius], [half, radius]];
  return { stone: spheroid(stone / 2, aspect), inner: wall(inner / 2), outer: wall(outer / 2), contact: [], deformed: false };
}

function spheroid(radius, aspect) {
  return Array.from({ length: ROUND + 1 }, (_, k) => {
    const angle = (Math.PI * k) / ROUND;
    return [-radius * aspect * Math.cos(angle), radius * Math.sin(angle)];
  });
}

function outlines(section) {
  return section;
}
