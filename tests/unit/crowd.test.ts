import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { arcTangent, cosine, sine } from "../../src/core/crowd/elementary.ts";
import { crowdOfScene } from "../../src/core/crowd/from-scene.ts";
import { obstacleGap } from "../../src/core/crowd/ground.ts";
import { createFootstep, createStop, evaluateStep } from "../../src/core/crowd/locomotion.ts";
import { simulateCrowd } from "../../src/core/crowd/simulate.ts";
import { P, S, STATE, STEP } from "../../src/core/crowd/state.ts";
import { readSteerCase } from "../../src/core/crowd/steer-case.ts";
import { trajectoryOf } from "../../src/core/crowd/trajectory.ts";
import { DEFAULT_GAIT } from "../../src/core/crowd/types.ts";
import { parseScene } from "../../src/core/scene/schema.ts";
import { overlaps, walker, wall, worldOf as world } from "../support/crowd-scenes.ts";
import { hasShared, SHARED } from "../support/shared.ts";

describe("elementary functions", () => {
  it("agree with the engine's to 1e-11", () => {
    for (let a = -20; a < 20; a += 0.037) {
      expect(Math.abs(sine(a) - Math.sin(a))).toBeLessThan(1e-11);
      expect(Math.abs(cosine(a) - Math.cos(a))).toBeLessThan(1e-11);
      const x = Math.cos(a);
      const y = Math.sin(a);
      expect(Math.abs(arcTangent(y, x) - Math.atan2(y, x))).toBeLessThan(1e-11);
    }
  });
});

describe("footsteps of the pendulum [Footsteps §3]", () => {
  it("go on where the step before ended, in place and direction, and keep their speed (eqs. 6-9)", () => {
    fc.assert(
      fc.property(
        fc.double({ min: 0.03, max: 1.2, noNaN: true }),
        fc.double({ min: 0.3, max: 1.6, noNaN: true }),
        fc.double({ min: 0.4, max: 0.7, noNaN: true }),
        fc.constantFrom(-1, 1),
        (turn, speed, duration, side) => {
          const s = new Float64Array(2 * STATE);
          s[S.uz] = s[S.faceZ] = s[S.headZ] = 1;
          s[S.speed] = speed;
          s[S.side] = side;
          // What the foot before leaves open is what a usual step leaves.
          s[S.theta] = s[S.outer] = 0.9;
          const step = new Float64Array(STEP);
          const [c, n] = [cosine(turn), sine(turn)];
          const gait = { ...DEFAULT_GAIT, strideMost: 3 };
          const cost = createFootstep(s, STATE, step, 0, s, 0, turn, c, n, speed, duration, gait);
          expect(cost).toBeGreaterThan(0);
          const out = new Float64Array(12);
          evaluateStep(out, 0, step, 0, 0, 0.09);
          expect(Math.hypot(out[0], out[1])).toBeLessThan(1e-12);
          evaluateStep(out, 0, step, 0, duration, 0.09);
          expect(out[0]).toBeCloseTo(s[STATE + S.x], 12);
          expect(out[1]).toBeCloseTo(s[STATE + S.z], 12);
          // Direction at both ends is the state's, by differences.
          const h = 1e-6;
          evaluateStep(out, 0, step, 0, h, 0.09);
          expect(out[1] / h).toBeCloseTo(speed, 3);
          evaluateStep(out, 0, step, 0, duration, 0.09);
          evaluateStep(out, 6, step, 0, duration - h, 0.09);
          expect((out[0] - out[6]) / h).toBeCloseTo(speed * s[STATE + S.ux], 3);
          expect((out[1] - out[7]) / h).toBeCloseTo(speed * s[STATE + S.uz], 3);
          // The foot is on its side of the way.
          const left = (step[P.footX] * step[P.pz] - step[P.footZ] * step[P.px]) * side;
          expect(left).toBeGreaterThan(0);
        },
      ),
      { seed: 4, numRuns: 200 },
    );
  });

  it("come to rest where the stop says", () => {
    const s = new Float64Array(2 * STATE);
    s[S.ux] = 0.6;
    s[S.uz] = 0.8;
    s[S.speed] = 1.3;
    const step = new Float64Array(STEP);
    createStop(s, STATE, step, 0, s, 0, 0.4, DEFAULT_GAIT);
    const out = new Float64Array(6);
    evaluateStep(out, 0, step, 0, 2, 0.09);
    expect(out[0]).toBeCloseTo(s[STATE + S.x], 12);
    expect(s[STATE + S.speed]).toBe(0);
  });
});

describe("crowds", () => {
  it("walk through each other's way without touching, and arrive: eight across a circle", () => {
    const agents = Array.from({ length: 8 }, (_, i) => {
      const a = (i * Math.PI) / 4;
      return walker(6 * Math.cos(a), 6 * Math.sin(a), -6 * Math.cos(a), -6 * Math.sin(a));
    });
    const w = world(agents);
    const track = simulateCrowd(w, 60);
    expect(track.arrived).toBe(8);
    expect(overlaps(track, w).bodies).toBeLessThan(0.01);
  });

  it("one yields at a door that lets one through", () => {
    const walls = [wall(-6, -0.45, -0.1, 0.1), wall(0.45, 6, -0.1, 0.1)];
    const w = world([walker(0.1, -4, 0.1, 5), walker(-0.1, 4, -0.1, -5)], walls);
    const track = simulateCrowd(w, 60);
    expect(track.arrived).toBe(2);
    expect(overlaps(track, w).bodies).toBeLessThan(0.01);
    // They are not both in the door at once.
    for (const [a, b] of track.positions)
      expect(!!a && !!b && Math.abs(a[1]) < 0.1 && Math.abs(b[1]) < 0.1).toBe(false);
  });

  it("goes round a wall that no straight way passes", () => {
    const track = simulateCrowd(world([walker(0, -3, 0, 4)], [wall(-4, 4, -0.2, 0.2)]), 60);
    expect(track.arrived).toBe(1);
    expect(Math.max(...track.positions.flatMap(([p]) => (p ? [Math.abs(p[0])] : [])))).toBeGreaterThan(4);
  });

  it("gives the same trajectories twice, and none with NaN", () => {
    const scene = parseScene({
      version: 1,
      seed: 9,
      crowd: {
        agents: [{ position: [0, 0], yaw: 0, goals: [[0, 6]], speed: 1.2 }],
        regions: [
          { bounds: [-3, 3, -6, -2], count: 12, goals: [[0, 8]], speed: 1.3 },
          { bounds: [-3, 3, 8, 12], count: 12, goals: [[0, -8]], speed: 1.3 },
        ],
      },
    });
    const run = (): string => JSON.stringify(trajectoryOf(simulateCrowd(crowdOfScene(scene, "s"), 40), null));
    const first = run();
    expect(run()).toBe(first);
    expect(first).not.toContain("NaN");
    expect(JSON.parse(first).arrived).toBe(25);
  });

  it("goals inside walls and agents on one spot do not hang", () => {
    const walls = [wall(-2, 2, 3, 7)];
    const track = simulateCrowd(world([walker(0, 0, 0, 5), walker(0, 0, 4, 0)], walls), 20);
    expect(track.positions.length).toBeGreaterThan(100);
    expect(track.positions.flat().every((p) => p === null || p.every(Number.isFinite))).toBe(true);
  });
});

describe("SteerSuite cases", () => {
  const text = (body: string): string => `<SteerBenchTestCase xmlns="x">\n${body}\n</SteerBenchTestCase>`;
  const agent = `<agent><initialConditions><position><x>0</x><y>0</y><z>1</z></position><direction><x>1</x><y>0</y><z>0</z></direction><radius>0.5</radius><speed>0</speed></initialConditions>
<goalSequence><seekStaticTarget><targetLocation><x>9</x><y>0</y><z>1</z></targetLocation><desiredSpeed>1.3</desiredSpeed><timeDuration>1000</timeDuration></seekStaticTarget></goalSequence></agent>`;

  it("are read: agents, goals, obstacles", () => {
    const w = readSteerCase(
      text(
        `<obstacle><xmin>1</xmin><xmax>3</xmax><ymin>0</ymin><ymax>0</ymax><zmin>-1</zmin><zmax>0</zmax></obstacle>${agent}`,
      ),
      "c.xml",
    );
    expect(w.agents[0]).toMatchObject({ x: 0, z: 1, dirX: 1, goals: [{ x: 9, z: 1, speed: 1.3 }] });
    expect(w.obstacles[0]).toMatchObject({ x: 2, z: -0.5, halfX: 1, halfZ: 0.5 });
  });

  it("are read: walls with a door, which people go through; polygons, which they go round", () => {
    const at = (tag: string, x: number, z: number): string =>
      `<${tag}><x>${x}</x><y>0</y><z>${z}</z></${tag}>`;
    const door = `<orientedWallObstacle><thetaY>90</thetaY><size><x>8</x><y>2</y><z>0.2</z></size>${at("position", 3, 0)}<doorway><value>0.75</value><doorRadius>0.5</doorRadius></doorway></orientedWallObstacle>`;
    const w = readSteerCase(text(door + agent), "c.xml");
    expect(w.repairs).toEqual([]);
    // Three quarters along a wall that is turned by 90 degrees, its x towards -z.
    expect(w.obstacles.map((o) => o.halfX)).toEqual([2.75, 0.75]);
    expect(obstacleGap(w.obstacles[0], 3, -2)).toBeCloseTo(0.5, 9);
    expect(obstacleGap(w.obstacles[1], 3, -2)).toBeCloseTo(0.5, 9);
    const track = simulateCrowd(w, 60);
    expect(track.arrived).toBe(1);
    expect(overlaps(track, w).walls).toBe(0);

    // An L: its notch is free, its inside is not.
    const corners = [
      [2, -3],
      [6, -3],
      [6, 4],
      [5, 4],
      [5, 0],
      [2, 0],
    ];
    const polygon = `<polygonObstacle>${corners.map(([x, z]) => at("vertex", x, z)).join("")}</polygonObstacle>`;
    const l = readSteerCase(text(polygon + agent), "c.xml");
    expect(Math.min(...l.obstacles.map((o) => obstacleGap(o, 3, 2)))).toBeCloseTo(2, 9);
    expect(Math.min(...l.obstacles.map((o) => obstacleGap(o, 4, -1.5)))).toBe(0);
    const round = simulateCrowd(l, 60);
    expect(round.arrived).toBe(1);
    expect(overlaps(round, l).walls).toBe(0);
    expect(() => readSteerCase(text("<polygonObstacle></polygonObstacle>"), "c.xml")).toThrow("two <vertex>");
  });

  it("say what they put right: starts that overlap, goals inside walls", () => {
    const block = `<obstacle><xmin>6</xmin><xmax>12</xmax><ymin>0</ymin><ymax>1</ymax><zmin>-2</zmin><zmax>4</zmax></obstacle>`;
    const w = readSteerCase(text(block + agent + agent), "c.xml");
    expect(w.repairs[0]).toBe("c.xml: agents 1 and 2 overlap at the start; they part first.");
    expect(w.repairs[1]).toContain("goal 1 of agent 1 is inside a wall; it is taken to the nearest room");
    const track = simulateCrowd(w, 60);
    expect(track.arrived).toBe(2);
  });

  it.each([
    ["", "c.xml: no <SteerBenchTestCase>"],
    [text("<agent>"), "c.xml, line 3: </SteerBenchTestCase> closes <agent>."],
    [text(agent.replace("<x>9</x>", "<x>nine</x>")), "a number is needed"],
    [text("<obstacle><xmin>&evil;</xmin></obstacle>"), "an entity that is not known"],
    [text("<!ENTITY a 'b'>"), "document types and entities are not read"],
    [text("<agent><initialConditions/></agent>"), "<agent> needs <goalSequence>"],
  ])("say what is wrong: %#", (xml, message) => {
    expect(() => readSteerCase(xml, "c.xml")).toThrow(message);
  });

  it("never crash otherwise than with a CaseError (seed 6)", () => {
    fc.assert(
      fc.property(
        fc.string({ unit: fc.constantFrom("<", ">", "/", "a", "agent", "&", ";", "!", "-", " ", "1") }),
        (s) => {
          try {
            readSteerCase(text(s), "c.xml");
          } catch (error) {
            expect((error as Error).name).toBe("CaseError");
          }
        },
      ),
      { seed: 6, numRuns: 500 },
    );
  });

  it.skipIf(!hasShared)("small cases come out clean", () => {
    for (const name of ["squeeze", "doorway-two-way", "circle-20", "oncoming-groups"]) {
      const path = join(SHARED, "crowd-cases", `${name}.xml`);
      expect(existsSync(path)).toBe(true);
      const w = readSteerCase(readFileSync(path, "utf8"), path);
      const track = simulateCrowd(w, 120);
      expect(track.arrived, name).toBe(w.agents.length);
      expect(overlaps(track, w).bodies, name).toBeLessThan(0.05);
    }
  });
});
