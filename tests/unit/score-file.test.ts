/** Scores as text: what is written is read the same; mistakes are told in one sentence; layers can be left out. */
import { describe, expect, it } from "vitest";
import { J, JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { renderScore, renderWorkings } from "../../src/studio/render.ts";
import { LAYERS, type Layer } from "../../src/studio/score.ts";
import { readScore, ScoreError, writeScore } from "../../src/studio/score-file.ts";
import { everyScore } from "../../src/studio/set.ts";
import { styleScore } from "../../src/studio/styles.ts";

const PAGE = {
  version: 1,
  name: "two-steps",
  start: { left: { x: 0.095, z: 0 }, right: { x: -0.095, z: 0 } },
  steps: [
    { foot: "left", kind: "walk", lift: 0.9, land: 1.35, x: 0.07, z: 0.5, yaw: 0.1 },
    { foot: "right", kind: "close", lift: 1.5, land: 1.9, x: -0.1, z: 0.5 },
    { foot: "left", kind: "heelPivot", lift: 2.2, land: 2.6, yaw: 0.7 },
  ],
};
const changed = (change: (page: typeof PAGE) => void): string => {
  const page = structuredClone(PAGE);
  change(page);
  return JSON.stringify(page);
};
const says = (text: string): string => {
  try {
    readScore(text);
  } catch (error) {
    if (error instanceof ScoreError) return error.message;
    throw error;
  }
  return "nothing";
};

describe("a page of a score", () => {
  it("is read the same as it was written, for every capture that ships", () => {
    for (const { score } of everyScore()) {
      const { shape, ...actor } = score.actor;
      const again = readScore(writeScore(score));
      expect(again.actor.shape).toBe(shape);
      const { shape: _, ...actorAgain } = again.actor;
      expect({ ...again, actor: actorAgain }).toEqual(JSON.parse(JSON.stringify({ ...score, actor })));
    }
  });

  it("needs no more than feet and steps; where a pivot ends follows from its yaw", () => {
    const score = readScore(JSON.stringify(PAGE));
    expect(score.duration).toBeCloseTo(3.7, 10);
    expect(score.steps[2].x).toBeGreaterThan(0.02);
    const { clip, sidecar } = renderScore(score);
    expect(clip.frames).toBe(223);
    expect(sidecar.steps).toHaveLength(3);
  });

  it.each([
    ["no JSON", "{", /^no JSON: /],
    ["no version", changed((p) => Object.assign(p, { version: 2 })), "version: version 1 is needed."],
    [
      "a step that lands before it lifts",
      changed((p) => Object.assign(p.steps[1], { land: 1.4 })),
      "steps[1].land: must come after lift, 1.5 s.",
    ],
    [
      "steps out of order",
      changed((p) => p.steps.reverse()),
      "steps[1].lift: steps stand in order of their lift, the one before lifts at 2.2 s.",
    ],
    [
      "a foot that is in the air already",
      changed((p) => Object.assign(p.steps[1], { foot: "left", lift: 1.2 })),
      "steps[1].lift: the left foot is still moving until 1.350 s.",
    ],
    [
      "a pivot that travels",
      changed((p) => Object.assign(p.steps[2], { x: 1, z: 1 })),
      /^steps\[2\]\.x: a pivot to this yaw ends at /,
    ],
    [
      "a kind that nobody knows",
      changed((p) => Object.assign(p.steps[0], { kind: "hop" })),
      /^steps\[0\]\.kind: one of walk, run/,
    ],
    [
      "a place of a walk left out",
      changed((p) => Object.assign(p.steps[0], { x: undefined })),
      "steps[0].x: a number is needed.",
    ],
    [
      "a box put down that nobody lifted",
      changed((p) =>
        Object.assign(p, {
          events: [
            { type: "place", task: { category: "place", position: [0, 1, 0], start: 1, contact: 2, end: 3 } },
          ],
        }),
      ),
      "events[0]: there is no box to put down.",
    ],
    [
      "a mood beyond what a body does",
      changed((p) => Object.assign(p, { actor: { mood: { lean: 500 } } })),
      "actor.mood.lean: at most 120 is possible.",
    ],
  ])("says what is wrong: %s", (_, text, message) => {
    if (typeof message === "string") expect(says(text)).toBe(message);
    else expect(says(text)).toMatch(message);
  });
});

describe("layers", () => {
  const whole = renderWorkings(styleScore("walking"));
  const without = (layer: Layer) => renderWorkings({ ...styleScore("walking"), without: [layer] });
  /** Largest second difference of a knee over two frames each, radians per second squared. */
  const jerk = (r: typeof whole): number => {
    let most = 0;
    for (const joint of [J.leftLowerLeg, J.rightLowerLeg]) {
      const bend = (f: number) =>
        2 * Math.asin(Math.min(1, Math.abs(r.clip.rotations[4 * (JOINT_COUNT * f + joint)])));
      for (let f = 2; f < r.clip.frames - 2; f++)
        most = Math.max(most, 900 * Math.abs(bend(f - 2) - 2 * bend(f) + bend(f + 2)));
    }
    return most;
  };

  it("each changes the motion of a walk when it is left out, but those of runs and tasks; feet stay where they are", () => {
    for (const layer of LAYERS) {
      const less = without(layer);
      const same = less.clip.rotations.every((v, k) => v === whole.clip.rotations[k]);
      expect(same, layer).toBe(layer === "flight" || layer === "tasks");
      expect(less.sidecar.steps).toEqual(whole.sidecar.steps);
    }
  });

  it("flat feet without the roll, a stiff body without the rhythm, hips that drift without balance", () => {
    expect(without("roll").feet[0].pitch.every((p) => p === 0)).toBe(true);
    expect(without("rhythm").gait.amount.every((a) => a === 0)).toBe(true);
    expect(without("balance").zeroMoment).toHaveLength(0);
    expect(whole.zeroMoment).toHaveLength(2 * whole.clip.frames);
    expect(without("knees").raise.every((r) => r === 0)).toBe(true);
  });

  it("who sets off leans ahead, who stops leans back, and in between hardly", () => {
    const { lean } = whole.body;
    const degrees = (f: number) => (180 / Math.PI) * f;
    const most = lean.indexOf(Math.max(...lean));
    const least = lean.indexOf(Math.min(...lean));
    expect(degrees(lean[most])).toBeGreaterThan(3);
    expect(degrees(lean[least])).toBeLessThan(-3);
    expect(most).toBeLessThan(least);
    const middle = lean.slice(Math.round(0.45 * lean.length), Math.round(0.55 * lean.length));
    expect(degrees(Math.max(...middle.map(Math.abs)))).toBeLessThan(1);
    expect(without("lean").body.lean.every((v) => v === 0)).toBe(true);
  });

  it("knees of a jog turn no faster than runners' do, and much faster without their layer", () => {
    const jog = styleScore("jogging");
    const eased = jerk(renderWorkings(jog));
    expect(eased).toBeLessThan(310);
    expect(jerk(renderWorkings({ ...jog, without: ["knees"] }))).toBeGreaterThan(1.3 * eased);
  });
});
