// @ts-check
// A view whose modules are fetched when it is first shown, so that the page starts without them.
import { h } from "../dom.js";
import { apart } from "../reactive.js";

/** @param {() => Promise<() => HTMLElement>} load @returns {() => HTMLElement} builds the element that will hold the view */
export const later = (load) => () => {
  const place = h("div", null, h("p", { class: "loading" }, "Loading…"));
  load().then((build) => place.replaceChildren(apart(build)), () => {
    place.replaceChildren(
      h("p", { class: "loading", role: "alert" }, "This view did not load. Reload the page."),
    );
  });
  return place;
};
