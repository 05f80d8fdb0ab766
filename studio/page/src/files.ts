// The files of the folder: reading, saving, and what happens if one was changed elsewhere.
import {Text} from "@codemirror/state";
import type {Connection, Failure} from "./connection";
import {OpenFile, STANDARD, pathOf, type Documents} from "./documents";
import type {Editor} from "./editor";
import {fill, h} from "./dom";
import {keep} from "./keep";
import {NOTATIONS, notationOf} from "./language";
import type {Notices} from "./notices";
import {STARTS, type Start} from "./starts";

export interface Folder {
  folder: string;
  readOnly: boolean;
  open: string | null;
  files: {path: string; size: number; notation: string}[];
  cut: boolean;
}

interface Draft {
  text: string;
  saved: string;
}

const DRAFT = "tartan.draft.";

export class Files {
  readonly element = h("nav", {class: "files", "aria-label": "Files", popover: "auto", id: "files"});
  readonly welcome = h("section", {class: "welcome", hidden: true, "aria-label": "Begin"});
  folder: Folder = {folder: "", readOnly: false, open: null, files: [], cut: false};
  shown: OpenFile | null = null;
  before: OpenFile | null = null; // the one of this folder that was shown before that of the standard library
  documents!: Documents;
  editor!: Editor;
  private asked = "";
  private reading = new Map<string, Promise<OpenFile | null>>();

  constructor(
    private connection: Connection,
    private notices: Notices,
    private changed: (another: boolean) => void,
  ) {
    connection.onNotice("tartan/changed", (params: {path: string; hash: string | null}) => this.outside(params.path, params.hash));
  }

  // ---- the folder

  async list(): Promise<Folder> {
    this.folder = await this.connection.ask("tartan/files", {});
    this.render();
    return this.folder;
  }

  private render(): void {
    const open = new Set(this.documents.files.filter((file) => file.changed).map((file) => file.path));
    const known = new Set(this.folder.files.map((file) => file.path));
    const unsaved = this.documents.files.filter((file) => !file.standard && !known.has(file.path)).map((file) => file.path);
    const row = (path: string) => h("li", null, h("button", {
      type: "button", class: "file", "aria-current": this.shown?.path === path && !this.shown.standard ? "true" : null,
      onclick: () => {
        this.element.hidePopover();
        void this.open(path);
      },
    }, h("span", null, path), open.has(path) && h("span", {class: "dot", title: "not saved", role: "img", "aria-label": "not saved"})));
    fill(
      this.element,
      h("p", {class: "folder"}, this.folder.folder),
      h("ul", null, unsaved.map(row), this.folder.files.map(({path}) => row(path))),
      this.folder.cut && h("p", {class: "hint"}, "There are more files than are listed."),
      this.folder.files.length + unsaved.length === 0 && h("p", {class: "hint"}, "There is no file of rules here yet."),
      !this.folder.readOnly && h("div", {class: "starts"}, h("h2", null, "New file"), h("ul", null, STARTS.map((start) => h("li", null, h("button", {type: "button", class: "file", title: start.about, onclick: () => {
        this.element.hidePopover();
        this.begin(start);
      }}, start.title, h("span", {class: "faint"}, start.name.slice(start.name.indexOf(".")))))))),
    );
  }

  showWelcome(): void {
    const card = (start: Start) => h("li", null, h("button", {type: "button", class: "start", onclick: () => this.begin(start)}, h("strong", null, start.title), h("span", null, start.about)));
    fill(
      this.welcome,
      h("h2", {class: "title"}, "Rules for plans, and the plans that they keep"),
      h("p", {class: "lead"}, "In a file of rules you say what a plan is made of and which plans are good. This page counts every plan there is, draws some, and says of each why it is kept or not, while you type."),
      this.folder.readOnly
        ? h("p", {class: "hint"}, "This folder has no file of rules, and may not be written to. Start Tartan in another folder.")
        : [h("h2", null, "Begin with a text that works, and change it"), h("ul", {class: "start-list"}, STARTS.slice(0, 2).map(card)),
          h("h2", null, "Or with another notation"), h("ul", {class: "start-list small"}, STARTS.slice(2).map(card))],
    );
    this.welcome.hidden = false;
    document.body.classList.add("welcoming");
  }

  private hideWelcome(): void {
    this.welcome.hidden = true;
    document.body.classList.remove("welcoming");
  }

  private begin(start: Start): void {
    const taken = new Set([...this.folder.files.map((file) => file.path), ...this.documents.files.map((file) => file.path)]);
    const [base, extension] = start.name.split(".");
    let name = start.name;
    for (let n = 2; taken.has(name); n++) name = `${base}-${n}.${extension}`;
    const file = new OpenFile(name, Text.of(start.text.split("\n")), "", null, false);
    this.documents.add(file);
    this.show(file);
    this.notices.say(`${name} is new. It is written to the folder when you save it.`);
  }

  // ---- opening

  // A file that is asked for while it is being read is read once.
  async load(path: string): Promise<OpenFile | null> {
    const known = this.documents.files.find((file) => file.path === path && !file.standard);
    if (known) return known;
    const reading = this.reading.get(path) ?? this.read(path).finally(() => this.reading.delete(path));
    this.reading.set(path, reading);
    return reading;
  }

  private async read(path: string): Promise<OpenFile | null> {
    try {
      const {text, hash} = await this.connection.ask("tartan/read", {path});
      const file = new OpenFile(path, Text.of(text.split(/\r\n?|\n/)), text.replace(/\r\n?/g, "\n"), hash, this.folder.readOnly);
      this.documents.add(file);
      this.watch();
      return file;
    } catch (failure) {
      this.notices.show("read", `${path} cannot be opened: ${(failure as Failure).message}`, [{label: "Close", run: () => this.notices.clear("read")}], true);
      return null;
    }
  }

  // Of files that are asked for one after the other, the last is shown, in whichever order they arrive.
  async open(path: string): Promise<void> {
    this.asked = path;
    const file = await this.load(path);
    if (!file || this.asked !== path) return;
    this.show(file);
    this.offerDraft(file);
  }

  show(file: OpenFile): void {
    this.hideWelcome();
    this.editor.show(file);
    if (this.shown && !this.shown.standard) this.before = this.shown;
    this.shown = file;
    if (!file.standard) sessionStorage.setItem("tartan.file", file.path);
    document.title = `${file.path} – Tartan`;
    this.changed(true);
    this.render();
    this.watch();
  }

  async showUri(uri: string): Promise<import("@codemirror/view").EditorView | null> {
    const file = this.documents.getFile(uri) ?? (uri.startsWith(STANDARD) ? await this.standard(uri.slice(STANDARD.length)) : await this.load(pathOf(uri)));
    if (!file) return null;
    this.show(file);
    return this.editor.view;
  }

  private async standard(name: string): Promise<OpenFile | null> {
    try {
      const {text} = (await this.connection.ask("tartan/stdlib", {name})) as {text: string};
      const file = new OpenFile(name, Text.of(text.split("\n")), text, "", true, true);
      this.documents.files.push(file);
      return file;
    } catch {
      this.notices.say(`${name} is of the standard library, and cannot be shown.`);
      return null;
    }
  }

  async loadUri(uri: string): Promise<OpenFile | null> {
    const file = await this.load(pathOf(uri));
    if (file && !file.view && !file.state) this.editor.prepare(file);
    return file;
  }

  // ---- saving

  async save(file = this.shown): Promise<void> {
    if (!file || file.readOnly || (!file.changed && file.hash !== null)) return;
    const text = file.text;
    try {
      const {hash} = await this.connection.ask("tartan/write", {path: file.path, text, hash: file.hash});
      file.hash = hash;
      file.saved = text;
      localStorage.removeItem(DRAFT + file.path);
      this.notices.clear("outside");
      this.notices.say(`${file.path} is saved.`);
      this.changed(false);
      void this.list();
      this.watch();
    } catch (failure) {
      const {data, message, code} = failure as Failure;
      if (data?.code === "conflict") this.outside(file.path, data.hash ?? null);
      else if (code === -1) this.notices.say("There is no connection, so nothing is saved. The text stays here.");
      else this.notices.show("write", `${file.path} cannot be saved: ${message}`, [{label: "Save a copy", run: () => keep(file.text, file.path.split("/").pop()!)}, {label: "Close", run: () => this.notices.clear("write")}], true);
    }
  }

  // What is not saved stays in this browser, too: against a closed window or a browser that ends.
  keepDrafts(): void {
    for (const file of this.documents.files) {
      try {
        if (file.changed) localStorage.setItem(DRAFT + file.path, JSON.stringify({text: file.text, saved: file.saved} satisfies Draft));
        else localStorage.removeItem(DRAFT + file.path);
      } catch {
        return; // the browser keeps no more: the text is in the window all the same
      }
    }
  }

  private offerDraft(file: OpenFile): void {
    const kept = localStorage.getItem(DRAFT + file.path);
    if (!kept || file.changed) return;
    const draft = JSON.parse(kept) as Draft;
    if (draft.text === file.saved) return localStorage.removeItem(DRAFT + file.path);
    this.notices.show("draft", `${file.path} was changed here and not saved.`, [
      {label: "Take that text", run: () => {
        this.notices.clear("draft");
        if (this.shown === file) this.editor.replace(draft.text);
      }},
      {label: "Leave it", run: () => {
        this.notices.clear("draft");
        localStorage.removeItem(DRAFT + file.path);
      }},
    ]);
  }

  // Texts that a window closed, or the server ended, before they were saved, and of which the folder has no file.
  restoreNew(): void {
    const known = new Set(this.folder.files.map((file) => file.path));
    for (let i = 0; i < localStorage.length; i++) {
      const key = localStorage.key(i)!;
      const path = key.slice(DRAFT.length);
      if (!key.startsWith(DRAFT) || known.has(path) || !notationOf(path) || this.documents.files.some((file) => file.path === path)) continue;
      const {text} = JSON.parse(localStorage.getItem(key)!) as Draft;
      this.documents.add(new OpenFile(path, Text.of(text.split("\n")), "", null, false));
    }
  }

  get unsaved(): OpenFile[] {
    return this.documents.files.filter((file) => file.changed || (file.hash === null && file.text !== ""));
  }

  // A link brings a file: it takes the place of one of that name, and is written; what was there can be had again by undo.
  async receive(path: string, text: string): Promise<void> {
    const known = this.folder.files.some((file) => file.path === path) || this.documents.files.some((file) => file.path === path);
    const file = known ? await this.load(path) : new OpenFile(path, Text.of(text.split("\n")), "", null, false);
    if (!file) return;
    if (!known) this.documents.add(file);
    this.show(file);
    if (known) this.editor.replace(text);
    await this.save(file);
  }

  // ---- changed elsewhere

  watch(): void {
    const paths = this.documents.files.filter((file) => file.hash !== null && !file.standard).map(({path, hash}) => ({path, hash}));
    void this.connection.ask("tartan/watch", {paths}).catch(() => {});
  }

  private outside(path: string, hash: string | null): void {
    const file = this.documents.files.find((one) => one.path === path && !one.standard);
    if (!file) this.changed(false); // one that a text here uses
    if (!file || hash === file.hash) return;
    if (hash === null) {
      file.hash = null;
      this.notices.show("outside", `${path} is gone from the folder. Its text is still here.`, [
        {label: "Write it again", run: () => void this.save(file)}, {label: "Close", run: () => this.notices.clear("outside")},
      ], true);
      this.changed(false);
      return;
    }
    void this.compare(file);
  }

  private async compare(file: OpenFile): Promise<void> {
    let there: {text: string; hash: string};
    try {
      there = await this.connection.ask("tartan/read", {path: file.path});
    } catch {
      return;
    }
    const text = there.text.replace(/\r\n?/g, "\n");
    const take = () => {
      this.notices.clear("outside");
      this.take(file, text, there.hash);
    };
    if (text === file.text) return take();
    if (!file.changed) {
      take();
      this.notices.say(`${file.path} was changed elsewhere, and is shown as it is now.`);
      return;
    }
    const keep = () => {
      this.notices.clear("outside");
      file.hash = there.hash;
      file.saved = text;
      this.watch();
      this.changed(false);
    };
    const answers = [{label: "Reload it", run: take}, {label: "Keep mine", run: keep}, {label: "See both", run: () => this.both(file, text, take, keep)}];
    this.notices.show("outside", `${file.path} was changed elsewhere, and here too.`, answers, true);
  }

  private take(file: OpenFile, text: string, hash: string): void {
    file.saved = text;
    file.hash = hash;
    if (file.view) this.editor.replace(text);
    else this.documents.updateFile(file.uri, {changes: {from: 0, to: file.current.length, insert: text}});
    this.watch();
    this.changed(false);
  }

  private both(file: OpenFile, theirs: string, take: () => void, keep: () => void): void {
    const mine = file.text.split("\n");
    const others = theirs.split("\n");
    const side = (title: string, lines: string[], against: string[]) => {
      const known = new Set(against);
      return h("section", null, h("h2", null, title), h("pre", {tabindex: "0"}, lines.map((line) => h("span", {class: known.has(line) ? "" : "differs"}, `${line}\n`))));
    };
    const dialog = h("dialog", {class: "both", "aria-label": "Both texts"},
      h("div", {class: "sides"}, side("Here", mine, others), side("In the folder", others, mine)),
      h("div", {class: "foot"},
        h("button", {type: "button", class: "quiet", onclick: () => dialog.close()}, "Decide later"),
        h("button", {type: "button", onclick: () => (dialog.close(), take())}, "Take that of the folder"),
        h("button", {type: "button", class: "primary", onclick: () => (dialog.close(), keep())}, "Keep mine")));
    dialog.addEventListener("close", () => dialog.remove());
    document.body.append(dialog);
    dialog.showModal();
  }
}

export function notationName(path: string): string {
  return NOTATIONS[notationOf(path)]?.name ?? "";
}
