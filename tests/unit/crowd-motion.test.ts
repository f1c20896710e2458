/** Crowds that are walked: the controller meets the planned footsteps in place and time; the scene may change meanwhile. */
import { describe, expect, it } from "vitest";
import { changeCrowd, createCrowdMotion, moveCrowd } from "../../src/core/crowd/motion.ts";
import { createSession, runSession } from "../../src/core/crowd/session.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { studioBlendLibrary } from "../../src/studio/blend-library.ts";
import { footstepErrors } from "../support/crowd-feet.ts";
import { drawCrowd, walker, wall, worldOf } from "../support/crowd-scenes.ts";

const skeleton = createSkeleton(1.75);
const library = studioBlendLibrary(skeleton);

describe("a crowd in motion", () => {
  it("meets its footsteps within 1 mm and 0.5 degrees", () => {
    const errors = footstepErrors(createCrowdMotion(drawCrowd("forest", 3), library), skeleton, 6);
    expect(errors.count).toBeGreaterThan(60);
    expect(errors.position).toBeLessThan(0.001);
    expect(errors.yaw).toBeLessThan(0.5 * (Math.PI / 180));
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
