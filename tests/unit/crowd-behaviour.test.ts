/** What walkers do, and why: the paper's figures, energies, feet, gaits and ground. */
import { describe, expect, it } from "vitest";
import { centreOfMass } from "../../src/core/crowd/centre-of-mass.ts";
import { createCrowd, stepCrowd, stepsOf } from "../../src/core/crowd/crowd.ts";
import { exponential } from "../../src/core/crowd/elementary.ts";
import { createGround } from "../../src/core/crowd/ground.ts";
import { ahead, covers, createLongWay, extendLongWay } from "../../src/core/crowd/long-way.ts";
import { type CrowdTrack, simulateCrowd } from "../../src/core/crowd/simulate.ts";
import { KIND, P, STEP } from "../../src/core/crowd/state.ts";
import {
  type CrowdWorld,
  DEFAULT_GAIT,
  froudeSpeed,
  limping,
  type Obstacle,
} from "../../src/core/crowd/types.ts";
import { chooseYaw, nextYawInterval } from "../../src/core/crowd/yaw-interval.ts";
import { CROWD_KINDS, drawCrowd, overlaps, walker, wall, worldOf } from "../support/crowd-scenes.ts";

const wrap = (a: number): number => Math.atan2(Math.sin(a), Math.cos(a));
const energyOf = ({ statistics: s }: CrowdTrack): number => s.fixedEnergy + s.speedEnergy + s.bendEnergy;

/** Walks round the end of a wall from seven lanes: mean seconds, and energy spent to bend the way, J/kg. */
function uTurns(speed: number): { seconds: number; bend: number } {
  const lanes = [-0.6, -0.7, -0.8, -0.9, -1, -1.1, -1.2];
  const out = { seconds: 0, bend: 0 };
  for (const x of lanes) {
    const w = worldOf([walker(x, -3, x, 3, speed)], [wall(-0.1, 0.1, -8, 2)]);
    w.agents[0].goals[0] = { x: 0.9, z: -4, box: null, speed, patience: 1e9 };
    const track = simulateCrowd(w, 60);
    expect(track.arrived).toBe(1);
    out.seconds += (track.positions.length * track.dt) / lanes.length;
    out.bend += track.statistics.bendEnergy / lanes.length;
  }
  return out;
}

describe("a U-turn", () => {
  it("at a lower speed wanted takes longer, and less force to bend the way [Footsteps Figure 6]", () => {
    const slow = uTurns(0.7);
    const quick = uTurns(1.3);
    expect(slow.seconds).toBeGreaterThan(1.3 * quick.seconds);
    expect(slow.bend).toBeLessThan(0.75 * quick.bend);
  });

  it("takes more steps when feet turn less [Footsteps Figure 7]", () => {
    const turnAbout = (yawRange: number): number => {
      // To a goal behind the back, from standing.
      const w = worldOf([walker(0, 0, 0, -5)]);
      w.agents[0].dirX = 0;
      w.agents[0].dirZ = 1;
      w.agents[0].gait = { yawRange };
      const track = simulateCrowd(w, 60);
      expect(track.arrived).toBe(1);
      return track.footsteps.findIndex((s) => s.lift !== null && Math.abs(wrap(s.yaw - Math.PI)) < 0.35);
    };
    expect(turnAbout(0.5)).toBeGreaterThan(turnAbout(Math.PI / 2));
  });
});

describe("the long way", () => {
  /** Places of a wall's parts along it, every 31 mm over a cell of the grid and a little more. */
  const places = Array.from({ length: 9 }, (_, n) => 0.5 + n / 32);
  const along = (axis: "x" | "z", a0: number, a1: number, b0: number, b1: number): Obstacle =>
    axis === "x" ? wall(a0, a1, b0, b1) : wall(b0, b1, a0, a1);

  const place = new Float64Array(3);

  it("leads through a gap of 0.55 m wherever it lies on the grid, not round the wall's end", () => {
    for (const axis of ["x", "z"] as const)
      for (const width of [0.55, 0.6])
        for (const middle of places) {
          const w = worldOf(
            [axis === "x" ? walker(-1, -4, 1, 5) : walker(-4, -1, 5, 1)],
            [
              along(axis, -6, middle - width / 2, 0, 0.2),
              along(axis, middle + width / 2, 6, 0, 0.2),
              along(axis, -6.2, -6, -6, 7),
            ],
          );
          const name = `${axis} ${width} ${middle}`;
          expect(simulateCrowd(w, 30).arrived, name).toBe(1);
          const ground = createGround(w);
          const [{ x, z, goals }] = w.agents;
          const way = createLongWay(ground, goals[0].x, goals[0].z);
          extendLongWay(ground, way, x, z);
          ahead(place, ground, way, Float64Array.of(x, z), 0);
          // Round the end it is 15.5 m; straight 9.2, but narrow ways count as longer.
          expect(place[2], name).toBeLessThan(13.5);
        }
  });

  it("never leads through a wall, be it as thin as paper and between two narrow ways", () => {
    let looked = 0;
    for (const axis of ["x", "z"] as const)
      for (const wide of [0.41, 0.46, 0.5, 0.55, 0.6, 0.7])
        for (const at of places) {
          const there = at - wide / 2;
          const here = at + wide / 2;
          const ground = createGround(
            worldOf(
              [axis === "x" ? walker(0, there, 0, here) : walker(there, 0, here, 0)],
              [
                along(axis, -3, 3, at - 0.005, at + 0.005),
                along(axis, -3, 3, at - wide - 0.4, at - wide),
                along(axis, -3, 3, at + wide, at + wide + 0.4),
                along(axis, -3.4, -3, at - wide - 0.4, at + wide + 0.4),
                along(axis, 3, 3.4, at - wide - 0.4, at + wide + 0.4),
              ],
            ),
          );
          const goal = axis === "x" ? [0, here] : [here, 0];
          const way = createLongWay(ground, goal[0], goal[1]);
          extendLongWay(ground, way, axis === "x" ? 0 : there, axis === "x" ? there : 0);
          const { columns, rows, cell } = ground;
          const centre = (c: number): number =>
            axis === "x"
              ? ground.z0 + (Math.floor(c / columns) + 0.5) * cell
              : ground.x0 + ((c % columns) + 0.5) * cell;
          const side = (c: number): number => Math.sign(centre(c) - at);
          // Where a side is too narrow for any cell the field begins beyond the walls.
          if (way.from < 0 || side(way.from) < 0 || centre(way.from) > at + wide) continue;
          looked++;
          for (let c = 0; c < columns * rows; c++) {
            const x = ground.x0 + ((c % columns) + 0.5) * cell;
            const z = ground.z0 + (Math.floor(c / columns) + 0.5) * cell;
            if (covers(ground, way, x, z)) expect(side(c), `${axis} ${wide} ${at}`).toBe(1);
          }
        }
    expect(looked).toBeGreaterThan(50);
  });
});

describe("energy [Footsteps §3.4]", () => {
  it("is lower than with one-step greedy choice, all else equal", () => {
    const scenes: CrowdWorld[] = [
      ...[1, 2, 3].map((s) => drawCrowd("corridor", s)),
      ...[1, 2, 3].map((s) => drawCrowd("forest", s)),
      drawCrowd("junction", 2),
    ];
    let planned = 0;
    let greedy = 0;
    for (const w of scenes) {
      planned += energyOf(simulateCrowd(w, 90));
      greedy += energyOf(simulateCrowd(w, 90, { greedy: true }));
    }
    expect(planned).toBeLessThan(0.95 * greedy);
  });

  it("makes a walker take a pavement instead of a road, as far as that is not too far", () => {
    const cross = (cost: number): number => {
      const w = worldOf([walker(0, 0, 0, 14)]);
      w.surfaces = [{ bounds: [-3, 3, 2, 12], cost }];
      const track = simulateCrowd(w, 90);
      expect(track.arrived).toBe(1);
      return Math.max(...track.positions.flatMap(([p]) => (p ? [Math.abs(p[0])] : [])));
    };
    expect(cross(1)).toBeLessThan(0.5);
    expect(cross(3)).toBeGreaterThan(2.8);
  });

  it("speaks for the Froude speed where none is wanted", () => {
    expect(froudeSpeed(0.9)).toBeCloseTo(Math.sqrt(9.81 * 0.9 * 0.25), 12);
  });
});

describe("feet", () => {
  it("point between parabola and motion, not over the foot before nor wider than the range (eq. 12)", () => {
    const out = new Float64Array(2);
    // Straight on: anything between the parabola and the motion.
    expect(nextYawInterval(out, 0, 0.05, 0.05, 0.05, Math.PI / 2)).toBe(true);
    expect([...out]).toEqual([0, 0.05]);
    // After a turn of the parabola by 1.2 the next foot would have to turn out by more than the range.
    expect(nextYawInterval(out, 0.6, 1.2, 1.2, 0.05, Math.PI / 2)).toBe(false);
    expect(nextYawInterval(out, 0, 1.2, 1.2, 0.05, Math.PI / 2)).toBe(true);
  });

  it("keep their intervals when the next step narrows them (§4.1)", () => {
    const out = new Float64Array(2);
    for (let a = 0.03; a < 1.1; a += 0.07)
      for (let b = 0.03; b < 1.1; b += 0.07) {
        if (!nextYawInterval(out, 0, a, a, b, Math.PI / 2)) continue;
        const next = { inner: out[0], outer: out[1], theta: b };
        const yaw = chooseYaw(0, a, a, next, Math.PI / 2);
        expect(yaw).toBeGreaterThanOrEqual(0);
        expect(yaw).toBeLessThanOrEqual(a + 1e-12);
        // The yaw chosen leaves the next foot something.
        expect(nextYawInterval(out, yaw, yaw, a, b, Math.PI / 2)).toBe(true);
      }
  });

  it("alternate while walking, lift after the other has landed and land before the other lifts", () => {
    const track = simulateCrowd(drawCrowd("doorway", 3), 90);
    const agents = new Set(track.footsteps.map((s) => s.agent));
    for (const agent of agents) {
      const own = track.footsteps.filter((s) => s.agent === agent);
      expect(own[0].lift).toBe(null);
      own.slice(2).forEach((s, i) => {
        const before = own[i + 1];
        expect(s.lift).not.toBe(null);
        expect((s.lift ?? 0) + 1e-9).toBeGreaterThanOrEqual(before.land);
        expect(s.land - (s.lift ?? 0)).toBeGreaterThan(0.2);
        const same = own
          .slice(0, i + 2)
          .reverse()
          .find((q) => q.side === s.side);
        if (same) expect(Math.hypot(same.x - s.x, same.z - s.z)).toBeLessThan(1.6);
      });
    }
  });

  it("take a person's time to turn about from standing: 0.5 to 0.7 s for the first step and the shift of weight before it", () => {
    for (const behind of [-1, -0.5, 0.5, 1]) {
      const w = worldOf([walker(0, 0, 0, 5)]);
      w.agents[0].goals[0] = { x: behind, z: -8, box: null, speed: 1.3, patience: 1e9 };
      const track = simulateCrowd(w, 30);
      expect(track.arrived).toBe(1);
      const first = track.footsteps.find((s) => s.lift !== null);
      expect(first?.land).toBeGreaterThanOrEqual(0.5 - 1e-9);
      expect(first?.land).toBeLessThanOrEqual(0.7 + 1e-9);
      expect((first?.land ?? 0) - (first?.lift ?? 0)).toBeGreaterThanOrEqual(0.4);
    }
  });

  it("stay down longer where a lower speed is wanted, as people's do", () => {
    const longest = [0.9, 1.3].map((speed) => {
      const w = worldOf([walker(0, 0, 0, 12, speed)]);
      const crowd = createCrowd(w);
      const times: number[] = [];
      crowd.onStep = () => {
        const p = stepsOf(0);
        if (crowd.steps[p + P.kind] === KIND.walk) times.push(crowd.steps[p + P.duration]);
      };
      for (let t = 0; t < 2000 && stepCrowd(crowd) > 0; t++);
      return times.sort((a, b) => a - b)[times.length >> 1];
    });
    expect(longest).toEqual([0.6, 0.5]);
  });

  it("that limp are quicker on the leg that hurts", () => {
    const w = worldOf([walker(0, 0, 0, 12)]);
    w.agents[0].gait = limping(0);
    const crowd = createCrowd(w);
    const times: [number[], number[]] = [[], []];
    crowd.onStep = () => {
      const p = stepsOf(0);
      if (crowd.steps[p + P.kind] === KIND.walk)
        times[crowd.steps[p + P.side] > 0 ? 0 : 1].push(crowd.steps[p + P.duration]);
    };
    for (let t = 0; t < 2000 && stepCrowd(crowd) > 0; t++);
    expect(times[0].length).toBeGreaterThan(4);
    expect(Math.max(...times[0])).toBeLessThan(Math.min(...times[1]));
  });
});

describe("the middle of mass for animation (eq. 3)", () => {
  it("meets the parabola at both ends, solves the pendulum between them and lingers at the apex", () => {
    expect(exponential(1.7)).toBeCloseTo(Math.exp(1.7), 11);
    const crowd = createCrowd(worldOf([walker(0, 0, 0, 12)]));
    let seen = 0;
    crowd.onStep = () => {
      const s = crowd.steps.slice(stepsOf(0), stepsOf(0) + STEP);
      if (s[P.kind] !== KIND.walk) return;
      seen++;
      const at = (t: number): Float64Array => {
        const out = new Float64Array(4);
        centreOfMass(out, s, 0, s[P.start] + t, DEFAULT_GAIT);
        return out;
      };
      const T = s[P.duration];
      expect(at(0)[1]).toBeCloseTo(s[P.z], 10);
      expect(at(T)[1]).toBeCloseTo(s[P.z] + s[P.pz] * s[P.along] * T, 10);
      const h = 1e-4;
      const [a, b, c] = [at(T / 3 - h), at(T / 3), at(T / 3 + h)];
      for (const [axis, foot] of [
        [0, s[P.footX]],
        [1, s[P.footZ]],
      ]) {
        const bend = (a[axis] - 2 * b[axis] + c[axis]) / (h * h);
        expect(bend).toBeCloseTo((9.81 / DEFAULT_GAIT.leg) * (b[axis] - foot), 3);
      }
      expect(Math.hypot(at(T / 2)[2], at(T / 2)[3])).toBeLessThan(Math.hypot(at(0)[2], at(0)[3]));
    };
    for (let t = 0; t < 2000 && stepCrowd(crowd) > 0; t++);
    expect(seen).toBeGreaterThan(10);
  });
});

describe("crowds drawn from a seed", () => {
  it.each(CROWD_KINDS.flatMap((kind) => [1, 2].map((seed) => [kind, seed] as const)))(
    "%s %i: all arrive, and nobody touches anybody or a wall",
    (kind, seed) => {
      const w = drawCrowd(kind, seed);
      const track = simulateCrowd(w, 240);
      expect(track.arrived).toBe(w.agents.length);
      const worst = overlaps(track, w);
      expect(worst.bodies).toBeLessThan(0.01);
      expect(worst.walls).toBeLessThan(0.01);
      expect(worst.feet).toBeLessThan(0.05);
    },
  );

  it("search no more in a tick than it may", () => {
    const w = drawCrowd("egress", 4);
    const crowd = createCrowd(w);
    let before = 0;
    for (let t = 0; t < 400; t++) {
      stepCrowd(crowd);
      const { expanded } = crowd.statistics;
      expect(expanded - before).toBeLessThanOrEqual(Math.max(1200, 7 * w.agents.length) + 260);
      before = expanded;
    }
  });
});
