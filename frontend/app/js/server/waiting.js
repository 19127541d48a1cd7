// @ts-check
// A job that waits for a worker of the server: its place in the queue, in words.

/** @typedef {{before: number, seconds: number}} Waiting */

/** @param {Waiting} waiting */
export function waitingWords({ before, seconds }) {
  const jobs = before === 0
    ? "next in the queue"
    : before === 1
    ? "1 job before it"
    : `${before} jobs before it`;
  return `The server is busy: ${jobs}, starts in about ${Math.max(1, Math.round(seconds))} s.`;
}
