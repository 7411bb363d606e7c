"use strict";
// Questions: the reader predicts what a change does, then the page runs both cases.

/** @typedef {Record<string, number>} Given values by their place */
/** @typedef {{text: string, before: Given, after: Given, compare: string, explanation: string}} Question */

/** What is read off the motion of a page; undefined where it has no such number.
 * @type {Record<string, (page: Explorer) => number | undefined>} */
const READINGS = {
  overturns: ({ of, outcome }) => Number(of.outcomes[outcome] === "overturned"),
  peak: ({ charts }) => Math.abs(peak(charts.rotation)),
  impacts: ({ runner }) => runner.spacing[2],
  period: ({ runner }) => (runner.spacing[3] > 1 ? 2 * (runner.impacts[1] - runner.impacts[0]) : undefined),
  duration: ({ runner: { impacts, spacing } }) =>
    spacing[3] > 0 && spacing[2] === spacing[3] ? impacts[spacing[3] - 1] : undefined,
};

/** The choice that comes true. @param {string} compare @param {number} a before @param {number} b after */
function truth(compare, a, b) {
  if (compare === "overturns") return b ? "yes" : "no";
  if (Math.abs(b - a) <= 0.01 * Math.abs(a)) return "same";
  return b > a ? "grows" : "falls";
}

class Lesson {
  /** @param {Explorer} page */
  constructor(page) {
    this.page = page;
    /** @type {Question[]} */
    this.questions = page.of.questions;
    /** @type {{choice: string, right?: boolean, text: string}[]} */
    this.answers = [];
    this.number = 0;
    by("run").addEventListener("click", () => this.answer());
    by("previous").addEventListener("click", () => this.go(-1));
    by("next").addEventListener("click", () => this.go(1));
  }

  /** @param {number} step */
  go(step) {
    this.number += step;
    this.open();
    by("question").focus();
  }

  /** Show the question, and the case before; or the one after, once it is answered. */
  open() {
    const { text, before, after, compare } = this.questions[this.number];
    const answered = this.answers[this.number];
    by("question").textContent = fill(TEXTS.question, this.number + 1, this.questions.length, text);
    by("compared").textContent = TEXTS.compared[compare];
    const choices = compare === "overturns" ? ["yes", "no"] : ["grows", "same", "falls"];
    by("choices").replaceChildren(...choices.map((choice) => this.choice(choice)));
    by("run").disabled = true;
    this.run(answered ? { ...before, ...after } : before);
    this.show();
  }

  /** @param {string} choice */
  choice(choice) {
    const label = document.createElement("label");
    const radio = Object.assign(document.createElement("input"), {
      type: "radio",
      name: "choice",
      value: choice,
      checked: choice === this.answers[this.number]?.choice,
      disabled: this.number in this.answers,
    });
    radio.addEventListener("change", () => (by("run").disabled = false));
    label.append(radio, TEXTS.choices[choice]);
    return label;
  }

  /** Run a case from the start; values that it does not give are those at first. @param {Given} given */
  run(given) {
    const { page } = this;
    page.values = [...page.of.start];
    page.set(given);
    page.restart();
  }

  /** Run both cases, and compare them with the prediction. */
  answer() {
    const { before, after, compare } = this.questions[this.number];
    const choice = /** @type {HTMLInputElement} */ (document.querySelector("[name=choice]:checked")).value;
    const [a, b] = [before, { ...before, ...after }].map((given) => {
      this.run(given);
      return {
        x: this.page.known ? READINGS[compare](this.page) : undefined,
        text: by("outcome").textContent,
      };
    });
    this.answers[this.number] = { choice, ...this.compare(compare, choice, a, b) };
    for (const radio of document.getElementsByName("choice"))
      /** @type {HTMLInputElement} */ (radio).disabled = true;
    this.show();
    by("answer").focus();
  }

  /**
   * @param {string} compare @param {string} choice
   * @param {{x?: number, text: string}} a @param {{x?: number, text: string}} b
   */
  compare(compare, choice, a, b) {
    if (a.x === undefined || b.x === undefined) return { text: this.missing(compare) };
    const found = truth(compare, a.x, b.x);
    const right = choice === found;
    const { of } = this.page;
    const unit = { peak: of.stateUnits[of.rotation], period: "s", duration: "s" }[compare] ?? "";
    const answer = fill(TEXTS.answers[found], quantity(a.x, unit), quantity(b.x, unit));
    const said = right ? TEXTS.predicted : fill(TEXTS.otherwise, TEXTS.choices[choice]);
    const both = compare === "overturns" ? `\n${fill(TEXTS.both, a.text, b.text)}` : "";
    return { right, text: `${answer} ${said}${both}` };
  }

  /** Why there is no number to compare. @param {string} compare */
  missing(compare) {
    if (compare === "period") return TEXTS.noPeriod;
    return compare === "duration" ? TEXTS.noDuration : TEXTS.unknown;
  }

  /** Show the answer, if there is one, and the score; sliders and map would tell it before. */
  show() {
    const answer = this.answers[this.number];
    this.page.lock(!answer);
    by("run").hidden = Boolean(answer);
    by("answer").textContent = answer?.text ?? "";
    by("explanation").textContent = answer ? (this.questions[this.number].explanation ?? "") : "";
    const right = this.answers.filter((a) => a?.right).length;
    by("score").textContent = fill(TEXTS.score, right, this.questions.length);
    by("previous").disabled = this.number === 0;
    by("next").disabled = this.number === this.questions.length - 1;
  }
}
