/** Scenes that nobody has seen before: narrow doors, dead ends, one goal for all, gaps, groups head on, contact at the start. */
import { describe, expect, it } from "vitest";
import { simulateCrowd } from "../../src/core/crowd/simulate.ts";
import { countContacts } from "../support/crowd-contacts.ts";
import { drawOddity, ODDITIES, PARTED } from "../support/crowd-oddities.ts";

describe("odd scenes", () => {
  it.each(ODDITIES)(
    "%s: all arrive, no faster than wanted, and no body touches another or a wall",
    (kind) => {
      const w = drawOddity(kind, 1);
      const track = simulateCrowd(w, 180);
      expect(track.arrived).toBe(w.agents.length);
      const c = countContacts(track, w, 0.01, PARTED[kind]);
      expect([c.bodies, c.obstacles]).toEqual([0, 0]);
      expect(c.quickest).toBeLessThanOrEqual(1.05);
    },
  );
});
