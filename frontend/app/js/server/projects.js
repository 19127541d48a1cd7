// @ts-check
// Projects on the server.
import { get, post, request, sendFile } from "./client.js";

/** @typedef {import("../types.js").S} S */
/** @typedef {S["ProjectSummary"]} Info */
/** @typedef {S["ProjectAnswer"]} Opened */

/** Characters of a body with which the browser goes on sending when the page is closed; its limit is 64 kB. */
const MOST_KEPT_ALIVE = 20_000;

/** @param {"PUT" | "PATCH" | "DELETE" | "POST"} method @param {string} path @param {unknown} [body] */
const send = (method, path, body) => {
  const text = body === undefined ? undefined : JSON.stringify(body);
  return request(`/api/projects/${path}`, {
    method,
    body: text,
    keepalive: (text?.length ?? 0) < MOST_KEPT_ALIVE,
    headers: text === undefined ? {} : { "content-type": "application/json" },
  });
};

/** @param {boolean} [deleted] @returns {Promise<S["ProjectsAnswer"]>} */
export const projects = (deleted = false) => get(`/api/projects?deleted=${deleted}`);
/** @param {string} id @param {number} [version] @returns {Promise<Opened>} */
export const project = (id, version) => get(`/api/projects/${id}${version ? `?version=${version}` : ""}`);
/** @param {string} title @param {unknown} document @param {unknown} study @returns {Promise<Opened>} */
export const create = (title, document, study) => post("/api/projects", { title, document, study });
/** @param {string} id @param {S["ProjectState"]} state @returns {Promise<Opened>} */
export const save = (id, state) => send("PUT", id, state);
/** @param {string} id @param {S["ProjectChange"]} change @returns {Promise<Info>} */
export const describe = (id, change) => send("PATCH", id, change);
/** @param {string} id @returns {Promise<Opened>} */
export const duplicate = (id) => send("POST", `${id}/copies`, {});
/** @param {string} id @returns {Promise<Info>} */
export const remove = (id) => send("DELETE", id);
/** @param {string} id @returns {Promise<Info>} */
export const erase = (id) => send("DELETE", `${id}?erase=true`);
/** @param {string} id @returns {Promise<Info>} */
export const restore = (id) => send("POST", `${id}/restore`);
/** @param {string} id @returns {Promise<S["HistoryAnswer"]>} */
export const history = (id) => get(`/api/projects/${id}/history`);
/** @param {File} file @returns {Promise<Opened>} */
export const unpack = (file) => sendFile("POST", "/api/projects/import", file);
/** Where the packed project is. @param {string} id */
export const fileOf = (id) => `/api/projects/${id}/file`;
