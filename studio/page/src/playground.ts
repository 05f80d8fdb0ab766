// The page without a server: the engines are in workers, the files in this page and in the address, where they can be
// passed on.
import {fragmentOf, linkedOf, type Linked} from "./link";
import {Studio} from "./studio";
import {WorkerTransport, type HeldFiles} from "./workers";

const KEPT = "tartan.playground";

async function begun(): Promise<Linked | null> {
  const linked = await linkedOf(location.hash);
  if (linked) return linked;
  const kept = localStorage.getItem(KEPT);
  return kept ? linkedOf(kept) : null;
}

async function start(): Promise<void> {
  const linked = await begun();
  const files: HeldFiles = {
    texts: new Map(Object.entries(linked?.files ?? {})),
    open: linked?.open ?? "",
    changed: () => void keep(),
  };
  const transport = new WorkerTransport(files);
  const studio = new Studio(transport);
  let shown = location.hash;

  async function keep(): Promise<void> {
    const open = studio.files.shown?.path ?? [...files.texts.keys()][0] ?? "";
    const fragment = await fragmentOf({files: Object.fromEntries(files.texts), open});
    if (!fragment) {
      studio.notices.show("link", "The files are too long for a link. Save a copy of each that you want to keep.", [{label: "Close", run: () => studio.notices.clear("link")}]);
      return;
    }
    studio.notices.clear("link");
    shown = fragment;
    history.replaceState(null, "", fragment);
    localStorage.setItem(KEPT, fragment);
    studio.notices.say("The address of this page holds the files now: pass it on as a link.");
  }

  window.addEventListener("hashchange", async () => {
    if (location.hash === shown) return;
    const another = await linkedOf(location.hash);
    if (!another) return;
    shown = location.hash;
    for (const [path, text] of Object.entries(another.files)) await studio.files.receive(path, text);
    await studio.files.open(another.open);
  });

  await transport.open();
}

void start();
