/** The frames that are played: an answer under way replaces the one before once it has what is shown. */
import type { BoxTrack, InkStroke, MotionChunk } from "../../core/motion/types.ts";
import { JOINT_COUNT } from "../../core/skeleton/joints.ts";

const Q = 4 * JOINT_COUNT;

export interface Motion {
  id: number;
  frames: number;
  /** Frames that have arrived, from 0 on. */
  filled: number;
  root: Float32Array;
  rotations: Float32Array;
  contacts: Uint8Array;
  boxes: BoxTrack[];
  ink: InkStroke[];
}

export class MotionStore {
  /** What is shown. */
  current: Motion | null = null;
  private incoming: Motion | null = null;

  /** An answer of `frames` frames begins. */
  begin(id: number, frames: number): void {
    this.incoming = {
      id,
      frames,
      filled: 0,
      root: new Float32Array(3 * frames),
      rotations: new Float32Array(Q * frames),
      contacts: new Uint8Array(frames),
      boxes: [],
      ink: [],
    };
  }

  private of(id: number): Motion | null {
    return this.incoming?.id === id ? this.incoming : this.current?.id === id ? this.current : null;
  }

  /** Frames arrive. @returns whether what is shown has changed over to the new answer. */
  add(id: number, chunk: MotionChunk, shown: number): boolean {
    const m = this.of(id);
    if (!m) return false;
    m.root.set(chunk.root, 3 * chunk.first);
    m.rotations.set(chunk.rotations, Q * chunk.first);
    m.contacts.set(chunk.contacts, chunk.first);
    m.filled = Math.max(m.filled, chunk.first + chunk.frames);
    if (m === this.incoming && m.filled > Math.min(shown + 1, m.frames - 1)) {
      this.current = m;
      this.incoming = null;
      return true;
    }
    return false;
  }

  finish(id: number, boxes: BoxTrack[], ink: InkStroke[]): void {
    const m = this.of(id);
    if (!m) return;
    m.boxes = boxes;
    m.ink = ink;
    this.current = m;
    if (this.incoming === m) this.incoming = null;
  }
}
