/** Captures that anyone may use, fetched by the visitor's own browser at a click; the list is `captures.json` beside the page. */
import * as v from "valibot";

const list = v.object({
  captures: v.array(
    v.object({
      name: v.string(),
      /** File name that it is opened under. */
      file: v.pipe(v.string(), v.regex(/^[\w.-]+\.bvh$/i)),
      url: v.string(),
      /** Whose it is and what is allowed. */
      licence: v.string(),
    }),
  ),
});
export type PublicCapture = v.InferOutput<typeof list>["captures"][number];

/** @throws Error with one sentence when the list is not there or broken. */
export async function publicCaptures(): Promise<PublicCapture[]> {
  const url = new URL("captures.json", document.baseURI);
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`captures.json: the list could not be loaded (${answer.status}).`);
  const read = v.safeParse(list, await answer.json());
  if (!read.success) throw new Error(`captures.json: ${read.issues[0].message}`);
  return read.output.captures;
}

/** The file from its public home. @throws Error with one sentence when it cannot be fetched. */
export async function fetchCapture(c: PublicCapture): Promise<File> {
  let answer: Response;
  try {
    answer = await fetch(new URL(c.url, document.baseURI));
  } catch {
    throw new Error(`${c.file}: its home does not answer. Is this computer online?`);
  }
  if (!answer.ok) throw new Error(`${c.file}: its home answers with ${answer.status}.`);
  return new File([await answer.blob()], c.file);
}
