// @ts-check
// Elements built by function calls. A function as attribute or child is evaluated again whenever a signal it
// reads changes.
import { effect, scope } from "./reactive.js";

/** @typedef {Node | string | number | null | undefined | false} Leaf */
/** @typedef {Leaf | Leaf[] | (() => Leaf | Leaf[])} Child */

/** Set as properties, because the attribute of the same name is only the initial value. */
const PROPERTIES = new Set([
  "value",
  "checked",
  "disabled",
  "hidden",
  "open",
  "textContent",
  "indeterminate",
]);

/** @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag @param {Record<string, unknown> | null} [props] "on…": a listener; "ref": called with the element
 * @param {Child[]} kids @returns {HTMLElementTagNameMap[K]} */
export function h(tag, props, ...kids) {
  const el = document.createElement(tag);
  kids.forEach((kid) => append(el, kid));
  for (const [key, value] of Object.entries(props ?? {})) {
    if (key.startsWith("on")) el.addEventListener(key.slice(2), /** @type {EventListener} */ (value));
    else if (key === "ref") /** @type {(el: HTMLElement) => void} */ (value)(el);
    else if (typeof value === "function") effect(() => setProp(el, key, value()));
    else setProp(el, key, value);
  }
  return el;
}

/** @param {HTMLElement} el @param {string} key @param {unknown} value */
function setProp(el, key, value) {
  if (PROPERTIES.has(key)) /** @type {Record<string, unknown>} */ (/** @type {unknown} */ (el))[key] = value;
  else if (value === false || value == null) el.removeAttribute(key);
  else {
    const text = value === true ? "" : String(value);
    if (el.getAttribute(key) !== text) el.setAttribute(key, text);
  }
}

/** @param {Node} el @param {Child} kid */
export function append(el, kid) {
  if (typeof kid === "function") {
    const end = document.createComment("");
    el.appendChild(end);
    /** @type {ChildNode[]} */
    let shown = [];
    effect(() => {
      const part = document.createDocumentFragment();
      append(part, kid());
      const only = part.childNodes.length === 1 ? part.firstChild : null;
      if (only instanceof Text && shown.length === 1 && shown[0] instanceof Text) {
        if (shown[0].data !== only.data) shown[0].data = only.data;
        return;
      }
      shown.forEach((node) => node.remove());
      shown = [...part.childNodes];
      end.before(part);
    });
  } else if (Array.isArray(kid)) kid.forEach((one) => append(el, one));
  else if (kid != null && kid !== false) {
    el.appendChild(kid instanceof Node ? kid : document.createTextNode(String(kid)));
  }
}

/** An element with a child for each item, behind its `first` ones. A child stays, with its focus, as long as an item has
 * its key; what it shows of signals it reads in functions. The focus of a child that goes moves to its neighbour.
 * @template {keyof HTMLElementTagNameMap} K @template T
 * @param {K} tag @param {Record<string, unknown> | null} props @param {() => T[]} items @param {(item: T) => unknown} keyOf
 * @param {(item: T) => HTMLElement} build @param {HTMLElement[]} first @returns {HTMLElementTagNameMap[K]} */
export function each(tag, props, items, keyOf, build, ...first) {
  const el = h(tag, props, ...first);
  /** @type {Map<unknown, [HTMLElement, () => void]>} */
  const shown = new Map();
  effect(() => {
    const now = items(), keys = new Set(now.map(keyOf));
    for (const [key, [child, stop]] of shown) {
      if (keys.has(key)) continue;
      const focused = child.contains(document.activeElement);
      const beside =
        /** @type {HTMLElement | null} */ (child.nextElementSibling ?? child.previousElementSibling);
      stop();
      child.remove();
      shown.delete(key);
      if (focused) {
        /** @type {HTMLElement | null | undefined} */ (beside?.querySelector("button, input"))?.focus();
      }
    }
    now.forEach((item, i) => {
      const key = keyOf(item);
      if (!shown.has(key)) shown.set(key, scope(() => build(item)));
      const child = /** @type {[HTMLElement, () => void]} */ (shown.get(key))[0];
      const place = el.children[first.length + i];
      if (place !== child) el.insertBefore(child, place ?? null);
    });
  });
  return el;
}

const SVG = "http://www.w3.org/2000/svg";

/** An element of a drawing; null and undefined attributes are left out.
 * @param {string} tag @param {Record<string, string | number | null | undefined>} attributes
 * @param {(Node | string | null)[]} kids @returns {SVGElement} */
export function svg(tag, attributes, ...kids) {
  const el = /** @type {SVGElement} */ (document.createElementNS(SVG, tag));
  for (const [key, value] of Object.entries(attributes)) {
    if (value != null) el.setAttribute(key, String(value));
  }
  el.append(...kids.filter((kid) => kid !== null));
  return el;
}

/** Line icons on a 20 × 20 grid, drawn with the text's colour. */
const ICONS = {
  undo: "M8 5 4 9l4 4M4.5 9H12a4 4 0 0 1 0 8H9",
  redo: "m12 5 4 4-4 4M15.5 9H8a4 4 0 0 0 0 8h3",
  export: "M10 3v9m-3.5-3.5L10 12l3.5-3.5M4 13v3.5h12V13",
  share: "M8.5 11.5 12 8m-4.5.5-2 2a2.8 2.8 0 0 0 4 4l2-2m-3-5 2-2a2.8 2.8 0 0 1 4 4l-2 2",
  help: "M7.5 7.7a2.5 2.5 0 1 1 3.6 2.2c-.8.4-1.1.9-1.1 1.8M10 14.5v.1",
  system: "M3.5 4.5h13v9h-13zM8 16.5h4M10 13.5v3",
  info: "M10 3a7 7 0 1 1 0 14 7 7 0 0 1 0-14M10 9.2V13.5M10 6.6v.1",
  reset: "M5 7.5A5.8 5.8 0 1 1 4.3 11M5 3.8v3.7h3.7",
  more: "M4.5 10h.1M10 10h.1M15.5 10h.1",
  close: "m5.5 5.5 9 9m0-9-9 9",
  plus: "M10 5v10M5 10h10",
  minus: "M5 10h10",
  check: "m4.5 10.5 3.5 3.5 7.5-8",
  warn: "M10 3.5 17.5 16.5h-15ZM10 8.5v3.5M10 14.2v.1",
  search: "M9 4a5 5 0 1 1 0 10A5 5 0 0 1 9 4m3.6 8.6L16.5 16.5",
  down: "m6 8 4 4 4-4",
  grip: "M7.5 5h.1M12.5 5h.1M7.5 10h.1M12.5 10h.1M7.5 15h.1M12.5 15h.1",
  file: "M5.5 3h6l3.5 3.5V17h-9.5ZM11.5 3v3.5H15",
  person: "M10 3.5a3 3 0 1 1 0 6 3 3 0 0 1 0-6M4 16.5c.7-3.300 3.200-4.600 6-4.600s5.300 1.300 6 4.600",
  flask: "M7.5 3h5M8.300 3v5L4 15.5a1 1 0 0 0 .9 1.5h10.200a1 1 0 0 0 .9-1.5L11.700 8V3M6.300 12.5h7.400",
  page: "M5 3h8l2.5 2.5V17H5ZM7.5 9.5h5M7.5 12.5h5M7.5 6.5h3",
  table: "M3.5 4.5h13v11h-13ZM3.5 8.5h13M3.5 12h13M8 8.5v7",
  braces: "M8 3.5c-2.5 0-1 5.5-3.5 6.5 2.5 1 1 6.5 3.5 6.5M12 3.5c2.5 0 1 5.5 3.5 6.5-2.5 1-1 6.5-3.5 6.5",
  code: "m7 5.5-4 4.5 4 4.5m6-9 4 4.5-4 4.5",
  wave: "M3 14c2-9 4-9 5-4s3 5 4 0 2-4 5 3",
  pin: "M7.5 3.5h5l-.7 5 2.7 2.5v1.5h-9V11l2.7-2.5ZM10 12.5v4.5",
};

/** @param {keyof typeof ICONS} name */
export function icon(name) {
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("viewBox", "0 0 20 20");
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(SVG, "path");
  path.setAttribute("d", ICONS[name]);
  svg.append(path);
  return svg;
}

/** MathML of the server as nodes, without anything that is not MathML.
 * @param {string} markup @returns {Node} */
export function mathml(markup) {
  const parsed = new DOMParser().parseFromString(markup, "application/xml").documentElement;
  if (parsed.localName !== "math") return document.createTextNode("");
  const node = /** @type {Element} */ (document.importNode(parsed, true));
  for (const el of [node, ...node.querySelectorAll("*")]) {
    if (el.namespaceURI !== "http://www.w3.org/1998/Math/MathML") el.remove();
    for (const { name } of [...el.attributes]) if (/^on|href/i.test(name)) el.removeAttribute(name);
  }
  return node;
}
