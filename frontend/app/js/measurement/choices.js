// @ts-check
// Answers about the columns of a file, as a mapping takes them. Pure functions.

/** @typedef {import("./types.js").Preview} Preview */
/** @typedef {import("./types.js").Column} Column */
/** @typedef {import("./types.js").Choice} Choice */
/** @typedef {import("./types.js").Mapping} Mapping */
/** @typedef {import("./types.js").OpenQuestion} OpenQuestion */

/** A column as it is read now, to change one thing of it. @param {Column} column @returns {Choice} */
export const choiceOf = (column) => ({
  channel: column.channel ?? "",
  ...(column.unit ? { unit: column.unit } : {}),
  ...(column.absolute === null ? {} : { absolute: column.absolute }),
  ...(column.sign < 0 ? { sign: -1 } : {}),
});

/** @param {Mapping} mapping @param {Record<string, Choice | null>} columns @returns {Mapping} */
export const withColumns = (mapping, columns) => ({
  ...mapping,
  columns: { ...mapping.columns, ...columns },
});

/** The mapping with the table of another head or sheet, whose columns nobody has changed yet.
 * @param {Mapping} mapping @param {{head?: number, sheet?: string}} place @returns {Mapping} */
export function withPlace({ columns: _, head: _head, ...mapping }, place) {
  return { ...mapping, ...place };
}

/** A quantity has a unit to choose; groups and words have none.
 * @param {Preview} p @param {string | null} channel */
export const channelOf = (p, channel) => p.channel_choices.find((one) => one.name === channel) ?? null;

/** The column of a name with or without its unit. @param {Preview} p @param {string} name */
function headerOf(p, name) {
  const bare = (/** @type {string} */ text) => text.replace(/\s*[[(][^\])]*[\])]\s*$/, "");
  const found = p.columns.find((c) => c.header === name) ?? p.columns.find((c) => bare(c.header) === name);
  return found?.header ?? name;
}

/** The questions that go on with their proposal until somebody says otherwise: the unit of a column that states none,
 * where the readings leave a usual one, and of a time whose unit its readings rule out. Every answer names them.
 * Any other unit that a file states and its readings contradict stays open. @param {Preview} p */
export const assumablesOf = (p) =>
  p.questions.filter((q) => {
    const column = p.columns.find((one) => one.header === q.column);
    return q.stops && column && q.proposed && q.choices.includes(q.proposed) &&
      q.about.startsWith("unit of ") &&
      (q.about === "unit of time" || column.unit_origin === "proposed");
  });

/** A choice that leaves the sign to the readings, as an assumption does. @param {Choice} choice @returns {Choice} */
function unsigned({ sign: _, ...choice }) {
  return choice;
}

/** The mapping with the proposals of questions as assumptions.
 * @param {OpenQuestion[]} asked @param {Preview} p @param {Mapping} mapping @returns {Mapping} */
export const withAssumed = (asked, p, mapping) =>
  withColumns(
    mapping,
    Object.fromEntries(asked.flatMap((q) => {
      const column = p.columns.find((one) => one.header === q.column);
      return column && q.proposed
        ? [[column.header, { ...unsigned(choiceOf(column)), unit: q.proposed, assumed: true }]]
        : [];
    })),
  );

/** What the user has to type: a value that the whole test held, or one for each word of a column.
 * @param {OpenQuestion} q */
export const typedAbout = (q) => q.about.startsWith("held ") || q.about.startsWith("levels of ");

/** What was said to be held, by its text: "3 bar". @param {Mapping} mapping @param {Preview} p */
export const heldIn = (mapping, p) =>
  Object.entries(mapping.columns ?? {}).flatMap(([text, choice]) =>
    choice && /^[-+]?\d/.test(text) && !p.columns.some((column) => column.header === text)
      ? [{ text, channel: choice.channel }]
      : []
  );

/** The mapping with what a channel was held at; "" takes it back.
 * @param {Mapping} mapping @param {Preview} p @param {string} channel @param {string} text @returns {Mapping} */
export function withHeld(mapping, p, channel, text) {
  const before = heldIn(mapping, p).filter((one) => one.channel === channel).map((one) => one.text);
  const columns = Object.fromEntries(
    Object.entries(mapping.columns ?? {}).filter(([name]) => !before.includes(name)),
  );
  return { ...mapping, columns: text ? { ...columns, [text]: { channel } } : columns };
}

/** An answer to a question: its words, and what it says of the columns or the sheet.
 * @typedef {{label: string, proposed: boolean, ignores: boolean, apply: (mapping: Mapping) => Mapping}} Answer */

/** @param {OpenQuestion} q @param {Preview} p @returns {Answer[]} */
export function answersOf(q, p) {
  const column = p.columns.find((one) => one.header === q.column) ?? null;
  /** @param {string} label @param {Record<string, Choice | null>} columns @returns {Answer} */
  const answer = (label, columns) => ({
    label,
    proposed: label === q.proposed,
    ignores: Object.values(columns).every((one) => one === null),
    apply: (mapping) => withColumns(mapping, columns),
  });
  if (q.about === "sheet") {
    return q.choices.map((sheet) => ({
      ...answer(sheet, {}),
      ignores: false,
      apply: (mapping) => withPlace(mapping, { sheet }),
    }));
  }
  if (typedAbout(q)) return []; // their example is no answer
  if (q.about.startsWith("unit of") && column) {
    return q.choices.map((unit) => answer(unit, { [column.header]: { ...choiceOf(column), unit } }));
  }
  if (q.about.startsWith("second ") && column) {
    // Both columns are the same quantity: the one that is chosen is used, the others are not.
    const channel = q.about.slice("second ".length);
    return q.choices.map((header) =>
      answer(
        header,
        Object.fromEntries(q.choices.map((one) => [one, one === header ? { channel } : null])),
      )
    );
  }
  if (column && !q.stops && q.choices.includes("keep the sign")) {
    // Turned already: both answers name the same channel, only the sign tells them apart.
    return q.choices.map((one) =>
      answer(one, { [column.header]: { ...choiceOf(column), sign: one === "keep the sign" ? 1 : -1 } })
    );
  }
  const said = q.answers.map((one) => spoken(one, p));
  // Both answers name the pressure; only the unit tells what it counts from.
  const named = q.about === "reference of pressure" ? q.choices : null;
  const found = said.map((one, i) => answer(named?.[i] ?? one.label, one.columns));
  if (column && q.choices.includes("ignore")) {
    const more = q.choices.filter((one) => one !== "ignore" && !found.some((a) => a.label === one));
    return [
      answer("ignore", { [column.header]: null }),
      ...found.filter((one) => !one.ignores).map((one) => one),
      ...more.map((channel) =>
        answer(channel, {
          [column.header]: channel === column.channel ? choiceOf(column) : { channel },
        })
      ),
    ];
  }
  if (column && q.choices.includes("keep the sign")) {
    found.push(answer("keep the sign", { [column.header]: { ...choiceOf(column), sign: 1 } }));
  }
  if (column && q.about === "specimens") {
    return [{ ...answer("read all as one muscle", { [column.header]: null }), ignores: false }];
  }
  return found;
}

/** A possible answer about a column, in the words of the page and for a mapping.
 * @param {OpenQuestion["answers"][number]} answer @param {Preview} p
 * @returns {{label: string, columns: Record<string, Choice | null>}} */
function spoken({ column, channel, unit, turned }, p) {
  const header = headerOf(p, column);
  if (channel === null) return { label: "ignore", columns: { [header]: null } };
  const now = p.columns.find((one) => one.header === header);
  const { sign: _, ...choice } = now?.channel === channel ? choiceOf(now) : { channel };
  return {
    label: turned ? "reverse the sign" : channel,
    columns: { [header]: { ...choice, ...(turned ? { sign: -1 } : {}), ...(unit ? { unit } : {}) } },
  };
}
