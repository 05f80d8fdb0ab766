// What is asked about a file that makes a form: by its notation, with what is chosen beside the drawing.
import type {Questions as Table} from "./requests";

// Chosen on the page; what is not is as the file says, or as the commands have it.
export interface Chosen {
  name?: string; // of several surfaces, designs or models
  grid?: number;
  steps?: number;
  seed?: number;
}

type Question = {[K in keyof Table]: {question: K; request: Table[K]["request"]}}[keyof Table];

export interface FormKind {
  declares: RegExp | null; // a name that can be chosen, in each match
  number: "grid" | "steps" | "seed" | null; // what else can be chosen
  shown: ((chosen: Chosen) => Question) | null; // its mesh; null: it has none
  saved: (chosen: Chosen, format: string) => Question;
  drawn: (chosen: Chosen) => Question; // a picture
  formats: string[];
}

const field = ({name, grid}: Chosen) => ({surface: name, grid});
const solid = ({name}: Chosen) => ({solid: name});
const model = ({name, seed}: Chosen) => ({model: name, seed});
const MESHES = ["glb", "stl", "obj", "ply", "3mf"];
const WIDTH = 900;

const grown: FormKind = {
  declares: null,
  number: "steps",
  shown: ({steps}) => ({question: "grow", request: {format: "glb", groups: true, steps}}),
  saved: ({steps}, format) => ({question: "grow", request: {format: format as "glb", steps}}),
  drawn: ({steps}) => ({question: "grow", request: {format: "svg", width: WIDTH, steps}}),
  formats: ["glb", "stl", "obj", "ply", "dxf"],
};

export const FORM_KINDS: Record<string, FormKind> = {
  field: {
    declares: /^[ \t]*surface[ \t]+([A-Za-z_]\w*)/gim,
    number: "grid",
    shown: (chosen) => ({question: "mesh", request: {format: "glb", normals: true, stats: true, ...field(chosen)}}),
    saved: (chosen, format) => ({question: "mesh", request: {format: format as "glb", ...field(chosen)}}),
    drawn: (chosen) => ({question: "draw", request: {format: "svg", width: WIDTH, ...field(chosen)}}),
    formats: MESHES,
  },
  solid: {
    declares: /^[ \t]*solid[ \t]+([A-Za-z_][\w-]*)/gim,
    number: null,
    shown: (chosen) => ({question: "mesh", request: {format: "glb", cells: true, stats: true, ...solid(chosen)}}),
    saved: (chosen, format) => ({question: "mesh", request: {format: format as "glb", ...solid(chosen)}}),
    drawn: (chosen) => ({question: "draw", request: {format: "svg", width: WIDTH, ...solid(chosen)}}),
    formats: MESHES,
  },
  hemls: grown,
  study: {...grown, number: null},
  kit: {
    declares: /^[ \t]*model[ \t]+([A-Za-z_][\w-]*)/gim,
    number: "seed",
    shown: (chosen) => ({question: "place", request: {formats: ["glb"], ...model(chosen)}}),
    saved: (chosen, format) => ({question: "place", request: {formats: [format], ...model(chosen)}}),
    drawn: (chosen) => ({question: "place", request: {formats: ["svg"], ...model(chosen)}}),
    formats: ["glb", "stl", "obj", "3mf", "ldr"],
  },
  pcfg: {
    declares: null,
    number: "seed",
    shown: null,
    saved: ({seed}, format) => ({question: "place", request: {formats: [format], seed}}),
    drawn: ({seed}) => ({question: "place", request: {formats: [], seed}}),
    formats: ["ldr", "csv"],
  },
};

// The names that can be chosen; the one that the engines take unless one is: of several models there is none.
export function namesIn(kind: FormKind, text: string): string[] {
  return kind.declares ? [...text.matchAll(kind.declares)].map(([, name]) => name) : [];
}
