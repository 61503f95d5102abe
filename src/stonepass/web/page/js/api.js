// The HTTP API of stonepass. The page has no other source of numbers.

const ROOT = "/api/v1";

/** A refused request; `field` is the input that the server names. */
export class Problem extends Error {
  constructor(status, body) {
    super(body.detail || body.title || "The server did not answer.");
    this.status = status;
    this.field = body.field || "";
  }
}

/** Send a request and return the parsed answer; a refusal is thrown as a `Problem`. */
export async function request(path, options = {}) {
  let response;
  try {
    response = await fetch(path.startsWith("/") ? path : `${ROOT}/${path}`, {
      cache: "no-store",
      ...options,
    });
  } catch (error) {
    if (error.name === "AbortError") throw error;
    throw new Problem(0, { detail: "The server does not answer. Start it again with `stonepass serve`." });
  }
  if (response.ok) return response.status === 204 ? null : response;
  const body = await response.json().catch(() => ({}));
  throw new Problem(response.status, body);
}

/** GET a JSON document. */
export async function get(path) {
  return (await request(path)).json();
}

/** POST a JSON document and return the JSON answer. */
export async function post(path, body, signal) {
  return (await send(path, body, signal)).json();
}

/** POST a JSON document and return the response itself. */
export function send(path, body, signal) {
  return request(path, {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(body),
    signal,
  });
}

/** Upload a file as it is; of a surface, `options` may have the `format` of a height map, such as "x3p", and the `area`. */
export async function upload(kind, file, type, options = {}) {
  const query = new URLSearchParams(Object.entries(options).filter(([, value]) => value));
  const sent = await request(`uploads/${kind}?${query}`, {
    method: "POST",
    headers: { "Content-Type": type },
    body: file,
  });
  return sent.json();
}

/**
 * Ask only for the latest of many questions: while one is on its way, later ones replace each other.
 *
 * `bodyOf(question)` is the body of the request. `answered(question, answer, problem, last)` is called
 * for each question that was sent; `last` is true if no other one is waiting.
 */
export function latest(path, bodyOf, answered) {
  let waiting = null;
  let busy = false;
  async function next() {
    while (waiting !== null) {
      const question = waiting;
      waiting = null;
      let answer = null;
      let problem = null;
      try {
        answer = await post(path, bodyOf(question));
      } catch (error) {
        if (!(error instanceof Problem)) throw error;
        problem = error;
      }
      answered(question, answer, problem, waiting === null);
    }
  }
  return async (question) => {
    waiting = question;
    if (busy) return;
    busy = true;
    try {
      await next();
    } finally {
      busy = false;
    }
  };
}
