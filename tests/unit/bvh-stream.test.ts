import { spawnSync } from "node:child_process";
import { appendFileSync, mkdtempSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { createBvhReader, parseBvh, readBvhStream } from "../../src/core/capture/bvh-parse.ts";
import { writeBvh } from "../../src/core/capture/bvh-write.ts";
import { renderScore } from "../../src/studio/render.ts";
import { studioSet } from "../../src/studio/set.ts";

const text = writeBvh(renderScore(studioSet()[0].score).clip);

describe("BVH in pieces", () => {
  it("cut anywhere, it is read as in one piece (seed 3)", () => {
    const start = text.slice(0, text.indexOf("MOTION"));
    const small = `${start}MOTION\r\nFrames: 2\r\nFrame Time: 0.01\r\n${text
      .trimEnd()
      .split("\n")
      .slice(-2)
      .join("\r\n")}`;
    const whole = parseBvh(small, "a.bvh");
    fc.assert(
      fc.property(fc.array(fc.nat(small.length), { maxLength: 30 }), (cuts) => {
        const reader = createBvhReader("a.bvh", small.length);
        let at = 0;
        for (const c of [...cuts.sort((a, b) => a - b), small.length]) {
          reader.push(small.slice(at, c));
          at = c;
        }
        expect(reader.end()).toEqual(whole);
      }),
      { seed: 3, numRuns: 50 },
    );
  });

  it("from a browser's file, names with letters of several bytes, mistakes on their line", async () => {
    const named = text.replaceAll("leftHand", "linke Händ");
    const bytes = new TextEncoder().encode(named);
    // Pieces of 7 bytes cut letters in two.
    const pieces = (b: Uint8Array) =>
      new ReadableStream<Uint8Array>({
        start(c) {
          for (let i = 0; i < b.length; i += 7) c.enqueue(b.subarray(i, i + 7));
          c.close();
        },
      });
    const read = await readBvhStream(pieces(bytes.subarray(0, 200_000)), 200_000, "cut.bvh").catch(
      (e: Error) => e.message,
    );
    expect(read).toMatch(/^cut\.bvh, line \d+: /);
    expect(await readBvhStream(new Blob([named]).stream(), bytes.length, "a.bvh")).toEqual(
      parseBvh(named, "a.bvh"),
    );
  });

  it("a line without end is refused before it fills the memory", () => {
    const reader = createBvhReader("a.bvh", 1e9);
    expect(() => {
      for (let k = 0; k < 100; k++) reader.push("x".repeat(100_000));
    }).toThrow("a.bvh, line 1: a line longer than");
  });

  it("100 MB are read in the room of their numbers: beyond these they take no more than 10 MB do", () => {
    const folder = mkdtempSync(join(tmpdir(), "stepwright-bvh-"));
    try {
      const rows = text.slice(text.indexOf("Frame Time")).split("\n").slice(1, 1001);
      const block = `${rows.join("\n")}\n`;
      const head = text.slice(0, text.indexOf("MOTION"));
      const write = (bytes: number) => {
        const blocks = Math.ceil(bytes / block.length);
        const path = join(folder, `${bytes}.bvh`);
        writeFileSync(path, `${head}MOTION\nFrames: ${1000 * blocks}\nFrame Time: 0.01666667\n`);
        for (let k = 0; k < blocks; k++) appendFileSync(path, block);
        return { path, frames: 1000 * blocks, size: statSync(path).size };
      };
      const program = `
        import { readBvhFile } from ${JSON.stringify(join(process.cwd(), "src/cli/read.ts"))};
        const file = readBvhFile(process.argv[2]);
        console.log(JSON.stringify({
          frames: file.frames, last: file.values[file.values.length - 1],
          numbers: file.values.byteLength, peak: process.resourceUsage().maxRSS * 1024,
        }));`;
      const script = join(folder, "read.ts");
      writeFileSync(script, program);
      const built = join(folder, "read.mjs");
      expect(
        spawnSync("npx", ["rolldown", script, "--platform", "node", "-f", "esm", "-o", built]).status,
      ).toBe(0);
      // A process of its own, whose heap for strings is smaller than the text: what is over is measured, not the collector's mood.
      const read = (bytes: number) => {
        const { path, frames, size } = write(bytes);
        const run = spawnSync("node", ["--max-old-space-size=32", "--max-semi-space-size=4", built, path], {
          encoding: "utf8",
        });
        expect(run.stderr).toBe("");
        expect(run.status).toBe(0);
        const got = JSON.parse(run.stdout) as Record<string, number>;
        expect(got.frames).toBe(frames);
        expect(got.last).toBe(Number(rows[999].trim().split(" ").pop()));
        return { size, over: got.peak - got.numbers };
      };
      const [small, large] = [read(10e6), read(100e6)];
      const told = `${(large.size / 1e6).toFixed(0)} MB take ${(large.over / 1e6).toFixed(0)} MB beside their numbers, ${(small.size / 1e6).toFixed(0)} MB take ${(small.over / 1e6).toFixed(0)}`;
      console.log(told);
      // The heap's whole allowance is the noise; the text kept would be 90 MB more.
      expect(large.over - small.over, told).toBeLessThan(45e6);
    } finally {
      rmSync(folder, { recursive: true });
    }
  }, 120_000);
});
