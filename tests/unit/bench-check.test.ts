import { describe, expect, it } from "vitest";
import { figureBars } from "../../src/plots/figure-bars.ts";
import { misses } from "../bench/check.ts";
import { figure } from "../bench/measure.ts";
import { table } from "../bench/table.ts";
import type { Figure } from "../bench/types.ts";

const ratio = (value: number): Figure => ({
  ...figure("r", "ms", [value], "ratio <= 0.7", () => value <= 0.7),
  peer: "p",
  peerMedian: 1,
  ratio: value,
});

describe("bench --check", () => {
  it("lets noise pass and nothing more", () => {
    expect(misses([ratio(0.7), ratio(0.76)])).toEqual([]);
    expect(misses([ratio(0.78)])).toEqual(["r: 0.780, goal ratio <= 0.7."]);
    const share = (v: number) => figure("f", "%", [v], ">= 100 %", (m) => m >= 100);
    expect(misses([share(91)])).toEqual([]);
    expect(misses([share(89)])).toHaveLength(1);
    expect(misses([figure("free", "m", [1], null, () => true)])).toEqual([]);
  });

  it("a slow machine is not held against the code: absolute times and rates are passed over", () => {
    expect(misses([figure("t", "ms", [900], "<= 50 ms", (m) => m <= 50)])).toEqual([]);
    expect(misses([figure("t", "s", [90], "<= 60 s", (m) => m <= 60)])).toEqual([]);
    expect(misses([figure("r", "frames/s", [900], ">= 10000", (m) => m >= 10000)])).toEqual([]);
  });

  it("goals with two ends and with thousands are read, with noise at both ends", () => {
    const within = (v: number) => figure("j", "", [v], "0.7 to 1.4", (m) => m >= 0.7 && m <= 1.4);
    expect(misses([within(0.65), within(1.5)])).toEqual([]);
    expect(misses([within(0.6), within(1.6)])).toEqual([
      "j: 0.600, goal 0.7 to 1.4.",
      "j: 1.60, goal 0.7 to 1.4.",
    ]);
    const many = (v: number) => figure("n", "labels", [v], ">= 30,000", (m) => m >= 30_000);
    expect(misses([many(28_000)])).toEqual([]);
    expect(misses([many(20_000)])).toHaveLength(1);
  });

  it("prints one table: columns aligned, a line a figure, what is not there left out", () => {
    const lines = table([
      ratio(0.5),
      figure("a longer name of a figure", "mm", [1234.5], null, () => true),
      figure("e", "ms", [], "<= 2 ms", (m) => m <= 2),
    ]).split("\n");
    expect(lines).toEqual([
      "figure                         measured  peer, same run  ratio  goal",
      "r                              0.500 ms  p 1.00 ms       0.500  ratio <= 0.7  met",
      "a longer name of a figure       1235 mm",
      "e                          not measured                         <= 2 ms       not met",
    ]);
  });

  it("what was never measured is missed", () => {
    expect(misses([{ ...ratio(0.9), ratio: null }])).toEqual(["r: not measured, goal ratio <= 0.7."]);
    expect(misses([figure("empty", "ms", [], "<= 2 ms", (m) => m <= 2)])).toHaveLength(1);
  });

  it("draws a bar for each figure and its peer, with names as text", () => {
    const svg = figureBars(
      [{ name: "<b>", unit: "ms", value: 2, peer: { name: "p", value: 4 }, goal: null, ok: null }],
      "t",
    );
    expect(svg).toContain('width="210.0"');
    expect(svg).toContain('width="420.0"');
    expect(svg).toContain("&#60;b&#62;");
    expect(svg).not.toContain("<b>");
  });
});
