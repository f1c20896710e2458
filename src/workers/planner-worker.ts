/**
 * The planner worker: holds the library, answers `plan` requests with footsteps at once and motion in slices.
 *
 * A newer request overtakes the one under way at its next slice. See protocol.ts for the order of answers.
 */

import { beginSynthesis, handResults, type SwingCache, synthesiseChunk } from "../core/motion/synthesise.ts";
import type { MotionChunk } from "../core/motion/types.ts";
import { measureMotion } from "../core/quality/measure.ts";
import type { Scene } from "../core/scene/types.ts";
import { JOINT_COUNT } from "../core/skeleton/joints.ts";
import { createSkeleton } from "../core/skeleton/skeleton.ts";
import type { StrideFamily } from "../core/styles/family.ts";
import { planPaths, stylesOf } from "../core/styles/plan-paths.ts";
import { goalsOf, planScene } from "../core/tasks/plan-scene.ts";
import type { Plan } from "../core/tasks/plan-types.ts";
import type { TaskGoal } from "../core/tasks/transition.ts";
import { decodeLibrary } from "../core/templates/library-file.ts";
import { retargetLibrary } from "../core/templates/retarget-library.ts";
import type { Library } from "../core/templates/types.ts";
import { styleFamilies } from "../studio/style-families.ts";
import type { PlannerRequest, PlannerResponse } from "./protocol.ts";

/** Frames made between two looks at the inbox. */
const SLICE = 240;
const Q = 4 * JOINT_COUNT;

type PlanRequest = Extract<PlannerRequest, { type: "plan" }>;

let base: Library | null = null;
let character: { key: string; library: Library; cache: SwingCache } | null = null;
let playing: { plan: Plan; goals: TaskGoal[]; key: string; shift: Float64Array | null } | null = null;
let families: { key: string; byStyle: Map<string, StrideFamily> } | null = null;
let newest: PlanRequest | null = null;
let busy = false;

const post = (message: PlannerResponse, transfer: Transferable[] = []): void => {
  (self as unknown as { postMessage(m: unknown, t: Transferable[]): void }).postMessage(message, transfer);
};

const pause = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 0));

async function load(url: string): Promise<void> {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: the library could not be loaded (${answer.status}).`);
  base = decodeLibrary(new Uint8Array(await answer.arrayBuffer()));
  post({
    type: "ready",
    templates: base.templates.length,
    clips: base.clips.length,
    transitions: base.transitions,
  });
}

/** Templates for the scene's character, kept until it changes. */
function libraryFor(scene: Scene): { key: string; library: Library; cache: SwingCache } {
  if (!base) throw new Error("The library is not loaded yet.");
  const { height, proportions } = scene.character;
  const key = `${height}/${proportions.leg}/${proportions.arm}/${proportions.torso}`;
  if (character?.key !== key)
    character = {
      key,
      library: retargetLibrary(base, createSkeleton(height, proportions)),
      cache: new Map(),
    };
  return character;
}

/** A scene with paths: the walk along them, in the styles painted; tasks wait until there are no paths. */
async function answerPaths(request: PlanRequest): Promise<void> {
  const { scene } = request;
  const skeleton = createSkeleton(scene.character.height, scene.character.proportions);
  const begun = performance.now();
  const { key } = libraryFor(scene);
  if (families?.key !== key) families = { key, byStyle: new Map() };
  const missing = stylesOf(scene).filter((style) => !families?.byStyle.has(style));
  for (const [style, family] of styleFamilies(missing, skeleton)) families.byStyle.set(style, family);
  const { plan, motion } = planPaths(scene, skeleton, families.byStyle);
  if (scene.tasks.length > 0) plan.warnings.push("paths: tasks wait while a path is followed.");
  playing = null;
  const { clip, contacts } = motion;
  post({ type: "planned", id: request.id, plan, planMs: performance.now() - begun, frames: clip.frames });
  await pause();
  const started = performance.now();
  const chunks: MotionChunk[] = [];
  for (let first = 0; first < clip.frames; first += SLICE) {
    if (newest !== request) {
      post({ type: "dropped", id: request.id });
      return;
    }
    const frames = Math.min(SLICE, clip.frames - first);
    const cut = (): MotionChunk => ({
      first,
      frames,
      root: Float32Array.from(clip.root.subarray(3 * first, 3 * (first + frames))),
      rotations: Float32Array.from(clip.rotations.subarray(Q * first, Q * (first + frames))),
      contacts: contacts.slice(first, first + frames),
    });
    chunks.push(cut());
    post({ type: "motion", id: request.id, chunk: cut() });
    await pause();
  }
  const motionMs = performance.now() - started;
  const quality = measureMotion(skeleton, chunks, clip.frames, plan, []);
  post({ type: "finished", id: request.id, boxes: [], ink: [], quality, motionMs });
}

async function answer(request: PlanRequest): Promise<void> {
  const { scene } = request;
  if (scene.paths.length > 0) return answerPaths(request);
  const { key, library, cache } = libraryFor(scene);
  const skeleton = createSkeleton(scene.character.height, scene.character.proportions);
  const begun = performance.now();
  const goals = goalsOf(scene);
  const earlier =
    request.now !== null && playing && playing.key === key
      ? { plan: playing.plan, goals: playing.goals, now: request.now }
      : null;
  const plan = planScene(scene, library, skeleton, { playing: earlier, trace: true });
  const planMs = performance.now() - begun;
  const shown = playing?.shift ?? null;
  playing = { plan, goals, key, shift: shown };
  const frames = Math.max(1, Math.round(plan.duration * 60));
  post({ type: "planned", id: request.id, plan, planMs, frames });
  await pause();
  if (newest !== request) {
    post({ type: "dropped", id: request.id });
    return;
  }
  const started = performance.now();
  const kept = earlier && shown ? { shift: shown, until: Math.round(earlier.now * 60) } : null;
  const synthesis = beginSynthesis(library, skeleton, plan, goals, cache, kept);
  playing.shift = synthesis.track.shift;
  const chunks: MotionChunk[] = [];
  for (let first = 0; first < synthesis.frames; first += SLICE) {
    const chunk = synthesiseChunk(synthesis, first, SLICE);
    chunks.push(chunk);
    // Frames before what is shown are only needed by the hands' state; all are sent, in order of playing.
    const copy: MotionChunk = {
      ...chunk,
      root: chunk.root.slice(),
      rotations: chunk.rotations.slice(),
      contacts: chunk.contacts.slice(),
    };
    post({ type: "motion", id: request.id, chunk: copy }, [
      copy.root.buffer,
      copy.rotations.buffer,
      copy.contacts.buffer,
    ]);
    await pause();
    if (newest !== request) {
      post({ type: "dropped", id: request.id });
      return;
    }
  }
  const motionMs = performance.now() - started;
  const { boxes, ink } = handResults(synthesis);
  const quality = measureMotion(skeleton, chunks, synthesis.frames, plan, goals);
  post({ type: "finished", id: request.id, boxes, ink, quality, motionMs });
}

async function work(): Promise<void> {
  if (busy) return;
  busy = true;
  let done: PlanRequest | null = null;
  while (newest && newest !== done) {
    const request: PlanRequest = newest;
    try {
      await answer(request);
    } catch (error) {
      post({
        type: "failed",
        id: request.id,
        message: error instanceof Error ? error.message : String(error),
      });
    }
    done = request;
  }
  busy = false;
}

self.onmessage = (event: MessageEvent<PlannerRequest>) => {
  const message = event.data;
  switch (message.type) {
    case "load":
      load(message.url).catch((error: unknown) =>
        post({ type: "failed", id: 0, message: error instanceof Error ? error.message : String(error) }),
      );
      break;
    case "plan":
      if (newest && busy && newest.id !== message.id) post({ type: "overtaken", id: newest.id });
      newest = message;
      void work();
      break;
    case "cancel":
      if (newest?.id === message.id) newest = null;
      break;
  }
};
