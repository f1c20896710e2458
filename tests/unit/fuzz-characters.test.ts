// @vitest-environment happy-dom
/** Broken glTF, GLB and VRM files: one clear sentence that names the place, no hang, no place that is not a number. */
import fc from "fast-check";
import { beforeAll, describe, expect, it } from "vitest";
import type { Clip } from "../../src/core/capture/clip.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { buildCharacterMesh } from "../../src/view/character/build-mesh.ts";
import { checkGltf } from "../../src/view/character/gltf-check.ts";
import { readCharacter } from "../../src/view/character/read-character.ts";
import { exportGlb } from "../../src/view/export-gltf.ts";
import { brokenBytes, brokenJson, budget, limit, survives } from "../support/fuzz.ts";

const NAME = "a.glb";
let sound: Uint8Array;
let document: string;

beforeAll(async () => {
  const skeleton = createSkeleton(1.75);
  const rotations = new Float64Array(8 * 22);
  for (let j = 0; j < 44; j++) rotations[4 * j + 3] = 1;
  const clip: Clip = {
    name: "x",
    rate: 60,
    frames: 2,
    skeleton,
    root: Float64Array.of(0, 0.9, 0, 0, 0.9, 0),
    rotations,
  };
  sound = new Uint8Array(await exportGlb(skeleton, buildCharacterMesh(skeleton, 6), clip));
  document = new TextDecoder().decode(
    sound.subarray(20, 20 + new DataView(sound.buffer).getUint32(12, true)),
  );
});

const buffer = (bytes: Uint8Array): ArrayBuffer => bytes.slice().buffer as ArrayBuffer;

/** The sound file with another document. */
function repacked(json: string): Uint8Array {
  const body = new TextEncoder().encode(json.padEnd(Math.ceil(json.length / 4) * 4));
  const rest = sound.subarray(20 + new DataView(sound.buffer).getUint32(12, true));
  const out = new Uint8Array(20 + body.length + rest.length);
  out.set(sound.subarray(0, 20));
  out.set(body, 20);
  out.set(rest, 20 + body.length);
  const head = new DataView(out.buffer);
  head.setUint32(8, out.length, true);
  head.setUint32(12, body.length, true);
  return out;
}

/** The sound document with one value put elsewhere, by a path such as "nodes.3.children". */
function withValue(path: string, value: unknown): Uint8Array {
  const tree = JSON.parse(document);
  const keys = path.split(".");
  const last = keys.pop() as string;
  keys.reduce((o, k) => o[k], tree)[last] = value;
  return repacked(JSON.stringify(tree));
}

const rootNode = (): number => JSON.parse(document).scenes[0].nodes[0];

async function settles(bytes: Uint8Array): Promise<void> {
  let outcome: unknown;
  try {
    outcome = await readCharacter(buffer(bytes), NAME);
  } catch (error) {
    outcome = error;
  }
  survives(() => {
    if (outcome instanceof Error) throw outcome;
  }, NAME);
  if (!(outcome instanceof Error)) expect(Number.isFinite((outcome as { height: number }).height)).toBe(true);
}

describe("broken characters", () => {
  it("the sound one is read", async () => {
    const { bones, height } = await readCharacter(buffer(sound), NAME);
    expect(bones.length).toBeGreaterThan(20);
    expect(height).toBeGreaterThan(1.5);
  });

  it("GLB containers (seed 7)", { timeout: limit(20_000) }, async () => {
    await fc.assert(
      fc.asyncProperty(
        fc.oneof(
          fc.constant(null).chain(() => brokenBytes(sound)),
          fc.uint8Array(),
        ),
        settles,
      ),
      budget(60),
    );
  });

  it("documents inside them (seed 7)", { timeout: limit(20_000) }, async () => {
    await fc.assert(
      fc.asyncProperty(
        fc.constant(null).chain(() => brokenJson(document)),
        (json) => settles(repacked(json)),
      ),
      budget(120),
    );
  });

  it.each([
    ["cut off", () => sound.slice(0, sound.length >> 1), /it is cut off: \d+ bytes are announced/],
    ["another version", () => withValue("asset.version", "1.0"), /only glTF 2.0/],
    ["a huge count", () => withValue("accessors.0.count", 4e9), /accessors\[0\]\.count must be at most/],
    ["beyond its buffer", () => withValue("accessors.0.count", 900_000), /accessors\[0\] reaches beyond/],
    [
      "a missing accessor",
      () => withValue("meshes.0.primitives.0.indices", 999),
      /indices names accessor 999/,
    ],
    ["a missing bone", () => withValue("skins.0.joints.2", 5000), /skins\[0\]\.joints\[2\] names node 5000/],
    [
      "its own ancestor",
      () => withValue(`nodes.${rootNode()}.children`, [rootNode()]),
      /is its own ancestor/,
    ],
    ["other files", () => withValue("buffers.0.uri", "body.bin"), /save it as one \.glb file/],
  ])("%s", async (_, make, message) => {
    await expect(readCharacter(buffer(make()), NAME)).rejects.toThrow(message);
    expect(() => checkGltf(buffer(make()), NAME)).toThrow(/^a\.glb: /);
  });
});
