/** The capture at hand in the stage: the character in its pose, and feet laid over each other in time [Oracle Figure 1]. */
import { Group } from "three";
import { JOINT_COUNT } from "../../core/skeleton/joints.ts";
import { createSkeleton } from "../../core/skeleton/skeleton.ts";
import { FootGhosts } from "../../view/foot-ghosts.ts";
import type { Editor } from "../editor.ts";
import type { ViewportLayer } from "../layers/layer.ts";
import type { CaptureSession } from "./session.ts";

const Q = 4 * JOINT_COUNT;

export function captureLayer(e: Editor, session: CaptureSession): ViewportLayer & { draw(): void } {
  const object = new Group();
  const ghosts = new FootGhosts();
  object.add(ghosts.object);
  const root = new Float64Array(3);
  let drawn = "";
  const draw = (): void => {
    const c = session.current;
    object.visible = session.deskOpen && c !== null;
    if (!c || !object.visible) return;
    const { clip, edits } = c;
    const { height, proportions } = e.store.getState().scene.character;
    // The scene's own character acts: places grow with its legs, so that its feet stand where the capture's do.
    const scale = createSkeleton(height, proportions).legLength / createSkeleton(clip.height).legLength;
    const middle = (session.stretch.first + session.stretch.last) >> 1;
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
  return { id: "capture", object, draw, update: draw, time: draw, dispose: () => ghosts.dispose() };
}
