/** Captures for the figures on contacts and loops: rendered by the studio when first needed, and kept. */
import type { Clip } from "../../core/capture/clip.ts";
import type { ContactTrack } from "../../core/steps/types.ts";
import { wearClip } from "../../studio/realism.ts";
import { renderScore } from "../../studio/render.ts";
import { type Style, styleScore } from "../../studio/styles.ts";

export interface Capture {
  clip: Clip;
  /** Exact contacts: the studio knows them. */
  contacts: ContactTrack;
}

const kept = new Map<Style, Capture>();

/** A straight walk in a style, clean. */
export function capture(style: Style): Capture {
  let c = kept.get(style);
  if (!c) {
    const { clip, contacts } = renderScore(styleScore(style));
    c = { clip, contacts };
    kept.set(style, c);
  }
  return c;
}

/** The same with the noise and drift of an optical capture. */
export function wornCapture(style: Style, seed: number): Capture {
  const { clip, contacts } = capture(style);
  return { clip: wearClip(clip, seed), contacts };
}
