// How fast the studio's page draws, in Chromium without a screen: node page.mjs TARTAN. Called by bench/studio, in whose rows it prints.
//
// An edit to its diagnostics, in the frame that draws them and as they arrive over the page's socket; an edit to the frame with the new form
// beside that frame; and frames while a form is turned, ours against three.js's own example of its OrbitControls (misc_controls_orbit) with the
// same mesh in the same browser. Both sides of a row take turns.
import {chromium} from "../tests/studio/node_modules/playwright-core/index.mjs";
import {build} from "../studio/page/node_modules/esbuild/lib/main.js";
import {spawn, spawnSync} from "node:child_process";
import {copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {dirname, join, resolve} from "node:path";
import {fileURLToPath} from "node:url";

const root = join(dirname(fileURLToPath(import.meta.url)), "..");
const tartan = resolve(process.argv[2]);
// Frames come as fast as they are drawn, not as fast as a screen shows them.
const UNBOUND = ["--disable-frame-rate-limit", "--disable-gpu-vsync"];
const FLAGS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic"];
const EDITS = 15;
const FRAMES = 15;
const TURNS = 5;
const VIEW = {width: 1280, height: 800};
const EGG = "surface egg = pow(x/2, 2) + y*y + z*z - 1.5\nbox (-4, -4, -4) .. (4, 4, 4)\ngrid 30\n";

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

function row(what, ours, other) {
  const [a, b] = [median(ours), median(other)];
  console.log(`${what.padEnd(46)} ${a.toFixed(2).padStart(9)} ${b.toFixed(2).padStart(9)} ms ${(a / b).toFixed(2).padStart(6)}`);
}

async function serve(folder) {
  const child = spawn(tartan, ["studio", folder, "--no-open"]);
  const address = await new Promise((done) => child.stdout.on("data", (part) => {
    const found = /http:\/\/\S+#[0-9a-f]{32}/.exec(String(part));
    if (found) done(found[0]);
  }));
  return {address, end: () => child.kill("SIGINT")};
}

async function openFile(page, name) {
  await page.locator(".cm-content").waitFor();
  await page.locator(".file-name").click();
  await page.locator(".files").getByRole("button", {name, exact: true}).click();
  await page.locator(".form-stage[data-frames]").waitFor();
  await page.waitForTimeout(1000);
}

// ---- edits

// Notes when diagnostics arrive, before the page takes them.
function watchSocket() {
  const Native = window.WebSocket;
  window.WebSocket = class extends Native {
    constructor(...given) {
      super(...given);
      this.addEventListener("message", ({data}) => {
        if (typeof data === "string" && data.includes("publishDiagnostics")) window.arrived = performance.now();
      });
    }
  };
}

// Changes the text from one to the other. Of the diagnostics, which then mark an error or none, and of the form, if it is drawn again: how many
// milliseconds later they stood in a frame, and the how many-eth that frame was after the diagnostics had arrived, which took so many milliseconds.
function edit([from, to, marked]) {
  const editor = document.querySelector(".editor").shadowRoot;
  const view = editor.querySelector(".cm-content").cmTile.root.view;
  const at = view.state.doc.toString().indexOf(from);
  const frames = () => document.querySelector(".form-stage").dataset.frames;
  const before = frames();
  const drawn = {marks: () => (editor.querySelector(".cm-lintRange-error") !== null) === marked, form: () => marked || frames() !== before};
  return new Promise((done) => {
    const began = performance.now();
    const found = {};
    let since = 0;
    window.arrived = 0;
    view.dispatch({changes: {from: at, to: at + from.length, insert: to}});
    const look = () => requestAnimationFrame((now) => {
      // Frames are asked for before what is drawn in them, so the form of this one comes after this call.
      queueMicrotask(() => {
        if (window.arrived) since++;
        for (const [what, is] of Object.entries(drawn)) if (window.arrived && !found[what] && is()) found[what] = {after: performance.now() - began, frame: since};
        if (found.marks && found.form) done({...found, arrived: window.arrived - began});
        else look();
      });
    });
    look();
  });
}

async function edits(browser, address) {
  const page = await browser.newPage({viewport: VIEW});
  await page.addInitScript(watchSocket);
  await page.goto(address);
  await openFile(page, "egg.field");
  const wrong = [];
  const right = [];
  for (let i = 0; i < EDITS; i++)
    for (const [list, words] of [[wrong, ["y*y", "y* ", true]], [right, ["y* ", "y*y", false]]]) {
      list.push(await page.evaluate(edit, words));
      await page.waitForTimeout(250);
    }
  await page.close();
  const all = [...wrong, ...right];
  row("edit to diagnostics: in the page, over its socket", all.map(({marks}) => marks.after), all.map(({arrived}) => arrived));
  row("edit to the form: in the page, diagnostics", right.map(({form}) => form.after), right.map(({marks}) => marks.after));
  console.log(`frames from the diagnostics' arrival: they are drawn in number ${median(all.map(({marks}) => marks.frame))}, the form in ${median(right.map(({form}) => form.frame))}`);
}

// ---- turning

const EXAMPLE = `
import * as THREE from "three";
import {OrbitControls} from "three/addons/controls/OrbitControls.js";
import {readMesh} from "./src/mesh";
export function begin(base64, {width, height}) {
  const file = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  const mesh = readMesh(file);
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0xcccccc);
  const renderer = new THREE.WebGLRenderer({antialias: true});
  renderer.setPixelRatio(window.devicePixelRatio);
  renderer.setSize(width, height);
  window.runs = (on) => renderer.setAnimationLoop(on ? animate : null);
  document.body.appendChild(renderer.domElement);
  const camera = new THREE.PerspectiveCamera(28, width / height, 0.001, 1000);
  const controls = new OrbitControls(camera, renderer.domElement);
  controls.enableDamping = true;
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(mesh.places, 3));
  if (mesh.normals) geometry.setAttribute("normal", new THREE.BufferAttribute(mesh.normals, 3));
  geometry.setIndex(new THREE.BufferAttribute(mesh.corners, 1));
  geometry.computeBoundingSphere();
  scene.add(new THREE.Mesh(geometry, new THREE.MeshPhongMaterial({color: 0xffffff, flatShading: !mesh.normals, side: THREE.DoubleSide})));
  const first = new THREE.DirectionalLight(0xffffff, 3);
  first.position.set(1, 1, 1);
  const second = new THREE.DirectionalLight(0x002288, 3);
  second.position.set(-1, -1, -1);
  scene.add(first, second, new THREE.AmbientLight(0x555555));
  const {center, radius} = geometry.boundingSphere;
  controls.target.copy(center);
  camera.position.copy(center).add(new THREE.Vector3(0.43, 0.5, 0.75).multiplyScalar(1.02 * radius / Math.sin(14 * Math.PI / 180)));
  function animate() {
    controls.update();
    renderer.render(scene, camera);
  }
}`;

async function example(browser, glb, size) {
  const {outputFiles} = await build({stdin: {contents: EXAMPLE, resolveDir: join(root, "studio/page"), loader: "ts"}, bundle: true, write: false, format: "iife", globalName: "example", logLevel: "error"});
  const page = await browser.newPage({viewport: VIEW});
  await page.setContent("<style>body { margin: 0 }</style>");
  await page.addScriptTag({content: outputFiles[0].text});
  await page.evaluate(({base64, size}) => window.example.begin(base64, size), {base64: glb.toString("base64"), size});
  return page;
}

async function ours(browser, address, name) {
  const page = await browser.newPage({viewport: VIEW});
  await page.goto(address);
  await openFile(page, name);
  return page;
}

// Drags the form by a step in each frame: milliseconds a frame. Each waits for the one before to be drawn, by reading a pixel of it.
function turn(count) {
  const canvas = document.querySelector("canvas");
  const gl = canvas.getContext("webgl2");
  const pixel = new Uint8Array(4);
  const send = (type, step) => canvas.dispatchEvent(new PointerEvent(type, {pointerId: 1, pointerType: "mouse", isPrimary: true, button: 0, buttons: 1, clientX: 200 + 3 * step, clientY: 200, bubbles: true}));
  canvas.setPointerCapture = canvas.releasePointerCapture = () => {};
  send("pointerdown", 0);
  return new Promise((done) => {
    let step = 0;
    let began = 0;
    const frame = () => {
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      if (step === 3) began = performance.now();
      send("pointermove", ++step);
      if (step < count + 3) requestAnimationFrame(frame);
      else {
        send("pointerup", step);
        done((performance.now() - began) / count);
      }
    };
    requestAnimationFrame(frame);
  });
}

async function turning(browser, address, folder, name, command, what) {
  const made = join(folder, "made.glb");
  spawnSync(tartan, [...command, "-o", made], {cwd: folder});
  const own = await ours(browser, address, name);
  const size = await own.locator(".form-stage").evaluate(({clientWidth: width, clientHeight: height}) => ({width, height}));
  const pages = [own, await example(browser, readFileSync(made), size)];
  const times = [[], []];
  for (let i = 0; i < TURNS; i++)
    for (const [side, page] of pages.entries()) {
      await page.bringToFront();
      await page.evaluate(() => window.runs?.(true));
      times[side].push(await page.evaluate(turn, FRAMES));
      await page.evaluate(() => window.runs?.(false)); // the example draws all the time
    }
  for (const page of pages) await page.close();
  row(`a frame of ${what}: ours, three.js's example`, ...times);
}

const folder = mkdtempSync(join(tmpdir(), "tartan-bench-"));
writeFileSync(join(folder, "egg.field"), EGG);
writeFileSync(join(folder, "tangle.field"), 'use "primitives"\nsurface tangle = blobby at (x, y, z)\nbox (-7, -7, -7) .. (7, 7, 7)\ngrid 60\n');
copyFileSync(join(root, "examples/gatehouse/gatehouse.kit"), join(folder, "gatehouse.kit"));
const {address, end} = await serve(folder);
const launch = (...more) => chromium.launch({executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: [...FLAGS, ...more]});
let browser = await launch();
await edits(browser, address);
await browser.close();
browser = await launch(...UNBOUND);
await turning(browser, address, folder, "tangle.field", ["mesh", "tangle.field", "--normals"], "a surface");
await turning(browser, address, folder, "gatehouse.kit", ["place", "gatehouse.kit"], "a kit");
await browser.close();
end();
rmSync(folder, {recursive: true, force: true});
