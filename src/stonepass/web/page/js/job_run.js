// A button that starts a job, with its progress, a way to cancel it, and the reason if it fails.

import { Problem } from "./api.js";
import { h, write } from "./dom.js";
import { startJob } from "./jobs.js";
import { partOf, progressBar, setProgress } from "./progress.js";

/** Build the button. `start(body, done, refused)` runs a job; `done(result)` receives its result. */
export function jobRun(label, hint) {
  const button = h("button", { type: "submit", class: "button first" }, label);
  const cancel = h("button", { type: "button", class: "button", hidden: true }, "Cancel");
  const progress = progressBar();
  const said = h("p", { class: "small quiet run-note", role: "status" }, hint);
  const element = h("div", { class: "run" }, h("div", { class: "row" }, button, cancel), progress, said);
  let stop = () => {};
  cancel.addEventListener("click", () => stop());
  rest(hint);

  function rest(text, bad = false) {
    button.disabled = false;
    cancel.hidden = true;
    setProgress(progress, null);
    said.dataset.state = bad ? "warning" : "";
    write(said, text);
  }
  function show(text, part) {
    button.disabled = true;
    cancel.hidden = false;
    setProgress(progress, part);
    said.dataset.state = "";
    write(said, text);
  }

  return {
    element,
    async start(body, done, refused = () => {}) {
      const fail = (problem) => {
        rest(problem.message, true);
        refused(problem);
      };
      show("The question is sent.", 0);
      try {
        const begun = startJob(body, (state) => {
          if (state.status === "queued") show("The question is waiting for a free worker.", 0);
          else if (state.status === "running")
            show(state.progress?.sentence || "The question is being answered.", partOf(state));
          else if (state.status === "done") {
            rest("Done.");
            done(state.result);
          } else if (state.status === "cancelled") rest("The work was cancelled.");
          else fail(new Problem(state.problem?.status, state.problem ?? { detail: "The work failed." }));
        });
        stop = begun.stop;
        await begun.accepted;
      } catch (error) {
        if (!(error instanceof Problem)) throw error;
        fail(error);
      }
    },
  };
}
