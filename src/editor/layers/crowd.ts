/** The crowd in the stage: bodies, areas and goals, and what the picked walker plans. */
import { Group, type Raycaster, Vector3 } from "three";
import { CrowdMarks } from "../../view/crowd/crowd-marks.ts";
import { CrowdMesh } from "../../view/crowd/crowd-mesh.ts";
import { type Footprint, FootprintLayer } from "../../view/footprints.ts";
import { crowdAlone, crowdSession } from "../crowd/crowd-session.ts";
import type { Editor } from "../editor.ts";
import { hasRef, ref } from "../selection.ts";
import type { ViewportLayer } from "./layer.ts";

/** A walker is caught within this of the line through its middle, metres. */
const CAUGHT = 0.32;

export function crowdLayer(e: Editor): ViewportLayer {
  const session = crowdSession(e);
  const group = new Group();
  const marks = new CrowdMarks();
  const prints = new FootprintLayer();
  let bodies: CrowdMesh | null = null;
  group.add(marks.group, prints.group);

  const drawMarks = (): void => {
    const { scene, selection, tool } = e.store.getState();
    const { crowd } = scene;
    const { story } = session;
    // Areas and goals stand back while nobody works on the crowd.
    const busy =
      crowd && (tool === "crowd" || selection.some((r) => r.kind.startsWith("crowd")) || !session.running);
    const tree: number[] = [];
    const path: number[] = [];
    if (story) {
      story.parent.forEach((p, n) => {
        if (p >= 0 && story.judged[n]) tree.push(story.x[p], story.z[p], story.x[n], story.z[n]);
      });
      for (const n of story.path) {
        const p = story.parent[n];
        path.push(story.x[p], story.z[p], story.x[n], story.z[n]);
      }
    }
    const goals = crowd
      ? [
          ...crowd.regions.flatMap((r, i) => r.goals.map((g, k) => ({ g, id: `r-${i}-${k}` }))),
          ...crowd.agents.flatMap((a, i) => a.goals.map((g, k) => ({ g, id: `a-${i}-${k}` }))),
        ].slice(0, 60)
      : [];
    marks.set({
      regions: busy
        ? crowd.regions.map((r, i) => ({
            bounds: r.bounds,
            selected: hasRef(selection, ref("crowd-region", String(i), i)),
          }))
        : [],
      surfaces: crowd?.surfaces.map((s) => s.bounds) ?? [],
      goals: busy
        ? goals.map(({ g, id }) => ({
            x: g[0],
            z: g[1],
            selected: selection.some((r) => r.kind === "crowd-goal" && r.id === id),
          }))
        : [],
      circles: story?.circles ?? [],
      tree,
      path,
    });
    prints.set(
      session.picked < 0
        ? []
        : session.footsteps.map(
            (s): Footprint => ({
              foot: s.side > 0 ? "left" : "right",
              x: s.x,
              y: 0,
              z: s.z,
              yaw: s.yaw,
              category: "Walk",
              phase: null,
              state: s.land < session.seconds - 0.8 ? "past" : s.land <= session.seconds ? "now" : "next",
            }),
          ),
      "category",
      [],
    );
  };

  session.onFrame = () => {
    if (session.meshes && !bodies) {
      bodies = new CrowdMesh(session.meshes);
      bodies.setTheme(e.store.getState().theme);
      group.add(bodies.group);
    }
    if (bodies) {
      bodies.group.visible = session.frame !== null;
      if (session.frame) bodies.show(session.frame, e.stage.camera.position);
    }
    drawMarks();
    e.stage.invalidate();
  };

  return {
    id: "crowd",
    object: group,
    update(_, what) {
      if (what === "scene") {
        const { scene } = e.store.getState();
        // A crowd has the floor to itself: no walls of the room in its way, and nobody who only stands there.
        e.stage.setOpen(scene.crowd !== null);
        e.stage.setFigureShown(!crowdAlone(scene));
        session.follow();
      }
      drawMarks();
    },
    theme(theme) {
      marks.setTheme(theme);
      prints.setTheme(theme);
      bodies?.setTheme(theme);
      session.onFrame();
    },
    pick: (ray) => pickWalker(ray, session.frame, e),
    dispose() {
      marks.dispose();
      bodies?.dispose();
    },
  };
}

/** The walker under a ray: the nearest whose upright line it passes. */
function pickWalker(
  ray: Raycaster,
  frame: { count: number; places: Float32Array; here: Uint8Array } | null,
  e: Editor,
): ReturnType<typeof ref> | null {
  if (!frame || e.store.getState().tool !== "select") return null;
  const point = new Vector3();
  const low = new Vector3();
  const high = new Vector3();
  let best = -1;
  let nearest = Number.POSITIVE_INFINITY;
  for (let i = 0; i < frame.count; i++) {
    if (frame.here[i] === 0) continue;
    low.set(frame.places[5 * i], 0.1, frame.places[5 * i + 2]);
    high.set(low.x, 1.65, low.z);
    if (ray.ray.distanceSqToSegment(low, high, point) > CAUGHT * CAUGHT) continue;
    const away = ray.ray.origin.distanceToSquared(point);
    if (away < nearest) {
      nearest = away;
      best = i;
    }
  }
  return best < 0 ? null : ref("crowd-walker", String(best), best);
}
