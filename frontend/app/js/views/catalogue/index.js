// @ts-check
import { h } from "../../dom.js";
export function catalogueView() { return h("div", null, "Catalogue"); }
