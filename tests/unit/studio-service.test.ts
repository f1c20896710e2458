/** The studio page's worker apart from its thread: answers, overtaken requests, mistakes, files. */
import { describe, expect, it } from "vitest";
import { parseBvh } from "../../src/core/capture/bvh-parse.ts";
import { readScore } from "../../src/studio/score-file.ts";
import { STYLES } from "../../src/studio/styles.ts";
import type { WalkSettings } from "../../src/studio/walk-score.ts";
import { inStyle, MOOD, PERSON, START, VARIATION } from "../../src/studio-page/settings.ts";
import type { StudioRequest, StudioResponse, Walked } from "../../src/workers/studio-protocol.ts";
import { StudioService } from "../../src/workers/studio-service.ts";

/** A service whose work is done when `run` is called. */
function service() {
  const answers: StudioResponse[] = [];
  let work: (() => void) | null = null;
  const s = new StudioService(
    (a) => answers.push(a),
    (run) => {
      work = run;
    },
  );
  return {
    answers,
    hear: (r: StudioRequest) => s.hear(r),
    run: () => {
      const w = work;
      work = null;
      w?.();
    },
  };
}

function walked(settings: WalkSettings): Walked {
  const s = service();
  s.hear({ type: "walk", id: 1, settings });
  s.run();
  const [answer] = s.answers;
  if (answer?.type !== "walked") throw new Error(JSON.stringify(answer));
  return answer;
}

describe("the studio's worker", () => {
  it("answers the newest of several requests and no other", () => {
    const s = service();
    for (let id = 1; id <= 5; id++)
      s.hear({ type: "walk", id, settings: { ...START, speed: 0.8 + 0.1 * id } });
    s.run();
    expect(s.answers.map((a) => a.id)).toEqual([5]);
    const [a] = s.answers;
    const speed = a.type === "walked" ? a.gait?.facts.speed : undefined;
    expect(Math.abs((speed ?? 0) - 1.3)).toBeLessThan(0.08);
  });

  it("says what is wrong with a score and goes on working", () => {
    const s = service();
    s.hear({ type: "score", id: 1, text: '{"version": 1}', without: [] });
    s.run();
    expect(s.answers[0]).toMatchObject({ type: "failed", id: 1 });
    s.hear({ type: "walk", id: 2, settings: START });
    s.run();
    expect(s.answers[1]).toMatchObject({ type: "walked", id: 2 });
  });

  it("saves what was walked last as BVH and as a score that walks the same", () => {
    const s = service();
    s.hear({ type: "save", id: 0, what: "bvh" });
    expect(s.answers[0]).toMatchObject({ type: "failed", message: "Nothing is walked yet." });
    s.hear({ type: "walk", id: 1, settings: START });
    s.run();
    s.hear({ type: "save", id: 1, what: "bvh" });
    s.hear({ type: "save", id: 1, what: "score" });
    const [, walk, bvh, score] = s.answers;
    if (walk.type !== "walked" || bvh.type !== "saved" || score.type !== "saved") throw new Error("kinds");
    expect(bvh.name).toBe("walk.bvh");
    expect(parseBvh(bvh.text, bvh.name).frames).toBe(walk.frames);
    expect(readScore(score.text).steps).toHaveLength(walk.steps.length - 2);
    s.hear({ type: "score", id: 2, text: score.text, without: [] });
    s.run();
    const again = s.answers[4];
    expect(again.type === "walked" && again.root).toEqual(walk.root);
  });

  it("walks at the speed and step length asked for, whatever the height", () => {
    for (const height of [1.5, 1.95]) {
      const f = walked({ ...START, height, speed: 1.3, stepLength: 0.7 }).gait?.facts;
      expect(Math.abs((f?.speed ?? 0) - 1.3)).toBeLessThan(0.08);
      expect(Math.abs((f?.stepLength ?? 0) - 0.7)).toBeLessThan(0.04);
    }
  });

  it("stands every slider's ends in every style", () => {
    for (const style of STYLES) {
      const own = inStyle(START, style);
      const w = walked(own);
      expect(w.gait, style).not.toBeNull();
      expect(
        w.tracks.every((t) => t.lines.every((l) => l.every(Number.isFinite))),
        style,
      ).toBe(true);
    }
    for (const slider of [...PERSON, ...MOOD, ...VARIATION])
      for (const end of [slider.min, slider.max]) {
        const w = walked(slider.write(START, end));
        expect(w.root.every(Number.isFinite) && w.rotations.every(Number.isFinite), slider.id).toBe(true);
        expect(slider.read(slider.write(START, end)), slider.id).toBeCloseTo(end, 9);
      }
  });
});
