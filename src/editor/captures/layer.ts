/** The capture at hand in the stage: the character in its pose, and feet laid over each other in time [Oracle Figure 1]. */
import { Group } from "three";
import { JOINT_COUNT } from "../../core/skeleton/joints.ts";
import { createSkeleton } from "../../core/skeleton/skeleton.ts";
import { FootGhosts } from "../../view/foot-ghosts.ts";
import type { Editor } from "../editor.ts";
import type { ViewportLayer } from "../layers/layer.ts";
import type { Capture, Stretch } from "./capture.ts";
import type { CaptureSession } from "./session.ts";

const Q = 4 * JOINT_COUNT;
/** Places of a stretch that are looked at to frame it. */
const LOOKS = 8;
/** A way longer than this has the floor without walls, seen from farther off, metres. */
const ROOM = 6;

export function captureLayer(e: Editor, session: CaptureSession): ViewportLayer & { draw(): void } {
  const object = new Group();
  const ghosts = new FootGhosts();
  object.add(ghosts.object);
  const root = new Float64Array(3);
  let drawn = "";
  let framed = "";
  /** The scene's own character acts: places grow with its legs, so that its feet stand where the capture's do. */
  const scaleOf = (c: Capture): number => {
    const { height, proportions } = e.store.getState().scene.character;
    return createSkeleton(height, proportions).legLength / createSkeleton(c.clip.height).legLength;
  };
  const middleOf = ({ first, last }: Stretch): number => (first + last) >> 1;
  const draw = (): void => {
    const c = session.current;
    object.visible = session.deskOpen && c !== null;
    // Another stretch, or the scene again, is another picture.
    const picture = c && object.visible ? `${c.key} ${session.stretch.first}` : "";
    if (picture !== framed) {
      framed = picture;
      const way = frames();
      if (way) {
        const [from, to] = [way[0], way[way.length - 1]];
        e.stage.setOpen(Math.hypot(to[0] - from[0], to[2] - from[2]) > ROOM);
      }
      e.frameScene();
      // The character goes back to where the scene has it.
      if (picture === "") e.playback.show();
    }
    if (!c || !object.visible) return;
    const { clip, edits } = c;
    const scale = scaleOf(c);
    const middle = middleOf(session.stretch);
    const f = edits.cursor;
    for (let k = 0; k < 3; k++)
      root[k] = scale * (clip.root[3 * f + k] - (k === 1 ? 0 : clip.root[3 * middle + k]));
    e.stage.setPose(root, 0, clip.rotations, Q * f);
    const shown = session.feetShown;
    const key = `${c.key} ${session.stretch.first} ${shown} ${c.cleaned !== null}`;
    if (key !== drawn) {
      drawn = key;
      const which = shown === "after" ? c.cleaned?.clip : shown === "before" ? clip : undefined;
      ghosts.show(which ?? null, session.stretch, middle, clip.root, scale);
    }
    e.stage.invalidate();
  };
  /** Where the figure of the stretch stands, from its first frame to its last. */
  const frames = (): [number, number, number][] | null => {
    const c = session.current;
    if (!c || !object.visible) return null;
    const { first, last } = session.stretch;
    const { root: way } = c.clip;
    const scale = scaleOf(c);
    const middle = middleOf(session.stretch);
    return Array.from({ length: LOOKS }, (_, k) => {
      const f = Math.min(last - 1, first + Math.round((k * (last - 1 - first)) / (LOOKS - 1)));
      return [scale * (way[3 * f] - way[3 * middle]), 0, scale * (way[3 * f + 2] - way[3 * middle + 2])];
    });
  };
  return { id: "capture", object, draw, frames, update: draw, time: draw, dispose: () => ghosts.dispose() };
}
