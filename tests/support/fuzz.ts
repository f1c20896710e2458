/** How long fuzzing runs, broken inputs made from sound ones, and what a parser may answer. */
import fc from "fast-check";
import { expect } from "vitest";

/** STEPWRIGHT_FUZZ multiplies the number of inputs: 1 in `npm test`, e.g. 50 for a long run. */
const FACTOR = Math.max(1, Number(process.env.STEPWRIGHT_FUZZ ?? 1) || 1);

/** Options of a property: a fixed seed for the short run, a seed of its own (shown when it fails) for a long one. */
export function budget(numRuns: number): { numRuns: number; seed?: number } {
  return FACTOR === 1 ? { numRuns, seed: 7 } : { numRuns: Math.round(numRuns * FACTOR) };
}

/** Vitest's limit for a property that takes `ms` in the short run. */
export const limit = (ms: number): number => Math.max(60_000, 4 * ms * FACTOR);

/** What stands where it should not in the files people have. */
const ODD = [
  "",
  "-",
  "NaN",
  "Infinity",
  "1e308",
  "-1e308",
  "1e-320",
  "0",
  "-1",
  "99999999999",
  "null",
  "{",
  "}",
  "[",
  "]",
  "<",
  ">",
  "</",
  "&x;",
  "\n",
  "\r\n",
  "\t",
  "\0",
  "\uFEFF",
  "\uD800",
  '"',
  ",",
  "<script>alert(1)</script>",
];

type Change = { kind: number; at: number; length: number; odd: string; to: number };

const change = fc.record({
  kind: fc.nat(5),
  at: fc.double({ min: 0, max: 1, noNaN: true }),
  length: fc.nat(60),
  odd: fc.constantFrom(...ODD),
  to: fc.double({ min: 0, max: 1, noNaN: true }),
});

function changed(text: string, c: Change): string {
  const at = Math.floor(c.at * text.length);
  const end = Math.min(text.length, at + c.length);
  switch (c.kind) {
    case 0:
      return text.slice(0, at) + text.slice(end);
    case 1:
      return text.slice(0, at) + c.odd + text.slice(at);
    case 2: {
      const to = Math.floor(c.to * text.length);
      return text.slice(0, to) + text.slice(at, end) + text.slice(to);
    }
    case 3:
      return text.slice(0, at);
    case 4: {
      // One word of the text is another.
      const words = [...text.matchAll(/[\w.+-]+/g)];
      const w = words[Math.floor(c.at * words.length)];
      return w ? text.slice(0, w.index) + c.odd + text.slice(w.index + w[0].length) : text;
    }
    default: {
      const lines = text.split("\n");
      lines.splice(Math.floor(c.at * lines.length), 1 + (c.length % 3));
      return lines.join("\n");
    }
  }
}

/** A sound text with one to four things wrong. */
export const brokenText = (sound: string): fc.Arbitrary<string> =>
  fc.array(change, { minLength: 1, maxLength: 4 }).map((list) => list.reduce(changed, sound));

/** Sound bytes with one to six bytes changed, or cut short. */
export const brokenBytes = (sound: Uint8Array): fc.Arbitrary<Uint8Array> =>
  fc
    .tuple(
      fc.array(fc.tuple(fc.double({ min: 0, max: 1, noNaN: true }), fc.nat(255)), {
        minLength: 1,
        maxLength: 6,
      }),
      fc.option(fc.double({ min: 0, max: 1, noNaN: true })),
    )
    .map(([changes, cut]) => {
      const out = sound.slice(0, cut === null ? sound.length : Math.floor(cut * sound.length));
      for (const [at, value] of changes) if (out.length > 0) out[Math.floor(at * (out.length - 1))] = value;
      return out;
    });

/** JSON with one value, anywhere, replaced by something that JSON can hold. */
export const brokenJson = (sound: string): fc.Arbitrary<string> =>
  fc
    .tuple(
      fc.double({ min: 0, max: 1, noNaN: true }),
      fc.oneof(fc.jsonValue({ maxDepth: 1 }), fc.constantFrom(1e300, -1, 0.5, 1e9, "", null, [], {})),
    )
    .map(([at, value]) => {
      let n = 0;
      const count = (v: unknown): void => {
        n++;
        if (typeof v === "object" && v !== null) Object.values(v).forEach(count);
      };
      const tree: unknown = JSON.parse(sound);
      count(tree);
      const target = Math.floor(at * n);
      let seen = 0;
      const put = (v: unknown): unknown => {
        if (seen++ === target) return value;
        if (Array.isArray(v)) return v.map(put);
        if (typeof v === "object" && v !== null)
          return Object.fromEntries(Object.entries(v).map(([k, x]) => [k, put(x)]));
        return v;
      };
      return JSON.stringify(put(tree));
    });

/** The value that `read` gives, or null after an input error: one sentence that begins with the place. */
export function survives<T>(read: () => T, place: string): T | null {
  try {
    return read();
  } catch (error) {
    expect(error).toBeInstanceOf(Error);
    const { name, message } = error as Error;
    // A parser's own error, not the engine's.
    expect(["TypeError", "RangeError", "ReferenceError", "SyntaxError"], `${name}: ${message}`).not.toContain(
      name,
    );
    expect(message.startsWith(place), `"${message}" begins with "${place}"`).toBe(true);
    expect(message, "one line").not.toMatch(/[\r\n]/);
    expect(message.length, message).toBeLessThan(400);
    return null;
  }
}

/** Every number of a value, however deep, is finite. */
export function expectFinite(value: unknown, path = "result"): void {
  if (typeof value === "number") {
    if (!Number.isFinite(value)) throw new Error(`${path} is ${value}`);
  } else if (ArrayBuffer.isView(value) && !(value instanceof DataView)) {
    const list = value as unknown as ArrayLike<number>;
    for (let i = 0; i < list.length; i++)
      if (!Number.isFinite(list[i])) throw new Error(`${path}[${i}] is ${list[i]}`);
  } else if (value instanceof Map) for (const [k, v] of value) expectFinite(v, `${path}.${String(k)}`);
  else if (typeof value === "object" && value !== null)
    for (const [k, v] of Object.entries(value)) expectFinite(v, `${path}.${k}`);
}
