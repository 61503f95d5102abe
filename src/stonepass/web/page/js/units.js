// Numbers and units as people read and type them. The server works in SI units; the page keeps
// lengths in mm and pressures in kPa, and converts at these two doors only.

export const KILOPASCAL_PER = { kPa: 1, Pa: 1e-3, MPa: 1e3, mmHg: 0.133322387415, cmH2O: 0.0980665 };
export const MILLIMETRE_PER = { mm: 1, cm: 10, m: 1e3, um: 1e-3, µm: 1e-3 };

/** Return a number with so many significant digits, without an exponent, with a true minus sign. */
export function digits(value, count = 3) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const places = Math.max(0, Math.min(8, count - 1 - Math.floor(Math.log10(Math.abs(value)))));
  return value.toFixed(places).replace("-", "−");
}

/** Return a number with a fixed number of decimals and a true minus sign. */
export function decimals(value, count) {
  return value === null || value === undefined ? "–" : value.toFixed(count).replace("-", "−");
}

/** Return the shortest text of a number that has at most so many decimals. */
export function plain(value, count = 4) {
  return String(Number(value.toFixed(count)));
}

/** Return a pressure in kPa also in the units of the clinic. */
export function clinical(kilopascal) {
  if (kilopascal === null || kilopascal === undefined) return "";
  return `${digits(kilopascal / KILOPASCAL_PER.mmHg)} mmHg · ${digits(kilopascal / KILOPASCAL_PER.cmH2O)} cmH₂O`;
}

/** Return a number and its error with the decimals that the error justifies. */
export function withError(value, error) {
  if (value === null || value === undefined) return ["–", ""];
  if (!error) return [digits(value, 4), ""];
  const places = Math.max(0, Math.min(4, 1 - Math.floor(Math.log10(error))));
  const kept = Math.min(places, Math.max(0, 3 - Math.floor(Math.log10(Math.abs(value) || 1))));
  return [decimals(value, kept), `± ${digits(Number(error.toPrecision(1)), 1)}`];
}

/**
 * Read a number with an optional unit, as a person types it: "4,2", "0.42 cm", "61 cmH2O".
 * Returns the number in the default unit, or null if it cannot be read.
 */
export function read(text, unit) {
  const parts = /^\s*([+]?\d*[.,]?\d+(?:e[+-]?\d+)?|\d+[.,]?)\s*([a-zA-Zµ₂²0-9]*)\s*$/.exec(text);
  if (!parts) return null;
  const number = Number(parts[1].replace(",", "."));
  const given = parts[2].replace("₂", "2");
  if (!given) return number;
  const factors = unit === "kPa" ? KILOPASCAL_PER : unit === "mm" ? MILLIMETRE_PER : {};
  const known = Object.keys(factors).find(
    (each) =>
      each.toLowerCase() === given.toLowerCase() &&
      (each === given || !["mpa", "m"].includes(given.toLowerCase())),
  );
  return known ? number * factors[known] : null;
}
