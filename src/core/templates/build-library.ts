/**
 * From captures to the library of footstep-strategy templates [TaskLoco §4, Algorithm 1 line 2].
 *
 * Contacts are detected, steps segmented, told apart and given their phases; every transition between two tasks of a
 * capture becomes an exit and an entry template with its descriptor; then all of it once more, mirrored.
 */
import type { Clip } from "../capture/clip.ts";
import { mirrorClip, mirrorContacts, mirrorFootstep, mirrorTask } from "../capture/mirror.ts";
import type { SidecarTask } from "../capture/sidecar.ts";
import { detectContacts } from "../contacts/baselines.ts";
import { type GroundPose, midPose, toLocal } from "../math/frame2.ts";
import { TASK_CATEGORIES, type TaskCategory } from "../scene/task-types.ts";
import { categorise } from "../steps/categories.ts";
import { assignPhases } from "../steps/phases.ts";
import { segmentSteps } from "../steps/segment.ts";
import { type ContactTrack, STEP_CATEGORIES, type Step } from "../steps/types.ts";
import type { Library, LibraryClip, Template, TransitionDescriptor } from "./types.ts";

export interface Capture {
  name: string;
  clip: Clip;
  tasks: SidecarTask[];
  /** Its contacts, one byte a frame; left out, they are found by height and speed, which is exact on captures without noise. */
  contacts?: ContactTrack;
}

/** A capture that begins somewhere begins as if it had stood there. */
const START: Pick<SidecarTask, "category" | "effort"> = { category: "stand", effort: 1 };

/** Steps that begin this long before a task's end still belong to coming to it, seconds. */
const BELONGS = 0.1;

/** The library of the given captures and their mirror images, in the order given. */
export function buildLibrary(captures: readonly Capture[], options: { mirror?: boolean } = {}): Library {
  return assembleLibrary(captures.map(prepareClip), options.mirror !== false);
}

/** The library of prepared clips, doubled by their mirror images where wanted. */
export function assembleLibrary(clips: readonly LibraryClip[], mirror: boolean): Library {
  const library = emptyLibrary();
  for (const c of clips) addClip(library, c, c.clip.name, false);
  if (mirror) for (const c of clips) addClip(library, mirrorLibraryClip(c), c.clip.name, true);
  learnRadii(library);
  return library;
}

function emptyLibrary(): Library {
  return {
    version: 1,
    clips: [],
    templates: [],
    walks: [],
    enterRadius: Object.fromEntries(TASK_CATEGORIES.map((c) => [c, 0.6])) as Record<TaskCategory, number>,
    transitions: STEP_CATEGORIES.map(() => STEP_CATEGORIES.map(() => 0)),
  };
}

/** Contacts, steps, categories and phases of a capture. */
export function prepareClip(capture: Capture): LibraryClip {
  const { clip, tasks } = capture;
  const contacts = capture.contacts ?? detectContacts(clip, "both");
  const { steps, initialStance } = segmentSteps(clip, contacts);
  categorise(steps, initialStance, tasks, clip.rate, clip.skeleton.legLength);
  const prepared: LibraryClip = {
    clip,
    contacts,
    tasks: [...tasks].sort((a, b) => a.contact - b.contact),
    steps,
    initialStance,
  };
  for (const t of transitionsOf(prepared)) assignPhases(steps, t.first, t.last, initialStance);
  return prepared;
}

function mirrorLibraryClip(source: LibraryClip): LibraryClip {
  const [left, right] = source.initialStance;
  return {
    clip: mirrorClip(source.clip),
    contacts: mirrorContacts(source.contacts),
    tasks: source.tasks.map(mirrorTask),
    steps: source.steps.map(
      (s): Step => ({
        ...s,
        foot: s.foot === "left" ? "right" : "left",
        from: mirrorFootstep(s.from),
        to: mirrorFootstep(s.to),
      }),
    ),
    initialStance: [mirrorFootstep(right), mirrorFootstep(left)],
  };
}

/** Steps first..last-1 lead from task `from` (-1: the start) to task `to` (tasks.length: the end). */
interface Transition {
  from: number;
  to: number;
  first: number;
  last: number;
}

function transitionsOf(clip: LibraryClip): Transition[] {
  const out: Transition[] = [];
  const { tasks, steps } = clip;
  let first = 0;
  for (let k = 0; k < tasks.length; k++) {
    const end = (tasks[k].end - BELONGS) * clip.clip.rate;
    let last = first;
    while (last < steps.length && steps[last].start < end) last++;
    out.push({ from: k - 1, to: k, first, last });
    first = last;
  }
  out.push({ from: tasks.length - 1, to: tasks.length, first, last: steps.length });
  return out;
}

function addClip(library: Library, clip: LibraryClip, name: string, mirrored: boolean): void {
  const index = library.clips.length;
  library.clips.push(clip);
  const { steps, tasks } = clip;
  for (let i = 0; i < steps.length; i++) {
    if (i > 0) {
      const a = STEP_CATEGORIES.indexOf(steps[i - 1].category);
      const b = STEP_CATEGORIES.indexOf(steps[i].category);
      library.transitions[a][b]++;
    }
    if (steps[i].category === "Walk" && steps[i].phase === "locomotion") library.walks.push([index, i]);
  }
  const start = midPose(clip.initialStance[0], clip.initialStance[1]);
  const frameOf = (k: number): GroundPose =>
    k < 0 ? start : { x: tasks[k].position[0], z: tasks[k].position[2], yaw: tasks[k].yaw };
  for (const t of transitionsOf(clip)) {
    if (t.to >= tasks.length) continue;
    const current = frameOf(t.from);
    const next = frameOf(t.to);
    const currentTask = t.from < 0 ? START : tasks[t.from];
    const nextTask = tasks[t.to];
    const followup = tasks[t.to + 1];
    const nextInCurrent = toLocal(current, next);
    const currentInNext = toLocal(next, current);
    const followupInNext = followup ? toLocal(next, frameOf(t.to + 1)) : null;
    const descriptor = (category: TaskCategory): TransitionDescriptor => ({
      category,
      nextInCurrent: [nextInCurrent.x, nextInCurrent.z],
      currentInNext: [currentInNext.x, currentInNext.z],
      currentEffort: currentTask.effort,
      nextEffort: nextTask.effort,
      followupInNext: followupInNext ? [followupInNext.x, followupInNext.z] : null,
      followupEffort: followup ? followup.effort : null,
    });
    const add = (
      phase: Template["phase"],
      category: TaskCategory,
      first: number,
      last: number,
      task: number,
    ) => {
      if (last <= first) return;
      library.templates.push({
        id: `${name}${mirrored ? "~" : ""}/${phase}/${first}`,
        phase,
        clip: index,
        first,
        last,
        descriptor: descriptor(category),
        task,
        singleStance: phase === "enter" ? endsOnOneFoot(clip, last, nextTask) : null,
        mirrored,
      });
    };
    let split = t.first;
    while (split < t.last && steps[split].phase === "exit") split++;
    let enter = split;
    while (enter < t.last && steps[enter].phase === "locomotion") enter++;
    add("exit", currentTask.category, t.first, split, t.from);
    if (nextTask.category !== "stand") add("enter", nextTask.category, enter, t.last, t.to);
  }
}

/** The foot that landed last when the other leaves within a third of a second of the task: the body never stood. */
function endsOnOneFoot(clip: LibraryClip, last: number, task: SidecarTask): "left" | "right" | null {
  const step = clip.steps[last - 1];
  const next = clip.steps[last];
  if (!step || !next) return null;
  const quick =
    next.start - step.end < 0.34 * clip.clip.rate &&
    next.start - task.end * clip.clip.rate < 0.34 * clip.clip.rate;
  return quick && next.foot !== step.foot ? step.foot : null;
}

/** Enter radius of a category: the median distance from the task at which its entries begin [TaskLoco Algorithm 1]. */
function learnRadii(library: Library): void {
  const found: Partial<Record<TaskCategory, number[]>> = {};
  for (const t of library.templates) {
    if (t.phase !== "enter") continue;
    const clip = library.clips[t.clip];
    const from = clip.steps[t.first].from;
    const task = clip.tasks[t.task];
    const list = found[t.descriptor.category] ?? [];
    list.push(Math.hypot(from.x - task.position[0], from.z - task.position[2]));
    found[t.descriptor.category] = list;
  }
  for (const c of TASK_CATEGORIES) {
    const list = found[c]?.sort((a, b) => a - b);
    if (list && list.length > 0) library.enterRadius[c] = list[list.length >> 1];
  }
}

/**
 * One library of several, whatever way their captures were divided: clips in order of their names.
 *
 * @throws Error when two of them hold a clip of the same name.
 */
export function mergeLibraries(libraries: readonly Library[]): Library {
  const clips = libraries.flatMap((l) => l.clips.filter((c) => !c.clip.name.endsWith("~")));
  clips.sort((a, b) => (a.clip.name < b.clip.name ? -1 : a.clip.name > b.clip.name ? 1 : 0));
  for (let i = 1; i < clips.length; i++)
    if (clips[i].clip.name === clips[i - 1].clip.name)
      throw new Error(`merge: ${clips[i].clip.name} is in the libraries twice.`);
  return assembleLibrary(clips, true);
}
