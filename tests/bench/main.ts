/** `npm run bench`: every figure beside its peer, measured in the same run. */
import browser from "./browser.bench.ts";
import contacts from "./contacts.bench.ts";
import crowd from "./crowd.bench.ts";
import ik from "./ik.bench.ts";
import optimiser from "./optimiser.bench.ts";
import planning from "./planning.bench.ts";
import type { BenchModule, BenchOptions, Figure } from "./types.ts";

const MODULES: BenchModule[] = [optimiser, planning, ik, contacts, crowd, browser];

const text = (v: number | null, unit: string): string =>
  v === null ? "" : `${v >= 100 ? v.toFixed(0) : v.toPrecision(3)} ${unit}`;

/** Runs the benchmarks named, or all. @returns exit code 0, or 2 for wrong usage. */
export async function main(args: string[]): Promise<number> {
  const value = (name: string): string | null => {
    const i = args.indexOf(`--${name}`);
    return i >= 0 ? (args[i + 1] ?? null) : null;
  };
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
    all.push(...(await m.run(options)));
  }
  if (args.includes("--json")) for (const f of all) console.log(JSON.stringify(f));
  else {
    for (const f of all) {
      const peer = f.peer
        ? `  ${f.peer} ${text(f.peerMedian, f.unit)}${f.ratio === null ? "" : `, ratio ${f.ratio.toFixed(3)}`}`
        : "";
      const goal = f.goal ? `  goal ${f.goal}: ${f.ok ? "met" : "not met"}` : "";
      console.log(`${f.name.padEnd(44)} ${text(f.median, f.unit).padStart(14)}${peer}${goal}`);
    }
  }
  return 0;
}
