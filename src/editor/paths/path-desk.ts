/**
 * What the path tool's parts share: the story of the walk being shown, the styles there are, what is switched on, and what of a
 * path is chosen. One desk an editor.
 */

import type { ScenePath } from "../../core/scene/types.ts";
import type { PathStory } from "../../core/styles/story.ts";
import { PATH_DEFAULTS, type PathOptions } from "../../core/styles/synthesise-path.ts";
import { freeName, type StyleFacts, styleName } from "../../core/styles/user-style.ts";
import { STYLES } from "../../studio/styles.ts";
import { type StyleLook, styleLook } from "../../view/style-look.ts";
import type { PlannerResponse } from "../../workers/protocol.ts";
import type { Editor } from "../editor.ts";
import { dropStyle, keepStyle, keptStyles } from "./style-storage.ts";

/** A stretch of a path: its path and place in the path's list of styles. */
export interface Stretch {
  path: string;
  index: number;
}

const desks = new WeakMap<Editor, PathDesk>();

/** The editor's desk. */
export function deskOf(e: Editor): PathDesk {
  let desk = desks.get(e);
  if (!desk) {
    desk = new PathDesk(e);
    desks.set(e, desk);
  }
  return desk;
}

/** The styles of a path from its start on; walking where nothing is painted. */
export function stretchesOf(path: ScenePath): { at: number; style: string }[] {
  return path.styles[0]?.at === 0 ? path.styles : [{ at: 0, style: "walking" }, ...path.styles];
}

export class PathDesk {
  story: PathStory | null = null;
  /** The visitor's own styles, in the order they came. */
  own: string[] = [];
  readonly facts = new Map<string, StyleFacts>();
  chosen: Stretch | null = null;
  /** What is being built, for the panel: "Strides of balancing, 20 of 50". */
  progress: string | null = null;
  /** Files of own styles whose answer is awaited. */
  private readonly waiting = new Map<string, { file: string; text: string; say: boolean }>();

  constructor(private readonly e: Editor) {
    e.plan.listen((m) => this.hear(m));
    void this.recall();
  }

  get options(): PathOptions {
    return { ...PATH_DEFAULTS, ...this.e.plan.pathOptions };
  }

  /** Switches an enhancement; the walk is made again. */
  toggle(change: Partial<PathOptions>): void {
    this.e.plan.pathOptions = { ...this.e.plan.pathOptions, ...change };
    this.e.plan.ask();
    this.e.redraw();
  }

  /** Names of all styles: those that ship, then the visitor's. */
  get styles(): string[] {
    return [...STYLES, ...this.own];
  }

  look(style: string): StyleLook {
    return styleLook(style, this.own);
  }

  private hear(m: PlannerResponse): void {
    switch (m.type) {
      case "planned":
        this.story = m.story ?? null;
        this.progress = null;
        break;
      case "families":
        this.progress = `Strides of ${m.style}, ${m.done} of ${m.of}`;
        break;
      case "styles":
        for (const f of m.facts) this.facts.set(f.name, f);
        break;
      case "style":
        this.facts.set(m.facts.name, m.facts);
        this.welcome(m.facts);
        break;
      case "style-failed":
        this.waiting.delete(m.name);
        this.e.plan.planner.forgetStyle(m.name);
        this.e.fail(m.message);
        break;
      default:
        return;
    }
    this.e.redraw();
  }

  // ---- the visitor's own styles ---------------------------------------------------------------------------------

  /** A straight sample is offered as a style. */
  async add(file: File): Promise<void> {
    const text = await file.text();
    const name = freeName(styleName(file.name), this.styles);
    this.waiting.set(name, { file: file.name, text, say: true });
    this.e.plan.planner.addStyle(name, file.name, text);
  }

  private welcome(facts: StyleFacts): void {
    const sent = this.waiting.get(facts.name);
    if (!sent) return;
    this.waiting.delete(facts.name);
    if (!this.own.includes(facts.name)) this.own = [...this.own, facts.name];
    this.e.layers.update("look");
    if (!sent.say) return;
    this.e.set({ tab: "path" });
    this.e.say(
      `${facts.name} is a style now: ${facts.steps} steps in ${facts.seconds.toFixed(2)} s, ${facts.speed.toFixed(2)} m/s.`,
      false,
    );
    void keepStyle({ name: facts.name, file: sent.file, text: sent.text });
  }

  /** Takes an own style back; where it is painted the path walks plainly. */
  forget(name: string): void {
    this.own = this.own.filter((x) => x !== name);
    this.facts.delete(name);
    void dropStyle(name);
    this.e.edit((scene, c) =>
      scene.paths.reduce(
        (s, p) =>
          p.styles.some((x) => x.style === name)
            ? c.paintPath(
                s,
                p.id,
                p.styles.map((x) => (x.style === name ? { at: x.at, style: "walking" } : x)),
              )
            : s,
        scene,
      ),
    );
    this.e.plan.planner.forgetStyle(name);
    this.e.redraw();
  }

  /** Own styles of earlier visits. A scene that names one waits for them. */
  private async recall(): Promise<void> {
    const kept = await keptStyles();
    for (const s of kept) {
      this.waiting.set(s.name, { file: s.file, text: s.text, say: false });
      this.e.plan.planner.addStyle(s.name, s.file, s.text);
    }
    if (kept.length > 0 && this.e.store.getState().scene.paths.length > 0) this.e.plan.ask();
  }

  // ---- places along the way ------------------------------------------------------------------------------------

  /** The path and share of it at a time of the walk, seconds; null when there is no walk. */
  placeAt(time: number): { path: string; at: number } | null {
    const { story } = this;
    if (!story || story.frames === 0) return null;
    const s = story.at[Math.max(0, Math.min(story.frames - 1, Math.round(time * 60)))];
    const span = story.spans.find((x) => s <= x.to) ?? story.spans[story.spans.length - 1];
    if (!span) return null;
    return {
      path: span.id,
      at: Math.max(0, Math.min(1, (s - span.from) / Math.max(1e-6, span.to - span.from))),
    };
  }

  /** First time at which the walk is at a share of a path, seconds. */
  timeAt(path: string, at: number): number {
    const { story } = this;
    const span = story?.spans.find((x) => x.id === path);
    if (!story || !span) return 0;
    const s = span.from + at * (span.to - span.from);
    let f = 0;
    while (f + 1 < story.frames && story.at[f] < s) f++;
    return f / 60;
  }

  /** The stretch at a time of the walk. */
  stretchAt(time: number): Stretch | null {
    const place = this.placeAt(time);
    const path = this.e.store.getState().scene.paths.find((p) => p.id === place?.path);
    if (!place || !path) return null;
    const list = stretchesOf(path);
    let index = 0;
    list.forEach((s, k) => {
      if (s.at <= place.at + 1e-6) index = k;
    });
    return { path: path.id, index };
  }

  /** The chosen stretch while it exists, else the one under the playhead. */
  current(): Stretch | null {
    const { scene, time } = this.e.store.getState();
    const { chosen } = this;
    const path = scene.paths.find((p) => p.id === chosen?.path);
    if (chosen && path && chosen.index < stretchesOf(path).length) return chosen;
    return this.stretchAt(time);
  }

  // ---- painting ------------------------------------------------------------------------------------------------

  /** A stretch takes a style. */
  paint(stretch: Stretch, style: string): void {
    this.e.edit((scene, c) => {
      const path = scene.paths.find((p) => p.id === stretch.path);
      if (!path) return scene;
      return c.paintPath(
        scene,
        path.id,
        stretchesOf(path).map((s, k) => (k === stretch.index ? { at: s.at, style } : s)),
      );
    });
  }

  /** From a place of a path on, up to the next change, it is walked in a style. */
  change(place: { path: string; at: number }, style: string): void {
    const at = Math.max(0.02, Math.min(0.98, place.at));
    this.e.edit((scene, c) => {
      const path = scene.paths.find((p) => p.id === place.path);
      if (!path) return scene;
      const others = stretchesOf(path).filter((s) => s.at === 0 || Math.abs(s.at - at) > 0.015);
      return c.paintPath(scene, path.id, [...others, { at, style }]);
    });
    this.choose(place.path, at);
  }

  private choose(id: string, at: number): void {
    const path = this.e.store.getState().scene.paths.find((p) => p.id === id);
    const index = path ? stretchesOf(path).findIndex((s) => Math.abs(s.at - at) < 1e-9) : -1;
    this.chosen = index >= 0 ? { path: id, index } : null;
  }

  /** A change moves along its path, held between its neighbours. */
  moveChange(stretch: Stretch, at: number): void {
    this.e.edit((scene, c) => {
      const path = scene.paths.find((p) => p.id === stretch.path);
      if (!path) return scene;
      const list = stretchesOf(path);
      const low = (list[stretch.index - 1]?.at ?? 0) + 0.01;
      const high = (list[stretch.index + 1]?.at ?? 1) - 0.01;
      if (stretch.index === 0 || high < low) return scene;
      const held = Math.max(low, Math.min(high, at));
      return c.paintPath(
        scene,
        path.id,
        list.map((s, k) => (k === stretch.index ? { at: held, style: s.style } : s)),
      );
    });
  }

  /** A change is taken away: the stretch before it goes on. */
  removeChange(stretch: Stretch): void {
    if (stretch.index === 0) return;
    this.chosen = { path: stretch.path, index: stretch.index - 1 };
    this.e.edit((scene, c) => {
      const path = scene.paths.find((p) => p.id === stretch.path);
      if (!path) return scene;
      return c.paintPath(
        scene,
        path.id,
        stretchesOf(path).filter((_, k) => k !== stretch.index),
      );
    });
  }
}
