/**
 * Crowds at length: hundreds of odd scenes, the SteerSuite cases with an independent count of contacts, two hundred animated.
 * `STEPWRIGHT_TABLES=1 npm run test:long -- crowds` writes the cases' figures into docs/footsteps.md.
 */
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { describe, expect, it } from "vitest";
import { createCrowdMotion } from "../../src/core/crowd/motion.ts";
import { simulateCrowd } from "../../src/core/crowd/simulate.ts";
import { readSteerCase } from "../../src/core/crowd/steer-case.ts";
import { createRandom } from "../../src/core/math/random.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { studioBlendLibrary } from "../../src/studio/blend-library.ts";
import { countContacts } from "../support/crowd-contacts.ts";
import { footstepErrors } from "../support/crowd-feet.ts";
import { drawOddity, ODDITIES, PARTED } from "../support/crowd-oddities.ts";
import { CROWD_KINDS, drawCrowd, walker, wall, worldOf } from "../support/crowd-scenes.ts";
import { hasShared, SHARED } from "../support/shared.ts";

describe("odd scenes", () => {
  it.each(ODDITIES)("%s: twenty come out clean", (kind) => {
    for (let seed = 1; seed <= 20; seed++) {
      const w = drawOddity(kind, seed);
      const track = simulateCrowd(w, 180);
      expect(track.arrived, w.name).toBe(w.agents.length);
      const c = countContacts(track, w, 0.01, PARTED[kind]);
      expect([c.bodies, c.obstacles], w.name).toEqual([0, 0]);
      expect(c.quickest, w.name).toBeLessThanOrEqual(1.05);
    }
  });

  it.each(CROWD_KINDS)("%s: ten come out clean", (kind) => {
    for (let seed = 11; seed <= 20; seed++) {
      const w = drawCrowd(kind, seed);
      const track = simulateCrowd(w, 240);
      expect(track.arrived, w.name).toBe(w.agents.length);
      const c = countContacts(track, w, 0.01);
      expect([c.bodies, c.obstacles], w.name).toEqual([0, 0]);
    }
  });
});

interface Row {
  name: string;
  agents: number;
  arrived: number;
  mean: number;
  last: number;
  bodies: number;
  obstacles: number;
  deepest: number;
  usPerAgentTick: number;
}

function runCase(path: string): Row {
  const w = readSteerCase(readFileSync(path, "utf8"), basename(path));
  const begun = performance.now();
  let present = 0;
  const track = simulateCrowd(w, 600, {
    tick(_tick, left) {
      present += left;
      return true;
    },
  });
  const ms = performance.now() - begun;
  const c = countContacts(track, w);
  const row = {
    name: basename(path, ".xml"),
    agents: w.agents.length,
    arrived: track.arrived,
    mean: c.meanSeconds,
    last: c.lastSeconds,
    bodies: c.bodies,
    obstacles: c.obstacles,
    deepest: Math.max(c.deepestBodies, c.deepestObstacles),
    usPerAgentTick: (1000 * ms) / Math.max(1, present),
  };
  console.log(JSON.stringify(row));
  expect(c.quickest, row.name).toBeLessThanOrEqual(1.05);
  return row;
}

/** Contacts over 5 cm that a case may have, the share that must arrive, and in how many seconds in the mean and at last. */
const ALLOWED: Record<string, { bodies: number; share: number; mean?: number; last?: number }> = {
  "egress-50": { bodies: 0, share: 1, last: 120 },
  "egress-50-tight": { bodies: 0, share: 1, last: 120 },
  "hallway-two-way-200": { bodies: 0, share: 1, mean: 80 },
  "forest-700-500": { bodies: Number.POSITIVE_INFINITY, share: 0.99 },
  "4-way-oncomming": { bodies: 5, share: 1 },
  "bottleneck-evacuation": { bodies: 5, share: 1 },
};

const MARKS = ["<!-- cases -->", "<!-- /cases -->"];

function table(rows: readonly Row[]): string {
  const line = (r: Row): string =>
    `| ${[
      r.name,
      r.agents,
      r.arrived,
      r.mean.toFixed(1),
      r.last.toFixed(1),
      r.bodies,
      r.obstacles,
      (1000 * r.deepest).toFixed(0),
      r.usPerAgentTick.toFixed(0),
    ].join(" | ")} |`;
  return [
    "| case | agents | arrive | mean s | last s | bodies | walls | deepest mm | microseconds |",
    "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ...rows.map(line),
  ].join("\n");
}

describe.skipIf(!hasShared)("SteerSuite cases (skipped where the shared folder is absent)", () => {
  it("all arrive and none touch, but for what is allowed", () => {
    const folder = join(SHARED, "crowd-cases");
    const rows = [folder, join(folder, "paper")].flatMap((dir) =>
      readdirSync(dir)
        .filter((f) => f.endsWith(".xml"))
        .map((f) => runCase(join(dir, f))),
    );
    if (process.env.STEPWRIGHT_TABLES) {
      const page = "docs/footsteps.md";
      const text = readFileSync(page, "utf8");
      const [from, to] = MARKS.map((m) => text.indexOf(m));
      if (from < 0 || to < from) throw new Error(`${page}: ${MARKS.join(" and ")} are needed.`);
      writeFileSync(page, `${text.slice(0, from + MARKS[0].length)}\n${table(rows)}\n${text.slice(to)}`);
    }
    for (const r of rows) {
      const { bodies, share, mean, last } = ALLOWED[r.name] ?? { bodies: 0, share: 1 };
      if (mean !== undefined) expect(r.mean, r.name).toBeLessThanOrEqual(mean);
      if (last !== undefined) expect(r.last, r.name).toBeLessThanOrEqual(last);
      expect(r.arrived, r.name).toBeGreaterThanOrEqual(share * r.agents);
      expect(r.bodies, r.name).toBeLessThanOrEqual(bodies);
      expect(r.obstacles, r.name).toBe(0);
    }
  });
});

describe("two hundred animated", () => {
  it("meet every footstep of half a minute within 1 mm and half a degree", () => {
    const skeleton = createSkeleton(1.75);
    const r = createRandom(3);
    const w = worldOf([], [wall(-150, 150, 4, 5), wall(-150, 150, -5, -4)]);
    while (w.agents.length < 200) {
      const east = w.agents.length % 2 === 0;
      const x = (east ? -1 : 1) * r.between(2, 50);
      const z = r.between(-3.5, 3.5);
      if (w.agents.every((a) => (a.x - x) ** 2 + (a.z - z) ** 2 > 0.8))
        w.agents.push(walker(x, z, east ? 60 : -60, z));
    }
    const errors = footstepErrors(createCrowdMotion(w, studioBlendLibrary(skeleton)), skeleton, 30);
    console.log(errors);
    expect(errors.count).toBeGreaterThan(10_000);
    expect(errors.position).toBeLessThan(0.001);
    expect(errors.yaw).toBeLessThan((0.5 * Math.PI) / 180);
  });
});
