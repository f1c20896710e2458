import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { bodyGap, clearOfWalls } from "../../src/core/crowd/bodies.ts";
import { createCrowd, stepCrowd, stepsOf } from "../../src/core/crowd/crowd.ts";
import { cosine, sine } from "../../src/core/crowd/elementary.ts";
import { createGround, obstacleGap, ROAM, roamsFree } from "../../src/core/crowd/ground.ts";
import { ALL, nearness, seeOthers, startJudging } from "../../src/core/crowd/judge.ts";
import { look, placeAll } from "../../src/core/crowd/neighbours.ts";
import { P, STATE, STEP } from "../../src/core/crowd/state.ts";
import { BODY_RADIUS, FOOT_RADIUS, SHOULDER } from "../../src/core/crowd/types.ts";
import { drawCrowd, pillar, walker, wall, worldOf } from "../support/crowd-scenes.ts";

const angle = fc.double({ min: -Math.PI, max: Math.PI, noNaN: true });
const coordinate = fc.double({ min: -1, max: 1, noNaN: true });

const circles = (a: Float64Array): [number, number][] =>
  [-1, 0, 1].map((s) => [a[0] + s * SHOULDER * a[3], a[1] - s * SHOULDER * a[2]]);

describe("gaps of bodies", () => {
  it("are those of the nearest two of their circles", () => {
    fc.assert(
      fc.property(coordinate, coordinate, angle, angle, (x, z, one, other) => {
        const a = Float64Array.of(0, 0, sine(one), cosine(one), 0, 0);
        const b = Float64Array.of(x, z, sine(other), cosine(other), x, z);
        const gaps = circles(a).flatMap(([ax, az]) =>
          circles(b).map(([bx, bz]) => Math.hypot(bx - ax, bz - az) - 2 * BODY_RADIUS),
        );
        // The root of a rounding error is larger than the error.
        expect(Math.abs(bodyGap(a, 0, b, 0, 0.7) - Math.min(0.7, ...gaps))).toBeLessThan(1e-7);
      }),
    );
  });

  it("to walls are kept by shoulders and the planted foot, whichever way they are told", () => {
    const world = worldOf([walker(-3, 0, 3, 0)], [wall(-0.5, 0.5, 1, 2), pillar(0.3, -0.9, 0.2)]);
    const ground = createGround(world);
    fc.assert(
      fc.property(coordinate, coordinate, angle, coordinate, (x, z, facing, foot) => {
        const a = Float64Array.of(x, z, sine(facing), cosine(facing), x + 0.3 * foot, z - 0.2 * foot);
        const gap = (px: number, pz: number): number =>
          Math.min(...world.obstacles.map((o) => obstacleGap(o, px, pz)));
        const clear =
          circles(a).every(([cx, cz]) => gap(cx, cz) >= BODY_RADIUS + 0.015) &&
          gap(a[4], a[5]) >= FOOT_RADIUS;
        expect(clearOfWalls(ground, a, 0)).toBe(clear);
      }),
      { numRuns: 400 },
    );
  });

  it("to walls need no look anywhere around where a walker may roam", () => {
    const ground = createGround(
      worldOf([walker(-6, -6, 6, 6)], [wall(-0.5, 0.5, 1, 2), pillar(0.3, -0.9, 0.2)]),
    );
    let roams = 0;
    for (let x = -5; x < 5; x += 0.23)
      for (let z = -5; z < 5; z += 0.23) {
        if (!roamsFree(ground, x, z)) continue;
        roams++;
        for (let turn = 0; turn < 6; turn += 0.3) {
          const a = Float64Array.of(x + ROAM * sine(turn), z + ROAM * cosine(turn), 0, 1, 0, 0);
          a[4] = a[0] + 0.3;
          a[5] = a[1];
          expect(clearOfWalls(ground, a, 0)).toBe(true);
        }
      }
    expect(roams).toBeGreaterThan(500);
  });
});

describe("nearness to others", () => {
  it("is the same, bit for bit, whether it is added up at once or one other at a time", () => {
    const crowd = createCrowd(drawCrowd("junction", 1));
    for (let t = 0; t < 120; t++) stepCrowd(crowd);
    const { planner, neighbours, people, states, steps, tick } = crowd;
    const { others } = planner;
    placeAll(neighbours, crowd.sight, people, tick);
    let parts = 0;
    people.forEach((person, i) => {
      if (!person.here) return;
      const count = look(neighbours, i, states, i * STATE, person.gait);
      seeOthers(others, crowd.sight, neighbours.seen, count, tick);
      startJudging(others, states, i * STATE);
      for (let k = 1; k <= person.planned; k++) {
        const p = stepsOf(i) + k * STEP;
        if (steps[p + P.duration] === 0) continue;
        others.sum.set([0, Number.POSITIVE_INFINITY]);
        expect(nearness(others, steps, p, person.gait, 0)).toBe(ALL);
        const whole = others.sum[0];
        others.sum.set([0, 0]);
        let from = 0;
        let before = 0;
        while (from !== ALL) {
          from = nearness(others, steps, p, person.gait, from);
          expect(others.sum[0]).toBeGreaterThanOrEqual(before);
          before = others.sum[0];
          if (from !== ALL) parts++;
        }
        expect(others.sum[0]).toBe(whole);
      }
    });
    expect(parts).toBeGreaterThan(20);
  });
});
