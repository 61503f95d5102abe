// A bar that shows how far a job is; it runs to and fro while the number of steps is unknown.

import { h } from "./dom.js";

/** Create the bar; it is invisible until `setProgress`, and its place is reserved. */
export function progressBar() {
  return h(
    "div",
    {
      class: "progress",
      role: "progressbar",
      "aria-label": "Progress",
      "aria-valuemin": "0",
      "aria-valuemax": "100",
    },
    h("div"),
  );
}

/** Return the finished part of a job from 0 to 1; 0 if it is unknown. */
export function partOf({ progress }) {
  return progress?.total ? progress.done / progress.total : 0;
}

/** Show a part from 0 to 1; 0 stands for an unknown part, and null hides the bar. */
export function setProgress(bar, part) {
  bar.dataset.state = part === null ? "" : part > 0 ? "running" : "busy";
  bar.firstChild.style.setProperty("--part", String(part || 0));
  if (part > 0) bar.setAttribute("aria-valuenow", String(Math.round(100 * part)));
  else bar.removeAttribute("aria-valuenow");
}
