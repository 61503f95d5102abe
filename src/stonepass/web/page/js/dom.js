// Elements of HTML and SVG without markup in strings: text from the server can never become markup.

const SVG = "http://www.w3.org/2000/svg";

/** Create an HTML element. Attributes named `on…` with a function are listeners. */
export function h(tag, attributes = {}, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

/** Create an SVG element. */
export function svg(tag, attributes = {}, ...children) {
  return filled(document.createElementNS(SVG, tag), attributes, children);
}

/** Replace all children of an element. */
export function fill(element, ...children) {
  element.replaceChildren(
    ...children.flat(4).filter((each) => each !== null && each !== undefined && each !== false),
  );
  return element;
}

/** Set the text of an element only if it differs, so that live regions stay quiet. */
export function write(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** Return the element with an id; a missing element is an error of the program. */
export function byId(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no element '${id}'`);
  return found;
}

let count = 0;
/** Return an id that no other element has. */
export function freshId(stem) {
  count += 1;
  return `${stem}-${count}`;
}

/** Let the browser save a text as a file. */
export function download(name, text, type) {
  const address = URL.createObjectURL(new Blob([text], { type }));
  h("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

let hiding = 0;
/** Show a short message for three seconds; it is read out by screen readers. */
export function toast(text) {
  const place = byId("toast");
  place.hidden = false;
  place.textContent = text;
  clearTimeout(hiding);
  hiding = setTimeout(() => {
    place.hidden = true;
  }, 3000);
}

function filled(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat(4).filter((each) => each !== null && each !== undefined && each !== false));
  return element;
}
