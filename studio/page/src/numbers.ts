// Counts are strings of digits and exact values are fractions: they are never made doubles but to be drawn.

// Digits in groups of three, with a sign before them if there is one.
export function grouped(digits: string): string {
  const [, sign, whole, rest] = /^([-+]?)(\d*)(.*)$/s.exec(digits)!;
  return sign.replace("-", "−") + whole.replace(/\B(?=(\d{3})+$)/g, ",") + rest;
}

// A count that may have passed a limit.
export function counted(digits: string | null | undefined): string {
  return digits === null || digits === undefined ? "too many to count" : grouped(digits);
}

const POWERS = ["", "thousand", "million", "billion", "trillion", "quadrillion", "quintillion", "sextillion", "septillion", "octillion", "nonillion", "decillion"];

// A count in few letters: whole up to seven digits, then four of them and a word.
export function rounded(digits: string | null | undefined): string {
  if (digits === null || digits === undefined || digits.length <= 7) return counted(digits);
  const power = Math.floor((digits.length - 1) / 3);
  if (power >= POWERS.length) return `${digits[0]}.${digits.slice(1, 3)} × 10^${digits.length - 1}`;
  const whole = digits.length - 3 * power;
  return `${digits.slice(0, whole)}${whole < 4 ? `.${digits.slice(whole, 4)}` : ""} ${POWERS[power]}`;
}

// "1 plan", "2,000 plans".
export function plans(digits: string | null | undefined, word = "plan"): string {
  return `${counted(digits)} ${word}${digits === "1" ? "" : "s"}`;
}

// The part of `whole` that `part` is, from 0 to 1: for lengths of bars.
export function share(part: string | null | undefined, whole: string | null | undefined): number {
  if (!part || !whole || BigInt(whole) === 0n) return 0;
  return Number((BigInt(part) * 1_000_000n) / BigInt(whole)) / 1_000_000;
}

// A share in words: "37%", "<0.01%".
export function percent(part: string | null | undefined, whole: string | null | undefined): string {
  if (!part || !whole || BigInt(whole) === 0n) return "";
  if (part === "0") return "none";
  if (part === whole) return "all";
  const value = share(part, whole) * 100;
  if (value < 0.01) return "<0.01%";
  if (value < 10) return `${value.toFixed(value < 1 ? 2 : 1)}%`;
  return `${Math.min(99, Math.round(value))}%`;
}

interface Fraction {
  over: bigint;
  under: bigint;
}

function fraction(text: string): Fraction {
  const [over, under = "1"] = text.split("/");
  const point = over.indexOf(".");
  if (point < 0) return {over: BigInt(over), under: BigInt(under)};
  const places = over.length - point - 1;
  return {over: BigInt(over.replace(".", "")), under: 10n ** BigInt(places) * BigInt(under)};
}

export function minus(a: string, b: string): string {
  const x = fraction(a);
  const y = fraction(b);
  return `${x.over * y.under - y.over * x.under}/${x.under * y.under}`;
}

// A fraction as a decimal of at most `places` places, rounded half away from zero.
export function decimal(text: string | null | undefined, places = 2): string {
  if (text === null || text === undefined) return "–";
  const {over, under} = fraction(text);
  const scale = 10n ** BigInt(places);
  const negative = over < 0n;
  const size = negative ? -over : over;
  const scaled = (size * scale * 2n + under) / (2n * under);
  const whole = scaled / scale;
  const rest = (scaled % scale).toString().padStart(places, "0").replace(/0+$/, "");
  return grouped(`${negative && scaled > 0n ? "-" : ""}${whole}${rest ? `.${rest}` : ""}`);
}

// What a fraction is as a double: for charts alone.
export function approximately(text: string): number {
  const {over, under} = fraction(text);
  return Number(over) / Number(under);
}

// The name of a clause: one without a name of its own is called by its line, and by its place in that.
export function inWords(name: string): string {
  return name.replace(/@(\d+)(?:\.(\d+))?$/, (_whole, line: string, place?: string) => ` in line ${line}${place ? `, no. ${place}` : ""}`);
}
