// The page, whatever carries its messages: rooms, the file that is shown, and what follows a change of its text.
import {Connection, GONE} from "./connection";
import type {Desk} from "./desk";
import {Documents} from "./documents";
import {fill, h, later, paced} from "./dom";
import {Editor, newClient} from "./editor";
import {applied, type Edit} from "./edits";
import {Files, notationName} from "./files";
import {keep} from "./keep";
import {LibraryRoom} from "./library_room";
import {Notices} from "./notices";
import {Questions} from "./questions";
import type {ShownLibrary} from "./requests";
import type {Transport, TransportState} from "./transport";

const PAUSE_MS = 120;
const FRAME_MS = 16;
const DRAFT_MS = 800;

export class Studio {
  readonly connection: Connection;
  readonly notices = new Notices();
  readonly files: Files;
  private editor: Editor;
  private room: LibraryRoom;
  private client;
  private began = false;
  private linked = false;
  private bar = h("header", {class: "top"});
  private status = h("span", {class: "status"});
  private name = h("button", {type: "button", class: "file-name", popovertarget: "files", "aria-haspopup": "true"});
  private saveButton = h("button", {type: "button", class: "save", onclick: () => void this.files.save()}, "Save");
  private follow = later(() => void this.room.refresh(), PAUSE_MS);
  private followForm = paced(() => this.room.refresh(), FRAME_MS);
  private draft = later(() => this.files.keepDrafts(), DRAFT_MS);

  constructor(transport: Transport) {
    this.connection = new Connection(transport);
    this.files = new Files(this.connection, this.notices, (another) => this.changed(another));
    this.client = newClient((client) => {
      this.files.documents = new Documents(client, (uri) => this.files.showUri(uri), (uri) => this.files.loadUri(uri));
      return this.files.documents;
    }, () => {});
    const host = h("div", {class: "editor"});
    this.editor = new Editor(host, this.client, {changed: () => this.typed(), moved: () => this.room.rule.cursorMoved(), save: () => void this.files.save()});
    this.files.editor = this.editor;
    this.room = new LibraryRoom(this.desk());
    this.build(host);
    this.connection.onState((state) => this.connected(state));
    window.addEventListener("beforeunload", (event) => {
      this.files.keepDrafts();
      if (this.files.unsaved.length) event.preventDefault();
    });
    document.addEventListener("keydown", (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "s" || event.defaultPrevented) return;
      event.preventDefault();
      void this.files.save();
    });
  }

  private desk(): Desk {
    const room = () => this.room;
    const file = () => this.files.shown;
    const schemaOf = (library: ShownLibrary | null) => room().shown?.schemas.find((schema) => schema.name === room().schemaOf(library)) ?? null;
    return {
      questions: new Questions(this.connection, this.client, file),
      editor: this.editor,
      file,
      shown: () => room().shown,
      library: () => room().library,
      schema: () => schemaOf(room().library),
      counts: () => room().counts,
      explain: (plan) => room().why.show(plan),
      showRule: (name) => {
        room().choose("rule");
        void room().rule.choose(name);
      },
      showWhere: (requirement, label) => {
        room().choose("plans");
        room().sheet.showWhere(requirement, label);
        room().sheet.element.scrollIntoView({block: "start"});
      },
      edit: (edits, said) => this.edit(edits, said),
      say: (sentence) => this.notices.say(sentence),
      watch: (plan) => room().watchedPlans.toggle(plan),
      watched: () => room().watchedPlans.plans,
      before: () => {
        const {before} = this.files;
        return before && {path: before.path, show: () => this.files.show(before)};
      },
      again: () => this.again(),
      refreshPane: () => room().refreshPane(),
    };
  }

  private build(host: HTMLElement): void {
    const room = (key: string, label: string) => h("button", {type: "button", "data-room": key, "aria-pressed": "false", onclick: () => this.enter(key)}, label);
    fill(this.bar,
      h("h1", {class: "brand"}, "Tartan"),
      this.name, this.status, h("span", {class: "space"}),
      h("div", {class: "rooms", role: "group", "aria-label": "Rooms"}, room("writing", "Writing"), room("library", "Library")),
      this.saveButton);
    const writing = h("section", {class: "writing", "aria-label": "Writing"}, host);
    document.body.replaceChildren(this.bar, this.notices.element, h("main", {class: "rooms-body"}, writing, this.room.element, this.files.welcome), this.files.element, this.room.addRule.element, this.notices.spoken);
    this.enter(sessionStorage.getItem("tartan.room") ?? "writing");
  }

  private enter(key: string): void {
    document.body.dataset.room = key;
    sessionStorage.setItem("tartan.room", key);
    for (const button of this.bar.querySelectorAll("[data-room]")) button.setAttribute("aria-pressed", String((button as HTMLElement).dataset.room === key));
  }

  // ---- what changes

  private typed(): void {
    this.showState();
    this.again();
    this.draft();
  }

  // Plans are counted when typing pauses; forms follow each letter.
  private again(): void {
    if (this.room.showsForm) this.followForm();
    else this.follow();
  }

  // The file that is shown is another one, or it was saved or read.
  private changed(another: boolean): void {
    this.showState();
    if (!another) {
      this.again();
      return;
    }
    this.follow.cancel();
    this.followForm.cancel();
    this.room.another();
    void this.room.refresh();
  }

  private edit(edits: Edit[], said: string): void {
    const before = this.files.shown!.text;
    const last = Math.max(...edits.map((edit) => edit.from));
    const earlier = edits.filter((edit) => edit.from < last).reduce((sum, edit) => sum + edit.insert.length - (edit.to - edit.from), 0);
    const end = edits.find((edit) => edit.from === last)!;
    this.editor.edit(edits, Math.min(applied(before, edits).length, last + earlier + end.insert.trimEnd().length));
    this.notices.say(said);
  }

  private showState(): void {
    const file = this.files.shown;
    this.bar.querySelector('[data-room="library"]')!.textContent = this.room.showsForm ? "Form" : "Library";
    const dirty = Boolean(file && (file.changed || file.hash === null));
    fill(this.name, file?.path ?? "Files", dirty && h("span", {class: "dot", "aria-hidden": "true"}), h("span", {class: "arrow", "aria-hidden": "true"}, "▾"));
    this.name.setAttribute("aria-label", `${file?.path ?? "No file"}: all files`);
    this.name.title = file ? notationName(file.path) : "";
    this.status.textContent = this.connection.state === "open" ? (file ? (file.readOnly ? "read-only" : dirty ? "not saved" : "saved") : "") : "no connection";
    this.saveButton.disabled = !dirty || Boolean(file?.readOnly) || this.connection.state !== "open";
    this.saveButton.hidden = !file || file.readOnly;
  }

  // ---- the connection

  private connected(state: TransportState): void {
    if (state !== "open" && this.linked) this.client.disconnect();
    this.linked = state === "open";
    this.showState();
    if (state === "open")
      this.welcome().catch((failure) => {
        if (failure?.code !== GONE) throw failure; // the next connection begins again
      });
    if (state === "lost" || state === "refused") this.gone(state);
  }

  private gone(state: TransportState): void {
    this.files.keepDrafts();
    const text = state === "refused" && !this.began
      ? "This address is not one that Tartan gave. Start `tartan studio`, and open the address that it prints."
      : "Tartan has ended, or does not answer. Your text is kept here, and is sent again when it is back. If it was started anew, open the address that it prints in this window.";
    const file = this.files.shown;
    this.notices.show("gone", text.replaceAll("`", ""), file ? [{label: "Save a copy", run: () => keep(file.text, file.path.split("/").pop()!)}] : [], true);
  }

  private async welcome(): Promise<void> {
    this.notices.clear("gone");
    this.client.disconnect(); // what was asked while there was no connection is forgotten: the texts come first
    this.client.connect(this.connection.languageTransport);
    this.client.initializing.catch(() => {});
    const folder = await this.files.list();
    if (this.began) {
      this.files.watch();
      this.showState();
      await this.room.refresh();
      return;
    }
    this.began = true;
    this.files.restoreNew();
    const last = sessionStorage.getItem("tartan.file");
    const known = (path: string | null) => path !== null && (folder.files.some((file) => file.path === path) || this.files.documents.files.some((file) => file.path === path));
    const path = known(last) ? last : known(folder.open) ? folder.open : (folder.files.find((file) => file.notation === "plan") ?? folder.files[0])?.path ?? this.files.documents.files[0]?.path;
    if (path) await this.files.open(path);
    else this.files.showWelcome();
    this.showState();
  }

}
