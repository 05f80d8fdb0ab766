// A form in space, which is turned, moved and zoomed. This file alone needs three.js, and is loaded when the first form is
// shown. Nothing is drawn while nothing changes.
import {
  BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, EdgesGeometry, HemisphereLight, LineBasicMaterial, LineSegments, Mesh as Body,
  MeshLambertMaterial, MOUSE, PerspectiveCamera, Scene, Sphere, Spherical, TOUCH, Vector3, WebGLRenderer,
} from "three";
import {OrbitControls} from "three/addons/controls/OrbitControls.js";
import type {Mesh} from "./mesh";

const FIELD_OF_VIEW = 28;
const BEND = 18; // degrees from which on an edge is drawn
const EDGES_MAX = 40_000; // triangles: finding edges takes longer than a frame beyond
const TURN = Math.PI / 24; // a key
const ZOOM = 1.12;
const MOVE = 0.06; // of the distance

// As the engines draw forms: from -60 degrees about the vertical, 30 high. Here y is up.
const VIEWS = {
  whole: [Math.cos(Math.PI / 6) * 0.5, 0.5, Math.cos(Math.PI / 6) * Math.sin(Math.PI / 3)],
  above: [0, 1, 0.0001],
  front: [0, 0, 1],
  side: [1, 0, 0],
} as const;

export type View = keyof typeof VIEWS;

// The edges of faces that are all triangles, or all quadrilaterals: each of these is two triangles that follow one
// another, and what both have is no edge. Null for other faces.
function netOf(mesh: Mesh, faces: number): BufferGeometry | null {
  const each = mesh.faces / faces;
  if (each !== 1 && each !== 2) return null;
  const ends: number[] = [];
  const met = new Set<number>();
  for (let face = 0; face < faces; face++) {
    const own = new Map<number, [number, number]>();
    for (let i = 3 * each * face; i < 3 * each * (face + 1); i++) {
      const a = mesh.corners[i];
      const b = mesh.corners[i % 3 === 2 ? i - 2 : i + 1];
      const key = Math.min(a, b) * mesh.vertices + Math.max(a, b);
      if (!own.delete(key)) own.set(key, [a, b]);
    }
    for (const [key, pair] of own) {
      if (!met.has(key)) ends.push(...pair);
      met.add(key);
    }
  }
  const net = new BufferGeometry();
  net.setAttribute("position", new BufferAttribute(mesh.places, 3));
  net.setIndex(ends);
  return net;
}

export class FormView {
  readonly canvas: HTMLCanvasElement;
  private renderer: WebGLRenderer;
  private scene = new Scene();
  private camera = new PerspectiveCamera(FIELD_OF_VIEW);
  private controls: OrbitControls;
  private light = new DirectionalLight(0xffffff, 2.1);
  private sphere = new Sphere(new Vector3(), 1);
  private shown: BufferGeometry[] = [];
  private materials: {smooth: MeshLambertMaterial[]; flat: MeshLambertMaterial[]} = {smooth: [], flat: []};
  private line = new LineBasicMaterial({transparent: true, opacity: 0.55});
  private frame = 0;
  private placed = false; // was there a place to be drawn in when it was looked at?

  // `drawn` is told each time that a form stands in a frame; `lost` if the browser takes the drawing away.
  constructor(private host: HTMLElement, name: string, private drawn: () => void, lost: () => void) {
    this.renderer = new WebGLRenderer({antialias: true, powerPreference: "low-power"});
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "application");
    this.canvas.setAttribute("aria-label", name);
    this.canvas.setAttribute("aria-describedby", "form-keys");
    this.canvas.addEventListener("webglcontextlost", lost);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.mouseButtons = {LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN};
    this.controls.touches = {ONE: TOUCH.ROTATE, TWO: TOUCH.DOLLY_PAN};
    this.controls.addEventListener("change", () => this.draw());
    this.canvas.addEventListener("keydown", (event) => this.press(event));
    this.camera.add(this.light);
    this.light.position.set(-0.6, 0.9, 0.6);
    this.scene.add(this.camera, new HemisphereLight(0xffffff, 0x9a9284, 1.8));
    host.append(this.canvas);
    new ResizeObserver(() => this.resize()).observe(host);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.recolour());
    this.recolour();
    this.resize();
  }

  // `fits`: it is looked at anew. So it is, too, if it has become much larger or smaller. `faces`: of a net, all edges of
  // which are drawn, how many faces it has; null: edges are where a form bends.
  show(mesh: Mesh, fits: boolean, faces: number | null): void {
    this.forget();
    this.resize(); // it may have had no place until now
    const geometry = this.geometryOf(mesh);
    const materials = this.materialsOf(mesh);
    this.scene.add(new Body(geometry, materials.length === 1 ? materials[0] : materials));
    if (!mesh.normals && mesh.faces > 0 && mesh.faces <= EDGES_MAX) {
      const edges = (faces === null ? null : netOf(mesh, faces)) ?? new EdgesGeometry(geometry, BEND);
      this.shown.push(edges);
      this.scene.add(new LineSegments(edges, this.line));
    }
    const before = this.sphere.radius;
    this.sphere.copy(geometry.boundingSphere!);
    this.sphere.radius = Math.max(this.sphere.radius, 1e-6);
    if (fits || this.sphere.radius > 1.8 * before || this.sphere.radius < 0.5 * before) this.look("whole", !fits);
    this.draw();
  }

  // One for each group. They stay for the next mesh: programs of new ones would be compiled again, which takes many frames.
  private materialsOf({groups, normals}: Mesh): MeshLambertMaterial[] {
    const all = normals ? this.materials.smooth : this.materials.flat;
    while (all.length < groups.length) all.push(new MeshLambertMaterial({side: DoubleSide, flatShading: !normals, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1}));
    groups.forEach(({colour}, i) => all[i].color.setRGB(...colour));
    return all.slice(0, groups.length);
  }

  private geometryOf(mesh: Mesh): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(mesh.places, 3));
    if (mesh.normals) geometry.setAttribute("normal", new BufferAttribute(mesh.normals, 3));
    geometry.setIndex(new BufferAttribute(mesh.corners, 1));
    if (mesh.groups.length > 1) mesh.groups.forEach(({start, count}, i) => geometry.addGroup(start, count, i));
    geometry.computeBoundingSphere();
    this.shown.push(geometry);
    return geometry;
  }

  private forget(): void {
    for (const object of [...this.scene.children]) if (object instanceof Body || object instanceof LineSegments) this.scene.remove(object);
    for (const one of this.shown) one.dispose();
    this.shown = [];
  }

  // From one of the sides; `turned`: from where it is looked at now.
  look(view: View, turned = false): void {
    const to = this.sphere.center;
    const direction = turned ? this.camera.position.clone().sub(this.controls.target).normalize() : new Vector3(...VIEWS[view]).normalize();
    const half = (FIELD_OF_VIEW / 2) * (Math.PI / 180);
    const narrow = Math.min(half, Math.atan(Math.tan(half) * this.camera.aspect));
    this.placed = this.host.clientWidth > 0;
    this.controls.target.copy(to);
    this.camera.position.copy(to).addScaledVector(direction, (1.02 * this.sphere.radius) / Math.sin(narrow));
    this.controls.update();
    this.draw();
  }

  private press(event: KeyboardEvent): void {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const sideways = event.key === "ArrowLeft" ? -1 : event.key === "ArrowRight" ? 1 : 0;
    const up = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
    if (sideways || up) event.shiftKey ? this.move(sideways, up) : this.turn(sideways, up);
    else if (event.key === "+" || event.key === "=") this.zoom(1 / ZOOM);
    else if (event.key === "-") this.zoom(ZOOM);
    else if (event.key === "0" || event.key === "Home") this.look("whole");
    else return;
    event.preventDefault();
  }

  // What is done to where the camera stands, as seen from what it looks at.
  private place(change: (from: Spherical) => void): void {
    const from = new Spherical().setFromVector3(this.camera.position.clone().sub(this.controls.target));
    change(from);
    from.makeSafe();
    this.camera.position.setFromSpherical(from).add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  private turn(sideways: number, up: number): void {
    this.place((from) => {
      from.theta += sideways * TURN;
      from.phi -= up * TURN;
    });
  }

  zoom(factor: number): void {
    this.place((from) => (from.radius *= factor));
  }

  private move(sideways: number, up: number): void {
    const far = this.camera.position.distanceTo(this.controls.target) * MOVE;
    const step = new Vector3(sideways * far, up * far, 0).applyQuaternion(this.camera.quaternion);
    this.camera.position.add(step);
    this.controls.target.add(step);
    this.controls.update();
    this.draw();
  }

  private resize(): void {
    const {clientWidth: width, clientHeight: height} = this.host;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    if (!this.placed && this.shown.length) this.look("whole");
    this.draw();
  }

  private recolour(): void {
    const colour = (name: string) => new Color(getComputedStyle(document.documentElement).getPropertyValue(name).trim());
    this.line.color.copy(colour("--ink"));
    this.renderer.setClearColor(colour("--paper"));
    this.draw();
  }

  private draw(): void {
    this.frame ||= requestAnimationFrame(() => {
      this.frame = 0;
      const far = this.camera.position.distanceTo(this.sphere.center);
      this.camera.near = Math.max(far - 1.1 * this.sphere.radius, this.sphere.radius / 500);
      this.camera.far = Math.max(far + 1.1 * this.sphere.radius, 2 * this.camera.near);
      this.camera.updateProjectionMatrix();
      this.renderer.render(this.scene, this.camera);
      if (this.shown.length) this.drawn();
    });
  }
}
