/** The contacts of a capture by the method asked for. */
import { fileURLToPath } from "node:url";
import type { Clip } from "../../core/capture/clip.ts";
import { CONTACT_METHODS, type ContactMethod, detectContacts } from "../../core/contacts/baselines.ts";
import { asRested } from "../../core/contacts/convention.ts";
import { decodeOracle, encodeOracle } from "../../core/contacts/model-file.ts";
import { trackOf } from "../../core/contacts/motion-track.ts";
import { askOracle, type Oracle } from "../../core/contacts/oracle.ts";
import type { ContactTrack } from "../../core/steps/types.ts";
import { startingOracle } from "../../studio/starting-oracle.ts";
import { UsageError } from "../args.ts";
import { readBytes } from "../read.ts";
import { keptBeside } from "../write.ts";

export type Detector = (clip: Clip) => ContactTrack;

/** @throws UsageError for a method that is not known; ModelError for a broken model. */
export function detector(method: string, model: string | undefined): Detector {
  if (method !== "oracle") {
    if (!CONTACT_METHODS.includes(method as ContactMethod))
      throw new UsageError(`--method: one of oracle, ${CONTACT_METHODS.join(", ")} is needed.`);
    return (clip) => detectContacts(clip, method as ContactMethod);
  }
  const oracle = model ? readModel(model) : startingModel();
  return (clip) => askOracle(oracle, trackOf(clip)).labels;
}

/** Contacts that steps are made of: as when the points rest, whatever the method calls planted. */
export function stepDetector(method: string, model: string | undefined): Detector {
  const detect = detector(method, model);
  return method === "oracle" ? (clip) => asRested(detect(clip)) : detect;
}

/** A model file. @throws ModelError for a broken one, Error "F: could not be read: ..." */
export function readModel(path: string): Oracle {
  return decodeOracle(readBytes(path), path);
}

/** The starting oracle: made once for each build of the command line and kept beside it. */
export function startingModel(): Oracle {
  made ??= makeStarting();
  return made;
}

let made: Oracle | null = null;

function makeStarting(): Oracle {
  const bytes = keptBeside(fileURLToPath(import.meta.url), "starting-oracle.bin", () => {
    console.error("making the starting oracle from the studio's captures ...");
    return encodeOracle(startingOracle());
  });
  return decodeOracle(bytes, "starting-oracle.bin");
}
