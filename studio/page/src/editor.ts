// The editor, with all that the language server gives. It stands in a shadow root: there its styles are sheets that the
// page's policy allows.
import {autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap} from "@codemirror/autocomplete";
import {defaultKeymap, history, historyKeymap, indentWithTab} from "@codemirror/commands";
import {bracketMatching, indentOnInput} from "@codemirror/language";
import {lintGutter, lintKeymap, setDiagnostics, type Action, type Diagnostic} from "@codemirror/lint";
import {
  LSPClient, LSPPlugin, findReferencesKeymap, formatKeymap, hoverTooltips, jumpToDefinitionKeymap, renameKeymap, serverCompletion,
} from "@codemirror/lsp-client";
import {highlightSelectionMatches, searchKeymap} from "@codemirror/search";
import {EditorState, StateEffect, StateField, Transaction, type Extension, type TransactionSpec} from "@codemirror/state";
import {
  Decoration, EditorView, crosshairCursor, drawSelection, dropCursor, highlightActiveLine, highlightActiveLineGutter, highlightSpecialChars, keymap,
  lineNumbers, placeholder, rectangularSelection, tooltips, type DecorationSet,
} from "@codemirror/view";
import type {OpenFile} from "./documents";
import {colours} from "./language";
import {sanitized} from "./sanitized";
import type {Edit} from "./edits";

const theme = EditorView.theme({
  "&": {height: "100%", color: "var(--ink)", backgroundColor: "transparent", fontSize: "13.5px"},
  ".cm-scroller": {fontFamily: "var(--mono)", lineHeight: "1.62", overflow: "auto"},
  ".cm-content": {padding: "14px 0 40vh", caretColor: "var(--ink)"},
  ".cm-line": {padding: "0 16px 0 8px"},
  "&.cm-focused": {outline: "none"},
  ".cm-cursor": {borderLeftColor: "var(--ink)", borderLeftWidth: "1.5px"},
  "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground": {background: "var(--selection)"},
  ".cm-gutters": {backgroundColor: "transparent", border: "none", color: "var(--faint)"},
  ".cm-lineNumbers .cm-gutterElement": {padding: "0 8px 0 12px", minWidth: "34px"},
  ".cm-activeLine, .cm-activeLineGutter": {backgroundColor: "var(--line-on)"},
  ".cm-matchingBracket": {backgroundColor: "var(--selection) !important", outline: "none"},
  ".cm-selectionMatch": {backgroundColor: "var(--match)"},
  ".cm-tooltip": {
    backgroundColor: "var(--raised)", color: "var(--ink)", border: "1px solid var(--line)", borderRadius: "6px",
    boxShadow: "var(--shadow)", fontFamily: "var(--sans)", fontSize: "13px", maxWidth: "min(560px, 92vw)",
  },
  ".cm-tooltip .cm-lsp-documentation, .cm-lsp-hover-tooltip": {padding: "8px 12px", maxHeight: "40vh", overflow: "auto"},
  ".cm-tooltip pre, .cm-tooltip code": {fontFamily: "var(--mono)", fontSize: "12.5px", whiteSpace: "pre-wrap"},
  ".cm-tooltip p": {margin: "4px 0"},
  ".cm-tooltip.cm-tooltip-autocomplete > ul": {fontFamily: "var(--mono)", fontSize: "13px", maxHeight: "16em"},
  ".cm-tooltip.cm-tooltip-autocomplete > ul > li": {padding: "3px 10px"},
  ".cm-tooltip-autocomplete ul li[aria-selected]": {backgroundColor: "var(--accent)", color: "var(--on-accent)"},
  ".cm-diagnostic": {padding: "8px 12px", borderLeftWidth: "3px", fontFamily: "var(--sans)", whiteSpace: "pre-wrap"},
  ".cm-diagnostic-error": {borderLeftColor: "var(--gone)"},
  ".cm-diagnostic-warning": {borderLeftColor: "var(--warn)"},
  ".cm-diagnostic-info": {borderLeftColor: "var(--muted)"},
  ".cm-diagnosticAction": {backgroundColor: "var(--accent)", color: "var(--on-accent)", borderRadius: "4px", padding: "2px 8px", marginLeft: "0", marginRight: "8px"},
  ".cm-lintRange-error": {backgroundImage: "none", textDecoration: "underline wavy var(--gone) 1px", textUnderlineOffset: "4px"},
  ".cm-lintRange-warning": {backgroundImage: "none", textDecoration: "underline wavy var(--warn) 1px", textUnderlineOffset: "4px"},
  ".cm-lintRange-info": {backgroundImage: "none", textDecoration: "underline dotted var(--muted) 1px", textUnderlineOffset: "4px"},
  ".cm-panels": {backgroundColor: "var(--raised)", color: "var(--ink)", borderColor: "var(--line)", fontFamily: "var(--sans)"},
  ".cm-textfield": {backgroundColor: "var(--paper)", color: "var(--ink)", border: "1px solid var(--line-strong)", borderRadius: "4px"},
  ".cm-button": {backgroundImage: "none", backgroundColor: "var(--paper)", color: "var(--ink)", border: "1px solid var(--line-strong)", borderRadius: "4px"},
  ".cm-lit": {backgroundColor: "var(--lit)", borderRadius: "2px"},
  ".cm-placeholder": {color: "var(--muted)"},
});

const setLit = StateEffect.define<{from: number; to: number} | null>();
const litMark = Decoration.mark({class: "cm-lit"});
const lit = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(set, transaction) {
    set = set.map(transaction.changes);
    for (const effect of transaction.effects)
      if (effect.is(setLit)) set = effect.value && effect.value.to > effect.value.from ? Decoration.set([litMark.range(effect.value.from, effect.value.to)]) : Decoration.none;
    return set;
  },
  provide: (field) => EditorView.decorations.from(field),
});

export interface EditorHooks {
  changed: () => void;
  moved: () => void; // the cursor, in the same text
  save: () => void;
}

export class Editor {
  readonly view: EditorView;
  private file: OpenFile | null = null;

  constructor(
    host: HTMLElement,
    private client: LSPClient,
    private hooks: EditorHooks,
  ) {
    const root = host.attachShadow({mode: "open"});
    const holder = document.createElement("div");
    root.appendChild(holder);
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(":host{display:block;height:100%} :host>div{height:100%}");
    root.adoptedStyleSheets = [sheet];
    this.view = new EditorView({parent: holder, root, state: EditorState.create({extensions: [theme, EditorView.editable.of(false), EditorView.contentAttributes.of({"aria-label": "No file is open"})]})});
  }

  private extensions(file: OpenFile): Extension {
    return [
      lineNumbers(), lintGutter(), highlightActiveLineGutter(), highlightSpecialChars(), history(), drawSelection(), dropCursor(),
      EditorState.allowMultipleSelections.of(true), indentOnInput(), bracketMatching(), closeBrackets(), autocompletion({icons: false}),
      rectangularSelection(), crosshairCursor(), highlightActiveLine(), highlightSelectionMatches(), tooltips({position: "absolute"}),
      keymap.of([
        {key: "Mod-s", preventDefault: true, run: () => (this.hooks.save(), true)},
        {key: "Escape", run: (view) => (view.state.readOnly ? false : (view.contentDOM.blur(), true))},
        ...closeBracketsKeymap, ...defaultKeymap, ...searchKeymap, ...historyKeymap, ...completionKeymap, ...lintKeymap,
        ...formatKeymap, ...renameKeymap, ...jumpToDefinitionKeymap, ...findReferencesKeymap, indentWithTab,
      ]),
      colours(file.path), theme, lit, placeholder("Write rules here."),
      EditorView.lineWrapping,
      EditorView.contentAttributes.of({"aria-label": `The text of ${file.path}`, tabindex: "0"}),
      EditorState.readOnly.of(file.readOnly), EditorView.editable.of(!file.readOnly), EditorState.tabSize.of(2),
      EditorView.updateListener.of((update) => {
        if (update.docChanged) this.hooks.changed();
        else if (update.selectionSet) this.hooks.moved();
      }),
      file.standard ? [] : [this.client.plugin(file.uri, file.languageId), serverCompletion(), hoverTooltips()],
    ];
  }

  show(file: OpenFile): void {
    if (this.file === file) return;
    this.client.sync();
    if (this.file) this.file.state = this.view.state;
    this.file = file;
    this.view.setState(file.state ?? EditorState.create({doc: file.doc, extensions: this.extensions(file)}));
    file.view = this.view;
    file.state = null;
  }

  // Prepares a file that is not shown, so that a rename can change it.
  prepare(file: OpenFile): void {
    file.state = EditorState.create({doc: file.doc, extensions: this.extensions(file)});
  }

  edit(edits: Edit[], select?: number): void {
    const spec: TransactionSpec = {changes: edits, userEvent: "input", annotations: Transaction.addToHistory.of(true), scrollIntoView: true};
    if (select !== undefined) spec.selection = {anchor: select};
    this.view.dispatch(spec);
  }

  replace(text: string): void {
    const old = this.view.state.doc.toString();
    let from = 0;
    while (from < old.length && from < text.length && old[from] === text[from]) from++;
    let to = old.length;
    let end = text.length;
    while (to > from && end > from && old[to - 1] === text[end - 1]) to--, end--;
    this.view.dispatch({changes: {from, to, insert: text.slice(from, end)}});
  }

  goTo(from: number, to = from): void {
    this.view.dispatch({selection: {anchor: from, head: to}, effects: EditorView.scrollIntoView(from, {y: "center"})});
    this.view.focus();
  }

  light(from: number, to: number): void {
    const end = this.view.state.doc.length;
    if (from > end) return;
    this.view.dispatch({effects: [setLit.of({from, to: Math.min(to, end)}), EditorView.scrollIntoView(from, {y: "nearest", yMargin: 60})]});
  }

  unlight(): void {
    this.view.dispatch({effects: setLit.of(null)});
  }
}

// ---- what the language server says

interface ServerDiagnostic {
  range: {start: {line: number; character: number}; end: {line: number; character: number}};
  severity?: number;
  code?: string | number;
  message: string;
  relatedInformation?: {message: string}[];
}

interface ServerAction {
  title: string;
  diagnostics?: ServerDiagnostic[];
  edit?: {changes?: Record<string, {range: ServerDiagnostic["range"]; newText: string}[]>};
}

const SEVERITIES = ["error", "error", "warning", "info", "hint"] as const;

function shown(plugin: LSPPlugin, item: ServerDiagnostic, actions: Action[]): Diagnostic {
  const place = (position: {line: number; character: number}) => plugin.unsyncedChanges.mapPos(plugin.fromPosition(position, plugin.syncedDoc));
  const from = place(item.range.start);
  return {from, to: Math.max(from, place(item.range.end)), severity: SEVERITIES[item.severity ?? 1], source: String(item.code ?? ""), message: item.message, actions};
}

function actionOf(client: LSPClient, file: OpenFile, action: ServerAction): Action {
  return {
    name: action.title,
    apply: (view) => {
      const plugin = LSPPlugin.get(view);
      const edits = action.edit?.changes?.[file.uri];
      if (!plugin || !edits || !plugin.unsyncedChanges.empty) return;
      view.dispatch({changes: edits.map(({range, newText}) => ({from: plugin.fromPosition(range.start), to: plugin.fromPosition(range.end), insert: newText})), userEvent: "input.fix"});
      client.sync();
    },
  };
}

const sameRange = (a: ServerDiagnostic, b: ServerDiagnostic) => JSON.stringify(a.range) === JSON.stringify(b.range) && a.message === b.message;

// Shows findings as they come, and the fixes of each as soon as they are known.
export function findings(found: (file: OpenFile, items: ServerDiagnostic[]) => void) {
  return {
    clientCapabilities: {textDocument: {publishDiagnostics: {versionSupport: true}, codeAction: {codeActionLiteralSupport: {codeActionKind: {valueSet: ["quickfix"]}}}}},
    notificationHandlers: {
      "textDocument/publishDiagnostics": (client: LSPClient, params: {uri: string; version?: number; diagnostics: ServerDiagnostic[]}) => {
        const file = client.workspace.getFile(params.uri) as OpenFile | null;
        if (!file || (params.version !== undefined && params.version !== null && params.version !== file.version)) return true;
        found(file, params.diagnostics);
        void present(client, file, params.diagnostics);
        return true;
      },
    },
  };
}

async function present(client: LSPClient, file: OpenFile, items: ServerDiagnostic[]): Promise<void> {
  const version = file.version;
  const show = (actions: (item: ServerDiagnostic) => Action[]) => {
    const plugin = file.view && LSPPlugin.get(file.view);
    if (!plugin || file.version !== version) return;
    file.view!.dispatch(setDiagnostics(file.view!.state, items.map((item) => shown(plugin, item, actions(item)))));
  };
  show(() => []);
  if (!items.length || file.readOnly) return;
  const end = {line: file.doc.lines - 1, character: file.doc.line(file.doc.lines).length};
  try {
    const actions = await client.request<unknown, ServerAction[] | null>("textDocument/codeAction", {
      textDocument: {uri: file.uri},
      range: {start: {line: 0, character: 0}, end},
      context: {diagnostics: items, only: ["quickfix"]},
    });
    if (actions?.length)
      show((item) => actions.filter((action) => action.diagnostics?.some((other) => sameRange(item, other))).map((action) => actionOf(client, file, action)));
  } catch {
    // The connection went; findings come again with the next one.
  }
}

export function newClient(workspace: (client: LSPClient) => import("@codemirror/lsp-client").Workspace, found: Parameters<typeof findings>[0]): LSPClient {
  return new LSPClient({rootUri: "file:///", timeout: 60_000, sanitizeHTML: sanitized, workspace, extensions: [findings(found)]});
}
