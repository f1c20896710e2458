/** `npm run bench`: every figure beside its peer, measured in the same run. */
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { type Options, one, readOptions, UsageError } from "../../src/cli/args.ts";
import { figureBars } from "../../src/plots/figure-bars.ts";
import blending from "./blending.bench.ts";
import browser from "./browser.bench.ts";
import { misses } from "./check.ts";
import contacts from "./contacts.bench.ts";
import crowd from "./crowd.bench.ts";
import groundTruth from "./ground-truth.bench.ts";
import ik from "./ik.bench.ts";
import leftOut from "./left-out.bench.ts";
import optimiser from "./optimiser.bench.ts";
import planning from "./planning.bench.ts";
import quality from "./quality.bench.ts";
import studio from "./studio.bench.ts";
import styles from "./styles.bench.ts";
import { table } from "./table.ts";
import type { BenchModule, BenchOptions, Figure } from "./types.ts";

const MODULES: BenchModule[] = [
  optimiser,
  planning,
  ik,
  contacts,
  crowd,
  styles,
  blending,
  groundTruth,
  leftOut,
  quality,
  studio,
  browser,
];

const KNOWN = {
  only: "one",
  json: "flag",
  check: "flag",
  figures: "one",
  instances: "one",
  reference: "one",
  out: "one",
} as const;
const USAGE = `bench [--only ${MODULES.map((m) => m.name).join("|")}] [--json] [--check] [--figures DIR] | bench --only optimiser --instances F --reference F [--out F]`;

/** The figures of one module as `NAME.svg` in a folder. */
function draw(folder: string, name: string, figures: readonly Figure[]): void {
  const bars = figures
    .filter((f) => Number.isFinite(f.median))
    .map((f) => ({
      name: f.name,
      unit: f.unit,
      value: f.median,
      peer: f.peer !== null && f.peerMedian !== null ? { name: f.peer, value: f.peerMedian } : null,
      goal: f.goal,
      ok: f.ok,
    }));
  if (bars.length === 0) return;
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(folder, `${name}.svg`), figureBars(bars, name));
}

/**
 * Runs the benchmarks named, or all. `--figures DIR` draws them there (docs/figures for those that the docs show).
 *
 * @returns exit code 0, 1 when `--check` finds a goal missed by more than noise, or 2 for wrong usage.
 */
export async function main(args: string[]): Promise<number> {
  if (args.includes("--help")) {
    console.error(USAGE);
    return 0;
  }
  let given: Options;
  try {
    given = readOptions(args, KNOWN);
  } catch (error) {
    if (!(error instanceof UsageError)) throw error;
    console.error(`${error.message}\n  ${USAGE}`);
    return 2;
  }
  const value = (name: string): string | null => one(given, name) ?? null;
  const only = value("only");
  const chosen = MODULES.filter((m) => only === null || m.name === only);
  if (chosen.length === 0) {
    console.error(`--only: one of ${MODULES.map((m) => m.name).join(", ")} is needed.`);
    return 2;
  }
  const options: BenchOptions = {
    instances: value("instances"),
    reference: value("reference"),
    out: value("out"),
    progress: (t) => console.error(t),
  };
  const all: Figure[] = [];
  for (const m of chosen) {
    console.error(`bench: ${m.name} ...`);
    const figures = await m.run(options);
    const folder = value("figures");
    if (folder !== null) {
      draw(folder, m.name, figures);
      for (const [name, svg] of Object.entries(m.plots?.(figures) ?? {}))
        writeFileSync(join(folder, `${name}.svg`), svg);
    }
    all.push(...figures);
  }
  if (given.values.has("json")) for (const f of all) console.log(JSON.stringify(f));
  else console.log(table(all));
  if (!given.values.has("check")) return 0;
  const missed = misses(all);
  for (const m of missed) console.error(m);
  return missed.length > 0 ? 1 : 0;
}
