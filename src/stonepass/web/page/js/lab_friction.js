// The friction coefficient from an image of a stone's surface.

import { upload } from "./api.js";
import { fill, h } from "./dom.js";
import { dropZone } from "./drop.js";
import { checkField, listField, quantityField, textField } from "./fields.js";
import { sentence } from "./glossary.js";
import { jobRun } from "./job_run.js";
import { labSection } from "./lab_section.js";
import { micrograph } from "./micrograph.js";
import { drawn } from "./pictures/axes.js";
import { spreadPicture } from "./pictures/spread.js";
import { decimals, digits } from "./units.js";

const GONE = 410; // the server has dropped an upload that was not used for a while
const PICTURES = {
  png: "image/png",
  jpg: "image/jpeg",
  jpeg: "image/jpeg",
  tif: "image/tiff",
  tiff: "image/tiff",
};
const ACCEPT = ".png,.jpg,.jpeg,.tif,.tiff,.x3p,.sur,.sdf,.al3d,image/*";

/** Build the section. */
export function frictionSection(take) {
  const results = h("div", { class: "stack" });
  const chosen = h("p", { class: "small quiet chosen", role: "status" }, "No image is chosen.");
  const image = micrograph();
  const pixel = quantityField("Size of a pixel", "µm");
  const heights = listField(
    "Heights are known by",
    [
      ["range", "height from black to white"],
      ["crystal", "edge of the cubic crystals"],
      ["map", "the file, a height map"],
    ],
    "range",
    showHeight,
  );
  const height = quantityField("Height", "µm");
  const area = textField("Area that shows the surface (optional)", "left, top, right, bottom in pixels", () => {
    if (file) choose(file);
  });
  const level = checkField("subtract the least-squares plane of the surface");
  const run = jobRun("Estimate the friction", "An image takes a second or two.");
  let file = null;
  let reading = 0; // counts the uploads; the answer to an earlier one is not used
  let held = null; // what the server says about the uploaded file

  const form = h(
    "form",
    { class: "inputs-form", "aria-label": "Image of a surface" },
    dropZone(
      "Drop a micrograph or a height map",
      "PNG, JPEG, TIFF, X3P and others. Grey is height: black is lowest, white is highest.",
      ACCEPT,
      choose,
    ),
    chosen,
    pixel.element,
    heights.element,
    height.element,
    area.element,
    level.element,
    run.element,
  );
  return labSection({
    title: "Friction of a surface",
    form,
    results,
    expected:
      "The image with the paths along which heights are read (move their ends with the mouse or the arrow keys), the friction coefficient, and how it changes with every choice of the analysis.",
    start,
  });

  async function choose(given) {
    const mine = ++reading;
    let found = null;
    file = given;
    held = null;
    chosen.textContent = `${given.name} is being read.`;
    const ending = given.name.toLowerCase().split(".").pop();
    try {
      found = await upload(
        "friction",
        given,
        PICTURES[ending] ?? "application/octet-stream",
        { format: PICTURES[ending] ? "" : ending, area: area.text() },
      );
    } catch (error) {
      if (mine !== reading) return;
      chosen.textContent = error.message;
      area.mark(error.field === "area");
      return;
    }
    if (mine !== reading) return;
    held = found;
    area.mark(false);
    const { summary } = held;
    chosen.textContent = [
      `${given.name}: ${summary.width} × ${summary.height} pixels.`,
      ...summary.notes.map(sentence),
    ].join(" ");
    if (summary.pixel_um) pixel.box.value = String(Number(summary.pixel_um[0].toPrecision(6)));
    if (summary.heights) heights.box.value = "map";
    showHeight(heights.box.value);
    image.open(held.links.preview, summary.width, summary.height, summary.area);
    fill(results, image.element);
  }
  function showHeight(kind) {
    height.element.hidden = kind === "map";
  }
  async function start() {
    if (!held) {
      chosen.textContent = file ? "This file cannot be used; choose another one." : "Choose an image first.";
      return;
    }
    const body = { kind: "friction", level: level.box.checked };
    if (pixel.text() && !held.summary.heights) body.pixel = pixel.text();
    if (heights.box.value !== "map" && height.text())
      body[heights.box.value === "crystal" ? "crystal" : "height_range"] = height.text();
    const paths = image.paths();
    if (paths) body.path = paths;
    await run.start({ ...body, upload: held.id }, show, (problem) => {
      for (const [name, each] of [
        ["pixel", pixel],
        ["height_range", height],
        ["crystal", height],
      ])
        each.mark(problem.field === name);
      if (problem.status === GONE) choose(file);
    });
  }
  function show(record) {
    const picture = h("div", { class: "canvas" });
    drawn(picture, (width, high) => spreadPicture(width, high, record));
    const sd = record.friction_sd === null ? "" : `± ${digits(record.friction_sd, 2)}`;
    fill(
      results,
      image.element,
      h(
        "div",
        { class: "readings two" },
        h(
          "section",
          { class: "reading" },
          h("h3", {}, "Friction coefficient"),
          h(
            "p",
            { class: "figure" },
            h("span", { class: "big" }, decimals(record.friction_coefficient, 3)),
            h("span", { class: "error" }, sd),
          ),
          h(
            "p",
            { class: "detail" },
            `From the slopes k₀ = ${decimals(record.k0, 3)} and k₁ = ${decimals(record.k1, 3)} of ${record.paths.length} paths of ${digits(record.path_length_um)} µm.`,
          ),
        ),
      ),
      h(
        "figure",
        { class: "picture card" },
        h("h3", {}, "Other choices of the analysis"),
        picture,
        h(
          "figcaption",
          {},
          "Each dot is the friction coefficient with one choice changed; the line is the estimate.",
        ),
      ),
      record.figure_svg &&
        h(
          "figure",
          { class: "picture card" },
          h("h3", {}, "Profiles and slopes"),
          h("img", {
            class: "profile",
            alt: "Mean profile, its baselines and their largest slopes.",
            src: `data:image/svg+xml;charset=utf-8,${encodeURIComponent(record.figure_svg)}`,
          }),
        ),
      record.warnings.length > 0 &&
        h(
          "ul",
          { class: "warnings" },
          record.warnings.map((each) => h("li", {}, sentence(each.sentence))),
        ),
      h(
        "div",
        { class: "row" },
        h(
          "button",
          {
            type: "button",
            class: "button first",
            onclick: () => take({ friction: Number(record.friction_coefficient.toFixed(3)) }),
          },
          "Use this friction in the calculator",
        ),
      ),
    );
  }
}
