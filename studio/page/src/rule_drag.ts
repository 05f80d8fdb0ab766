// Dragging by mouse, pen and finger: what is pressed is carried once the pointer has moved, until it is let go.
import {h} from "./dom";
import type {Carried} from "./rule_drops";

const FAR = 6; // pixels until a press is a drag

export interface DragHooks {
  over: (carried: Carried, x: number, y: number) => void;
  drop: (carried: Carried, x: number, y: number) => void;
  end: () => void;
}

export class Drag {
  private ghost: HTMLElement | null = null;
  private stop: (() => void) | null = null;
  private ended = 0;

  constructor(private hooks: DragHooks) {}

  // A click that ends a drag is none.
  get justEnded(): boolean {
    return performance.now() - this.ended < 50;
  }

  // Begins when the pointer is pressed on something that can be carried.
  press(event: PointerEvent, carried: Carried, label: string): void {
    if (event.button !== 0 || !event.isPrimary) return;
    this.stop?.();
    const from = {x: event.clientX, y: event.clientY};
    const move = (at: PointerEvent) => {
      if (at.pointerId !== event.pointerId) return;
      if (!this.ghost && Math.hypot(at.clientX - from.x, at.clientY - from.y) < FAR) return;
      at.preventDefault();
      this.carry(label, at.clientX, at.clientY);
      this.hooks.over(carried, at.clientX, at.clientY);
    };
    const up = (at: PointerEvent) => {
      if (at.pointerId !== event.pointerId) return;
      if (this.ghost && at.type === "pointerup") this.hooks.drop(carried, at.clientX, at.clientY);
      this.stop?.();
    };
    const key = (at: KeyboardEvent) => {
      if (at.key !== "Escape" || !this.ghost) return;
      at.stopPropagation();
      this.stop?.();
    };
    this.stop = () => {
      window.removeEventListener("pointermove", move);
      window.removeEventListener("pointerup", up);
      window.removeEventListener("pointercancel", up);
      window.removeEventListener("keydown", key, true);
      if (this.ghost) this.ended = performance.now();
      this.ghost?.remove();
      this.ghost = null;
      this.stop = null;
      document.body.classList.remove("dragging");
      this.hooks.end();
    };
    window.addEventListener("pointermove", move);
    window.addEventListener("pointerup", up);
    window.addEventListener("pointercancel", up);
    window.addEventListener("keydown", key, true);
  }

  private carry(label: string, x: number, y: number): void {
    if (!this.ghost) {
      this.ghost = h("div", {class: "ghost", "aria-hidden": "true"}, label);
      document.body.append(this.ghost);
      document.body.classList.add("dragging");
    }
    this.ghost.style.transform = `translate(${x + 12}px, ${y + 10}px)`;
  }
}
