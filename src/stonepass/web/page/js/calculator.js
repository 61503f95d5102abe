// The calculator: inputs, instant answer, pictures, finite elements, and how to repeat them.

import { get, latest } from "./api.js";
import { answerPanel } from "./answer.js";
import { byId, fill, h } from "./dom.js";
import { inputsPanel } from "./inputs.js";
import { picturesPanel } from "./pictures.js";
import { changed, fromQuery, toInstant, toQuery } from "./question.js";
import { repeatPanel } from "./repeat.js";
import { solvePanel } from "./solve.js";

const INCLUDE = ["curve", "map", "section"];
const LINK_DELAY = 300; // ms; browsers refuse to change the address too often

/** Build the panel. Returns `take(values)`, which takes values over from other panels, and `link()`. */
export function calculator(query, showLink) {
  let question = fromQuery(query);
  let found = null;
  let waiting = 0;

  const ask = latest("instant", (asked, answer, problem, more) => {
    if (more && problem) return;
    found = answer ?? found;
    show(answer, problem);
  });
  const inputs = inputsPanel((values) => {
    question = changed(question, values);
    inputs.show(question, found);
    solve.asked(question);
    ask(toInstant(question, INCLUDE));
    clearTimeout(waiting);
    waiting = setTimeout(() => showLink(toQuery(question)), LINK_DELAY);
  });
  const answers = answerPanel();
  const pictures = picturesPanel();
  const solve = solvePanel((solved) => {
    if (found) pictures.show(question, found, solved);
  });
  const repeat = repeatPanel(() => toQuery(question));
  answers.place(solve.element);

  fill(byId("calculator-body"), h("div", { class: "calculator" }, answers.element, inputs.element, pictures.element, repeat.element), answers.pinned);
  inputs.show(question, null);
  solve.asked(question);
  ask(toInstant(question, INCLUDE));
  Promise.all([get("materials"), get("pressure-limits")]).then(([materials, limits]) => {
    inputs.know(materials, limits);
    inputs.show(question, found);
  });

  function show(answer, problem) {
    inputs.show(question, answer, problem);
    answers.show(question, answer, problem);
    if (!answer) return;
    solve.asked(question, answer.answer?.critical_pressure_kPa ?? null);
    pictures.show(question, answer, solve.current());
    repeat.show(question, answer);
    document.documentElement.dataset.answered = String(Number(document.documentElement.dataset.answered ?? 0) + 1);
  }

  return {
    take(values) {
      question = changed(question, values);
      inputs.show(question, found);
      solve.asked(question);
      ask(toInstant(question, INCLUDE));
      showLink(toQuery(question));
    },
    open(text) {
      if (text === toQuery(question)) return;
      question = fromQuery(text);
      inputs.show(question, found);
      solve.asked(question);
      ask(toInstant(question, INCLUDE));
    },
    link: () => toQuery(question),
  };
}
