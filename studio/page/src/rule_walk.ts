// The next part by an arrow: to the sides everything in the order of reading, down into a box, up out of it.
import {childrenOf, type Tree} from "./rule_parts";

export function nextPart(rule: Tree, part: number, key: string): number | null {
  const last = rule.parts.length - 1;
  switch (key) {
    case "ArrowRight":
      return part < last ? part + 1 : null;
    case "ArrowLeft":
      return part > 0 ? part - 1 : null;
    case "ArrowDown":
      return childrenOf(rule, part)[0] ?? null;
    case "ArrowUp":
      return rule.parts[part].parent ?? null;
    case "Home":
      return 0;
    case "End":
      return last;
    default:
      return null;
  }
}
