// @ts-check
// A plot of this view: its element and its chart.
import { h } from "../../../dom.js";
import { Chart } from "../../../plots/chart.js";

/** @typedef {{id: string, title: string, host: HTMLElement, chart: Chart}} Plot */

/** @param {string} id @param {string} title @param {string} label @param {boolean} [small] @returns {Plot} */
export function plot(id, title, label, small) {
  const host = h("div", { class: "plot", id: `run-${id}`, role: "figure", "aria-label": label });
  return { id, title, host, chart: new Chart(host, `run-${id}`, small) };
}
