// A job on the server: asked for, followed by server-sent events, cancelled.

import { get, post, request } from "./api.js";

const ENDED = ["done", "failed", "cancelled"];

/**
 * Start a job and follow it.
 *
 * `told(state)` is called with every state of the job until it has ended. `stop()` cancels the job,
 * also before the server has accepted it; `accepted` is a promise of this moment.
 */
export function startJob(body, told) {
  let cancel = () => {};
  let unwanted = false;
  const accepted = begin(body, told).then((found) => {
    cancel = found;
    if (unwanted) cancel();
  });
  const stop = () => {
    unwanted = true;
    cancel();
  };
  return { stop, accepted };
}

/** Ask for a job and follow it; return a function that cancels it. */
async function begin(body, told) {
  const begun = await post("jobs", body);
  const place = begun.links?.self || `jobs/${begun.id}`;
  let over = false;
  const say = (state) => {
    if (over) return;
    over = ENDED.includes(state.status);
    told(state);
  };
  if (ENDED.includes(begun.status)) {
    say(begun.result === undefined ? await get(place) : begun);
    return () => {};
  }
  say(begun);
  follow(begun.links?.events || `/api/v1/jobs/${begun.id}/events`, place, say, () => over);
  return () => request(place, { method: "DELETE" }).catch(() => {});
}

function follow(events, place, say, isOver) {
  const stream = new EventSource(events);
  const heard = (event) => {
    say(JSON.parse(event.data));
    if (isOver()) stream.close();
  };
  stream.addEventListener("job", heard);
  // A broken stream is not the end of the job: its state is asked for instead.
  stream.onerror = async () => {
    stream.close();
    while (!isOver()) {
      try {
        say(await get(place));
      } catch (error) {
        say({ status: "failed", problem: { detail: error.message } });
      }
      if (!isOver())
        await new Promise((resolve) => {
          setTimeout(resolve, 700);
        });
    }
  };
}
