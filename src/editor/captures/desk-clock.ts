/** Plays the stretch shown at the desk over and over, at a part of its speed. */
import { elapsed } from "../../core/math/elapsed.ts";

export interface DeskClockHost {
  /** First frame, one past the last, and frames a second; null while there is nothing to play. */
  span(): { first: number; last: number; rate: number } | null;
  cursor(): number;
  moveTo(frame: number): void;
  changed(): void;
}

export class DeskClock {
  playing = false;
  /** Of the capture's own speed. */
  speed = 1;
  private lastTick = 0;
  private toFrame = 0;

  constructor(private readonly host: DeskClockHost) {}

  setSpeed(speed: number): void {
    this.speed = speed;
    this.host.changed();
  }

  toggle(): void {
    const span = this.host.span();
    this.playing = !this.playing && span !== null;
    if (this.playing && span) {
      if (this.host.cursor() >= span.last - 1) this.host.moveTo(span.first);
      this.lastTick = performance.now();
      this.toFrame = this.host.cursor();
      requestAnimationFrame(() => this.tick());
    }
    this.host.changed();
  }

  stop(): void {
    this.playing = false;
  }

  private tick(): void {
    const span = this.host.span();
    if (!this.playing || !span) {
      this.playing = false;
      return;
    }
    const now = performance.now();
    this.toFrame += elapsed(this.lastTick, now) * this.speed * span.rate;
    this.lastTick = now;
    if (this.toFrame >= span.last) this.toFrame = span.first;
    this.host.moveTo(Math.min(span.last - 1, Math.floor(this.toFrame)));
    requestAnimationFrame(() => this.tick());
  }
}
