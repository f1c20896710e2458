/** An editor without a browser: the real scene session, tools and features, over a stage that is a flat floor. */
import { defaultScene } from "../../src/core/scene/default-scene.ts";
import type { Scene } from "../../src/core/scene/types.ts";
import type { Editor } from "../../src/editor/editor.ts";
import { ALL_FEATURES } from "../../src/editor/features/all.ts";
import { Registry } from "../../src/editor/features/feature.ts";
import { SceneSession } from "../../src/editor/session/scene-session.ts";
import { createEditorStore } from "../../src/editor/state.ts";
import type { Thing } from "../../src/editor/things/thing.ts";
import { ToolHost } from "../../src/editor/tools/tool-host.ts";

const PIXELS = 100;

export interface TestEditor {
  editor: Editor;
  canvas: HTMLElement;
  said: string[];
  /** Presses, moves and lets go over the floor, metres; `bail` presses Escape before the end. */
  drag(points: readonly [number, number][], options?: { bail?: boolean; shift?: boolean }): void;
}

/** A pixel is a centimetre of the floor; x grows with x, y with z. */
export function createTestEditor(scene: Scene = defaultScene()): TestEditor {
  const canvas = document.createElement("div");
  const overlay = document.createElement("div");
  document.body.append(canvas);
  const said: string[] = [];
  const store = createEditorStore(scene, "Test", "light");
  const nothing = () => undefined;
  const registry = new Registry(ALL_FEATURES);
  const parts = {
    store,
    registry,
    stage: {
      setOrbit: nothing,
      invalidate: nothing,
      levelPoint: (x: number, y: number): [number, number] => [x / PIXELS, y / PIXELS],
      project: (x: number, _: number, z: number) => ({ x: x * PIXELS, y: z * PIXELS, visible: true }),
    },
    layers: { update: nothing, pick: () => null },
    markers: { draw: nothing, overlay },
    plan: { announce: nothing, startOver: nothing, motion: { current: null }, duration: 0 },
    playback: { show: nothing },
    set: (change: object) => store.setState(change),
    redraw: nothing,
    sceneChanged: nothing,
    frameScene: nothing,
    hoverStep: nothing,
    setMenu: nothing,
    announce: nothing,
    say: (text: string) => said.push(text),
    fail: (text: string) => said.push(text),
    things: (): Thing[] => registry.things.flatMap((k) => k.list(editor)),
    edit: (...change: Parameters<SceneSession["edit"]>) => editor.scene.edit(...change),
    snapped: (at: [number, number]) => at,
    snappedYaw: (yaw: number) => yaw,
  };
  const editor = parts as unknown as Editor;
  Object.assign(parts, { scene: new SceneSession(editor, scene), tools: new ToolHost(editor, canvas) });
  const send = (
    target: EventTarget,
    type: string,
    [x, z]: readonly [number, number],
    shift = false,
  ): void => {
    target.dispatchEvent(
      new PointerEvent(type, {
        clientX: x * PIXELS,
        clientY: z * PIXELS,
        pointerId: 1,
        button: 0,
        buttons: type === "pointerup" ? 0 : 1,
        shiftKey: shift,
        bubbles: true,
      }),
    );
  };
  return {
    editor,
    canvas,
    said,
    drag(points, { bail = false, shift = false } = {}) {
      send(canvas, "pointerdown", points[0], shift);
      for (const p of points.slice(1)) send(window, "pointermove", p, shift);
      if (bail) window.dispatchEvent(new KeyboardEvent("keydown", { key: "Escape" }));
      send(window, "pointerup", points[points.length - 1], shift);
    },
  };
}
