"use strict";
// The controls of the page: presets, menus and sliders, all of them inputs of the program.

/**
 * An input of the program: a slider, or a menu, whose value is the number of the option.
 * @typedef {{name: string, low: number, high: number, start: number, unit: string, meaning: string,
 *   options?: string[]}} Input
 */

/** The inputs by their place among the values of a page. @param {any} of @returns {Input[]} */
function inputsOf(of) {
  const menus = (of.menus ?? []).map((/** @type {any} */ { name, options }) => {
    return { name, options, low: 0, high: options.length - 1, start: 0, unit: "", meaning: "" };
  });
  return [...of.sliders, ...menus];
}

/** @param {number} x @param {{low: number, high: number}} range */
function within(x, { low, high }) {
  return Math.min(Math.max(x, low), high);
}

/** A round step, 250 to 625 of which go through a range. @param {number} range */
function roundStep(range) {
  const size = 10 ** Math.floor(Math.log10(range / 250));
  return size * ([5, 2].find((k) => k * size <= range / 250) ?? 1);
}

class Panel {
  /** @param {Explorer} page */
  constructor(page) {
    this.page = page;
    this.makePresets(page.of.presets ?? []);
    /** @type {((x: number) => void)[]} what shows the value of each input */
    this.shown = page.inputs.map((input, place) =>
      input.options ? this.menu(input, place, input.options) : this.slider(input, place),
    );
  }

  /** @param {{name: string, values: Record<string, number>}[]} presets */
  makePresets(presets) {
    by("presets").hidden = !presets.length;
    for (const { name, values } of presets) {
      const button = Object.assign(document.createElement("button"), { type: "button", textContent: name });
      button.addEventListener("click", () => this.page.set(values));
      by("presets").append(button);
    }
  }

  /** @param {Input} input @param {number} place @param {string[]} options */
  menu(input, place, options) {
    const select = document.createElement("select");
    options.forEach((label, i) => select.add(new Option(label, String(i))));
    select.addEventListener("change", () => this.page.set({ [place]: Number(select.value) }));
    this.row("menu", input, place, select);
    return (/** @type {number} */ x) => void (select.value = String(x));
  }

  /** @param {Input} input @param {number} place */
  slider(input, place) {
    const { low, high, unit } = input;
    const range = document.createElement("input");
    Object.assign(range, { type: "range", min: low, max: high, step: roundStep(high - low) });
    range.addEventListener("input", () => {
      this.page.values[place] = Number(range.value);
      this.page.move();
    });
    range.addEventListener("change", () => this.page.settle());
    const value = document.createElement("span");
    this.row("slider", input, place, value, range);
    return (/** @type {number} */ x) => {
      const text = quantity(x, unit);
      if (Number(range.value) !== x) range.value = String(x);
      range.setAttribute("aria-valuetext", text);
      value.textContent = text;
    };
  }

  /** @param {string} kind @param {Input} input @param {number} place @param {...HTMLElement} parts the last one is the control */
  row(kind, input, place, ...parts) {
    const box = Object.assign(document.createElement("div"), { className: kind });
    const control = parts[parts.length - 1];
    const label = Object.assign(document.createElement("label"), { textContent: words(input.name) });
    control.id = label.htmlFor = `input-${place}`;
    control.title = label.title = input.meaning;
    box.append(label, ...parts);
    by("controls").append(box);
  }

  show() {
    this.shown.forEach((show, place) => show(this.page.values[place]));
  }
}
