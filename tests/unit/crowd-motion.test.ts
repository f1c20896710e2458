/** Crowds that are walked: the controller meets the planned footsteps in place and time; the scene may change meanwhile. */
import { describe, expect, it } from "vitest";
import { type CrowdMotion, changeCrowd, createCrowdMotion, moveCrowd } from "../../src/core/crowd/motion.ts";
import { createSession, runSession } from "../../src/core/crowd/session.ts";
import { J } from "../../src/core/skeleton/joints.ts";
import { holdToLimits } from "../../src/core/skeleton/limits.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { studioBlendLibrary } from "../../src/studio/blend-library.ts";
import { restPlaces } from "../../src/view/character/body-shape.ts";
import { footstepErrors } from "../support/crowd-feet.ts";
import { drawCrowd, walker, wall, worldOf } from "../support/crowd-scenes.ts";

const skeleton = createSkeleton(1.75);
const library = studioBlendLibrary(skeleton);

const rest = restPlaces(skeleton);
const SIDES = [
  { hip: J.leftUpperLeg, knee: J.leftLowerLeg, foot: J.leftFoot, toes: J.leftToes },
  { hip: J.rightUpperLeg, knee: J.rightLowerLeg, foot: J.rightFoot, toes: J.rightToes },
];

/** Where a joint of the first character is, from its skinning matrix. */
function jointPlace(m: CrowdMotion, joint: number): [number, number, number] {
  const o = joint * 16;
  const e = m.body.matrices;
  const [x, y, z] = [rest[3 * joint], rest[3 * joint + 1], rest[3 * joint + 2]];
  const row = (k: number): number => e[o + k] * x + e[o + 4 + k] * y + e[o + 8 + k] * z + e[o + 12 + k];
  return [row(0), row(1), row(2)];
}

/** How far a knee points beside its foot, radians; 0 where the foot hangs so steeply that it points nowhere. */
function kneeOverFoot(m: CrowdMotion, side: (typeof SIDES)[number]): number {
  const [hip, knee, foot, toes] = [side.hip, side.knee, side.foot, side.toes].map((j) => jointPlace(m, j));
  const [fx, fz] = [toes[0] - foot[0], toes[2] - foot[2]];
  const [kx, kz] = [knee[0] - (hip[0] + foot[0]) / 2, knee[2] - (hip[2] + foot[2]) / 2];
  if (Math.hypot(fx, fz) < 0.08 || Math.hypot(kx, kz) < 0.05) return 0;
  return Math.atan2(kx * fz - kz * fx, kx * fx + kz * fz);
}

describe("a crowd in motion", () => {
  it("meets its footsteps within 1 mm and 0.5 degrees where two pass each other", () => {
    const errors = footstepErrors(
      createCrowdMotion(worldOf([walker(0, 0, 0, 14), walker(0.4, 14, 0.4, 0)]), library),
      skeleton,
      9,
    );
    expect(errors.count).toBeGreaterThan(24);
    expect(errors.position).toBeLessThan(0.001);
    expect(errors.yaw).toBeLessThan(0.5 * (Math.PI / 180));
  });

  it("meets every footstep where many dodge each other", () => {
    const errors = footstepErrors(createCrowdMotion(drawCrowd("forest", 3), library), skeleton, 6);
    expect(errors.count).toBeGreaterThan(200);
    expect(errors.exact).toBe(1);
    expect(errors.position).toBeLessThan(0.001);
    expect(errors.yaw).toBeLessThan(0.5 * (Math.PI / 180));
  });

  it("turns its shoulders where a gap is narrower than they are, with its joints in their ranges and its feet met", () => {
    // As wide as its shoulders: not enough for one who sways.
    const w = worldOf([walker(0.125, 0, 0.125, 8)], [wall(-10, -0.175, 3, 3.3), wall(0.425, 10, 3, 3.3)]);
    const m = createCrowdMotion(w, library);
    let widest = 0;
    let fastest = 0;
    let before = 0;
    let knees = 0;
    let outside = 0;
    for (let f = 0; f < 60 * 12; f++) {
      moveCrowd(m, f / 60);
      const turned = m.body.upperYaw[0];
      if (Math.abs(turned) > 0.5)
        for (const side of SIDES) {
          knees = Math.max(knees, Math.abs(kneeOverFoot(m, side)));
          const [x, , z] = jointPlace(m, side.knee);
          if (z > 3 && z < 3.3) outside = Math.max(outside, Math.abs(x - 0.125));
        }
      widest = Math.max(widest, Math.abs(turned));
      if (m.session.gone[0] > f / 60) fastest = Math.max(fastest, Math.abs(turned - before) * 60);
      before = turned;
      const pose = Float64Array.from(m.body.rotations.subarray(0, 88));
      for (const j of [J.spine, J.chest, J.upperChest, J.neck, J.head])
        expect(holdToLimits(pose, 4 * j, j), `frame ${f}, joint ${j}`).toBeLessThan(0.01);
    }
    expect(m.session.gone[0]).toBeLessThan(12);
    expect(widest).toBeGreaterThan(1);
    expect(fastest).toBeLessThan(6);
    // The hips turn over the legs: knees point as the feet do, and stay out of the walls by their own thickness.
    expect(knees).toBeLessThan(0.2);
    expect(outside).toBeLessThan(0.3 - 0.06);
    const errors = footstepErrors(createCrowdMotion(w, library), skeleton, 8);
    expect(errors.exact).toBe(1);
  });

  it("reacts to a wall that comes while it walks, and goes on from where it is", () => {
    const w = worldOf([walker(0, 0, 0, 10)]);
    const m = createCrowdMotion(w, library);
    for (let t = 0; t < 2; t += 1 / 30) moveCrowd(m, t);
    const before = m.session.footsteps.filter((f) => f.step.land < 2).map((f) => f.step);
    expect(changeCrowd(m, { ...w, obstacles: [wall(-2, 2, 6, 6.4)] })).toBe(true);
    let widest = 0;
    for (let t = 2; t < 16; t += 1 / 30) {
      moveCrowd(m, t);
      widest = Math.max(widest, Math.abs(m.body.root[0]));
    }
    const after = m.session.footsteps.filter((f) => f.step.land < 2).map((f) => f.step);
    expect(after).toEqual(before);
    expect(widest).toBeGreaterThan(1.9);
    expect(m.session.gone[0]).toBeLessThan(16);
  });

  it("is the same after a change that changes nothing", () => {
    const w = drawCrowd("junction", 2);
    const plain = createSession(w);
    runSession(plain, 3, 200);
    const again = createSession(w);
    runSession(again, 3, 200);
    expect(again.footsteps).toEqual(plain.footsteps);
    expect(again.crowd.states).toEqual(plain.crowd.states);
  });
});
