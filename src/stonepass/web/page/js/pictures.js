// The pictures of the calculator; each is drawn anew with every answer.

import { fill, h, svg } from "./dom.js";
import { term } from "./glossary.js";
import { plain } from "./units.js";
import { redrawn } from "./pictures/axes.js";
import { curvePicture } from "./pictures/curve.js";
import { mapPicture } from "./pictures/map.js";
import { sectionPicture, sectionWords } from "./pictures/section.js";

/** Build the panel of the pictures. */
export function picturesPanel() {
  const section = picture("Section through ureter and stone, to scale", [], "wide");
  const curve = picture(
    ["Size of the stone and ", term("critical pressure")],
    [
      "The thin band is the error of the instant answer. The shaded area holds the stones that move at the limit.",
    ],
  );
  const map = picture(["Thickness of the wall and size"], []);
  const turned = h("div", { class: "canvas", hidden: true });
  const turn = h(
    "button",
    { type: "button", class: "button small no-print", "aria-expanded": "false" },
    "Turn it in 3-D",
  );
  section.tools.append(turn);
  section.body.after(turned);
  let view = null;
  let shown = null;

  turn.addEventListener("click", async () => {
    const open = turned.hidden;
    turned.hidden = !open;
    section.body.hidden = open;
    turn.setAttribute("aria-expanded", String(open));
    turn.textContent = open ? "Show the section" : "Turn it in 3-D";
    if (!open) return;
    const { revolvedView } = await import("./pictures/revolved.js");
    view ??= revolvedView(turned);
    if (shown) view.show(shown);
  });

  const drawMap = mapPicture();
  let known; // the map, which is answered apart from the rest; undefined before the first one
  let latest = null; // question, answer and finite elements of the last drawing

  function show(question, found, solved) {
    latest = { ...found, question, solved };
    shown = { question, section: solved?.section ?? found.section, exact: Boolean(solved?.section) };
    section.draw((width, height) => sectionPicture(width, height, shown));
    fill(section.caption, sectionWords(shown));
    if (view && !turned.hidden) view.show(shown);
    const drawn = latest;
    curve.draw(found.curve ? (width, height) => curvePicture(width, height, drawn) : emptyPicture);
    if (known === undefined) fill(map.caption, mapWords(question));
    drawPoint();
  }
  /** Draw the point of the last question into the map. */
  function drawPoint() {
    const drawn = { ...latest, map: known };
    if (latest && known !== undefined)
      map.draw(known ? (width, height) => drawMap(width, height, drawn) : emptyPicture);
  }
  function showMap(question, answered) {
    known = answered;
    fill(map.caption, mapWords(question));
    drawPoint();
  }
  const element = h(
    "section",
    { class: "pictures", "aria-label": "Pictures" },
    section.element,
    curve.element,
    map.element,
  );
  return { element, show, showMap };
}

function picture(title, caption, size = "") {
  const body = h("div", { class: "canvas" });
  const words = h("figcaption", {}, caption);
  const tools = h("div", { class: "row" });
  const element = h(
    "figure",
    { class: `picture card ${size}` },
    h("div", { class: "head-line" }, h("h2", {}, title), tools),
    body,
    words,
  );
  return { element, body, tools, caption: words, draw: redrawn(body) };
}

function mapWords(question) {
  return [
    `Stones below the thick line move at ${plain(question.limit, 2)} kPa. The thin lines are the `,
    term("critical pressure"),
    " in kPa; ",
    term("wall ratio"),
    " and ",
    term("size ratio"),
    " are outer and stone over inner diameter.",
  ];
}

function emptyPicture(width, height) {
  return svg(
    "svg",
    {},
    svg(
      "text",
      { x: width / 2, y: height / 2, "text-anchor": "middle" },
      "There is no instant answer for these inputs.",
    ),
  );
}
