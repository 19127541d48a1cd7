// @ts-check
// Which field of the page the message of a refused request belongs to.

/** @typedef {import("./client.js").ApiError} ApiError */

/** @param {() => ApiError | null} error the error to show, if there is one
 * @param {(path: string) => string} keyOf the field of the page for a path of the request */
export function fieldMessages(error, keyOf) {
  const keyOfError = () => {
    const path = error()?.field;
    return path ? keyOf(path.replace(/^body\.?/, "")) : null;
  };
  return {
    /** The field of the page the error belongs to. */
    field: keyOfError,
    /** The message for a field. @param {string} key */
    at: (key) => keyOfError() === key ? error()?.words ?? null : null,
    /** The message for a field or for one inside it. @param {string} key */
    within: (key) => {
      const field = keyOfError();
      return field === key || field?.startsWith(`${key}.`) ? error()?.words ?? null : null;
    },
  };
}
