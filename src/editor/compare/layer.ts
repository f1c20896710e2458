/** The performance in the stage: a second figure that one sees through, and its footsteps in white under the plan's; of a result, the footsteps. */
import { Group } from "three";
import { JOINT_COUNT } from "../../core/skeleton/joints.ts";
import { createSkeleton } from "../../core/skeleton/skeleton.ts";
import type { CharacterMesh } from "../../view/character/build-mesh.ts";
import { Figure } from "../../view/character/figure.ts";
import { type Footprint, FootprintLayer } from "../../view/footprints.ts";
import type { Editor } from "../editor.ts";
import type { ViewportLayer } from "../layers/layer.ts";
import type { CompareSession } from "./session.ts";

const Q = 4 * JOINT_COUNT;
const COLOUR = "#3a6fb0";
const OPACITY = 0.42;

export function compareLayer(e: Editor, session: CompareSession): ViewportLayer {
  const object = new Group();
  const prints = new FootprintLayer();
  // Under the plan's.
  prints.group.position.y = -0.0015;
  object.add(prints.group);
  let figure: Figure | null = null;
  let worn: CharacterMesh | null = null;

  /** The scene's character has the performer's build: its skin fits. */
  const dress = (): void => {
    const { mesh } = e.character;
    if (mesh === worn) return;
    worn = mesh;
    if (figure) {
      object.remove(figure.group);
      figure.dispose();
      figure = null;
    }
    if (!mesh) return;
    const { height, proportions } = e.store.getState().scene.character;
    figure = new Figure(createSkeleton(height, proportions), mesh);
    figure.makeGhost(COLOUR, OPACITY);
    object.add(figure.group);
  };

  const time = (_: Editor, seconds: number): void => {
    const p = session.shown;
    object.visible = p !== null && e.tools.current.id !== "label";
    if (!p || !object.visible) return;
    if (p.frames > 0) dress();
    if (figure) figure.group.visible = p.frames > 0;
    if (p.frames === 0) return;
    const f = Math.max(0, Math.min(p.frames - 1, Math.floor(seconds * 60)));
    figure?.setPose(p.root, 3 * f, p.rotations, Q * f);
  };

  return {
    id: "compare",
    object,
    update(_, what) {
      if (what === "scene") session.follow();
      const p = session.shown;
      const all = p ? [...p.start, ...p.steps] : [];
      prints.set(
        all.map((s): Footprint => ({ ...s, category: null, phase: null, state: "next" })),
        "category",
        [],
      );
      time(e, e.store.getState().time);
      e.stage.invalidate();
    },
    time,
    theme: (theme) => prints.setTheme(theme),
    dispose: () => figure?.dispose(),
  };
}
