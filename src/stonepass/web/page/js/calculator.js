// The calculator: inputs, instant answer, pictures, finite elements, and how to repeat them.

import { get, latest } from "./api.js";
import { answerPanel } from "./answer.js";
import { byId, fill, h } from "./dom.js";
import { inputsPanel } from "./inputs.js";
import { picturesPanel } from "./pictures.js";
import { changed, fromQuery, toInstant, toQuery } from "./question.js";
import { repeatPanel } from "./repeat.js";
import { solvePanel } from "./solve.js";

const INCLUDE = ["curve", "section"];
// The map takes the server longer than all the rest. It is asked for when its inputs rest for a
// moment, and at least this often while they change.
const MAP_REST = 80; // ms
const MAP_LONGEST = 300; // ms
const MAP_INPUTS = ["friction", "stiffness", "confining", "material", "limit", "aspect", "model"];
const LINK_DELAY = 300; // ms; browsers refuse to change the address too often

/**
 * Build the panel.
 *
 * Returns `take(values)`, which takes values over from other panels, `open(query)`, which shows the
 * question of a link, and `link()`, the query of the present question.
 */
export function calculator(query, showLink) {
  let question = fromQuery(query);
  let found = null; // the last answer, and the question that it belongs to
  let waiting = 0;
  const root = document.documentElement;

  const ask = latest(
    "instant",
    (asked) => toInstant(asked, INCLUDE),
    (asked, answer, problem, last) => {
      if (answer) found = { asked, answer };
      show(asked, answer, problem);
      root.dataset.answered = "";
      if (last) root.dataset.pending = "0";
    },
  );
  const askMap = latest(
    "instant",
    (asked) => toInstant(asked, ["map"]),
    (asked, answer, problem, last) => {
      if (answer) pictures.showMap(asked, answer.map ?? null);
      if (last) root.dataset.map = "0";
    },
  );
  const mapWhenAtRest = atRest(askMap, (asked) => JSON.stringify(MAP_INPUTS.map((key) => asked[key])));
  const inputs = inputsPanel((values) => {
    renew(changed(question, values));
    clearTimeout(waiting);
    waiting = setTimeout(() => showLink(toQuery(question)), LINK_DELAY);
  });
  const answers = answerPanel();
  const pictures = picturesPanel();
  const solve = solvePanel((solved) => {
    if (found) pictures.show(found.asked, found.answer, solved);
  });
  const repeat = repeatPanel();
  answers.place(solve.element);

  fill(
    byId("calculator-body"),
    h("div", { class: "calculator" }, answers.element, inputs.element, pictures.element, repeat.element),
    answers.pinned,
  );
  renew(question);
  Promise.all([get("materials"), get("pressure-limits")]).then(([materials, limits]) => {
    inputs.know(materials, limits);
    inputs.show(question, found?.answer ?? null);
  });

  function renew(next) {
    question = next;
    root.dataset.pending = "1";
    inputs.show(question, found?.answer ?? null);
    solve.asked(question);
    ask(question);
    if (mapWhenAtRest(question)) root.dataset.map = "1";
  }

  function show(asked, answer, problem) {
    inputs.show(question, answer, problem);
    answers.show(asked, answer, problem);
    if (!answer) return;
    solve.asked(question, answer.answer?.critical_pressure_kPa ?? null);
    pictures.show(asked, answer, asked === question ? solve.current() : null);
    repeat.show(answer);
  }

  return {
    take(values) {
      renew(changed(question, values));
      showLink(toQuery(question));
    },
    open(text) {
      if (text !== toQuery(question)) renew(fromQuery(text));
    },
    link: () => toQuery(question),
  };
}

/**
 * Return a function that passes a question on when its key has changed and then rests for a moment.
 * It returns true if the question will be passed on.
 */
function atRest(pass, keyOf) {
  let passed = null;
  let timer = 0;
  let since = 0;
  return (question) => {
    const key = keyOf(question);
    clearTimeout(timer);
    if (key === passed) {
      since = 0;
      return false;
    }
    if (!since) since = performance.now();
    const rest =
      passed === null ? 0 : Math.max(0, Math.min(MAP_REST, since + MAP_LONGEST - performance.now()));
    timer = setTimeout(() => {
      since = 0;
      passed = key;
      pass(question);
    }, rest);
    return true;
  };
}
