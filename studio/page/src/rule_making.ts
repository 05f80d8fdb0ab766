// The name of a new rule.
import {fill, h, withCode} from "./dom";

export interface MakingHooks {
  free: () => string; // a name that nothing has yet
  make: (name: string) => void;
  shown: (is: boolean) => void;
  cancelled: () => void;
}

export class Making {
  readonly element = h("form", {class: "tools new-rule", hidden: true});

  constructor(private hooks: MakingHooks) {
    this.element.addEventListener("submit", (event) => {
      event.preventDefault();
      hooks.make(this.element.querySelector("input")!.value.trim());
    });
  }

  get open(): boolean {
    return !this.element.hidden;
  }

  // `focus`: somebody wants to write it now.
  show(focus: boolean): void {
    if (this.open && !focus) return;
    const input = h("input", {type: "text", id: "new-rule-name", value: this.hooks.free(), "aria-label": "The name of the new rule", autocomplete: "off", spellcheck: "false"});
    fill(this.element, h("label", {for: "new-rule-name"}, "Its name"), input, h("button", {type: "submit", class: "primary"}, "Make it"),
      h("button", {type: "button", class: "quiet", onclick: () => {
        this.hide();
        this.hooks.cancelled();
      }}, "Cancel"));
    this.element.hidden = false;
    this.hooks.shown(true);
    if (!focus) return;
    input.focus();
    input.select();
  }

  hide(): void {
    this.element.hidden = true;
    this.hooks.shown(false);
  }

  refuse(why: string): void {
    this.element.querySelector(".refused")?.remove();
    this.element.append(h("p", {class: "trouble refused", role: "alert"}, withCode(why)));
  }
}
