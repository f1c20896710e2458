/** docs/faults.md and tests/guards say the same: every guard stands in the table, every test it names is there. */
import { existsSync, readFileSync } from "node:fs";
import { expect, it } from "vitest";
import { GUARDS } from "../guards/guards.mjs";

const rows = readFileSync("docs/faults.md", "utf8")
  .split("\n")
  .filter((l) => l.startsWith("| ") && !/^\| (fault|---) /.test(l))
  .map((l) => l.split("|").map((c) => c.trim()));
const group = (name: string): string => name.slice(0, name.indexOf(":"));

it("every test that the table names is there", () => {
  expect(rows.length).toBeGreaterThan(15);
  for (const r of rows)
    for (const [, path] of r[2].matchAll(/`([^`]+)`/g)) expect(existsSync(path), path).toBe(true);
});

it("every guard has a row, every row's guards are tried, by tests of that row", () => {
  const named = new Set(rows.flatMap((r) => (/^none/.test(r[3]) ? [] : r[3].split(", "))));
  expect([...new Set(GUARDS.map((g) => group(g.name)))].sort()).toEqual([...named].sort());
  for (const g of GUARDS) {
    const mine = rows.filter((r) => r[3].split(", ").includes(group(g.name)));
    expect(
      mine.some((r) => r[2].includes(g.tests)),
      `${g.name}: ${g.tests}`,
    ).toBe(true);
  }
});

it("every guard's text stands once in its file", () => {
  for (const g of GUARDS) {
    expect(readFileSync(g.file, "utf8").split(g.guard), g.name).toHaveLength(2);
    expect(existsSync(g.tests), g.tests).toBe(true);
  }
});
