// Builds the page into dist/: index.html, app.js, app.css and form_view.js, which is loaded when a form is shown; with --playground FOLDER, the one that has no server, beside
// the engines in that folder (`make wasm`). The words of the notations come from the grammars of the
// extension for VS Code, so that both colour the same.
import {build} from "esbuild";
import {mkdirSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync} from "node:fs";
import {dirname, join, relative} from "node:path";
import {fileURLToPath} from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const grammars = join(here, "../../editors/vscode/syntaxes");
const classes = [
  ["keyword.operator.logical", "operator"],
  ["support.function", "function"],
  ["storage.type", "type"],
  ["keyword", "keyword"],
];

// The words of one grammar, by class: those alternatives of its patterns that are plain words.
function wordsOf(grammar) {
  const words = {};
  const take = (name, pattern) => {
    const found = typeof name === "string" && classes.find(([prefix]) => name.startsWith(prefix));
    if (!found || !pattern) return;
    for (const [, group] of pattern.matchAll(/\(((?:[A-Za-z][\w-]*\|)+[A-Za-z][\w-]*)\)/g))
      for (const word of group.split("|")) words[word.toLowerCase()] ??= found[1];
  };
  const walk = (node) => {
    if (Array.isArray(node)) return node.forEach(walk);
    if (typeof node !== "object" || node === null) return;
    take(node.name, node.match);
    for (const capture of Object.values(node.captures ?? {})) take(capture.name, node.match);
    Object.values(node).forEach(walk);
  };
  walk(grammar);
  return words;
}

function notationWords() {
  const all = {};
  for (const name of readdirSync(grammars).sort())
    all[name.split(".")[0]] = wordsOf(JSON.parse(readFileSync(join(grammars, name), "utf8")));
  return all;
}

const words = {
  name: "words",
  setup(build) {
    build.onResolve({filter: /^tartan:words$/}, () => ({path: "words", namespace: "tartan"}));
    build.onLoad({filter: /.*/, namespace: "tartan"}, () => ({contents: JSON.stringify(notationWords()), loader: "json"}));
  },
};

export const options = {bundle: true, format: "esm", target: "es2022", charset: "utf8", plugins: [words], logLevel: "warning"};

// A server of files alone sends no policy along, so that page has its own.
const POLICY =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; connect-src 'self'; worker-src 'self'; img-src data: blob:; base-uri 'none'; form-action 'none'";

// The licences of the packages that are bundled, each text once, as a comment.
function licencesOf(inputs) {
  const packages = new Set(inputs.map((path) => /^.*node_modules\/(?:@[^/]+\/)?[^/]+/.exec(path)?.[0]).filter(Boolean));
  const texts = new Map();
  for (const path of [...packages].sort()) {
    const folder = join(here, path);
    const {name, version} = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const file = readdirSync(folder).find((one) => /^licen[cs]e/i.test(one));
    if (!file) throw new Error(`${name} has no licence`);
    const text = readFileSync(join(folder, file), "utf8").trim();
    texts.set(text, [...(texts.get(text) ?? []), `${name} ${version}`]);
  }
  const said = [...texts].map(([text, names]) => `${names.join(", ")}:\n\n${text}`).join("\n\n");
  return packages.size === 0 ? "" : `/* This file bundles:\n\n${said.replaceAll("*/", "* /")}\n*/\n`;
}

async function buildPage(entry, out) {
  mkdirSync(out, {recursive: true});
  const bundle = {...options, absWorkingDir: here, entryPoints: {app: join("src", entry)}, outdir: out, minify: true, splitting: true, chunkNames: "[name]"};
  const {outputFiles, metafile} = await build({...bundle, write: false, metafile: true});
  for (const {path, text} of outputFiles) writeFileSync(path, text + licencesOf(Object.keys(metafile.outputs[relative(here, path)].inputs)));
  await build({entryPoints: [join(here, "src/app.css")], outdir: out, minify: true});
  const page = readFileSync(join(here, "src/index.html"), "utf8");
  const policy = `<meta http-equiv="Content-Security-Policy" content="${POLICY}">\n`;
  writeFileSync(join(out, "index.html"), entry === "playground.ts" ? page.replace("<title>", `${policy}<title>`) : page);
  for (const name of ["index.html", "app.js", "app.css", "form_view.js"]) console.log(name, statSync(join(out, name)).size);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const playground = process.argv.indexOf("--playground");
  if (playground > 0) await buildPage("playground.ts", process.argv[playground + 1]);
  else {
    const out = join(here, "dist");
    rmSync(out, {recursive: true, force: true});
    await buildPage("app.ts", out);
  }
}
