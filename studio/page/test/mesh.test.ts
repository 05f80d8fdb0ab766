import assert from "node:assert/strict";
import test from "node:test";
import {readMesh} from "../src/mesh";

// A .glb as the engines write it, behind the eight bytes of its message.
function file(said: object, numbers: ArrayBuffer): Uint8Array<ArrayBuffer> {
  const json = new TextEncoder().encode(JSON.stringify(said).padEnd(Math.ceil(JSON.stringify(said).length / 4) * 4));
  const bytes = new Uint8Array(8 + 20 + json.length + 8 + numbers.byteLength);
  const view = new DataView(bytes.buffer, 8);
  [0x46546c67, 2, bytes.length - 8, json.length, 0x4e4f534a].forEach((word, i) => view.setUint32(4 * i, word, true));
  bytes.set(json, 28);
  view.setUint32(20 + json.length, numbers.byteLength, true);
  bytes.set(new Uint8Array(numbers), 36 + json.length);
  return bytes.subarray(8);
}

const material = (red: number) => ({pbrMetallicRoughness: {baseColorFactor: [red, 0, 0, 1]}});

test("a mesh of two groups, looked at where it is", () => {
  const places = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0]);
  const corners = new Uint32Array([0, 1, 2, 1, 3, 2]);
  const numbers = new Uint8Array([...new Uint8Array(places.buffer), ...new Uint8Array(corners.buffer)]).buffer;
  const glb = file({
    meshes: [{primitives: [{attributes: {POSITION: 0}, indices: 1, material: 0}, {attributes: {POSITION: 0}, indices: 2, material: 1}]}],
    materials: [material(0.5), material(1)],
    accessors: [{bufferView: 0, count: 4}, {bufferView: 1, byteOffset: 0, count: 3}, {bufferView: 1, byteOffset: 12, count: 3}],
    bufferViews: [{byteLength: 48}, {byteOffset: 48, byteLength: 24}],
  }, numbers);
  const mesh = readMesh(glb);
  assert.equal(mesh.places.buffer, glb.buffer);
  assert.deepEqual(mesh.places, places);
  assert.deepEqual(mesh.corners, corners);
  assert.equal(mesh.normals, null);
  assert.deepEqual([mesh.vertices, mesh.faces], [4, 2]);
  assert.deepEqual(mesh.groups, [{start: 0, count: 3, colour: [0.5, 0, 0]}, {start: 3, count: 3, colour: [1, 0, 0]}]);
});

test("normals, nothing at all, and what is no mesh", () => {
  const one = readMesh(file({
    meshes: [{primitives: [{attributes: {POSITION: 0, NORMAL: 1}, indices: 2, material: 0}]}],
    materials: [material(1)],
    accessors: [{bufferView: 0, count: 1}, {bufferView: 1, count: 1}, {bufferView: 2, count: 3}],
    bufferViews: [{byteLength: 12}, {byteOffset: 12, byteLength: 12}, {byteOffset: 24, byteLength: 12}],
  }, new Float32Array([1, 2, 3, 0, 0, 1, 0, 0, 0]).buffer));
  assert.deepEqual(one.normals, new Float32Array([0, 0, 1]));
  const none = readMesh(file({meshes: [{primitives: []}], materials: [], accessors: [{bufferView: 0, count: 0}], bufferViews: [{byteLength: 0}, {byteLength: 0}]}, new ArrayBuffer(0)));
  assert.deepEqual([none.vertices, none.faces, none.groups.length], [0, 0, 0]);
  assert.throws(() => readMesh(new Uint8Array(40)), /no mesh/);
});
