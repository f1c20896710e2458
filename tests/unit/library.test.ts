import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { createRandom } from "../../src/core/math/random.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { STEP_CATEGORIES } from "../../src/core/steps/types.ts";
import { mergeLibraries } from "../../src/core/templates/build-library.ts";
import { createKdTree, nearest } from "../../src/core/templates/kd-tree.ts";
import { decodeLibrary, encodeLibrary } from "../../src/core/templates/library-file.ts";
import { retargetLibrary } from "../../src/core/templates/retarget-library.ts";
import { retrieveEntry } from "../../src/core/templates/retrieve.ts";
import { studioSet } from "../../src/studio/set.ts";
import { studio } from "../support/library.ts";

describe("k-d tree", () => {
  it("finds what brute force finds (seed 8)", () => {
    fc.assert(
      fc.property(fc.integer({ min: 0, max: 1e6 }), (seed) => {
        const r = createRandom(seed);
        const d = 1 + r.below(4);
        const n = 1 + r.below(60);
        const rows = Float64Array.from({ length: n * d }, () => Math.round(r.between(-5, 5)));
        const query = Array.from({ length: d }, () => r.between(-5, 5));
        const all = Array.from({ length: n }, (_, id) => ({
          id,
          distance: Math.hypot(...query.map((q, k) => rows[id * d + k] - q)),
        })).sort((a, b) => a.distance - b.distance || a.id - b.id);
        const found = nearest(createKdTree(rows, d), query, 5);
        expect(found.map((f) => f.distance)).toEqual(
          all.slice(0, 5).map((f) => expect.closeTo(f.distance, 10)),
        );
      }),
      { seed: 8, numRuns: 200 },
    );
  });
});

describe("library of the studio's captures", () => {
  const { library, rendered } = studio();

  it("has templates of every task, both ways", () => {
    for (const c of ["write", "lift", "place", "sit", "turn"] as const) {
      expect(
        library.templates.filter((t) => t.phase === "enter" && t.descriptor.category === c).length,
        c,
      ).toBeGreaterThan(10);
      expect(
        library.templates.filter((t) => t.phase === "exit" && t.descriptor.category === c).length,
        c,
      ).toBeGreaterThan(5);
    }
    expect(library.walks.length).toBeGreaterThan(60);
  });

  it("finds every pivot of the scores, all seven categories, and times within 2 frames for three steps in four", () => {
    const seen = new Set<string>();
    let near = 0;
    let all = 0;
    const set = studioSet();
    rendered.forEach((_, i) => {
      const clip = library.clips[i];
      for (const s of clip.steps) seen.add(s.category);
      const pivots = set[i].score.steps.filter((s) => s.kind === "heelPivot" || s.kind === "toePivot");
      for (const p of pivots) {
        const kind = p.kind === "heelPivot" ? "HeelPivot" : "ToePivot";
        expect(
          clip.steps.some(
            (s) => s.category === kind && s.foot === p.foot && Math.abs(s.end - p.land * 60) < 12,
          ),
          `${set[i].name} ${p.kind} at ${p.lift}`,
        ).toBe(true);
      }
      for (const p of set[i].score.steps) {
        all++;
        if (
          clip.steps.some(
            (s) =>
              s.foot === p.foot && Math.abs(s.start - p.lift * 60) <= 2 && Math.abs(s.end - p.land * 60) <= 2,
          )
        )
          near++;
      }
    });
    expect([...seen].sort()).toEqual([...STEP_CATEGORIES].sort());
    expect(near / all).toBeGreaterThan(0.75);
  });

  it("reads back from its bytes: same steps, feet within 0.1 mm of rotation error", () => {
    const back = decodeLibrary(encodeLibrary(library));
    expect(back.templates.map((t) => t.id)).toEqual(library.templates.map((t) => t.id));
    const a = library.clips[3].clip.rotations;
    const b = back.clips[3].clip.rotations;
    let worst = 0;
    for (let i = 0; i < a.length; i += 4) {
      const dot = Math.abs(a[i] * b[i] + a[i + 1] * b[i + 1] + a[i + 2] * b[i + 2] + a[i + 3] * b[i + 3]);
      worst = Math.max(worst, Math.sqrt(Math.max(0, 1 - dot * dot)));
    }
    expect(worst).toBeLessThan(1e-4);
  });

  it("damaged bytes give one sentence", () => {
    const bytes = encodeLibrary(library);
    expect(() => decodeLibrary(bytes.subarray(0, 5))).toThrow("library:");
    expect(() => decodeLibrary(bytes.subarray(0, 4000))).toThrow("library:");
    expect(() => decodeLibrary(bytes.subarray(0, bytes.length - 1000))).toThrow("library:");
  });

  it("merging does not depend on how captures were divided", () => {
    const parts = [0, 1, 2].map((k) => ({ ...library, clips: library.clips.filter((_, i) => i % 3 === k) }));
    const one = mergeLibraries([library]);
    expect(mergeLibraries(parts).templates.map((t) => t.id)).toEqual(one.templates.map((t) => t.id));
    expect(mergeLibraries([...parts].reverse()).templates.map((t) => t.id)).toEqual(
      one.templates.map((t) => t.id),
    );
  });

  it("a taller character's templates reach farther", () => {
    const tall = retargetLibrary(library, createSkeleton(2));
    expect(tall.enterRadius.write / library.enterRadius.write).toBeCloseTo(2 / 1.75, 6);
  });

  it("near writing places are entered by side steps, middle ones by turn and step, far ones by walking [TaskLoco Figure 4]", () => {
    const share = (x: number, category: string): number => {
      const found = retrieveEntry(
        library,
        {
          category: "write",
          currentInNext: [x, 0],
          nextEffort: 1,
          followupInNext: null,
          followupEffort: null,
          hand: "right",
        },
        1,
      )[0].template;
      const steps = library.clips[found.clip].steps.slice(found.first, found.last);
      return steps.filter((s) => s.category === category).length / steps.length;
    };
    expect(share(0.4, "SideStep")).toBeGreaterThan(0.5);
    expect(share(1.2, "SideStep")).toBe(0);
    expect(share(1.2, "TurnAndStep")).toBeGreaterThan(0.3);
    expect(share(2.6, "SideStep")).toBe(0);
  });
});
