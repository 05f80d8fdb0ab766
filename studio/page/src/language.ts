// Colours of the notations: a tokenizer that knows comments, texts, numbers with their units, and the words of each.
import {HighlightStyle, StreamLanguage, syntaxHighlighting, type StreamParser} from "@codemirror/language";
import type {Extension} from "@codemirror/state";
import {tags} from "@lezer/highlight";
import words from "tartan:words";

export const NOTATIONS: Record<string, {comment: string; name: string}> = {
  plan: {comment: "#", name: "plans and their rules"},
  hemls: {comment: "//", name: "growing surfaces"},
  bnf: {comment: "#", name: "grammars"},
  study: {comment: "#", name: "studies of evolution"},
  pcfg: {comment: "#", name: "connection grammars"},
  kit: {comment: "#", name: "parts and models"},
  field: {comment: "#", name: "implicit surfaces"},
  solid: {comment: "#", name: "designs of boxes"},
};

export function notationOf(path: string): string {
  const extension = /\.(\w+)$/.exec(path)?.[1].toLowerCase() ?? "";
  return extension in NOTATIONS ? extension : "";
}

const NUMBER = /^\d+(?:\.\d+)?(?:\/\d+)?(?:['’′](?:[ \t]*\d+(?:[ -]\d+\/\d+|\/\d+)?["”″])?|["”″]|(?:mm|cm|m[23]?|sf|cf|ft[23]?)\b)?/;
const NAME = /^[\p{L}_][\p{L}\p{N}_]*(?:-+[\p{L}\p{N}_]+)*/u;
const DECLARING = /^(?:form|let|library|measure|param|rule|schema|test|number|zone|surface|solid|part|model)$/i;

interface State {
  declares: boolean;
}

function parser(notation: string): StreamParser<State> {
  const known: Record<string, string> = (words as Record<string, Record<string, string>>)[notation] ?? {};
  return {
    name: notation,
    startState: () => ({declares: false}),
    token(stream, state) {
      if (stream.eatSpace()) return null;
      if (stream.match("#") || (notation === "hemls" && stream.match("//"))) {
        stream.skipToEnd();
        return "comment";
      }
      if (stream.match(NUMBER)) return "number";
      if (stream.match(/^["“„](?:\\.|[^"”“\\])*["”“]?/)) return "string";
      if (stream.match(/^<[\w-]+>/)) return "typeName";
      const name = stream.match(NAME) as RegExpMatchArray | null;
      if (name) {
        if (state.declares) {
          state.declares = false;
          return "definition";
        }
        state.declares = notation !== "bnf" && DECLARING.test(name[0]);
        return known[name[0].toLowerCase()] ?? "variableName";
      }
      state.declares = false;
      stream.next();
      return "punctuation";
    },
    languageData: {commentTokens: {line: NOTATIONS[notation]?.comment ?? "#"}, closeBrackets: {brackets: ["(", "[", "{", '"']}},
    tokenTable: {
      keyword: tags.keyword,
      operator: tags.operatorKeyword,
      function: tags.standard(tags.function(tags.variableName)),
      type: tags.typeName,
      definition: tags.definition(tags.variableName),
    },
  };
}

const style = HighlightStyle.define([
  {tag: tags.comment, color: "var(--code-comment)", fontStyle: "italic"},
  {tag: tags.string, color: "var(--code-text)"},
  {tag: tags.number, color: "var(--code-number)"},
  {tag: [tags.keyword, tags.typeName], color: "var(--code-word)", fontWeight: "600"},
  {tag: tags.operatorKeyword, color: "var(--code-word)"},
  {tag: tags.standard(tags.function(tags.variableName)), color: "var(--code-function)"},
  {tag: tags.definition(tags.variableName), color: "var(--code-name)", fontWeight: "600"},
  {tag: tags.punctuation, color: "var(--code-sign)"},
]);

export function colours(path: string): Extension {
  return [StreamLanguage.define(parser(notationOf(path))), syntaxHighlighting(style)];
}
