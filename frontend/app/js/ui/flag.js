// @ts-check
// A remark of an answer: what is wrong, or what is only to be known. Values that no source states are a long list,
// which is folded, so that the remark is one line in every state.
import { h, icon } from "../dom.js";

/** @param {{code: string, message: string}} f @param {boolean} note whether it is about no limit */
export function flag(f, note) {
  const sign = icon(note ? "info" : "warn"), kind = `flag ${note ? "note" : "bad"}`;
  if (f.code !== "unverified") return h("p", { class: kind }, sign, h("span", null, f.message));
  const [of, values] = f.message.split(/: (.*)/s);
  return h(
    "details",
    { class: `${kind} folded` },
    h("summary", null, sign, h("span", null, values ? `${of}: unverified values` : "Unverified values")),
    h("p", null, values ?? of),
  );
}
