/** Every feature of the editor, a line each. */
import { basics } from "./basics.ts";
import { captures } from "./captures.ts";
import { characters } from "./characters.ts";
import { comparison } from "./comparison.ts";
import { crowds } from "./crowds.ts";
import type { Feature } from "./feature.ts";
import { footsteps } from "./footsteps.ts";
import { furniture } from "./furniture.ts";
import { paths } from "./paths.ts";
import { stones } from "./stones.ts";
import { tasks } from "./tasks.ts";

export const ALL_FEATURES: readonly Feature[] = [
  basics,
  furniture,
  tasks,
  footsteps,
  paths,
  captures,
  stones,
  characters,
  crowds,
  comparison,
];
