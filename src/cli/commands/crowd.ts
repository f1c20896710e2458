/** `crowd`: SteerSuite cases or scenes with a crowd into trajectories and footsteps. */
import { crowdOfScene } from "../../core/crowd/from-scene.ts";
import { simulateCrowd } from "../../core/crowd/simulate.ts";
import { readSteerCase } from "../../core/crowd/steer-case.ts";
import { trajectoryOf } from "../../core/crowd/trajectory.ts";
import { readScene } from "../../core/scene/schema.ts";
import { needed, one, outputs, readOptions, UsageError } from "../args.ts";
import { readText } from "../read.ts";
import { writeOutput } from "../write.ts";

export const crowdCommand = {
  usage: "crowd --case F.xml|F.json ... --out F.json | DIR/ [--seconds N]",
  run(args: string[]) {
    const o = readOptions(args, { case: "many", out: "one", seconds: "one" });
    needed(o, "case");
    const files = o.values.get("case") ?? [];
    const to = outputs(files, needed(o, "out"), "json");
    const seconds = Number(one(o, "seconds") ?? 600);
    if (!(seconds > 0 && seconds <= 3600)) throw new UsageError("--seconds: a number up to 3600 is needed.");
    return files.map((file, i) => {
      const text = readText(file);
      const world = file.toLowerCase().endsWith(".json")
        ? crowdOfScene(readScene(text, file), file)
        : readSteerCase(text, file);
      const ms: number[] = [];
      const begun = performance.now();
      let last = begun;
      let setup = 0;
      const track = simulateCrowd(world, seconds, {
        tick(tick, left) {
          const now = performance.now();
          // Before the first tick the ground and the long ways are made.
          if (tick === 0) setup = now - begun;
          ms.push(tick === 0 ? 0 : Math.round((now - last) * 1000) / 1000);
          last = now;
          if (tick % 400 === 399) console.error(`${file}: ${(tick + 1) / 20} s, ${left} on their way`);
          return true;
        },
      });
      writeOutput(to[i], JSON.stringify(trajectoryOf(track, ms)));
      return {
        case: file,
        agents: world.agents.length,
        arrived: track.arrived,
        seconds: (track.positions.length - 1) * track.dt,
        setupMs: setup,
        ...track.statistics,
        msPerPlan: ms.reduce((a, b) => a + b, 0) / Math.max(1, track.statistics.plans),
        worstTickMs: Math.max(0, ...ms),
        repairs: world.repairs,
      };
    });
  },
};
