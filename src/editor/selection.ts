/** What is selected: one list for tasks, paths, props, stones, footsteps and whatever a feature adds. */

/** Names one thing of the scene or of the plan. */
export interface Ref {
  /** The kind's name, as `things/` registers it: "task", "path", "point", "prop", "stone", "step", "agent", ... */
  kind: string;
  id: string;
  /** Place in a list that has no ids of its own (points of a path, steps of a plan); 0 otherwise. */
  index: number;
}

export const ref = (kind: string, id: string, index = 0): Ref => ({ kind, id, index });

export const sameRef = (a: Ref, b: Ref): boolean => a.kind === b.kind && a.id === b.id && a.index === b.index;

export const hasRef = (list: readonly Ref[], r: Ref): boolean => list.some((x) => sameRef(x, r));

/** The id of the only selected thing of a kind; null when there is none or several things are selected. */
export function onlyId(list: readonly Ref[], kind: string): string | null {
  return list.length === 1 && list[0].kind === kind ? list[0].id : null;
}

/** Ids of the selected things of a kind. */
export function idsOf(list: readonly Ref[], kind: string): string[] {
  return list.filter((r) => r.kind === kind).map((r) => r.id);
}
