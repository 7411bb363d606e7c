"use strict";
// All English of the page in one table, which Python reads as JSON; and numbers with their units.

const TEXTS = {
  lang: "en",
  /** @type {Record<string, string>} words of the names of sliders, menus, states and presets */
  names: {},
  // the labels of page.html
  mode: "Mode",
  explore: "Explore",
  questions: "Questions",
  verdict: "Verdict",
  controls: "Sliders and menus",
  presets: "Presets",
  views: "Motion",
  structure: "The structure in motion, to scale",
  play: "Play",
  pause: "Pause",
  time: "time",
  speed: "speed",
  history: "Rotation and ground acceleration over time",
  quantity: "upper curve",
  impactTicks: "short ticks: impacts",
  energy: "Energy",
  energyCaption: "energy at the shown time, less that at rest",
  energyRatio: "(divided by m g R: no mass was given)",
  sizes: "three sizes",
  phase: "Phase portrait",
  phaseCaption: "rotation and its rate",
  map: "Outcomes over two sliders. The arrow keys move the point.",
  across: "across",
  up: "up",
  share: "Copy link",
  python: "Copy as Python",
  csv: "Save CSV",
  png: "Save PNG",
  reset: "Reset",
  copied: "Copied",
  uncopied: "The browser refuses to copy. The text:",
  run: "Run",
  previous: "Previous",
  next: "Next",
  // sentences on a motion
  broken: "The page cannot run here: {0}",
  unknown: "This combination is outside of what the page knows: move a slider back.",
  summary: "{0}: largest {1} {2}, {3}.",
  impact: "1 impact",
  impacts: "{0} impacts",
  now: "{0} s of {1} s",
  seconds: "{0} s",
  falls: "overturns",
  back: "does not",
  other: "other ends: {0}",
  /** @type {Record<string, string>} by the words of Python */
  outcomes: {
    completed: "Completed",
    "came to rest": "Came to rest",
    overturned: "Overturned",
    "too many impacts": "Too many impacts",
    stalled: "Stalled",
    chatter: "Chatter",
    "not finite": "Not finite",
    "no solution": "No solution",
    "several solutions": "Several solutions",
  },
  // views
  ratio: "{0} / overturning angle",
  limit: "overturning angle",
  peakOf: "{0}, at most {1}",
  ground: "ground acceleration",
  vertical: "vertical",
  phaseOf: "Phase portrait: the rotation is at most {0}, its rate {1}",
  separatrix: "separatrix",
  /** Of structures in space, where these stand in place of those of the plane and beside them. */
  space: {
    structure: "The structure in space, to scale. The arrow keys turn the view, plus and minus zoom.",
    tilt: "tilt",
    grid: "grid {0} m",
    ground_x: "ground along x",
    ground_y: "dotted: along y",
    energyCaption: "energy at the shown time; gravitational: above the lowest place of the motion",
    phaseCaption: "tilt against its direction, seen from the body; dashed: where it overturns",
    leanOf: "Tilt against its direction: at most {0}. It overturns between {1} and {2}.",
    leanAlone: "Tilt against its direction: at most {0}.",
    planCaption: "feet on the ground, seen from above; dashed: the base at first",
    planOf: "Seen from above: the feet move within {0} along x and {1} along y.",
  },
  putIn: "put in by the ground",
  kinetic: "kinetic",
  gravitational: "gravitational",
  elastic: "elastic",
  lost: "lost",
  energyOf: "Energy: {0} put in by the ground, {1} lost",
  size: "× {0}",
  outOfRange: "not known to the page",
  // values that come from outside
  address: "The address",
  frame: "The page around this one",
  noName: "{0} names '{1}', which this page does not have.",
  noNumber: "{0} gives '{2}' for '{1}', which is no finite number.",
  noOption: "{0} gives '{2}' for '{1}', which is none of its options.",
  outside: "{0} gives {2} for '{1}', outside of the slider: {3} is taken.",
  // questions
  question: "Question {0} of {1}: {2}",
  /** @type {Record<string, string>} by what is compared */
  compared: {
    overturns: "Will it overturn?",
    peak: "The largest rotation",
    impacts: "The number of impacts",
    period: "The period",
    duration: "The time of the last impact",
  },
  /** @type {Record<string, string>} */
  choices: { yes: "yes", no: "no", grows: "grows", same: "stays the same", falls: "falls" },
  both: "Before: {0}\nAfter: {1}",
  /** @type {Record<string, string>} with the numbers before and after */
  answers: {
    yes: "It overturns.",
    no: "It does not overturn.",
    grows: "It grows from {0} to {1}.",
    same: "It stays the same, within 1 %: {0} and {1}.",
    falls: "It falls from {0} to {1}.",
  },
  predicted: "You predicted it.",
  otherwise: "You predicted: {0}.",
  score: "{0} of {1} predicted",
  // verdict
  uplift: "A foot lifts at {0} g ({1} m/s²).",
  slides: "It rocks before it slides where the friction coefficient is at least {0}.",
  motions: "{0} of {1} motions overturn it.",
  motionsUnknown: "{0} of {1} motions overturn it; the page does not know {2} of them.",
};

/** A text with its places {0}, {1} ... filled. @param {string} text @param {...unknown} parts */
function fill(text, ...parts) {
  return text.replace(/\{(\d+)\}/g, (whole, k) => String(parts[k] ?? whole));
}

/** Put the texts into page.html, which has none of its own. */
function translate() {
  const texts = /** @type {Record<string, any>} */ (TEXTS);
  document.documentElement.lang = TEXTS.lang;
  for (const [kind, attribute] of [
    ["text", ""],
    ["label", "aria-label"],
  ]) {
    for (const element of document.querySelectorAll(`[data-${kind}]`)) {
      const text = texts[String(element.getAttribute(`data-${kind}`))];
      if (attribute) element.setAttribute(attribute, text);
      else element.textContent = text;
    }
  }
}

const G = 9.80665;
const DEGREE = Math.PI / 180;

/** A number with its unit, accelerations in g besides and angles in degrees. @param {number} x @param {string} unit */
function quantity(x, unit) {
  if (!unit || unit === "-") return few(x);
  const besides = unit === "rad" ? ` (${few(x / DEGREE)}°)` : unit === "m/s2" ? ` (${few(x / G)} g)` : "";
  return `${few(x)} ${unit.replaceAll("2", "²")}${besides}`;
}

/** How a motion ends, by the word of Python; undefined where the page does not know. @param {string | undefined} word */
function outcomeWord(word) {
  return word ? (TEXTS.outcomes[word] ?? word) : TEXTS.outOfRange;
}

/** A name as words. @param {string} name */
function words(name) {
  return TEXTS.names[name] ?? name;
}
