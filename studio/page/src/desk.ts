// What the panes of the library share.
import type {OpenFile} from "./documents";
import type {Edit} from "./edits";
import type {Editor} from "./editor";
import type {Questions} from "./questions";
import type {CountedPlans, ShownFile, ShownLibrary, ShownSchema} from "./requests";

export interface Desk {
  questions: Questions;
  editor: Editor;
  file(): OpenFile | null;
  shown(): ShownFile | null; // what the file has, as it was when it last compiled
  library(): ShownLibrary | null; // the one that is looked at
  schema(): ShownSchema | null; // of its trays
  counts(): CountedPlans | null; // of that library, with what its clauses do
  explain(plan: string): void;
  showRule(name: string): void; // as a picture
  showWhere(requirement: string, label: string): void; // plans of the sheet: only these
  edit(edits: Edit[], said: string): void;
  say(sentence: string): void;
  watch(plan: string): void;
  watched(): string[];
  before(): {path: string; show: () => void} | null; // the file that was shown before
  again(): void; // what is shown is asked for anew
  refreshPane(): Promise<void>; // what is asked anew when a choice in a pane changes
}
