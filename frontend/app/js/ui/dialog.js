// @ts-check
// Dialogs (modal) and popovers (beside their button); both close with Esc and give the focus back.
import { append, h, icon } from "../dom.js";

/** `outside`: a click beside the dialog closes it.
 * @param {{title: string, wide?: boolean, outside?: boolean}} o @param {import("../dom.js").Child[]} body
 * @returns {HTMLDialogElement} */
export function openDialog({ title, wide = false, outside = true }, ...body) {
  const dialog = h(
    "dialog",
    { class: wide ? "wide" : "", "aria-label": title, onclose: () => dialog.remove() },
    h(
      "div",
      { class: "dialog-head" },
      h("h2", null, title),
      h(
        "button",
        { type: "button", class: "quiet", "aria-label": "Close", onclick: () => dialog.close() },
        icon("close"),
      ),
    ),
    h("div", { class: "dialog-body", tabindex: -1 }, ...body),
  );
  dialog.addEventListener("click", (event) => {
    if (outside && event.target === dialog) dialog.close();
  });
  document.body.append(dialog);
  dialog.showModal();
  return dialog;
}

/** The body is built when the popover opens.
 * @param {HTMLElement} anchor @param {string} label
 * @param {(close: () => void) => import("../dom.js").Child} body
 * @param {{role?: string, kind?: string}} [o] */
export function openPopover(anchor, label, body, { role = "dialog", kind = "" } = {}) {
  const open = document.querySelector("[popover]:popover-open");
  const again = open && anchor.getAttribute("aria-expanded") === "true";
  /** @type {any} */ (open)?.hidePopover();
  if (again) return null;
  const box = h("div", { popover: "auto", role, "aria-label": label, class: `popover ${kind}` });
  const close = () => box.hidePopover();
  append(box, body(close));
  // Inside the landmark of its button, so that screen readers know where it belongs.
  (anchor.closest("section, header") ?? document.body).append(box);
  box.addEventListener("toggle", (event) => {
    const shown = /** @type {any} */ (event).newState === "open";
    anchor.setAttribute("aria-expanded", String(shown));
    if (!shown) {
      const inside = box.contains(document.activeElement) || document.activeElement === document.body;
      box.remove();
      if (inside) anchor.focus({ preventScroll: true });
    }
  });
  box.showPopover();
  anchor.setAttribute("aria-expanded", "true");
  place(box, anchor);
  const first = box.querySelector("button, [href], input, select");
  if (role === "menu") /** @type {HTMLElement | null} */ (first)?.focus();
  else box.tabIndex = -1;
  if (role !== "menu") box.focus({ preventScroll: true });
  return box;
}

const GAP = 6, EDGE = 8;

/** Beside the anchor for a long text; else below or above it; never over the edge of the window.
 * @param {HTMLElement} box @param {HTMLElement} anchor */
function place(box, anchor) {
  const a = anchor.getBoundingClientRect();
  if (box.classList.contains("about") && innerWidth - a.right > box.offsetWidth + 2 * EDGE) {
    box.style.maxHeight = `${innerHeight - 2 * EDGE}px`;
    box.style.left = `${a.right + GAP}px`;
    box.style.top = `${Math.max(EDGE, Math.min(a.top - 40, innerHeight - box.offsetHeight - EDGE))}px`;
    return;
  }
  const below = innerHeight - a.bottom - GAP - EDGE, above = a.top - GAP - EDGE;
  const up = box.offsetHeight > below && above > below;
  box.style.maxHeight = `${Math.max(120, up ? above : below)}px`;
  const left = Math.min(a.left, innerWidth - box.offsetWidth - EDGE);
  box.style.left = `${Math.max(EDGE, left)}px`;
  box.style.top = up ? `${Math.max(EDGE, a.top - GAP - box.offsetHeight)}px` : `${a.bottom + GAP}px`;
}
