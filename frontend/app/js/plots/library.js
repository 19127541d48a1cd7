// @ts-check
// The Plotly library (4.8 MB), which the page does not wait for.
import { signal } from "../reactive.js";
import { get } from "../server/client.js";
import { status } from "../store.js";

/** True once Plotly can draw; until then the page is usable without plots. */
export const plotlyReady = signal(false);

/** The Plotly global once its script has arrived. @returns {any} */
export const plotly = () => /** @type {any} */ (globalThis).Plotly;

/** Loads Plotly through a script element added after the first paint: a deferred script in the HTML would
 * delay the modules. */
export async function fetchPlotly() {
  const { plotly: version = "" } = await get("/api/health").catch(() => ({}));
  const script = document.createElement("script");
  script.src = `/vendor/plotly.min.js${version ? `?v=${encodeURIComponent(version)}` : ""}`;
  script.addEventListener("load", () => (plotlyReady.value = true));
  script.addEventListener("error", () => {
    status.value = "The plotting library did not load; numbers and tables work without it.";
  });
  document.head.append(script);
}
