/** The timing editor [Express Figure 3]: styles over time with edges to drag, loops, speed, stride and lean. */

import type { Scene } from "../../core/scene/types.ts";
import type { PathStory } from "../../core/styles/story.ts";
import {
  type BlendBox,
  leanSvg,
  loopsSvg,
  type StyleStretch,
  stylesSvg,
  trackSvg,
} from "../../plots/path-lanes.ts";
import type { Editor } from "../editor.ts";
import { deskOf, type Stretch, stretchesOf } from "../paths/path-desk.ts";
import { ref } from "../selection.ts";
import type { Lane, LaneFrame } from "./lane.ts";

const RATE = 60;
const shown = (e: Editor): boolean => e.store.getState().scene.paths.length > 0 && deskOf(e).story !== null;

/** A change as markup carries it: "path 2". */
const codeOf = (s: Stretch): string => `${s.path} ${s.index}`;
function stretchOf(code: string | null | undefined): Stretch | null {
  const at = code?.lastIndexOf(" ") ?? -1;
  return code && at > 0 ? { path: code.slice(0, at), index: Number(code.slice(at + 1)) } : null;
}

/** A lane's markup is made anew only when the walk, the room for it or `key` changes: not for each frame that is played. */
function kept(
  draw: (e: Editor, story: PathStory, frame: LaneFrame) => string,
  key: (e: Editor) => string = () => "",
) {
  let last: { story: PathStory; scene: Scene; key: string; svg: string } | null = null;
  return (e: Editor, frame: LaneFrame): string => {
    const { story } = deskOf(e);
    const { scene } = e.store.getState();
    if (!story) return "";
    const now = `${frame.width} ${frame.height.toFixed(1)} ${frame.x(1).toFixed(2)} ${key(e)}`;
    if (last?.story !== story || last.scene !== scene || last.key !== now)
      last = { story, scene, key: now, svg: draw(e, story, frame) };
    return last.svg;
  };
}

/** Stretches of time and the blends between them, as the walk being shown has them. */
function timed(e: Editor): { stretches: StyleStretch[]; blends: BlendBox[] } {
  const desk = deskOf(e);
  const { story } = desk;
  const stretches: StyleStretch[] = [];
  const blends: BlendBox[] = [];
  if (!story) return { stretches, blends };
  const { scene } = e.store.getState();
  const chosen = desk.current();
  const end = story.frames / RATE;
  // The change that begins each blend: the last one at or before where the walk was when it began.
  const changes = scene.paths.flatMap((p) => {
    const span = story.spans.find((x) => x.id === p.id);
    return span
      ? stretchesOf(p).map((s, index) => ({
          metres: span.from + s.at * (span.to - span.from),
          stretch: { path: p.id, index },
        }))
      : [];
  });
  const at = (metres: number): Stretch | null =>
    changes.filter((c) => c.metres <= metres + 0.06).at(-1)?.stretch ?? changes[0]?.stretch ?? null;
  let from = 0;
  let style = story.styles[story.blends[0]?.from ?? story.loopStarts[0]?.style ?? 0] ?? "walking";
  let stretch: Stretch | null = changes[0]?.stretch ?? null;
  const push = (to: number): void => {
    stretches.push({
      from,
      to,
      style,
      look: desk.look(style),
      change: stretch ? codeOf(stretch) : null,
      selected: stretch !== null && chosen !== null && codeOf(stretch) === codeOf(chosen),
    });
  };
  for (const b of story.blends) {
    push(b.start / RATE);
    const next = at(story.at[Math.min(story.frames - 1, b.start)]);
    from = Math.min(end, (b.start + b.frames) / RATE);
    style = story.styles[b.to];
    stretch = next;
    if (next)
      blends.push({
        from: b.start / RATE,
        to: from,
        change: codeOf(next),
        words: `Change from ${story.styles[b.from]} to ${style}`,
      });
  }
  push(end);
  return { stretches, blends };
}

/** Moves a change to where the walk is at a time. */
function moveTo(e: Editor, stretch: Stretch, seconds: number): void {
  const place = deskOf(e).placeAt(seconds);
  if (place && place.path === stretch.path) deskOf(e).moveChange(stretch, place.at);
}

function choose(e: Editor, stretch: Stretch | null): void {
  const desk = deskOf(e);
  desk.chosen = stretch;
  if (stretch) e.scene.select([ref("path", stretch.path)]);
  e.set({ tab: "path" });
  e.redraw();
}

const styleLane: Lane = {
  id: "styles",
  order: 20,
  shown,
  height: () => 50,
  draw: kept(
    (e, _, frame) => {
      const { stretches, blends } = timed(e);
      return stylesSvg(stretches, blends, frame.x);
    },
    (e) => {
      const chosen = deskOf(e).current();
      return chosen ? codeOf(chosen) : "";
    },
  ),
  down(e, target, frame, ev) {
    const change = stretchOf(target.closest("[data-change]")?.getAttribute("data-change"));
    if (change) return dragChange(e, change, target, frame, ev);
    const stretch = target.closest("[data-stretch]")?.getAttribute("data-stretch");
    if (!stretch) return null;
    choose(e, stretchOf(stretch));
    return { plain: true, move: () => undefined };
  },
  keydown(e, target, ev) {
    const change = stretchOf(target.closest("[role=slider]")?.getAttribute("data-change"));
    const stretch = stretchOf(target.closest("[data-stretch]")?.getAttribute("data-stretch"));
    const step = ev.key === "ArrowLeft" ? -1 : ev.key === "ArrowRight" ? 1 : 0;
    if (change && step !== 0) {
      const path = e.scene.scene.paths.find((p) => p.id === change.path);
      const now = path ? stretchesOf(path)[change.index] : undefined;
      if (now) deskOf(e).moveChange(change, now.at + step * (ev.shiftKey ? 0.05 : ev.altKey ? 0.002 : 0.01));
      return true;
    }
    if (change && (ev.key === "Delete" || ev.key === "Backspace")) {
      deskOf(e).removeChange(change);
      return true;
    }
    if (stretch && (ev.key === "Enter" || ev.key === " ")) {
      choose(e, stretch);
      return true;
    }
    return false;
  },
};

/** A change follows the pointer along the time axis; what is left of it stays as it was, so its place is known. */
function dragChange(e: Editor, change: Stretch, target: Element, frame: LaneFrame, ev: PointerEvent) {
  const left = target.closest("svg")?.getBoundingClientRect().left ?? 0;
  choose(e, change);
  const { story } = deskOf(e);
  const box = story?.blends.length ? timed(e).blends.find((b) => b.change === codeOf(change)) : undefined;
  const grabbed = box ? frame.seconds(ev.clientX - left) - box.from : 0;
  return {
    move(p: { event: PointerEvent }) {
      moveTo(e, change, frame.seconds(p.event.clientX - left) - grabbed);
    },
  };
}

const lane = (id: string, order: number, height: number, draw: Lane["draw"]): Lane => ({
  spare: true,
  id,
  order,
  shown,
  height: () => height,
  draw,
});

const loopLane = lane(
  "loops",
  21,
  22,
  kept((_, story, frame) =>
    loopsSvg(
      story.loopStarts.map((l) => l.frame),
      story.frames,
      frame.x,
      frame.height,
    ),
  ),
);

const speedLane = lane(
  "speed",
  22,
  36,
  kept((_, story, frame) =>
    trackSvg(
      {
        title: "Speed",
        unit: "m/s",
        values: story.speed,
        range: [0, 1.5],
        write: (v) => `${v.toFixed(2)} m/s`,
      },
      frame.x,
      frame.height,
    ),
  ),
);

const strideLane = lane(
  "stride",
  23,
  36,
  kept((_, story, frame) =>
    trackSvg(
      {
        title: "Stride",
        unit: "scale",
        values: story.scale,
        range: [0.5, 1],
        write: (v) => `${Math.round(100 * v)} %`,
      },
      frame.x,
      frame.height,
    ),
  ),
);

const leanLane = lane(
  "lean",
  24,
  26,
  kept((_, story, frame) =>
    leanSvg(
      story.lean.map((v) => (v * 180) / Math.PI),
      frame.x,
      frame.height,
    ),
  ),
);

export const pathLanes: readonly Lane[] = [styleLane, loopLane, speedLane, strideLane, leanLane];
