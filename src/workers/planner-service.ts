/**
 * The planner: holds the library, answers `plan` requests with footsteps at once and motion in slices.
 *
 * A newer request overtakes the one under way at its next slice. See protocol.ts for the order of answers. It runs in
 * planner-worker.ts, or on the page's own thread where no worker can start (then with smaller slices).
 */

import { type BlendLibrary, bakeLibrary } from "../core/blending/library.ts";
import type { CyclicSource } from "../core/blending/types.ts";
import { beginSynthesis, handResults, type SwingCache, synthesiseChunk } from "../core/motion/synthesise.ts";
import type { MotionChunk } from "../core/motion/types.ts";
import { planWhole } from "../core/motion/whole-scene.ts";
import { measureMotion } from "../core/quality/measure.ts";
import type { Scene } from "../core/scene/types.ts";
import { JOINT_COUNT } from "../core/skeleton/joints.ts";
import { createSkeleton, type Skeleton } from "../core/skeleton/skeleton.ts";
import type { StrideFamily } from "../core/styles/family.ts";
import { joinStories } from "../core/styles/story.ts";
import { goalsOf, planScene } from "../core/tasks/plan-scene.ts";
import type { Plan } from "../core/tasks/plan-types.ts";
import type { TaskGoal } from "../core/tasks/transition.ts";
import { mergeLibraries } from "../core/templates/build-library.ts";
import { decodeLibrary } from "../core/templates/library-file.ts";
import { retargetLibrary } from "../core/templates/retarget-library.ts";
import type { Library } from "../core/templates/types.ts";
import { cyclicSources } from "../studio/blend-library.ts";
import { PathPlanner } from "./path-planner.ts";
import type { PlannerRequest, PlannerResponse } from "./protocol.ts";

/** Frames made between two looks at the inbox, in a worker. */
const SLICE = 240;
/** Characters whose templates are kept, and askers whose played plan is known. */
const MOST_KEPT = 4;
const Q = 4 * JOINT_COUNT;

type PlanRequest = Extract<PlannerRequest, { type: "plan" }>;

interface Character {
  key: string;
  library: Library;
  cache: SwingCache;
}
interface Playing {
  plan: Plan;
  goals: TaskGoal[];
  key: string;
  shown: { shift: Float64Array; drop: Float64Array; heels: Float64Array } | null;
}

/** Sends one answer; what is in the second list may be transferred. */
export type PostAnswer = (message: PlannerResponse, transfer?: Transferable[]) => void;

/** Keeps the `most` newest entries of a map that is filled in order. */
function trim<K, V>(map: Map<K, V>, most: number): void {
  for (const key of map.keys()) {
    if (map.size <= most) return;
    map.delete(key);
  }
}

async function fetchLibrary(url: string): Promise<Uint8Array> {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: the library could not be loaded (${answer.status}).`);
  return new Uint8Array(await answer.arrayBuffer());
}

/**
 * A planner of its own.
 *
 * @param post where its answers go.
 * @param slice frames made at a stretch, 60 Hz; at least 1.
 * @returns what takes its requests.
 */
export function createPlanner(post: PostAnswer, slice: number = SLICE): (message: PlannerRequest) => void {
  let base: Library | null = null;
  /** The library that was loaded, without a person's own. */
  let loaded: Library | null = null;
  let own: Library | null = null;
  const characters = new Map<string, Character>();
  /** The plan that each asker plays, by `client`. */
  const played = new Map<number, Playing>();
  let cycles: CyclicSource[] | null = null;
  let blends: { key: string; library: BlendLibrary } | null = null;
  const paths = new PathPlanner();
  let told = false;
  let newest: PlanRequest | null = null;
  let busy = false;

  const pause = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 0));

  async function load(from: string | Uint8Array): Promise<void> {
    loaded = decodeLibrary(typeof from === "string" ? await fetchLibrary(from) : from);
    use();
  }

  /** The loaded library with a person's own beside it. */
  function use(): void {
    if (!loaded) return;
    base = own ? mergeLibraries([loaded, own]) : loaded;
    characters.clear();
    post({
      type: "ready",
      templates: base.templates.length,
      clips: base.clips.length,
      transitions: base.transitions,
    });
    void work();
  }

  /** Templates for the scene's character, kept until it changes. */
  function libraryFor(scene: Scene): Character {
    if (!base) throw new Error("The library is not loaded yet.");
    const { height, proportions } = scene.character;
    const key = `${height}/${proportions.leg}/${proportions.arm}/${proportions.torso}`;
    const character = characters.get(key) ?? {
      key,
      library: retargetLibrary(base, createSkeleton(height, proportions)),
      cache: new Map(),
    };
    characters.delete(key);
    characters.set(key, character);
    trim(characters, MOST_KEPT);
    return character;
  }

  /** The strides of a scene's styles, built ahead and kept; null when a newer request has come meanwhile. */
  const familiesOf = (
    request: PlanRequest,
    skeleton: Skeleton,
    key: string,
  ): Promise<ReadonlyMap<string, StrideFamily> | null> =>
    paths.families(
      request.scene,
      skeleton,
      key,
      (style, done, of) => post({ type: "families", id: request.id, style, done, of }),
      async () => {
        await pause();
        return newest === request;
      },
    );

  /** The clips that steps on stones are blended of, baked for a character. */
  function blendsFor(key: string, skeleton: Skeleton): BlendLibrary {
    cycles ??= cyclicSources();
    if (blends?.key !== key) blends = { key, library: bakeLibrary(cycles, skeleton) };
    return blends.library;
  }

  /** A scene with paths or stones: everything in its order, as one motion. */
  async function answerWhole(request: PlanRequest): Promise<void> {
    const { scene } = request;
    const skeleton = createSkeleton(scene.character.height, scene.character.proportions);
    const begun = performance.now();
    const { key, library, cache } = libraryFor(scene);
    const families = await familiesOf(request, skeleton, key);
    if (!families) {
      post({ type: "dropped", id: request.id });
      return;
    }
    const { plan, clip, contacts, boxes, ink, walks } = planWhole(
      scene,
      skeleton,
      {
        library: () => library,
        families: () => families,
        blends: () => blendsFor(key, skeleton),
        cache,
      },
      { lambda4: request.lambda4 ?? 0, trace: true, paths: request.paths ?? {} },
    );
    const story = joinStories(walks, clip.frames);
    played.delete(request.client);
    const planMs = performance.now() - begun;
    post({
      type: "planned",
      id: request.id,
      plan,
      planMs,
      frames: clip.frames,
      ...(story ? { story } : {}),
    });
    await pause();
    const started = performance.now();
    const chunks: MotionChunk[] = [];
    for (let first = 0; first < clip.frames; first += slice) {
      if (newest !== request) {
        post({ type: "dropped", id: request.id });
        return;
      }
      const frames = Math.min(slice, clip.frames - first);
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
    const quality = measureMotion(skeleton, chunks, clip.frames, plan, goalsOf(scene));
    post({ type: "finished", id: request.id, boxes, ink, quality, motionMs });
    if (scene.paths.length === 0) return;
    await pause();
    if (told || newest !== request) return;
    told = true;
    post({ type: "styles", facts: paths.shippedFacts() });
  }

  async function answer(request: PlanRequest): Promise<void> {
    const { scene } = request;
    if (scene.paths.length > 0 || scene.stones.length > 0) return answerWhole(request);
    const { key, library, cache } = libraryFor(scene);
    const skeleton = createSkeleton(scene.character.height, scene.character.proportions);
    const begun = performance.now();
    const goals = goalsOf(scene);
    const playing = played.get(request.client);
    const earlier =
      request.now !== null && playing && playing.key === key
        ? { plan: playing.plan, goals: playing.goals, now: request.now }
        : null;
    const plan = planScene(scene, library, skeleton, { playing: earlier, trace: true });
    const planMs = performance.now() - begun;
    const shown = playing?.shown ?? null;
    const now: Playing = { plan, goals, key, shown };
    played.delete(request.client);
    played.set(request.client, now);
    trim(played, 4 * MOST_KEPT);
    const frames = Math.max(1, Math.round(plan.duration * 60));
    post({ type: "planned", id: request.id, plan, planMs, frames });
    await pause();
    if (newest !== request) {
      post({ type: "dropped", id: request.id });
      return;
    }
    const started = performance.now();
    const kept = earlier && shown ? { ...shown, until: Math.round(earlier.now * 60) } : null;
    const synthesis = beginSynthesis(library, skeleton, plan, goals, cache, kept);
    const { shift, drop, heels } = synthesis.track;
    now.shown = { shift, drop, heels };
    const chunks: MotionChunk[] = [];
    for (let first = 0; first < synthesis.frames; first += slice) {
      const chunk = synthesiseChunk(synthesis, first, slice);
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
    // What is asked for before the library is there waits for it.
    if (busy || !base) return;
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

  return (message) => {
    switch (message.type) {
      case "load":
        post({ type: "started" });
        load("url" in message ? message.url : message.bytes).catch((error: unknown) =>
          post({ type: "failed", id: 0, message: error instanceof Error ? error.message : String(error) }),
        );
        break;
      case "plan":
        if (newest && busy && newest.id !== message.id) post({ type: "overtaken", id: newest.id });
        newest = message;
        void work();
        break;
      case "style":
        try {
          post({ type: "style", facts: paths.addStyle(message.name, message.file, message.text) });
        } catch (error) {
          post({
            type: "style-failed",
            name: message.name,
            message: error instanceof Error ? error.message : String(error),
          });
        }
        break;
      case "forget-style":
        paths.forgetStyle(message.name);
        break;
      case "own":
        try {
          own = message.bytes ? decodeLibrary(message.bytes) : null;
          use();
        } catch (error) {
          own = null;
          post({ type: "failed", id: 0, message: error instanceof Error ? error.message : String(error) });
        }
        break;
      case "cancel":
        if (newest?.id === message.id) newest = null;
        break;
    }
  };
}
