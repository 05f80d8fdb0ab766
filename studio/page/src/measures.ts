// Measures: how plans are spread over the values of one, what one more tray does to it, and the front of two.
import type {Desk} from "./desk";
import {fill, h} from "./dom";
import {bar, drawing} from "./drawn";
import {approximately, decimal, grouped, minus} from "./numbers";
import {Refused} from "./questions";
import type {CountedValues, FoundFront, ShownMeasure, SpreadRow} from "./requests";
import {clicked, picture} from "./svg";

const BINS = 16;
const LENGTHS_MOST = 12;

// A value of a measure in the words of the file, as what stands right of a comparison.
export function spelled(fraction: string, unit: string): {times: string; value: string} {
  const [over, under] = fraction.split("/");
  const ending = unit === "ft" ? "'" : unit;
  if (!under || under === "1") return {times: "", value: over + ending};
  let rest = BigInt(under);
  while (rest % 2n === 0n) rest /= 2n;
  while (rest % 5n === 0n) rest /= 5n;
  if (rest !== 1n) return {times: `${under} * `, value: over + ending};
  return {times: "", value: decimal(fraction, 12).replace(/,/g, "").replace("−", "-") + ending};
}

export function requirement(measure: string, unit: string, row: SpreadRow): string {
  const side = (sign: string, value: string) => {
    const {times, value: text} = spelled(value, unit);
    return `${times}${measure} ${sign} ${text}`;
  };
  if (row.value !== undefined) return side("=", row.value);
  return [row.from !== undefined && side(">=", row.from), row.to !== undefined && side("<", row.to)].filter(Boolean).join(" and ");
}

export class Measures {
  readonly element: HTMLElement;
  private tools = h("div", {class: "tools"});
  private body = h("div", null);
  private by = "";
  private other = "";
  private most = [false, false];

  constructor(private desk: Desk) {
    this.element = h("section", {class: "pane measures", "aria-label": "Measures"}, this.tools, this.body);
  }

  private choices(): ShownMeasure[] {
    const library = this.desk.library();
    return (this.desk.shown()?.measures ?? []).filter((measure) => (library?.form ? measure.form : measure.schema));
  }

  async refresh(): Promise<void> {
    const library = this.desk.library();
    const choices = this.choices();
    if (!library) return;
    if (!choices.length) {
      fill(this.tools);
      fill(this.body, h("p", {class: "lead"}, "A measure gives each plan a number: its cost, its area, how many rooms it has."), h("p", {class: "hint"}, "This file has none yet. For example, a line such as this, with the words of your file:"), h("pre", null, `measure cost "in thousands" = 9 * sum(width) / 1m + 25 * trays`));
      return;
    }
    if (!choices.some(({name}) => name === this.by)) this.by = choices[0].name;
    if (!choices.some(({name}) => name === this.other)) this.other = "";
    this.renderTools(choices);
    const chosen = choices.find(({name}) => name === this.by)!;
    const spread = await this.spread(library.name);
    const chart = h("figure", {class: "chart"});
    const svg = spread.files?.[0]?.text ? picture(spread.files[0].text, `How many plans have which ${this.by}`) : null;
    if (svg) {
      chart.append(svg);
      clicked(svg, "bar", (number) => this.show(spread, spread.distribution[number]));
    }
    const rows = h("div", null);
    const lengths = h("section", null);
    const front = h("section", null);
    fill(
      this.body,
      h("p", {class: "lead"}, `${chosen.doc ? `${this.by}, ${chosen.doc}` : this.by}: `, h("strong", null, this.value(spread.least, spread.unit)), " to ", h("strong", null, this.value(spread.most, spread.unit)), ", ", h("strong", null, this.value(spread.mean, spread.unit)), " on average."),
      chart, rows, lengths, front,
    );
    this.bins(rows, spread);
    await this.byLength(lengths, library.name, library.trays, spread.unit);
    if (this.other) await this.front(front, library.name, choices);
  }

  // Engines that were built without pictures count all the same.
  private async spread(library: string): Promise<CountedValues> {
    const request = {library, by: this.by, bins: BINS};
    try {
      return (await this.desk.questions.ask("count", {...request, picture: "svg"}, "measure")) as CountedValues;
    } catch (failure) {
      if (!(failure instanceof Refused)) throw failure;
      return (await this.desk.questions.ask("count", request, "measure")) as CountedValues;
    }
  }

  private value(fraction: string | null, unit: string): string {
    return `${decimal(fraction)}${unit && fraction !== null ? ` ${unit}` : ""}`;
  }

  private renderTools(choices: ShownMeasure[]): void {
    const focused = document.activeElement?.id;
    const select = (id: string, label: string, value: string, none: boolean, set: (name: string) => void) =>
      h("label", null, `${label} `, h("select", {id, onchange: (event: Event) => {
        set((event.target as HTMLSelectElement).value);
        void this.desk.refreshPane();
      }}, none && h("option", {value: ""}, "no other"), choices.filter(({name}) => !none || name !== this.by).map(({name}) => h("option", {value: name, selected: name === value}, name))));
    const wish = (id: string, i: number) => h("button", {id, type: "button", class: "quiet", "aria-label": `${i ? this.other : this.by}: ${this.most[i] ? "most" : "least"} is best`, onclick: () => {
      this.most[i] = !this.most[i];
      void this.desk.refreshPane();
    }}, this.most[i] ? "most is best" : "least is best");
    fill(
      this.tools,
      select("measure-by", "Measure", this.by, false, (name) => (this.by = name)), this.other && wish("wish-by", 0),
      choices.length > 1 && select("measure-other", "against", this.other, true, (name) => (this.other = name)), this.other && wish("wish-other", 1),
    );
    if (focused) document.getElementById(focused)?.focus();
  }

  private label(row: SpreadRow): string {
    return row.value !== undefined ? decimal(row.value) : `${decimal(row.from)} to ${decimal(row.to)}`;
  }

  private show(spread: CountedValues, row: SpreadRow): void {
    this.desk.showWhere(requirement(spread.measure, spread.unit, row), `${spread.measure} ${this.label(row)}${spread.unit ? ` ${spread.unit}` : ""}`);
  }

  private bins(place: Element, spread: CountedValues): void {
    const count = (row: SpreadRow) => row.plans ?? row.houses ?? "0";
    const most = spread.distribution.reduce((max, row) => Math.max(max, approximately(count(row))), 1);
    fill(place, h("table", {class: "bins"},
      h("thead", {class: "sr"}, h("tr", null, h("th", {scope: "col"}, spread.measure), h("th", {scope: "col"}, "share"), h("th", {scope: "col"}, "plans"))),
      h("tbody", null, spread.distribution.filter((row) => count(row) !== "0").map((row) =>
        h("tr", null,
          h("th", {scope: "row"}, h("button", {type: "button", class: "link", title: "Show these plans", onclick: () => this.show(spread, row)}, this.label(row))),
          h("td", {class: "bar-cell"}, bar(approximately(count(row)) / most)), h("td", {class: "num"}, grouped(count(row))))))));
  }

  // What one more tray comes to: the least, the mean and the most of the plans of each length.
  private async byLength(place: Element, library: string, trays: [number, number] | undefined, unit: string): Promise<void> {
    if (!trays || trays[1] === trays[0] || trays[1] - trays[0] >= LENGTHS_MOST) return;
    const found: {length: number; answer: CountedValues}[] = [];
    for (let length = trays[0]; length <= trays[1]; length++)
      found.push({length, answer: (await this.desk.questions.ask("count", {library, by: this.by, bins: 1, trays: {from: length, to: length}}, `measure ${length}`)) as CountedValues});
    const rows = found.filter(({answer}) => answer.least !== null);
    const more = (now: string | null, before: string | null | undefined, trays: number) => {
      if (now === null || before === null || before === undefined) return "";
      const text = decimal(minus(now, before));
      return `${text.startsWith("−") || text === "0" ? text : `+${text}`}${trays > 1 ? ` for ${trays}` : ""}`;
    };
    fill(place,
      h("h2", null, "What one more tray does to it"),
      h("table", {class: "by-length"},
        h("thead", null, h("tr", null, ["trays", "least", "", "mean", "", "most", ""].map((name, i) => (name ? h("th", {scope: "col", class: i ? "num" : ""}, name) : h("td", null))))),
        h("tbody", null, rows.map(({length, answer}, i) => {
          const before = rows[i - 1]?.answer;
          const trays = length - (rows[i - 1]?.length ?? length);
          const cells = (now: string | null, then: string | null | undefined) => [h("td", {class: "num"}, this.value(now, unit)), h("td", {class: "num more"}, more(now, then, trays))];
          return h("tr", null, h("th", {scope: "row"}, length), cells(answer.least, before?.least), cells(answer.mean, before?.mean), cells(answer.most, before?.most));
        }))));
  }

  private async front(place: Element, library: string, choices: ShownMeasure[]): Promise<void> {
    const by = [{measure: this.by, most: this.most[0]}, {measure: this.other, most: this.most[1]}];
    const answer = (await this.desk.questions.ask("pareto", {library, by}, "front")) as FoundFront;
    const drawn = this.desk.library()?.form ? null : await drawing(this.desk, {front: true, by}, "front", `The best trade-offs of ${this.by} and ${this.other}`);
    const show = ({plan, house}: {plan?: string; house?: string}) => this.desk.explain(plan ?? house!);
    if (drawn?.whole) clicked(drawn.whole, "point", (number) => show(answer.points[number]));
    const unit = (name: string) => choices.find((measure) => measure.name === name)?.unit ?? "";
    fill(place,
      h("h2", null, `The best trade-offs of ${this.by} and ${this.other}`),
      drawn?.whole && h("figure", {class: "chart"}, drawn.whole),
      h("table", {class: "front"},
        h("thead", null, h("tr", null, answer.measures.map((name) => h("th", {scope: "col", class: "num"}, name)), h("th", {scope: "col", class: "num"}, "plans"), h("th", {scope: "col"}, "one of them"))),
        h("tbody", null, answer.points.map((point) => h("tr", null,
          point.values.map((value, i) => h("td", {class: "num"}, this.value(value, unit(answer.measures[i])))),
          h("td", {class: "num"}, grouped(point.plans ?? point.houses ?? "")),
          h("td", null, h("button", {type: "button", class: "link", onclick: () => show(point)}, point.rank !== undefined ? `no. ${grouped(point.rank)}` : "show")))))));
  }
}

