/** The contacts of a capture by the method asked for. */
import { readFileSync } from "node:fs";
import type { Clip } from "../../core/capture/clip.ts";
import { CONTACT_METHODS, type ContactMethod, detectContacts } from "../../core/contacts/baselines.ts";
import { decodeOracle } from "../../core/contacts/model-file.ts";
import { trackOf } from "../../core/contacts/motion-track.ts";
import { askOracle } from "../../core/contacts/oracle.ts";
import type { ContactTrack } from "../../core/steps/types.ts";
import { startingOracle } from "../../studio/starting-oracle.ts";
import { UsageError } from "../args.ts";

export type Detector = (clip: Clip) => ContactTrack;

/** @throws UsageError for a method that is not known; ModelError for a broken model. */
export function detector(method: string, model: string | undefined): Detector {
  if (method !== "oracle") {
    if (!CONTACT_METHODS.includes(method as ContactMethod))
      throw new UsageError(`--method: one of oracle, ${CONTACT_METHODS.join(", ")} is needed.`);
    return (clip) => detectContacts(clip, method as ContactMethod);
  }
  if (!model) console.error("making the starting oracle from the studio's captures ...");
  const oracle = model ? decodeOracle(new Uint8Array(readFileSync(model)), model) : startingOracle();
  return (clip) => askOracle(oracle, trackOf(clip)).labels;
}
