/** The body over its feet: the pendulum of the stepping-stone controller; own clips. */

import { beforeAll, describe, expect, it } from "vitest";
import { createBlendCrowd } from "../../src/core/blending/crowd.ts";
import { type BlendLibrary, bakeLibrary } from "../../src/core/blending/library.ts";
import { ownCycle, withOwnCycles } from "../../src/core/blending/own-cycles.ts";
import { planStones } from "../../src/core/blending/plan-stones.ts";
import type { CyclicSource } from "../../src/core/blending/types.ts";
import { wholeChunk } from "../../src/core/motion/chunk.ts";
import { measureMotion, motionPoints } from "../../src/core/quality/measure.ts";
import { pillarScene, riverScene } from "../../src/core/scene/stone-examples.ts";
import type { Scene } from "../../src/core/scene/types.ts";
import { J, JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { cyclicSources } from "../../src/studio/blend-library.ts";
import { courseScene, stairsScene } from "../support/stone-scenes.ts";

const skeleton = createSkeleton(1.75);
/** About a stone's middle it is stone in any case, metres. */
const STONE = 0.12;
let sources: CyclicSource[];
let library: BlendLibrary;
beforeAll(() => {
  sources = cyclicSources();
  library = bakeLibrary(sources, skeleton);
}, 60_000);

function quality(scene: Scene) {
  const { clip, contacts, plan } = planStones(scene, library);
  const chunk = wholeChunk(clip, contacts);
  return measureMotion(skeleton, [chunk], clip.frames, plan, []);
}

describe("the body over its feet", () => {
  const scenes: [string, () => Scene][] = [
    ["river", riverScene],
    ["pillars", pillarScene],
    ["stairs", stairsScene],
    ["obstacle course", courseScene],
  ];
  it.each(scenes)("%s: in balance, without pops, soles on the ground, slopes too", (_, scene) => {
    const q = quality(scene());
    expect(q.balanceWithin50mm).toBeGreaterThan(0.85);
    expect(q.poppingOwn).toBeLessThan(1.75);
    expect(q.skate).toBeLessThan(1);
    expect(q.penetration).toBeLessThan(3);
    expect(q.float).toBeLessThan(5);
    expect(q.footstepError?.position).toBeLessThan(1);
  });

  it.each(scenes)("%s: feet come over the edges of stones and steps, not through them", (_, make) => {
    const scene = make();
    const { clip, contacts } = planStones(scene, library);
    const { soles } = motionPoints(skeleton, [wholeChunk(clip, contacts)], clip.frames);
    for (let f = 0; f < clip.frames; f++)
      for (let o = 18 * f; o < 18 * (f + 1); o += 3)
        for (const { id, position } of scene.stones) {
          const [x, y, z] = position;
          if (Math.hypot(soles[o] - x, soles[o + 2] - z) > STONE) continue;
          // What is far below it is under another stone's step.
          const deep = y - soles[o + 1];
          if (deep < 0.5) expect(deep, `frame ${f}, ${id}`).toBeLessThan(0.01);
        }
  });

  it("who climbs stairs pushes off a leg that comes nearly straight", () => {
    const { clip, plan } = planStones(stairsScene(), library);
    const least = plan.steps.flatMap((s, i) => {
      // The other foot goes up two steps over this one, which bears meanwhile.
      const [over, own] = [plan.steps[i + 1], plan.steps[i - 1]];
      if (!over || !own || over.y <= s.y || own.y >= s.y) return [];
      const knee = s.foot === "left" ? J.leftLowerLeg : J.rightLowerLeg;
      const flexion = (f: number) =>
        (360 / Math.PI) * Math.acos(Math.min(1, Math.abs(clip.rotations[4 * (JOINT_COUNT * f + knee) + 3])));
      const bears = Array.from({ length: Math.round(60 * (over.land - over.lift)) }, (_, k) =>
        flexion(Math.round(60 * over.lift) + k),
      );
      return [Math.min(...bears)];
    });
    expect(least.length).toBeGreaterThan(5);
    for (const degrees of least) {
      expect(degrees).toBeLessThan(30);
      expect(degrees).toBeGreaterThan(5);
    }
  });

  it("a plan that changes in mid-step, every frame for a while, does not jerk the hips", () => {
    const crowd = createBlendCrowd(library, 1, { matrices: false });
    crowd.add({ x: 0, z: 0, yaw: 0 });
    const track = (aside: number, after: number) => {
      for (let k = 0; k < 8; k++) {
        const lift = 0.6 + 0.6 * k;
        if (lift > after)
          crowd.push(0, {
            foot: k % 2 === 0 ? "left" : "right",
            x: (k % 2 === 0 ? 0.09 : -0.09) + aside * k,
            y: 0,
            z: 0.55 * (k + 1),
            yaw: 0,
            lift,
            land: lift + 0.44,
          });
      }
    };
    track(0, 0);
    const at: number[][] = [];
    for (let f = 0; f < 240; f++) {
      if (crowd.time > 1.9 && crowd.time < 2.3) {
        crowd.clear(0);
        track(0.1 * Math.sin(9 * crowd.time), crowd.time);
      }
      crowd.update(1 / 60);
      at.push([crowd.root[0], crowd.root[2]]);
    }
    let most = 0;
    for (let f = 1; f + 1 < at.length; f++)
      for (let k = 0; k < 2; k++)
        most = Math.max(most, 3600 * Math.abs(at[f + 1][k] - 2 * at[f][k] + at[f - 1][k]));
    expect(most).toBeLessThan(8);
  });

  it("a character's way does not depend on who else is in the batch", () => {
    const way = (others: number): number[] => {
      const crowd = createBlendCrowd(library, 1 + others, { matrices: false });
      for (let i = 0; i <= others; i++) crowd.add({ x: 2 * i, z: 0, yaw: 0 });
      const out: number[] = [];
      for (let i = 0; i <= others; i++)
        for (let k = 0; k < 6; k++) {
          // The others run, each at a rhythm of its own.
          const pace = i === 0 ? 0.6 : 0.3 + 0.01 * i;
          const lift = 0.6 + pace * k;
          const x = 2 * i + (k % 2 === 0 ? 0.08 : -0.08);
          const z = (i === 0 ? 0.5 : 0.9) * (k + 1);
          crowd.push(i, {
            foot: k % 2 === 0 ? "left" : "right",
            x,
            y: 0,
            z,
            yaw: 0,
            lift,
            land: lift + 0.42,
          });
        }
      for (let f = 0; f < 200; f++) {
        crowd.update(1 / 60);
        out.push(crowd.root[0], crowd.root[1], crowd.root[2]);
      }
      return out;
    };
    expect(way(3)).toEqual(way(0));
  });
});

describe("clips of one's own", () => {
  it("join ours or replace the one of their name, and the triangles are drawn anew", () => {
    const walk = sources[3];
    const joined = ownCycle("mine", walk.clip);
    const more = bakeLibrary(withOwnCycles(sources, [joined]), skeleton);
    expect(more.names).toEqual([...sources.map((s) => s.name), "mine"]);
    expect(more.feet[0].points.length).toBe(library.feet[0].points.length + 2);
    const other = ownCycle(walk.name, sources[5].clip);
    const replaced = bakeLibrary(withOwnCycles(sources, [other]), skeleton);
    expect(replaced.names).toEqual(library.names);
    expect(Array.from(replaced.feet[0].points.subarray(6, 8))).not.toEqual(
      Array.from(library.feet[0].points.subarray(6, 8)),
    );
  });

  it("without a cycle are told of in one sentence", () => {
    const clip = sources[0].clip;
    const still = {
      ...clip,
      frames: 90,
      root: clip.root.slice(0, 3 * 20),
      rotations: clip.rotations.slice(0, 88 * 20),
    };
    const root = new Float64Array(3 * 90);
    const rotations = new Float64Array(88 * 90);
    for (let f = 0; f < 90; f++) {
      root.set(still.root.subarray(0, 3), 3 * f);
      rotations.set(still.rotations.subarray(0, 88), 88 * f);
    }
    expect(() => ownCycle("still", { ...still, root, rotations })).toThrow(/still/);
  });
});
