/** JSON text of other people, with mistakes told in one line. */

/** The value of a JSON text. @throws Error "no JSON: ..." on one line, at most about 200 characters. */
export function readJson(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch (error) {
    // Engines quote the text as it stands, with its line breaks.
    const said = error instanceof Error ? error.message : String(error);
    throw new Error(`no JSON: ${said.replace(/\s+/g, " ").slice(0, 200)}`);
  }
}
