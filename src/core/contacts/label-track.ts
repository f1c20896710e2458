/**
 * Labels while a person corrects them: four tracks, a cursor, a brush, what is confirmed, and undo. No page, no clock.
 *
 * Frames are those of the clip. What the oracle thinks fills every label that is neither confirmed nor painted by hand; edits and
 * confirmations are entries of one history.
 */
import type { ContactTrack } from "../steps/types.ts";

export interface LabelRun {
  /** First frame, and one past the last. */
  from: number;
  to: number;
}

interface Snapshot {
  labels: Uint8Array;
  confirmed: Uint8Array;
  touched: Uint8Array;
}

/** Entries of the history that are kept. */
const MOST = 200;

export class LabelTrack {
  labels: ContactTrack;
  /** 1 for frames that the person has looked at: the oracle learns from them and changes them no more. */
  confirmed: Uint8Array;
  /** A bit for each track: labels that the person has painted. The oracle leaves them, and learns from them once they are confirmed. */
  touched: Uint8Array;
  /** Track at hand: 0 left heel, 1 left toe, 2 right heel, 3 right toe. */
  track = 0;
  cursor = 0;
  /** What the brush puts where the cursor goes; null when it is up. */
  brush: 0 | 1 | null = null;
  private past: Snapshot[] = [];
  private future: Snapshot[] = [];
  private mark: Snapshot | null = null;

  constructor(
    labels: ContactTrack,
    confirmed: Uint8Array = new Uint8Array(labels.length),
    touched: Uint8Array = new Uint8Array(labels.length),
  ) {
    for (const marks of [confirmed, touched])
      if (marks.length !== labels.length)
        throw new RangeError(`${marks.length} marks for ${labels.length} labels.`);
    this.labels = labels.slice();
    this.confirmed = confirmed.slice();
    this.touched = touched.slice();
  }

  get frames(): number {
    return this.labels.length;
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  at(track: number, frame: number): 0 | 1 {
    return ((this.labels[frame] >> track) & 1) as 0 | 1;
  }

  /** Planted runs of a track within [from, to). */
  runs(track: number, from = 0, to = this.frames): LabelRun[] {
    const out: LabelRun[] = [];
    for (let f = from; f < to; f++) {
      if (!this.at(track, f)) continue;
      const first = f;
      while (f < to && this.at(track, f)) f++;
      out.push({ from: first, to: f });
    }
    return out;
  }

  /** The planted run that holds a frame, whole, or null. */
  runAt(track: number, frame: number): LabelRun | null {
    if (!this.at(track, frame)) return null;
    let from = frame;
    let to = frame + 1;
    while (from > 0 && this.at(track, from - 1)) from--;
    while (to < this.frames && this.at(track, to)) to++;
    return { from, to };
  }

  // ---- gestures: everything between begin and commit is one entry ---------------------------------------------------

  /** Begins a drag or a stroke. */
  begin(): void {
    this.mark ??= this.snapshot();
  }

  /** Ends it. @returns whether anything changed. */
  commit(): boolean {
    const { mark } = this;
    this.mark = null;
    if (!mark || this.same(mark)) return false;
    this.past.push(mark);
    if (this.past.length > MOST) this.past.shift();
    this.future = [];
    return true;
  }

  /** Gives it up. */
  cancel(): void {
    if (this.mark) this.restore(this.mark);
    this.mark = null;
  }

  private edit(act: () => void): boolean {
    if (this.mark) {
      act();
      return true;
    }
    this.begin();
    act();
    return this.commit();
  }

  undo(): boolean {
    return this.step(this.past, this.future);
  }

  redo(): boolean {
    return this.step(this.future, this.past);
  }

  private step(from: Snapshot[], to: Snapshot[]): boolean {
    this.cancel();
    this.brush = null;
    const other = from.pop();
    if (!other) return false;
    to.push(this.snapshot());
    this.restore(other);
    return true;
  }

  // ---- edits ---------------------------------------------------------------------------------------------------

  /** Plants or lifts a track over frames [from, to), in either order, held inside the clip. */
  paint(track: number, from: number, to: number, value: 0 | 1): boolean {
    const a = this.hold(Math.min(from, to));
    const b = Math.min(this.frames, Math.max(from, to));
    return this.edit(() => {
      for (let f = a; f < b; f++) {
        this.labels[f] = value ? this.labels[f] | (1 << track) : this.labels[f] & ~(1 << track);
        this.touched[f] |= 1 << track;
      }
    });
  }

  /** Moves a run's end: `edge` is its first frame or one past its last; it never passes the run's other end. @returns where it is now. */
  moveEdge(track: number, edge: number, to: number): number {
    const starts =
      edge < this.frames && this.at(track, edge) === 1 && (edge === 0 || !this.at(track, edge - 1));
    const run = this.runAt(track, this.hold(starts ? edge : edge - 1));
    if (!run) return edge;
    const target = starts
      ? Math.max(0, Math.min(run.to - 1, Math.round(to)))
      : Math.min(this.frames, Math.max(run.from + 1, Math.round(to)));
    this.edit(() => {
      if (starts ? target < edge : target > edge) this.paint(track, edge, target, 1);
      else this.paint(track, edge, target, 0);
    });
    return target;
  }

  /** `[`: the run at the cursor, or the next one, begins here. */
  startHere(): boolean {
    const { track, cursor } = this;
    const run = this.runAt(track, cursor) ?? this.runs(track, cursor)[0];
    if (!run) return false;
    return run.from < cursor
      ? this.paint(track, run.from, cursor, 0)
      : this.paint(track, cursor, run.from, 1);
  }

  /** `]`: the run at the cursor, or the one before, ends here, with this frame. */
  endHere(): boolean {
    const { track, cursor } = this;
    const run = this.runAt(track, cursor) ?? this.runs(track, 0, cursor).pop();
    if (!run) return false;
    return run.to > cursor + 1
      ? this.paint(track, cursor + 1, run.to, 0)
      : this.paint(track, run.to, cursor + 1, 1);
  }

  /** Delete: lifts the whole run at the cursor. */
  clearHere(): boolean {
    const run = this.runAt(this.track, this.cursor);
    return run ? this.paint(this.track, run.from, run.to, 0) : false;
  }

  /** Space: the brush goes down with the opposite of what is here, or up. A stroke is one entry. */
  toggleBrush(): void {
    if (this.brush !== null) {
      this.brush = null;
      this.commit();
      return;
    }
    this.brush = this.at(this.track, this.cursor) ? 0 : 1;
    this.begin();
    this.paint(this.track, this.cursor, this.cursor + 1, this.brush);
  }

  /** Moves the cursor; a brush that is down paints the frames it passes. */
  moveTo(frame: number): void {
    const to = this.hold(Math.round(frame));
    if (this.brush !== null)
      this.paint(this.track, Math.min(this.cursor, to), Math.max(this.cursor, to) + 1, this.brush);
    this.cursor = to;
  }

  /** Another track; the brush goes up. */
  pick(track: number): void {
    if (this.brush !== null) this.toggleBrush();
    this.track = Math.max(0, Math.min(3, track));
  }

  /** Frames [from, to) are as they should be. */
  confirm(from: number, to: number): boolean {
    if (this.brush !== null) this.toggleBrush();
    return this.edit(() => {
      this.confirmed.fill(1, from, to);
    });
  }

  /**
   * What the oracle thinks now, where the person has said nothing; no entry of the history.
   *
   * @param learned the confirmed frames that it has learned from: when others are confirmed by now its thoughts are late, and are left.
   * @returns whether they were taken.
   */
  fill(labels: ContactTrack, learned: Uint8Array = this.confirmed): boolean {
    if (labels.length !== this.frames)
      throw new RangeError(`${labels.length} labels for ${this.frames} frames: they are of another clip.`);
    if (!learned.every((v, f) => v === this.confirmed[f])) return false;
    for (let f = 0; f < this.frames; f++) {
      const own = this.confirmed[f] ? 15 : this.touched[f];
      this.labels[f] = (this.labels[f] & own) | (labels[f] & ~own);
    }
    return true;
  }

  /** Labels of a file, all of them confirmed. */
  replace(labels: ContactTrack): boolean {
    if (labels.length !== this.frames)
      throw new RangeError(`${labels.length} labels for ${this.frames} frames: they are of another clip.`);
    return this.edit(() => {
      this.labels.set(labels);
      this.confirmed.fill(1);
    });
  }

  private hold(frame: number): number {
    return Math.max(0, Math.min(this.frames - 1, frame));
  }

  private snapshot(): Snapshot {
    return {
      labels: this.labels.slice(),
      confirmed: this.confirmed.slice(),
      touched: this.touched.slice(),
    };
  }

  private same(s: Snapshot): boolean {
    return (
      s.labels.every((v, i) => v === this.labels[i]) && s.confirmed.every((v, i) => v === this.confirmed[i])
    );
  }

  private restore(s: Snapshot): void {
    this.labels = s.labels;
    this.confirmed = s.confirmed;
    this.touched = s.touched;
  }
}
