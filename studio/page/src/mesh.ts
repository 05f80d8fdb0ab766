// Meshes as they come: .glb files of the engines, whose numbers are looked at where they are.

export interface MeshGroup {
  start: number; // corners
  count: number;
  colour: [number, number, number]; // linear
}

export interface Mesh {
  places: Float32Array<ArrayBuffer>;
  normals: Float32Array<ArrayBuffer> | null;
  corners: Uint32Array<ArrayBuffer>;
  groups: MeshGroup[];
  vertices: number;
  faces: number;
}

const MAGIC = 0x46546c67;
const HEADER = 20; // of the file and of its part of JSON
const CHUNK = 8;

interface Said {
  accessors: {bufferView: number; byteOffset?: number; count: number}[];
  bufferViews: {byteOffset?: number; byteLength: number}[];
  materials: {pbrMetallicRoughness: {baseColorFactor: number[]}}[];
  meshes: {primitives: {attributes: {POSITION: number; NORMAL?: number}; indices: number; material: number}[]}[];
}

// A mesh of no triangles has no primitives.
export function readMesh(file: Uint8Array<ArrayBuffer>): Mesh {
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  if (file.byteLength < HEADER || view.getUint32(0, true) !== MAGIC) throw new Error("this is no mesh");
  const size = view.getUint32(12, true);
  const said = JSON.parse(new TextDecoder().decode(file.subarray(HEADER, HEADER + size))) as Said;
  const binary = file.byteOffset + HEADER + size + CHUNK;
  const floats = (index: number) => {
    const {bufferView, count} = said.accessors[index];
    return new Float32Array(file.buffer, binary + (said.bufferViews[bufferView].byteOffset ?? 0), 3 * count);
  };
  const {primitives} = said.meshes[0];
  const all = said.bufferViews.at(-1)!;
  const corners = new Uint32Array(file.buffer, binary + (all.byteOffset ?? 0), all.byteLength / 4);
  const normal = primitives[0]?.attributes.NORMAL;
  const places = floats(0);
  return {
    places,
    normals: normal === undefined ? null : floats(normal),
    corners,
    groups: primitives.map(({indices, material}) => {
      const {byteOffset, count} = said.accessors[indices];
      const [red, green, blue] = said.materials[material].pbrMetallicRoughness.baseColorFactor;
      return {start: (byteOffset ?? 0) / 4, count, colour: [red, green, blue]};
    }),
    vertices: places.length / 3,
    faces: corners.length / 3,
  };
}
