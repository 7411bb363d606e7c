"use strict";
// What a reader takes along: a link, the case as Python, the motion as CSV, the picture.

/** @param {Explorer} page */
function makeTools(page) {
  const { code } = page.of;
  by("share").addEventListener("click", () => {
    remember(page);
    copy("share", location.href);
  });
  by("python").hidden = !code;
  by("python").addEventListener("click", () => copy("python", python(page, code)));
  by("csv").addEventListener("click", () =>
    save("motion.csv", URL.createObjectURL(new Blob([csv(page)], { type: "text/csv" }))),
  );
  by("png").addEventListener("click", () => save("structure.png", by("structure").toDataURL("image/png")));
  by("reset").addEventListener("click", () => {
    page.values = [...page.of.start];
    page.set({});
  });
}

/** The case as Python: a label is a string there as it is in JSON. @param {Explorer} page @param {string} code */
function python(page, code) {
  const values = page.inputs.map(({ options }, i) =>
    options ? JSON.stringify(options[page.values[i]]) : page.values[i],
  );
  return fill(code, ...values, ...page.values.slice(values.length));
}

/** Copy a text; where the browser refuses, show it. @param {string} id of the button @param {string} text */
async function copy(id, text) {
  try {
    await navigator.clipboard.writeText(text);
    by(id).textContent = TEXTS.copied;
    setTimeout(() => (by(id).textContent = /** @type {any} */ (TEXTS)[id]), 2000);
  } catch {
    by("uncopied").hidden = false;
    by("text").value = text;
    by("text").select();
  }
}

/** The motion at all samples. @param {Explorer} page */
function csv({ runner, of }) {
  const { states, ground, spacing } = runner;
  const n = of.states.length;
  const names = of.states.map(
    (/** @type {string} */ s, /** @type {number} */ j) => `${s} [${of.stateUnits[j]}]`,
  );
  const rows = Array.from({ length: runner.shown }, (_, i) =>
    [i * spacing[0], ...states.subarray(i * n, (i + 1) * n), ground[i]].join(","),
  );
  return [["t [s]", ...names, "ground [m/s2]"].join(","), ...rows].join("\n");
}

/** @param {string} name @param {string} address */
function save(name, address) {
  Object.assign(document.createElement("a"), { download: name, href: address }).click();
}
