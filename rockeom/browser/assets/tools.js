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
  by("png").addEventListener("click", async () => save("page.png", (await picture()).toDataURL("image/png")));
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
  /** @type {string[]} */
  const axes = of.ground.slice(0, -1);
  const names = of.states.map(
    (/** @type {string} */ s, /** @type {number} */ j) => `${s} [${of.stateUnits[j]}]`,
  );
  const rows = Array.from({ length: runner.shown }, (_, i) =>
    [
      i * spacing[0],
      ...states.subarray(i * n, (i + 1) * n),
      ...axes.map((_, k) => ground[k * SAMPLES + i]),
    ].join(","),
  );
  return [["t [s]", ...names, ...axes.map((name) => `${name} [m/s2]`)].join(","), ...rows].join("\n");
}

/** The whole page on a canvas, as an image of its elements. */
async function picture() {
  const { width, height } = document.documentElement.getBoundingClientRect();
  for (const element of document.querySelectorAll("input, option")) {
    const { value, checked, selected } = /** @type {any} */ (element);
    element.setAttribute("value", value); // an image has attributes alone
    element.toggleAttribute("checked", checked === true);
    element.toggleAttribute("selected", selected === true);
  }
  const copy = /** @type {HTMLElement} */ (document.body.cloneNode(true));
  const canvases = copy.querySelectorAll("canvas");
  document.querySelectorAll("canvas").forEach((canvas, i) => {
    const { width, height } = canvas.getBoundingClientRect();
    canvases[i].replaceWith(Object.assign(new Image(width, height), { src: canvas.toDataURL() }));
  });
  for (const script of copy.querySelectorAll("script")) script.remove();
  const page = document.querySelector("style")?.outerHTML + new XMLSerializer().serializeToString(copy);
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}">
    <foreignObject width="100%" height="100%">${page}</foreignObject></svg>`;
  const image = Object.assign(new Image(), { src: `data:image/svg+xml,${encodeURIComponent(svg)}` });
  await image.decode();
  const scale = window.devicePixelRatio || 1;
  const size = { width: width * scale, height: height * scale };
  const canvas = Object.assign(document.createElement("canvas"), size);
  canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
  return canvas;
}

/** @param {string} name @param {string} address */
function save(name, address) {
  Object.assign(document.createElement("a"), { download: name, href: address }).click();
}
