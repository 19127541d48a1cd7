// @ts-check
// Exports of this view: data with residuals, plots, the report, the model for the Design view.
import { units } from "../../state.js";
import { openDesign } from "../../muscle/document.js";
import { ApiError, post, postForText } from "../../server/client.js";
import { scaleOf, toShown } from "../../format.js";
import { status } from "../../store.js";
import { saveSheet } from "../../plots/export.js";
import { downloadText, fileName, toCsv } from "../../ui/table.js";
import { openTakeAlong } from "../../ui/take-along.js";
import { answer, compare, diagnosis, files, preset } from "./answers.js";
import { freeOfOther } from "./document.js";
import { effectValues } from "../../muscle/preset.js";
import { presetDialog } from "../../muscle/preset-dialog.js";
import { overlays } from "./where/overlay.js";
import { allSeries } from "./where/pictures.js";
import { modelBody, used } from "./request.js";
import { chart as residual, TITLE } from "./where/residual.js";
import { channelScale, titleOf, VARIABLES } from "./words.js";

/** Every point with its residual, in shown units. @param {import("./types.js").Comparison} a
 * @returns {import("../../ui/table.js").Table} */
function residualTable(a) {
  const system = units.peek(), all = allSeries(a);
  const names = Object.keys(VARIABLES).filter((name) => all.some((s) => VARIABLES[name].of(s)?.length));
  const scales = names.map((name) => scaleOf(VARIABLES[name].quantity, system));
  const one = channelScale(all[0]?.unit ?? a.unit, all[0]?.channel ?? a.predicted, system);
  const several = new Set(all.map((s) => s.channel)).size > 1;
  const unit = several ? "" : one.unit;
  return {
    columns: [
      { title: "series", text: true },
      { title: "use", text: true },
      ...(several ? [{ title: "channel", text: true }] : []),
      ...names.map((name, i) => ({ title: name, unit: scales[i].unit })),
      ...["measured", "predicted", "residual"].map((title) => ({ title, unit })),
    ],
    rows: all.flatMap((s) => {
      const scale = channelScale(s.unit, s.channel, system);
      const value = (/** @type {number | null} */ si) => si === null ? null : toShown(si, scale);
      return s.measured.map((measured, i) => [
        s.label,
        s.use,
        ...(several ? [s.channel] : []),
        ...names.map((name, k) => {
          const si = VARIABLES[name].of(s)?.[i] ?? null;
          return si === null ? null : toShown(si, scales[k]);
        }),
        value(measured),
        value(s.predicted[i]),
        s.residual[i] === null ? null : /** @type {number} */ (s.residual[i]) / scale.factor,
      ]);
    }),
  };
}

export function saveCsv() {
  const a = answer.peek();
  if (!a) return void (status.value = "There is no comparison to save.");
  downloadText(fileName("residuals", "csv"), toCsv(residualTable(a)), "text/csv");
}

/** @param {"png" | "svg"} format */
export const savePlots = (format) =>
  saveSheet([...overlays, { title: TITLE, chart: residual }], format, fileName("compare")).catch(
    (error) => {
      status.value = `The plots could not be saved: ${error.message}`;
    },
  );

/** The model as the document that the command line takes with --model; null before there is one. */
function modelDocument() {
  const c = compare.peek(), a = answer.peek();
  if (!a) return null;
  const { muscle, effects, freed = [], free = [], drive } = /** @type {Record<string, any>} */ (modelBody(c));
  return {
    schema: 1,
    kind: "model",
    muscle: muscle ?? drive?.muscle ?? {},
    effects: effects ?? effectValues(preset.peek()),
    freed,
    free: freeOfOther(free),
    ...(drive ? { drive: { ...drive, effects: effects ?? effectValues(preset.peek()) } } : {}),
    envelope: diagnosis.peek()?.envelope ?? {},
    assumed: a.assumptions,
  };
}

export function saveModel() {
  const document = modelDocument();
  if (!document) return void (status.value = "There is no model to save.");
  downloadText(fileName("model", "json"), `${JSON.stringify(document, null, 2)}\n`, "application/json");
  status.value = "The model is saved.";
}

/** The model for other programs, as it is now. */
export function takeAlong() {
  const model = modelDocument();
  if (!model) return void (status.value = "There is no model to take along.");
  return openTakeAlong({ what: "The model of this case", drive: "drive" in model, body: () => ({ model }) });
}

/** Saves data, model, plots and verdict as one file. */
export async function saveReport() {
  const c = compare.peek();
  const title = used({ ...c, files: files.peek() }).map((f) => f.name).join(", ");
  try {
    const text = await postForText("/api/reports", {
      ...modelBody(c),
      history: c.history.map(({ effects, freed, label }) => ({ effects, freed, label })),
      title,
    });
    downloadText(fileName("report", "html"), text, "text/html");
    status.value = "The report is saved.";
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    status.value = `The report could not be written: ${error.words}`;
  }
}

/** Keeps the model as a muscle of the user, with the covariance of its values and the range of its data. */
export function keepAsPreset() {
  const body = modelBody(compare.peek()), base = preset.peek();
  presetDialog({
    id: `${base?.id ?? "muscle"}-fitted`,
    title: `${base?.title ?? "Muscle"} (fitted)`,
    note: "Keeps the model as it is now, with how sure its values are and where it was measured. " +
      "Design, Transient and Sizing then offer it among the muscles.",
    save: (id, title) => post("/api/presets/muscles/fitted", { ...body, id, title }),
  });
}

/** Takes muscle and effects over into the Design view, which knows effects of the catalogue only. */
export function useInDesign() {
  const c = compare.peek();
  const all = c.effects ?? effectValues(preset.peek());
  const effects = Object.fromEntries(
    Object.entries(all).flatMap(([id, values]) => {
      const numbers = Object.entries(values).filter(([, v]) => typeof v === "number");
      return numbers.length === Object.keys(values).length ? [[id, /** @type {any} */ (values)]] : [];
    }),
  );
  openDesign({ muscle: c.muscle, effects, reference: "auto" }, "model of the comparison");
  const left = Object.keys(all).filter((id) => !(id in effects)).map(titleOf);
  if (left.length) {
    status.value = `Left out, because Design accepts only effects of the catalogue: ${left.join(", ")}.`;
  }
}
