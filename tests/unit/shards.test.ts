/** A library made in pieces by separate processes is the library made at once, byte for byte. */
import { spawn, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { writeBvh } from "../../src/core/capture/bvh-write.ts";
import { renderScore } from "../../src/studio/render.ts";
import { studioSet } from "../../src/studio/set.ts";

const hasParallel = /GNU/.test(String(spawnSync("parallel", ["--version"]).stdout ?? ""));
if (!hasParallel) console.warn("GNU parallel is not installed: its lines of docs/scale.md are not run.");
const CLI = ["src/cli/launch.mjs"];
const folder = mkdtempSync(join(tmpdir(), "stepwright-shards-"));
const clips = join(folder, "clips");
const at = (name: string) => join(folder, name);

/** One process of the command line. @returns its exit code. */
const run = (...args: string[]): Promise<number | null> =>
  new Promise((resolve) => {
    spawn("node", [...CLI, ...args], { stdio: "ignore" }).on("close", resolve);
  });

describe("library in pieces", () => {
  beforeAll(() => {
    mkdirSync(clips);
    // Names that sort another way with their endings than without.
    ["b-2", "b", "a", "c", "b-1"].forEach((name, i) => {
      const { clip, sidecar } = renderScore(studioSet()[i].score);
      writeFileSync(join(clips, `${name}.bvh`), writeBvh(clip));
      writeFileSync(join(clips, `${name}.json`), JSON.stringify(sidecar));
    });
    // Built once, so that the processes side by side find it.
    expect(spawnSync("node", [...CLI, "--help"]).status).toBe(0);
  }, 120_000);
  afterAll(() => rmSync(folder, { recursive: true }));

  it("any number of processes side by side, merged in any order, gives the same bytes", async () => {
    expect(await run("library", "--clips", clips, "--method", "both", "--out", at("whole.bin"))).toBe(0);
    const whole = readFileSync(at("whole.bin"));
    expect(whole.length).toBeGreaterThan(10_000);
    // Seven pieces of five captures: two are empty.
    for (const n of [2, 7]) {
      const pieces = Array.from({ length: n }, (_, i) => at(`piece-${i + 1}-of-${n}.bin`));
      const codes = await Promise.all(
        pieces.map((out, i) =>
          run("library", "--clips", clips, "--method", "both", "--out", out, "--shard", `${i + 1}/${n}`),
        ),
      );
      expect(codes.every((c) => c === 0)).toBe(true);
      const merged = at(`merged-${n}.bin`);
      expect(await run("library", "merge", ...pieces.reverse(), "--out", merged)).toBe(0);
      expect(readFileSync(merged).equals(whole)).toBe(true);
    }
  }, 120_000);

  it.skipIf(!hasParallel)(
    "GNU parallel, as docs/scale.md has it, gives the same bytes",
    () => {
      const doc = readFileSync("docs/scale.md", "utf8");
      const lines = /## GNU parallel\n\n```\n([\s\S]*?)```/.exec(doc)?.[1] ?? "";
      expect(lines).toContain("parallel --halt");
      const pieces = at("pieces");
      mkdirSync(pieces);
      // The page's own lines, with this machine's folders and fewer pieces.
      const script = lines
        .replace(/N=\d+/, "N=3")
        .replaceAll("npm run -s cli --", "node src/cli/launch.mjs")
        .replaceAll("--clips captures", `--clips ${clips} --method both`)
        .replaceAll("pieces/", `${pieces}/`)
        .replace("--joblog pieces.log", `--joblog ${at("pieces.log")}`)
        .replace("--out library.bin", `--out ${at("library.bin")}`);
      const done = spawnSync("sh", ["-ec", script], { encoding: "utf8" });
      expect(done.status, done.stderr).toBe(0);
      expect(readFileSync(at("library.bin")).equals(readFileSync(at("whole.bin")))).toBe(true);
    },
    120_000,
  );

  /** A page's script for one piece, with this machine's folders, run as the engine would run it. @returns its exit code. */
  const piece = (script: string, env: Record<string, string>): Promise<number | null> =>
    new Promise((resolve) => {
      spawn("sh", ["-ec", script], { env: { ...process.env, ...env }, stdio: "ignore" }).on("close", resolve);
    });
  const mergedAs = async (name: string, pieces: string): Promise<Buffer> => {
    const all = [1, 2, 3].map((i) => join(pieces, `${i}.bin`));
    expect(await run("library", "merge", ...all, "--out", at(name))).toBe(0);
    return readFileSync(at(name));
  };
  const section = (title: string, language: string): string =>
    new RegExp(`## ${title}\\n[\\s\\S]*?\\n\`\`\`${language}\\n([\\s\\S]*?)\`\`\``).exec(
      readFileSync("docs/scale.md", "utf8"),
    )?.[1] ?? "";
  const here = (script: string): string =>
    script
      .replaceAll("npm run -s cli --", "node src/cli/launch.mjs")
      .replace(/--clips (\/data\/)?captures/, `--clips ${clips} --method both`);

  it("Slurm's array, as docs/scale.md has it, gives the same bytes", async () => {
    const script = section("Slurm", "");
    expect(script).toContain("#SBATCH --array=1-64");
    const pieces = at("slurm");
    const mine = here(script).replace("pieces/", `${pieces}/`);
    const codes = await Promise.all(
      ["1", "2", "3"].map((id) =>
        piece(mine, {
          SLURM_SUBMIT_DIR: process.cwd(),
          SLURM_ARRAY_TASK_ID: id,
          SLURM_ARRAY_TASK_COUNT: "3",
        }),
      ),
    );
    expect(codes).toEqual([0, 0, 0]);
    expect((await mergedAs("slurm.bin", pieces)).equals(readFileSync(at("whole.bin")))).toBe(true);
  }, 120_000);

  it("Kubernetes' indexed Job, as docs/scale.md has it, gives the same bytes", async () => {
    const manifest = section("Kubernetes", "yaml");
    expect(manifest).toContain("completionMode: Indexed");
    const completions = /completions: (\d+)/.exec(manifest)?.[1] ?? "";
    // Folded lines, as YAML's >- reads them.
    const folded = / >-\n((?: {14}.*\n)+)/.exec(manifest)?.[1].replace(/\s+/g, " ").trim() ?? "";
    expect(folded).toContain(`--shard $I/${completions}`);
    const pieces = at("kubernetes");
    const mine = here(folded).replace("/data/pieces/", `${pieces}/`).replace(`/${completions}`, "/3");
    const codes = await Promise.all(["0", "1", "2"].map((i) => piece(mine, { JOB_COMPLETION_INDEX: i })));
    expect(codes).toEqual([0, 0, 0]);
    expect((await mergedAs("kubernetes.bin", pieces)).equals(readFileSync(at("whole.bin")))).toBe(true);
  }, 120_000);

  it("a piece given twice, a broken one and a wrong number are refused", async () => {
    const whole = at("whole.bin");
    writeFileSync(at("broken.bin"), readFileSync(whole).subarray(0, 5000));
    const twice = spawnSync("node", [...CLI, "library", "merge", whole, whole, "--out", at("x.bin")]);
    expect(twice.status).toBe(1);
    expect(String(twice.stderr)).toContain("merge: a is in the libraries twice.");
    const broken = spawnSync("node", [...CLI, "library", "merge", at("broken.bin"), "--out", at("x.bin")]);
    expect(broken.status).toBe(1);
    expect(String(broken.stderr)).toContain("broken.bin: library:");
    for (const shard of ["0/2", "3/2", "1.5/2", "a/b", "1"])
      expect(await run("library", "--clips", clips, "--out", at("x.bin"), "--shard", shard)).toBe(2);
  }, 60_000);
});
