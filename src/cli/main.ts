/** The command line: one command a file under `commands/`. Results on standard output as JSON, progress on standard error. */
import { UsageError } from "./args.ts";
import { cleanCommand } from "./commands/clean.ts";
import { contactsCommand } from "./commands/contacts.ts";
import { contactsTrainCommand } from "./commands/contacts-train.ts";
import { crowdCommand } from "./commands/crowd.ts";
import { importCommand } from "./commands/import.ts";
import { libraryCommand } from "./commands/library.ts";
import { planCommand } from "./commands/plan.ts";
import { stepsCommand } from "./commands/steps.ts";
import { studioCommand } from "./commands/studio.ts";

export interface Command {
  usage: string;
  run(args: string[]): Promise<unknown> | unknown;
}

const COMMANDS: Record<string, Command> = {
  import: importCommand,
  contacts: contactsCommand,
  "contacts-train": contactsTrainCommand,
  clean: cleanCommand,
  steps: stepsCommand,
  studio: studioCommand,
  library: libraryCommand,
  plan: planCommand,
  crowd: crowdCommand,
};

/** The benchmarks are a program of their own: `launch.mjs` starts it. */
const BENCH = "bench [--only NAME] [--json] [--check] [--figures DIR]";

const usage = (): string =>
  ["stepwright COMMAND ...", ...Object.values(COMMANDS).map((c) => `  ${c.usage}`), `  ${BENCH}`].join("\n");

/** Runs a command line. @returns the exit code: 0 done, 1 bad input, 2 wrong usage. */
export async function main(args: string[]): Promise<number> {
  const [name, ...rest] = args;
  const command = name ? COMMANDS[name] : undefined;
  if (!command) {
    console.error(name && name !== "--help" ? `${name}: no such command is known.\n${usage()}` : usage());
    return name === "--help" ? 0 : 2;
  }
  if (rest.includes("--help")) {
    console.error(command.usage);
    return 0;
  }
  try {
    const result = await command.run(rest);
    if (result !== undefined) console.log(JSON.stringify(result, null, 2));
    return 0;
  } catch (error) {
    if (error instanceof UsageError) {
      console.error(`${error.message}\n  ${command.usage}`);
      return 2;
    }
    console.error(error instanceof Error ? error.message : String(error));
    return 1;
  }
}
