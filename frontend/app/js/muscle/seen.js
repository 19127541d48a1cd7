// @ts-check
// The residual of the case at hand, for the atlas: what the case sees, and how much each effect alone explains of it.
import { signal } from "../reactive.js";

/** `points`: variable -> values in SI beside `residual`; `likeness`: effect -> share of the error that it removes.
 * @typedef {{kind: string, quantity: string, points: Record<string, (number | null)[]>,
 *   residual: (number | null)[], likeness: Record<string, number>}} Seen */

export const seen = signal(/** @type {Seen | null} */ (null));
