/** A character from a file: kept by name in the browser's own database, its bones mapped, moved by the motion. */
import type { JointName } from "../../core/skeleton/joints.ts";
import { createSkeleton } from "../../core/skeleton/skeleton.ts";
import type { BoneMap } from "../../view/character/bone-map.ts";
import type { Guest } from "../../view/character/guest.ts";
import type { Editor } from "../editor.ts";
import { keepModel, loadModel } from "./storage.ts";

/** Heights that a character may have, metres; others are scaled to 1.75 m. */
const HEIGHTS: readonly [number, number] = [1.2, 2.3];
const USUAL = 1.75;
const LEGS: readonly [number, number] = [0.7, 1.4];

interface Loaded {
  name: string;
  bytes: ArrayBuffer;
  /** Names of all its bones. */
  bones: string[];
  map: BoneMap;
  /** Whether the file itself says which bone is which. */
  sure: boolean;
  missing: JointName[];
  guest: Guest | null;
}

export class GuestSession {
  loaded: Loaded | null = null;
  /** Bones that the user chose, by joint. */
  private readonly chosen = new Map<JointName, string>();
  private asked: string | null = null;

  constructor(private readonly e: Editor) {}

  /** Opens a character's file. @throws Error "F: ..." for files that are none. */
  async open(file: File): Promise<void> {
    this.chosen.clear();
    const bytes = await file.arrayBuffer();
    await this.load(file.name, bytes);
    const { loaded } = this;
    if (!loaded) return;
    await keepModel(file.name, bytes);
    this.asked = file.name;
    this.wear();
    this.e.set({ tab: "character" });
    this.e.say(
      loaded.missing.length > 0
        ? `${file.name}: ${loaded.missing.length} bones are not known. Say which they are.`
        : `${file.name} opened.`,
      loaded.missing.length === 0,
      loaded.missing.length > 0,
    );
  }

  private async load(name: string, bytes: ArrayBuffer): Promise<void> {
    const [{ readCharacter }, { missingJoints }, { Guest }] = await Promise.all([
      import("../../view/character/read-character.ts"),
      import("../../view/character/bone-map.ts"),
      import("../../view/character/guest.ts"),
    ]);
    const { scene, bones, map, sure, height } = await readCharacter(bytes, name);
    for (const [joint, bone] of this.chosen) {
      const found = bones.find((b) => b.name === bone);
      if (found) map.set(joint, found);
      else map.delete(joint);
    }
    if (height < HEIGHTS[0] || height > HEIGHTS[1]) scene.scale.multiplyScalar(USUAL / height);
    const missing = missingJoints(map);
    const { character } = this.e.store.getState().scene;
    const skeleton = createSkeleton(character.height, character.proportions);
    this.loaded?.guest?.dispose();
    this.loaded = {
      name,
      bytes,
      bones: bones.map((b) => b.name),
      map,
      sure,
      missing,
      guest: missing.length === 0 ? new Guest(scene, map, skeleton) : null,
    };
  }

  /** Puts the character on, and the scene's build to its own: what is planned fits its legs. */
  private wear(): void {
    const { loaded, e } = this;
    if (!loaded?.guest) {
      e.stage.setGuest(null);
      return;
    }
    const { measure } = loaded.guest;
    const clamp = (v: number, [a, b]: readonly [number, number]): number => Math.max(a, Math.min(b, v));
    const height = clamp(measure.height, HEIGHTS);
    const leg = clamp(measure.hips / createSkeleton(height).offsets[1], LEGS);
    e.stage.setGuest(loaded.guest);
    e.edit((scene, c) => c.setModel(c.setCharacter(scene, height, leg), loaded.name));
    e.playback.show();
  }

  /** Says which bone a joint is; "" for none. */
  async choose(joint: JointName, bone: string): Promise<void> {
    const { loaded } = this;
    if (!loaded) return;
    this.chosen.set(joint, bone);
    await this.load(loaded.name, loaded.bytes);
    this.wear();
    this.e.redraw();
  }

  /** The scene's own character again. */
  takeOff(): void {
    this.e.edit((scene, c) => c.setModel(scene, null));
  }

  /** The scene names another character, or none: undo, examples, links and reloads come through here. */
  follow(): void {
    const { model } = this.e.store.getState().scene.character;
    const skeleton = createSkeleton(
      this.e.store.getState().scene.character.height,
      this.e.store.getState().scene.character.proportions,
    );
    if (this.loaded?.guest) this.loaded.guest.skeleton = skeleton;
    if (model === this.asked) return;
    this.asked = model;
    if (model === null) {
      this.e.stage.setGuest(null);
      this.loaded?.guest?.dispose();
      this.loaded = null;
      return;
    }
    void this.restore(model);
  }

  private async restore(name: string): Promise<void> {
    const bytes = await loadModel(name);
    if (!bytes) {
      this.e.say(`${name} is not kept in this browser: the usual character is shown.`, false, true);
      return;
    }
    try {
      await this.load(name, bytes);
      if (this.asked === name) this.e.stage.setGuest(this.loaded?.guest ?? null);
      this.e.playback.show();
    } catch (error) {
      this.e.fail(error instanceof Error ? error.message : String(error));
    }
  }
}
