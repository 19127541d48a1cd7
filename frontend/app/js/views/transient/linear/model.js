// @ts-check
// The linear view of the drive: what is asked, the answer, and taking the designed controller over.
import { computed, signal } from "../../../reactive.js";
import { edit } from "../../../state.js";
import { post } from "../../../server/client.js";
import { Question } from "../../../server/question.js";
import { statedGain } from "../../../drive/document.js";
import { documentNow, drive, mode } from "../model.js";

/** @typedef {import("../../../types.js").S["LinearResult"]} Linear */
/** @typedef {Linear["models"][number]} Model */
/** @typedef {NonNullable<Linear["design"]>} Design */
/** @typedef {Design["trials"][number]} Trial */
/** @typedef {"middle" | "position" | "contraction" | "pressure" | "command"} PointKind */

/** Where the drive is linearised; the value is a text with a unit. */
export const point = signal(/** @type {{kind: PointKind, value: string}} */ ({ kind: "middle", value: "" }));
/** Input and output of Bode diagram, poles and zeros, by their names on the wire. */
export const channel = signal({ input: "command", output: "position" });
/** Goals of the design as texts. */
export const goals = signal({ overshoot: "5 %", settling: "1 s", step: "", unsaturated: false });

const question = new Question(
  (text, signal) => /** @type {Promise<Linear>} */ (post("/api/linearisations", JSON.parse(text), signal)),
  { patience: 0 },
);
export const { answer: linear, error: linearError, stage: linearStage } = question;

const drawnFrom = signal("");
/** Whether the drive is no longer the one of the answer. */
export const outdated = computed(() =>
  linear.value !== null && drawnFrom.value !== JSON.stringify(documentNow())
);

/** @param {boolean} withDesign */
export function linearise(withDesign) {
  const document = documentNow(), { kind, value } = point.peek(), wanted = goals.peek();
  drawnFrom.value = JSON.stringify(document);
  question.ask(
    JSON.stringify({
      drive: document,
      ...channel.peek(),
      ...(kind === "middle" ? {} : { at: { [kind]: value } }),
      ...(withDesign
        ? {
          design: {
            overshoot: wanted.overshoot,
            settling: wanted.settling,
            ...(wanted.step.trim() ? { step: wanted.step } : {}),
            unsaturated: wanted.unsaturated,
          },
        }
        : {}),
    }),
    true,
  );
}

export const stop = () => question.cancel();

/** @param {string} key @param {number} si */
const gainOf = (key, si) => Number(statedGain(key, si).toPrecision(8));

/** Puts a controller into the drive; without a reference of its own the drive gets the steps of the design.
 * @param {Trial} trial */
export function takeOver(trial) {
  const c = trial.controller, old = drive.peek().controller ?? {};
  const start = trial.reference[0] ?? 0;
  const level = Math.max(...trial.reference.map((x) => x ?? start)), isUp = level > start;
  const far = isUp ? level : Math.min(...trial.reference.map((x) => x ?? start));
  const steps = {
    shape: "pulse",
    on: trial.begins,
    off: trial.returns,
    level: Number(far.toPrecision(6)),
    initial: Number(start.toPrecision(6)),
  };
  const isControlled = mode.peek() === "controller";
  const end = Number((trial.time.at(-1) ?? 1).toPrecision(6));
  const controller = {
    ...old,
    type: "pid",
    kp: gainOf("kp", c.kp),
    ki: gainOf("ki", c.ki),
    kd: gainOf("kd", c.kd),
    feed_forward: gainOf("feed_forward", c.feed_forward),
    derivative_filter: c.derivative_filter,
    sample_time: c.sample_time,
    output_min: c.output_min,
    output_max: c.output_max,
    ...(old.angle === undefined ? { reference: isControlled && old.reference ? old.reference : steps } : {}), // a joint keeps its set points
  };
  edit((d) => ({
    ...d,
    transient: {
      ...d.transient,
      mode: "controller",
      drive: { ...d.transient.drive, controller, ...(isControlled ? {} : { duration: end }) },
    },
  }), `${trial.name} controller`);
}
