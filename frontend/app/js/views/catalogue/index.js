// @ts-check
// The Catalogue view as the program sees it; its page is fetched when it is first shown.
import { later } from "../../ui/later.js";
import "./document.js";

export const catalogueView = later(async () => (await import("./page.js")).cataloguePage);
