/** What the studio's worker does, apart from being a worker: answers requests, drops those that a newer one overtook. */
import { writeBvh } from "../core/capture/bvh-write.ts";
import { measureGait } from "../core/quality/gait.ts";
import { rangeAt } from "../studio/gait-range.ts";
import { layerTracks } from "../studio/layer-tracks.ts";
import { leftOutScore } from "../studio/left-out.ts";
import { renderScore, renderWorkings, type Workings } from "../studio/render.ts";
import { CATEGORY_OF, type Score } from "../studio/score.ts";
import { readScore, writeScore } from "../studio/score-file.ts";
import { walkScore } from "../studio/walk-score.ts";
import type { PerformedSequence, StudioRequest, StudioResponse, Walked } from "./studio-protocol.ts";

type Render = Extract<StudioRequest, { type: "walk" | "score" }>;

export class StudioService {
  private waiting: Render | null = null;
  private shown: { score: Score; workings: Workings } | null = null;

  constructor(
    private readonly answer: (response: StudioResponse, transfer: Transferable[]) => void,
    /** Runs something once the messages that have come by now are heard. */
    private readonly later: (run: () => void) => void = (run) => {
      setTimeout(run, 0);
    },
  ) {}

  hear(request: StudioRequest): void {
    if (request.type === "save") {
      this.save(request.id, request.what);
      return;
    }
    if (request.type === "left-out") {
      this.perform(request.id);
      return;
    }
    const idle = this.waiting === null;
    this.waiting = request;
    if (idle) this.later(() => this.work());
  }

  private work(): void {
    const request = this.waiting;
    this.waiting = null;
    if (!request) return;
    try {
      const base = request.type === "walk" ? walkScore(request.settings) : readScore(request.text);
      const without = request.type === "walk" ? request.settings.without : request.without;
      const score: Score = without.length > 0 ? { ...base, without } : base;
      const workings = renderWorkings(score);
      this.shown = { score, workings };
      const walked = walkedOf(request.id, score, workings);
      this.answer(walked, [
        walked.root.buffer as ArrayBuffer,
        walked.rotations.buffer as ArrayBuffer,
        walked.contacts.buffer as ArrayBuffer,
      ]);
    } catch (error) {
      this.fail(request.id, error);
    }
  }

  private perform(id: number): void {
    const score = leftOutScore();
    const { clip, sidecar } = renderScore(score);
    const place = (foot: "left" | "right") => ({ foot, ...score.start[foot], y: 0 });
    const performed: PerformedSequence = {
      type: "performed",
      id,
      name: score.name,
      height: score.actor.height,
      proportions: score.actor.proportions,
      frames: clip.frames,
      root: Float32Array.from(clip.root),
      rotations: Float32Array.from(clip.rotations),
      start: [place("left"), place("right")],
      steps: score.steps.map(({ foot, x, z, yaw }) => ({ foot, x, y: 0, z, yaw })),
      tasks: sidecar.tasks,
    };
    this.answer(performed, [performed.root.buffer as ArrayBuffer, performed.rotations.buffer as ArrayBuffer]);
  }

  private save(id: number, what: "bvh" | "score"): void {
    if (!this.shown) {
      this.fail(id, new Error("Nothing is walked yet."));
      return;
    }
    const { score, workings } = this.shown;
    const text = what === "bvh" ? writeBvh(workings.clip) : writeScore(score);
    this.answer(
      { type: "saved", id, name: `${score.name}.${what === "bvh" ? "bvh" : "score.json"}`, text },
      [],
    );
  }

  private fail(id: number, error: unknown): void {
    this.answer({ type: "failed", id, message: error instanceof Error ? error.message : String(error) }, []);
  }
}

function walkedOf(id: number, score: Score, w: Workings): Walked {
  const gait = measureGait(w.clip, w.contacts);
  const stances = (["left", "right"] as const).map((foot) => ({
    foot,
    ...score.start[foot],
    y: 0,
    category: null,
    lift: 0,
    land: 0,
  }));
  return {
    type: "walked",
    id,
    name: score.name,
    height: score.actor.height,
    proportions: score.actor.proportions,
    frames: w.clip.frames,
    root: Float32Array.from(w.clip.root),
    rotations: Float32Array.from(w.clip.rotations),
    contacts: w.contacts.slice(),
    steps: [
      ...stances,
      ...score.steps.map((s) => ({
        foot: s.foot,
        x: s.x,
        y: 0,
        z: s.z,
        yaw: s.yaw,
        category: CATEGORY_OF[s.kind] ?? ("Walk" as const),
        lift: s.lift,
        land: s.land,
      })),
    ],
    gait,
    range: gait ? rangeAt(gait.facts.speed, gait.facts.flight > 0) : null,
    tracks: layerTracks(w),
  };
}
