// The files that this window has open, as the client of the language server sees them. One is shown at a time; the
// others wait with their undo history.
import type {ChangeSet, EditorState, Text, TransactionSpec} from "@codemirror/state";
import type {EditorView} from "@codemirror/view";
import {LSPPlugin, Workspace, type LSPClient, type WorkspaceFile} from "@codemirror/lsp-client";
import {notationOf} from "./language";

export const STANDARD = "stdlib:/";

export class OpenFile implements WorkspaceFile {
  version = 1;
  view: EditorView | null = null;
  state: EditorState | null = null; // while it is not shown
  readonly uri: string;
  readonly languageId: string;

  constructor(
    readonly path: string,
    public doc: Text,
    public saved: string, // the text as it was last read or written
    public hash: string | null, // of that; null if there is no such file yet
    readonly readOnly: boolean,
    readonly standard = false, // a file of the standard library, which no server knows as an open one
  ) {
    this.uri = standard ? STANDARD + path : uriOf(path);
    this.languageId = notationOf(path);
  }

  getView(): EditorView | null {
    return this.view;
  }

  get current(): Text {
    return this.view?.state.doc ?? this.state?.doc ?? this.doc;
  }

  get text(): string {
    return this.current.toString();
  }

  get changed(): boolean {
    const now = this.current;
    return now.length !== this.saved.length || now.toString() !== this.saved;
  }
}

export function uriOf(path: string): string {
  return `file:///${path.split("/").map(encodeURIComponent).join("/")}`;
}

export function pathOf(uri: string): string {
  return decodeURIComponent(uri.replace(/^file:\/\/\//, ""));
}

export class Documents extends Workspace {
  files: OpenFile[] = [];

  constructor(
    client: LSPClient,
    private show: (uri: string) => Promise<EditorView | null>,
    private load: (uri: string) => Promise<OpenFile | null>,
  ) {
    super(client);
  }

  override getFile(uri: string): OpenFile | null {
    return this.files.find((file) => file.uri === uri) ?? null;
  }

  add(file: OpenFile): void {
    this.files.push(file);
    if (!file.standard) this.client.didOpen(file);
  }

  remove(file: OpenFile): void {
    this.files = this.files.filter((other) => other !== file);
    if (!file.standard) this.client.didClose(file.uri);
  }

  syncFiles() {
    const updates: {file: OpenFile; prevDoc: Text; changes: ChangeSet}[] = [];
    for (const file of this.files) {
      const plugin = file.view && LSPPlugin.get(file.view);
      if (!plugin || plugin.unsyncedChanges.empty) continue;
      updates.push({file, prevDoc: file.doc, changes: plugin.unsyncedChanges});
      file.doc = file.view!.state.doc;
      file.version++;
      plugin.clear();
    }
    return updates;
  }

  // The files are opened as they are shown, and stay open behind those that are shown later.
  openFile(uri: string, _languageId: string, view: EditorView): void {
    const file = this.getFile(uri);
    if (file) file.view = view;
  }

  closeFile(uri: string): void {
    const file = this.getFile(uri);
    if (file) file.view = null;
  }

  // A connection is made, perhaps again: the server knows nothing of these texts.
  override connected(): void {
    for (const file of this.files) {
      if (file.standard) continue;
      const plugin = file.view && LSPPlugin.get(file.view);
      file.doc = file.current;
      file.version++;
      plugin?.clear();
      this.client.didOpen(file);
    }
  }

  override updateFile(uri: string, update: TransactionSpec): void {
    const file = this.getFile(uri);
    if (file?.view) file.view.dispatch(update);
    else if (file?.state) {
      file.state = file.state.update(update).state;
      file.doc = file.state.doc;
      file.version++;
      this.client.notification("textDocument/didChange", {
        textDocument: {uri, version: file.version},
        contentChanges: [{text: file.doc.toString()}],
      });
    }
  }

  override async requestFile(uri: string): Promise<WorkspaceFile | null> {
    return this.getFile(uri) ?? (await this.load(uri));
  }

  override displayFile(uri: string): Promise<EditorView | null> {
    return this.show(uri);
  }
}
