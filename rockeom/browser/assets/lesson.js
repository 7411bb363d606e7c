"use strict";
// Questions: the reader predicts what a change does, then the page runs both cases.

/** @typedef {Record<string, number>} Given values by their place */
/**
 * reading : the place of what is compared; ends : times of both motions by which it is settled [s].
 * @typedef {{text: string, before: Given, after: Given, compare: string, reading: number,
 *   ends: number[], explanation: string}} Question
 */

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
    /** @type {{choice: string, right: boolean, text: string}[]} */
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
    const { text, before, after, compare, ends } = this.questions[this.number];
    const answered = this.answers[this.number];
    by("question").textContent = fill(TEXTS.question, this.number + 1, this.questions.length, text);
    by("compared").textContent = TEXTS.compared[compare];
    const choices = compare === "overturns" ? ["yes", "no"] : ["grows", "same", "falls"];
    by("choices").replaceChildren(...choices.map((choice) => this.choice(choice)));
    by("run").disabled = true;
    this.run(answered ? after : before, ends[answered ? 1 : 0]);
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

  /** Run a case from the start; values that it does not give are those at first. @param {Given} given @param {number} end [s] */
  run(given, end) {
    const { page } = this;
    page.values = [...page.of.start];
    page.end = end;
    page.set(given);
    page.restart();
  }

  /** Run both cases, and compare them with the prediction. */
  answer() {
    const { before, after, compare, reading, ends } = this.questions[this.number];
    const choice = /** @type {HTMLInputElement} */ (document.querySelector("[name=choice]:checked")).value;
    const [a, b] = [before, after].map((given, k) => {
      this.run(given, ends[k]);
      return { x: this.page.runner.readings[reading], text: by("outcome").textContent };
    });
    this.answers[this.number] = { choice, ...this.compare(compare, choice, a, b) };
    for (const radio of document.getElementsByName("choice"))
      /** @type {HTMLInputElement} */ (radio).disabled = true;
    this.show();
    by("answer").focus();
  }

  /**
   * @param {string} compare @param {string} choice
   * @param {{x: number, text: string}} a @param {{x: number, text: string}} b
   */
  compare(compare, choice, a, b) {
    const found = truth(compare, a.x, b.x);
    const right = choice === found;
    const { of } = this.page;
    const unit = { peak: of.stateUnits[of.rotation], period: "s", duration: "s" }[compare] ?? "";
    const answer = fill(TEXTS.answers[found], quantity(a.x, unit), quantity(b.x, unit));
    const said = right ? TEXTS.predicted : fill(TEXTS.otherwise, TEXTS.choices[choice]);
    const both = compare === "overturns" ? `\n${fill(TEXTS.both, a.text, b.text)}` : "";
    return { right, text: `${answer} ${said}${both}` };
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
