// The answer in words.

import { decimals, digits, plain } from "./units.js";

/** Return the parts of the sentence about a question: texts, and `{strong}` for emphasis. */
export function verdict(question, found) {
  const { answer } = found;
  const limit = `${plain(question.limit, 2)} kPa`;
  if (!answer || answer.outside)
    return ["There is no instant answer for these inputs. Solve by finite elements instead."];
  const pressure = answer.critical_pressure_kPa;
  if (answer.outcome === "LOOSE")
    return [{ strong: "This stone is not held" }, ": it is not larger than the opening of the ureter."];
  if (answer.outcome === "BEYOND_CLOSURE") {
    const bound = digits(answer.lower_bound_kPa, 3);
    return answer.lower_bound_kPa > question.limit
      ? [
          `At ${limit} `,
          { strong: "this stone does not move" },
          `: it needs more than ${bound} kPa (end of the model).`,
        ]
      : [
          `At ${limit} `,
          { strong: "the paper’s model cannot decide" },
          `: it ends at ${bound} kPa. The direct model goes on.`,
        ];
  }
  if (pressure === null) return [answer.message];
  const error = answer.critical_pressure_error_kPa ?? 0;
  if (Math.abs(pressure - question.limit) <= error) {
    return [
      `At ${limit} `,
      { strong: "the instant answer cannot decide" },
      ": the difference is within its error.",
    ];
  }
  if (pressure < question.limit) {
    return [
      `At ${limit} `,
      { strong: "this stone moves" },
      `: it needs ${digits(pressure, 3)} kPa, which is ${share(pressure / question.limit)} of the limit.`,
    ];
  }
  return [
    `At ${limit} `,
    { strong: "this stone does not move" },
    `: it needs ${digits(pressure, 3)} kPa, which is ${share(pressure / question.limit)} the limit.`,
  ];
}

function share(ratio) {
  return ratio < 1 ? `${decimals(100 * ratio, 0)} %` : `${decimals(ratio, ratio < 10 ? 2 : 0)} times`;
}

/** Return the words of an outcome without a number, for the place of the number. */
export function outcomeWords(record) {
  return (
    {
      LOOSE: "not held",
      BEYOND_CLOSURE: "no answer",
      NO_SOLUTION: "no instant answer",
      BELOW_RANGE: "none",
      BEYOND_RANGE: "no limit found",
      LEAKS: "urine passes first",
    }[record?.outcome] ?? "no instant answer"
  );
}

/** Return the text of the parts of a sentence. */
export function spoken(parts) {
  return parts.map((each) => each.strong ?? each).join("");
}
