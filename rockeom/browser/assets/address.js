"use strict";
// Values from and to outside: the address of the page, and the page around it if it is in a frame.

/** The values by name, a menu's by its label. @param {Explorer} page */
function named(page) {
  return Object.fromEntries(
    page.inputs.map(({ name, options }, i) => [name, options?.[page.values[i]] ?? page.values[i]]),
  );
}

/**
 * Take what can be taken of values by name, and tell the reader of the rest.
 * @param {Explorer} page @param {string} source @param {Iterable<[string, unknown]>} given
 */
function accept(page, source, given) {
  /** @type {string[]} */
  const notes = [];
  for (const [name, value] of given) {
    const note = taken(page, name, value);
    const short = [name, value].map((x) => String(x).slice(0, 60));
    if (note) notes.push(fill(note[0], source, ...short, note[1]));
  }
  page.note = notes.join(" ");
}

/**
 * Take one value; what there is to say of it, if anything.
 * @param {Explorer} page @param {string} name @param {unknown} value @returns {[string, string] | undefined}
 */
function taken(page, name, value) {
  const place = page.inputs.findIndex((input) => input.name === name);
  if (place < 0) return [TEXTS.noName, ""];
  const { options, low, high } = page.inputs[place];
  if (options) {
    const option = options.indexOf(String(value));
    if (option < 0) return [TEXTS.noOption, ""];
    page.values[place] = option;
    return undefined;
  }
  const x = Number(String(value).trim() || NaN);
  if (!Number.isFinite(x)) return [TEXTS.noNumber, ""];
  page.values[place] = within(x, { low, high });
  return x === page.values[place] ? undefined : [TEXTS.outside, few(page.values[place])];
}

/** @param {Explorer} page */
function readAddress(page) {
  accept(page, TEXTS.address, new URLSearchParams(location.hash.slice(1)));
}

/** Put the values into the address. @param {Explorer} page */
function remember(page) {
  const values = Object.entries(named(page)).map(([name, x]) => [name, String(x)]);
  try {
    history.replaceState(null, "", `#${new URLSearchParams(values)}`);
  } catch {
    // a frame, as in a notebook, has no address of its own
  }
}

/** Tell the values to the page around, which may be of any origin: they are no secret. @param {Explorer} page */
function tell(page) {
  if (window.parent !== window) window.parent.postMessage({ rockeom: "values", values: named(page) }, "*");
}

/** Follow the address, and the page around. @param {Explorer} page */
function listen(page) {
  window.addEventListener("hashchange", () => {
    readAddress(page);
    page.set({});
  });
  window.addEventListener("message", ({ source, data }) => {
    const asked = window.parent !== window && source === window.parent && data?.rockeom === "set";
    if (!asked || typeof data.values !== "object" || !data.values) return;
    accept(page, TEXTS.frame, Object.entries(data.values));
    page.set({});
  });
}
