// @ts-check
// A view whose modules are fetched when it is first shown, so that the page starts without them.
import { h } from "../dom.js";
import { apart } from "../reactive.js";
import { untilLoaded } from "../server/patience.js";

/** @param {() => Promise<() => HTMLElement>} load @returns {() => HTMLElement} builds the element that will hold the view */
export const later = (load) => () => {
  const place = h("div", null, h("p", { class: "loading" }, "Loading…"));
  const say = (/** @type {string} */ text) =>
    place.replaceChildren(h("p", { class: "loading", role: "alert" }, text));
  apart(() =>
    untilLoaded(load, () => say("This view loads when the server answers again.")).then(
      (build) => place.replaceChildren(apart(build)),
      () => say("This view did not load. Reload the page."),
    )
  );
  return place;
};
