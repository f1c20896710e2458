/**
 * The k templates most similar to a transition [TaskLoco §4.2, eqs. 6-10].
 *
 * w_d = 0.001 counts centimetres, so effort (w_e = 0.999) acts as a partition: each (phase, category, effort, hand) has
 * its own k-d tree over the places, and the next effort is only looked into when the first has too few.
 */
import type { Effort, TaskCategory } from "../scene/task-types.ts";
import { createKdTree, type KdTree, nearest } from "./kd-tree.ts";
import type { Library, Template } from "./types.ts";

/** w_d for metres, w_f for metres, w_e. */
const W_D = 0.1;
const W_F = 0.05;
const W_E = 0.999;

export interface Retrieved {
  template: Template;
  distance: number;
}

export interface ExitQuery {
  /** Null: from standing at the start. */
  category: TaskCategory | null;
  /** Next task in the frame of the current: lateral, forward, metres. */
  nextInCurrent: [number, number];
  currentEffort: Effort;
  hand: "left" | "right";
}

export interface EntryQuery {
  category: TaskCategory;
  currentInNext: [number, number];
  nextEffort: Effort;
  followupInNext: [number, number] | null;
  followupEffort: Effort | null;
  hand: "left" | "right";
}

interface Group {
  tree: KdTree;
  templates: Template[];
}

const indices = new WeakMap<Library, Map<string, Group>>();

function group(
  library: Library,
  key: string,
  keep: (t: Template) => boolean,
  place: (t: Template) => number[],
): Group {
  let map = indices.get(library);
  if (!map) {
    map = new Map();
    indices.set(library, map);
  }
  let g = map.get(key);
  if (!g) {
    const templates = library.templates.filter(keep);
    const rows = templates.map(place);
    g = { templates, tree: createKdTree(Float64Array.from(rows.flat()), rows[0]?.length ?? 2) };
    map.set(key, g);
  }
  return g;
}

function pick(g: Group, query: number[], k: number, extra: number): Retrieved[] {
  return nearest(g.tree, query, k).map((n) => ({
    template: g.templates[n.id],
    distance: n.distance + extra,
  }));
}

/** Whether a template was performed with this hand; only writing has one. */
function handOf(library: Library, t: Template): "left" | "right" | "both" {
  return library.clips[t.clip].tasks[t.task]?.hand ?? "both";
}

function best(lists: Retrieved[][], k: number): Retrieved[] {
  return lists
    .flat()
    .sort((a, b) => a.distance - b.distance || (a.template.id < b.template.id ? -1 : 1))
    .slice(0, k);
}

/** Exit templates by eq. 8, nearest first. */
export function retrieveExit(library: Library, query: ExitQuery, k: number): Retrieved[] {
  const category = query.category ?? "stand";
  const of = (c: TaskCategory, effort: Effort) =>
    group(
      library,
      `exit/${c}/${effort}`,
      (t) => t.phase === "exit" && t.descriptor.category === c && t.descriptor.currentEffort === effort,
      (t) => t.descriptor.nextInCurrent.map((v) => v * W_D),
    );
  const at = query.nextInCurrent.map((v) => v * W_D);
  const lists = [
    pick(of(category, query.currentEffort), at, k, 0),
    pick(of(category, query.currentEffort === 1 ? 0 : 1), at, k, W_E),
  ];
  return best(lists, k);
}

/** Entry templates by eq. 9, or eq. 10 where a low-effort task has one that follows; nearest first. */
export function retrieveEntry(library: Library, query: EntryQuery, k: number): Retrieved[] {
  const { category, hand } = query;
  const handed = category === "write";
  const fits = (t: Template) =>
    t.phase === "enter" && t.descriptor.category === category && (!handed || handOf(library, t) === hand);
  const at = query.currentInNext.map((v) => v * W_D);
  const plain = (effort: Effort) =>
    group(
      library,
      `enter/${category}/${effort}/${handed ? hand : ""}`,
      (t) => fits(t) && t.descriptor.nextEffort === effort,
      (t) => t.descriptor.currentInNext.map((v) => v * W_D),
    );
  if (query.nextEffort === 0 && query.followupInNext) {
    const follow = query.followupInNext.map((v) => v * W_F);
    const efforts: Effort[] = [0, 1];
    const lists = efforts.map((f) => {
      const g = group(
        library,
        `coarticulated/${category}/${f}/${handed ? hand : ""}`,
        (t) =>
          fits(t) &&
          t.descriptor.nextEffort === 0 &&
          t.descriptor.followupInNext !== null &&
          t.descriptor.followupEffort === f,
        (t) => [
          ...t.descriptor.currentInNext.map((v) => v * W_D),
          ...(t.descriptor.followupInNext ?? [0, 0]).map((v) => v * W_F),
        ],
      );
      if (g.templates.length === 0) return [];
      // Eq. 10 adds the two distances; the tree's joint one finds candidates, eq. 10 ranks them.
      return nearest(g.tree, [...at, ...follow], Math.max(4 * k, 16)).map((n) => {
        const t = g.templates[n.id];
        const d = t.descriptor;
        const dc = Math.hypot(
          d.currentInNext[0] - query.currentInNext[0],
          d.currentInNext[1] - query.currentInNext[1],
        );
        const df =
          d.followupInNext && query.followupInNext
            ? Math.hypot(
                d.followupInNext[0] - query.followupInNext[0],
                d.followupInNext[1] - query.followupInNext[1],
              )
            : 0;
        return {
          template: t,
          distance: W_D * dc + W_F * df + W_E * Math.abs((query.followupEffort ?? 1) - f),
        };
      });
    });
    const found = best(lists, k);
    if (found.length > 0) return found;
  }
  const effort = query.nextEffort;
  return best([pick(plain(effort), at, k, 0), pick(plain(effort === 1 ? 0 : 1), at, k, W_E)], k);
}
