// Reads building models by web-ifc: check-ifc.mjs FILE.ifc ...
//
// It has to find as many instances of each element as the text has; the body of each element is closed, and holds what its base quantities say; what is
// of glass is transparent; elements are within their storeys' building.
import fs from "node:fs";
import * as webifc from "web-ifc";

const ELEMENTS = ["IFCWALL", "IFCDOOR", "IFCWINDOW", "IFCSLAB", "IFCROOF", "IFCSPACE", "IFCSTAIR", "IFCSTAIRFLIGHT", "IFCCOLUMN", "IFCBEAM", "IFCRAILING", "IFCFURNITURE", "IFCOPENINGELEMENT",
  "IFCRELCONNECTSPATHELEMENTS", "IFCRELSPACEBOUNDARY", "IFCRELDEFINESBYTYPE", "IFCZONE"];
const FOOT = 0.3048;
console.log = console.warn = (...words) => process.stderr.write(`${words.join(" ")}\n`); // web-ifc's own
const api = new webifc.IfcAPI();
await api.Init();
let wrong = 0;

function fail(path, text) {
  process.stderr.write(`${path}: ${text}\n`);
  wrong++;
}

// The corners of a piece of a mesh, where it stands.
function cornersOf(model, piece) {
  const data = api.GetGeometry(model, piece.geometryExpressID);
  const values = api.GetVertexArray(data.GetVertexData(), data.GetVertexDataSize()), index = api.GetIndexArray(data.GetIndexData(), data.GetIndexDataSize()), t = piece.flatTransformation;
  const points = [];
  for (let i = 0; i < values.length; i += 6) {
    const [x, y, z] = values.subarray(i, i + 3);
    points.push([0, 1, 2].map((k) => t[k] * x + t[4 + k] * y + t[8 + k] * z + t[12 + k]));
  }
  return {points, index};
}

// The volume of a mesh, and how many of its edges are not between two faces that go opposite ways.
function measure(model, mesh) {
  let six = 0, open = 0;
  for (let i = 0; i < mesh.geometries.size(); i++) {
    const {points, index} = cornersOf(model, mesh.geometries.get(i)), edges = new Map(), names = points.map((p) => p.map((c) => Math.round(c * 1e4)).join());
    for (let f = 0; f < index.length; f += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => points[index[f + k]]);
      six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
      for (const [from, to] of [[0, 1], [1, 2], [2, 0]].map((e) => e.map((k) => names[index[f + k]]))) {
        if (from === to) continue;
        const key = from < to ? `${from} ${to}` : `${to} ${from}`;
        edges.set(key, (edges.get(key) ?? 0) + (from < to ? 1 : -1));
      }
    }
    open += [...edges.values()].filter((n) => n !== 0).length;
  }
  return {volume: six / 6, open};
}

// The net volume of each element by its quantities, in cubic metres.
function volumesSaid(model, scale) {
  const said = new Map();
  for (const id of api.GetLineIDsWithType(model, webifc.IFCRELDEFINESBYPROPERTIES)) {
    const relation = api.GetLine(model, id), set = api.GetLine(model, relation.RelatingPropertyDefinition.value);
    for (const value of set.Quantities ?? []) {
      const quantity = api.GetLine(model, value.value);
      if (quantity.Name.value === "NetVolume") for (const part of relation.RelatedObjects) said.set(part.value, quantity.VolumeValue.value * scale ** 3);
    }
  }
  return said;
}

function checkModel(path) {
  const text = fs.readFileSync(path), model = api.OpenModel(text, {COORDINATE_TO_ORIGIN: false});
  const written = text.toString(), scale = written.includes("IFCCONVERSIONBASEDUNIT") ? FOOT : 1;
  for (const name of ELEMENTS) {
    const found = api.GetLineIDsWithType(model, webifc[name]).size(), wanted = written.split(`=${name}(`).length - 1;
    if (found !== wanted) fail(path, `${found} ${name}, not ${wanted}`);
  }
  const said = volumesSaid(model, scale), glass = new Set(api.GetLineIDsWithType(model, webifc.IFCWINDOW));
  let meshes = 0;
  const look = (mesh) => {
    const {volume, open} = measure(model, mesh), wanted = said.get(mesh.expressID);
    meshes++;
    if (open) fail(path, `#${mesh.expressID} has ${open} open edges`);
    if (!(volume > 0)) fail(path, `#${mesh.expressID} holds nothing`);
    if (wanted !== undefined && Math.abs(volume - wanted) > 1e-3 * Math.max(wanted, 0.01)) fail(path, `#${mesh.expressID} holds ${volume} m3, not ${wanted}`);
    if (glass.has(mesh.expressID) && !(mesh.geometries.get(0).color.w < 1)) fail(path, `#${mesh.expressID} is a window that is not transparent`);
  };
  api.StreamAllMeshes(model, look);
  api.StreamAllMeshesWithTypes(model, [webifc.IFCSPACE, webifc.IFCOPENINGELEMENT], look);
  if (meshes === 0) fail(path, "nothing in it has a body");
  api.CloseModel(model);
  return meshes;
}

const paths = process.argv.slice(2);
let bodies = 0;
for (const path of paths) bodies += checkModel(path);
if (wrong) process.exit(1);
process.stdout.write(`web-ifc finds nothing wrong with ${bodies} bodies of ${paths.length} models\n`);
