import { describe, expect, it } from "vitest";
import { solePoints } from "../../src/core/contacts/baselines.ts";
import { pivotPlace, plantedAnkle } from "../../src/core/motion/sole.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { studio } from "../support/library.ts";

describe("planted foot", () => {
  const shape = createSkeleton(1.75).foot;
  const out = new Float64Array(3);
  it("rolls over a heel point that stays", () => {
    for (const pitch of [0, 0.1, 0.3, 0.5]) {
      plantedAnkle(out, shape, pitch);
      const back = out[0] - shape.heelBack * Math.cos(pitch) + shape.ankleHeight * Math.sin(pitch);
      const up = out[1] - shape.heelBack * Math.sin(pitch) - shape.ankleHeight * Math.cos(pitch);
      expect(back).toBeCloseTo(-shape.heelBack, 10);
      expect(up).toBeCloseTo(0, 10);
    }
  });
  it("rolls over a ball that stays until the toes rise, then over the tip", () => {
    const ball = (pitch: number) => {
      plantedAnkle(out, shape, pitch);
      const rise = shape.ankleHeight - shape.ballHeight;
      return [
        out[0] + shape.ballForward * Math.cos(pitch) + rise * Math.sin(pitch),
        out[1] + shape.ballForward * Math.sin(pitch) - rise * Math.cos(pitch),
      ];
    };
    for (const pitch of [-0.05, -0.2]) {
      expect(ball(pitch)[0]).toBeCloseTo(shape.ballForward, 3);
      expect(ball(pitch)[1]).toBeCloseTo(shape.ballHeight, 3);
    }
    expect(ball(-1)[1]).toBeGreaterThan(shape.ballHeight + 0.01);
  });
  it("pivots about a point that stays", () => {
    const from = { x: 0.3, z: -0.2, yaw: 0.4 };
    for (const [end, d] of [
      ["heel", -shape.heelBack],
      ["ball", shape.ballForward],
    ] as const) {
      const to = pivotPlace(shape, from, 1.1, end);
      expect(to.x + d * Math.sin(to.yaw)).toBeCloseTo(from.x + d * Math.sin(from.yaw), 12);
      expect(to.z + d * Math.cos(to.yaw)).toBeCloseTo(from.z + d * Math.cos(from.yaw), 12);
    }
  });
});

describe("captures of the studio", () => {
  const { rendered } = studio();
  it("claimed plants slide under 1 mm and never sink by 3 mm", () => {
    for (const r of rendered) {
      const points = solePoints(r.clip);
      for (let side = 0; side < 2; side++) {
        let x = 0;
        let z = 0;
        let on = false;
        for (let f = 1; f < r.clip.frames; f++) {
          const o = (2 * f + side) * 9;
          const flat = ((r.contacts[f] >> (2 * side)) & 3) === 3;
          if (flat && on) {
            x += points[o + 3] - points[o - 18 + 3];
            z += points[o + 5] - points[o - 18 + 5];
            expect(Math.hypot(x, z), `${r.name} frame ${f}`).toBeLessThan(1e-3);
          } else x = z = 0;
          on = flat;
          for (const k of [1, 4, 7]) expect(points[o + k], `${r.name} frame ${f}`).toBeGreaterThan(-0.006);
        }
      }
    }
  });
  it("are made the same twice", async () => {
    const { renderScore } = await import("../../src/studio/render.ts");
    const { studioSet } = await import("../../src/studio/set.ts");
    const { clip } = renderScore(studioSet()[2].score);
    expect(Buffer.from(clip.rotations.buffer).equals(Buffer.from(rendered[2].clip.rotations.buffer))).toBe(
      true,
    );
  });
});
