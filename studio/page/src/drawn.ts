// Plans as pictures, drawn by the engines.
import type {Desk} from "./desk";
import {h} from "./dom";
import {NO_NUMBER, cards, picture, type Card} from "./svg";
import type {DrawRequest} from "./requests";

export interface Drawn {
  each: Card[]; // a picture for each plan, or
  whole: SVGSVGElement | null; // one of all of them
}

export async function drawing(desk: Desk, request: DrawRequest, subject: string, name: string): Promise<Drawn> {
  const library = desk.library();
  const {files} = await desk.questions.ask("draw", {format: "svg", library: library?.name, title: "", ...request}, subject);
  const sheet = files[0]?.text ? picture(files[0].text, name) : null;
  if (!sheet) return {each: [], whole: null};
  const each = cards(sheet);
  return each.length ? {each, whole: null} : {each: [], whole: sheet};
}

export async function drawPlans(desk: Desk, plans: string[], subject: string): Promise<Drawn> {
  const drawn = await drawing(desk, {plans: plans.map((plan) => ({plan, number: NO_NUMBER}))}, subject, "the plans");
  return drawn.each.length === plans.length ? drawn : {each: [], whole: drawn.whole};
}

// The pictures of a sheet at one scale: the widest has the whole width of its place. Bars of a style would be refused as
// inline styles; properties of the element are not.
export function scaled(each: Card[]): SVGSVGElement[] {
  const widest = Math.max(...each.map((card) => card.width));
  for (const {svg, width} of each) svg.style.width = `${(100 * width) / widest}%`;
  return each.map((card) => card.svg);
}

export function bar(fraction: number, kind = ""): HTMLElement {
  const inside = h("span", {class: "bar-in"});
  inside.style.width = `${Math.max(fraction > 0 ? 1.5 : 0, fraction * 100)}%`;
  return h("span", {class: `bar ${kind}`, "aria-hidden": "true"}, inside);
}
