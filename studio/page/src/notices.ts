// Sentences above the page that stay until they are answered, one of each kind; and those that are only said.
import {h} from "./dom";

export interface Answer {
  label: string;
  run: () => void;
}

export class Notices {
  readonly element = h("div", {class: "notices"});
  readonly spoken = h("div", {class: "spoken", role: "status"});
  private timer = 0;

  show(kind: string, text: string, answers: Answer[], grave = false): void {
    this.clear(kind);
    this.element.append(h("div", {class: `notice${grave ? " grave" : ""}`, "data-kind": kind, role: grave ? "alert" : "status"},
      h("p", null, text),
      answers.map(({label, run}) => h("button", {type: "button", onclick: run}, label))));
  }

  clear(kind: string): void {
    this.element.querySelector(`[data-kind="${kind}"]`)?.remove();
  }

  say(text: string): void {
    this.spoken.textContent = text;
    this.spoken.classList.add("on");
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.spoken.classList.remove("on"), 4000);
  }
}
