// Rules as sentences of choices, for those who do not know the words yet: each makes the rule that one would write.
import type {ShownSchema} from "./requests";

export interface TrayChoice {
  label: string;
  text: string; // of the expression
  name: string; // for the name of a rule
}

// What can be said of one tray, value by value, the fields of names first.
export function trayChoices(schema: ShownSchema): TrayChoice[] {
  const order = ["choice", "flag", "zone", "length"];
  const uses = new Map<string, number>();
  for (const field of schema.fields) for (const name of new Set(field.values.map((value) => value.name))) uses.set(name, (uses.get(name) ?? 0) + 1);
  const fields = [...schema.fields].sort((a, b) => order.indexOf(a.kind) - order.indexOf(b.kind));
  const choices: TrayChoice[] = [];
  for (const field of fields) {
    if (field.kind === "flag") {
      choices.push({label: field.name, text: `tray(${field.name})`, name: field.name});
      choices.push({label: `not ${field.name}`, text: `tray(not ${field.name})`, name: `not-${field.name}`});
      continue;
    }
    for (const name of new Set(field.values.map((value) => value.name))) {
      const alone = field.kind === "choice" && uses.get(name) === 1;
      const label = field.kind === "choice" ? name : `${field.name} ${name}`;
      choices.push({label, text: alone ? `tray(${name})` : `tray(${field.name} ${name})`, name: slug(alone ? name : `${field.name}-${name}`)});
    }
  }
  return choices;
}

function slug(text: string): string {
  const plain = text.replace(/'/g, "ft").replace(/[^\p{L}\p{N}_-]+/gu, "-").replace(/^-+|-+$/g, "");
  return /^\d/.test(plain) ? `of-${plain}` : plain;
}

export interface Place {
  key: string;
  label: string;
  two: boolean; // it is about a second tray
  text: (one: string, other: string) => string;
  name: (one: string, other: string) => string;
}

export const PLACES: Place[] = [
  {key: "middle", label: "in the middle", two: false, text: (a) => `${a} where quantity(any before) = quantity(any after)`, name: (a) => `${a}-in-the-middle`},
  {key: "somewhere", label: "somewhere", two: false, text: (a) => a, name: (a) => `some-${a}`},
  {key: "end", label: "at one end or both", two: false, text: (a) => `symmetric neighbour(beginning, ${a})`, name: (a) => `${a}-at-an-end`},
  {key: "once", label: "exactly once", two: false, text: (a) => `quantity(${a}) = 1`, name: (a) => `one-${a}`},
  {key: "several", label: "more than once", two: false, text: (a) => `quantity(${a}) > 1`, name: (a) => `several-${a}`},
  {key: "row", label: "twice, side by side", two: false, text: (a) => `neighbour(${a}, ${a})`, name: (a) => `two-${a}-in-a-row`},
  {key: "beside", label: "beside", two: true, text: (a, b) => `${a} beside ${b}`, name: (a, b) => `${a}-beside-${b}`},
  {key: "every", label: "always beside", two: true, text: (a, b) => `every ${a} beside ${b}`, name: (a, b) => `every-${a}-beside-${b}`},
  {key: "only", label: "and nothing else", two: false, text: (a) => `every(any, ${a})`, name: (a) => `only-${a}`},
];

export function sentence(one: TrayChoice, place: Place, other: TrayChoice): {name: string; doc: string; text: string} {
  return {
    name: place.name(one.name, other.name),
    doc: `${one.label}, ${place.label}${place.two ? ` ${other.label}` : ""}`,
    text: place.text(one.text, other.text),
  };
}
