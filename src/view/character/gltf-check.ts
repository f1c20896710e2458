/**
 * Looks at a glTF 2.0 file before it is read: three's loader trusts what a file says of its sizes and indices, and a damaged one
 * may hang it, ask for all memory, or fail with the engine's own words.
 */

/** Most numbers that one accessor may hold: far beyond any character, well below what a page can hold. */
const MOST_NUMBERS = 20_000_000;
const GLB_MAGIC = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const COMPONENT_BYTES: Record<number, number> = { 5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4 };
const COMPONENTS: Record<string, number> = {
  SCALAR: 1,
  VEC2: 2,
  VEC3: 3,
  VEC4: 4,
  MAT2: 4,
  MAT3: 9,
  MAT4: 16,
};

type Json = Record<string, unknown>;

class Checker {
  constructor(private readonly name: string) {}

  fail(text: string): never {
    throw new Error(`${this.name}: ${text}.`);
  }

  object(v: unknown, at: string): Json {
    if (typeof v !== "object" || v === null || Array.isArray(v)) this.fail(`${at} must be an object`);
    return v as Json;
  }

  list(v: unknown, at: string): unknown[] {
    if (v === undefined) return [];
    if (!Array.isArray(v)) this.fail(`${at} must be a list`);
    return v as unknown[];
  }

  objects(v: unknown, at: string): Json[] {
    return this.list(v, at).map((x, i) => this.object(x, `${at}[${i}]`));
  }

  whole(v: unknown, at: string, most: number, otherwise?: number): number {
    if (v === undefined && otherwise !== undefined) return otherwise;
    if (typeof v !== "number" || !Number.isInteger(v) || v < 0)
      this.fail(`${at} must be a whole number from 0`);
    if ((v as number) > most) this.fail(`${at} must be at most ${most}, found ${v as number}`);
    return v as number;
  }

  index(v: unknown, at: string, of: readonly unknown[], what: string): number {
    const i = this.whole(v, at, Number.MAX_SAFE_INTEGER);
    if (i >= of.length) this.fail(`${at} names ${what} ${i}, there are ${of.length}`);
    return i;
  }

  numbers(v: unknown, at: string, count: number): void {
    if (v === undefined) return;
    const l = this.list(v, at);
    if (l.length !== count || !l.every((x) => typeof x === "number" && Number.isFinite(x)))
      this.fail(`${at} must be ${count} finite numbers`);
  }
}

/**
 * Checks container, sizes, indices and the tree of nodes.
 *
 * @param bytes a `.glb`, or a `.gltf` that carries its buffers itself.
 * @returns the file's JSON.
 * @throws Error "NAME: ..." that names the place.
 */
export function checkGltf(bytes: ArrayBuffer, name: string): Json {
  const c = new Checker(name);
  const { json, binary } = open(c, bytes);
  const asset = c.object(json.asset ?? {}, "asset");
  if (typeof asset.version !== "string" || !asset.version.startsWith("2."))
    c.fail("only glTF 2.0 can be read");
  const buffers = c.objects(json.buffers, "buffers").map((b, i) => bufferBytes(c, b, i, binary));
  const views = c.objects(json.bufferViews, "bufferViews").map((v, i) => {
    const at = `bufferViews[${i}]`;
    const size = buffers[c.index(v.buffer, `${at}.buffer`, buffers, "buffer")];
    const offset = c.whole(v.byteOffset, `${at}.byteOffset`, size, 0);
    return {
      length: c.whole(v.byteLength, `${at}.byteLength`, size - offset),
      stride: c.whole(v.byteStride, `${at}.byteStride`, 255, 0),
    };
  });
  const accessors = c.objects(json.accessors, "accessors");
  accessors.forEach((a, i) => {
    checkAccessor(c, a, `accessors[${i}]`, views);
  });
  checkMeshes(c, json, accessors);
  const nodes = c.objects(json.nodes, "nodes");
  checkNodes(c, json, nodes);
  c.objects(json.skins, "skins").forEach((s, i) => {
    const at = `skins[${i}]`;
    const joints = c.list(s.joints, `${at}.joints`);
    joints.forEach((j, k) => {
      c.index(j, `${at}.joints[${k}]`, nodes, "node");
    });
    if (s.skeleton !== undefined) c.index(s.skeleton, `${at}.skeleton`, nodes, "node");
    if (s.inverseBindMatrices === undefined) return;
    const m = accessors[c.index(s.inverseBindMatrices, `${at}.inverseBindMatrices`, accessors, "accessor")];
    if (m.type !== "MAT4" || (m.count as number) < joints.length)
      c.fail(`${at}.inverseBindMatrices must be a matrix for each of ${joints.length} joints`);
  });
  return json;
}

function open(c: Checker, bytes: ArrayBuffer): { json: Json; binary: number | null } {
  const view = new DataView(bytes);
  const parse = (from: number, length: number): Json => {
    const text = new TextDecoder().decode(new Uint8Array(bytes, from, length));
    try {
      return c.object(JSON.parse(text), "its document");
    } catch (error) {
      if (error instanceof SyntaxError) c.fail("no glTF document can be read in it");
      throw error;
    }
  };
  if (bytes.byteLength < 4 || view.getUint32(0, true) !== GLB_MAGIC)
    return { json: parse(0, bytes.byteLength), binary: null };
  if (bytes.byteLength < 20) c.fail("it ends in its header");
  const length = view.getUint32(8, true);
  if (length > bytes.byteLength)
    c.fail(`it is cut off: ${length} bytes are announced, ${bytes.byteLength} are there`);
  const first = view.getUint32(12, true);
  if (view.getUint32(16, true) !== JSON_CHUNK || 20 + first > length) c.fail("its first part is no document");
  const json = parse(20, first);
  const next = 20 + first;
  if (next === length) return { json, binary: null };
  if (next + 8 > length) c.fail("its second part is cut off");
  const second = view.getUint32(next, true);
  if (next + 8 + second > length) c.fail("its second part is cut off");
  return { json, binary: second };
}

function bufferBytes(c: Checker, b: Json, i: number, binary: number | null): number {
  const at = `buffers[${i}]`;
  const size = c.whole(b.byteLength, `${at}.byteLength`, 2 ** 31);
  if (b.uri === undefined) {
    if (i > 0 || binary === null || size > binary) c.fail(`${at} is not in the file`);
    return size;
  }
  if (typeof b.uri !== "string") c.fail(`${at}.uri must be text`);
  if (!(b.uri as string).startsWith("data:"))
    c.fail(`it needs other files beside it: save it as one .glb file`);
  // Four letters are three bytes.
  if (size > 0.75 * (b.uri as string).length) c.fail(`${at} is cut off`);
  return size;
}

function checkAccessor(c: Checker, a: Json, at: string, views: { length: number; stride: number }[]): void {
  const part = COMPONENT_BYTES[a.componentType as number];
  const parts = typeof a.type === "string" ? COMPONENTS[a.type] : undefined;
  if (part === undefined) c.fail(`${at}.componentType is unknown`);
  if (parts === undefined) c.fail(`${at}.type is unknown`);
  const count = c.whole(a.count, `${at}.count`, MOST_NUMBERS / (parts as number));
  if (a.bufferView === undefined) return;
  const view = views[c.index(a.bufferView, `${at}.bufferView`, views, "buffer view")];
  const size = (part as number) * (parts as number);
  const stride = view.stride || size;
  const offset = c.whole(a.byteOffset, `${at}.byteOffset`, view.length, 0);
  if (offset % (part as number) !== 0) c.fail(`${at}.byteOffset must be a multiple of ${part}`);
  if (count > 0 && offset + stride * (count - 1) + size > view.length)
    c.fail(`${at} reaches beyond its buffer view`);
}

function checkMeshes(c: Checker, json: Json, accessors: Json[]): void {
  c.objects(json.meshes, "meshes").forEach((m, i) => {
    c.objects(m.primitives, `meshes[${i}].primitives`).forEach((p, k) => {
      const at = `meshes[${i}].primitives[${k}]`;
      const attributes = c.object(p.attributes ?? {}, `${at}.attributes`);
      for (const [key, v] of Object.entries(attributes))
        c.index(v, `${at}.attributes.${key}`, accessors, "accessor");
      if (p.indices !== undefined) c.index(p.indices, `${at}.indices`, accessors, "accessor");
      if (p.material !== undefined)
        c.index(p.material, `${at}.material`, c.list(json.materials, "materials"), "material");
    });
  });
}

/** Indices of the nodes, and that they are trees: every node has one parent at most, and none is its own ancestor. */
function checkNodes(c: Checker, json: Json, nodes: Json[]): void {
  const meshes = c.list(json.meshes, "meshes");
  const skins = c.list(json.skins, "skins");
  const parent = new Int32Array(nodes.length).fill(-1);
  nodes.forEach((n, i) => {
    const at = `nodes[${i}]`;
    c.numbers(n.translation, `${at}.translation`, 3);
    c.numbers(n.rotation, `${at}.rotation`, 4);
    c.numbers(n.scale, `${at}.scale`, 3);
    c.numbers(n.matrix, `${at}.matrix`, 16);
    if (n.mesh !== undefined) c.index(n.mesh, `${at}.mesh`, meshes, "mesh");
    if (n.skin !== undefined) c.index(n.skin, `${at}.skin`, skins, "skin");
    c.list(n.children, `${at}.children`).forEach((child, k) => {
      const j = c.index(child, `${at}.children[${k}]`, nodes, "node");
      if (parent[j] >= 0) c.fail(`nodes[${j}] has two parents`);
      parent[j] = i;
    });
  });
  for (let i = 0; i < nodes.length; i++) {
    let up = parent[i];
    for (let k = 0; up >= 0; k++) {
      if (up === i || k > nodes.length) c.fail(`nodes[${i}] is its own ancestor`);
      up = parent[up];
    }
  }
  const scenes = c.objects(json.scenes, "scenes");
  scenes.forEach((s, i) => {
    c.list(s.nodes, `scenes[${i}].nodes`).forEach((n, k) => {
      c.index(n, `scenes[${i}].nodes[${k}]`, nodes, "node");
    });
  });
  if (json.scene !== undefined) c.index(json.scene, "scene", scenes, "scene");
  if (scenes.length === 0) c.fail("it has no scene");
}
