import { existsSync, readdirSync, readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import { lessonPage } from "../../src/cli/lesson-plugin.ts";
import { formula } from "../../src/cli/math-markup.ts";
import { FIGURES } from "../../src/lessons/figures/all.ts";
import { STRATEGIES, StepFitter } from "../../src/lessons/figures/fit-problem.ts";
import { Parameters } from "../../src/lessons/kit/parameters.ts";
import { LESSONS } from "../../src/lessons/list.ts";

describe("formulas", () => {
  test("scripts, fractions, primes and live numbers", () => {
    expect(formula("x_i^2", false)).toBe(
      "<math><mrow><msubsup><mi>x</mi><mi>i</mi><mn>2</mn></msubsup></mrow></math>",
    );
    expect(formula("\\frac{a}{b}", true)).toBe(
      '<math display="block"><mrow><mfrac><mrow><mi>a</mi></mrow><mrow><mi>b</mi></mrow></mfrac></mrow></math>',
    );
    expect(formula("x_c'", false)).toContain("<msubsup><mi>x</mi><mi>c</mi><mo>′</mo></msubsup>");
    expect(formula("\\val{k}", false)).toContain('<mn data-value="k">–</mn>');
    expect(formula("a - b < c", false)).toContain("<mo>−</mo>");
  });
  test("sums carry their limits below in displays and beside in text", () => {
    expect(formula("\\sum_i x", true)).toContain("<munder><mo>∑</mo><mi>i</mi></munder>");
    expect(formula("\\sum_i x", false)).toContain("<msub><mo>∑</mo><mi>i</mi></msub>");
  });
  test("a mistake names the formula and the place", () => {
    expect(() => formula("a + \\fraq{b}", false)).toThrow(
      'formula "a + \\fraq{b}", character 10: \\fraq is not known.',
    );
    expect(() => formula("\\frac{a}{b", false)).toThrow("a brace is not closed");
  });
});

describe("parameters", () => {
  const spec = { name: "k", value: 10, min: 1, max: 40, step: 1 };
  test("an address presets and locks; reset goes back to the preset; the state is an address again", () => {
    const p = new Parameters(new URLSearchParams("k=5&m=900&lock=m"));
    p.declare(spec);
    p.declare({ ...spec, name: "m" });
    expect([p.get("k"), p.get("m")]).toEqual([5, 40]);
    let heard = 0;
    p.watch(["k", "m"], () => heard++);
    expect(p.set("m", 3)).toBe(false);
    expect(p.set("k", 12)).toBe(true);
    expect(heard).toBe(1);
    expect(p.queryText()).toBe("k=12&m=40&lock=m");
    p.reset();
    expect(p.get("k")).toBe(5);
  });
  test("what is no number is ignored, and all can be locked", () => {
    const p = new Parameters(new URLSearchParams("k=soon&lock=all"));
    p.declare(spec);
    expect(p.get("k")).toBe(10);
    expect(p.set("k", 3)).toBe(false);
  });
});

test("the small problem: the objective falls, and with the goal's weight alone the last three footsteps meet their goals", () => {
  const fitter = new StepFitter();
  for (const strategy of STRATEGIES) {
    const goal = { x: -0.75, z: 2.95, yaw: 0.3 };
    const fit = fitter.solve({
      strategy,
      goal,
      weights: [0.4, 0.1, 0.1, 0.3, 0.1],
      phase: "enterPreparation",
    });
    expect(fit.terms[fit.terms.length - 1][0]).toBeLessThan(fit.terms[0][0]);
    const alone = fitter.solve({ strategy, goal, weights: [0, 0, 0, 1, 0], phase: "enter" });
    const last = alone.after[alone.after.length - 1];
    expect(Math.hypot(last.x - alone.target.x, last.z - alone.target.z)).toBeLessThan(1e-3);
    expect(alone.after[0]).toEqual(alone.before[0]);
  }
});

describe("pages", () => {
  const pages = readdirSync("lessons").filter((f) => f.endsWith(".html"));
  test("there is one for every lesson that is listed", () => {
    for (const l of LESSONS) expect(pages).toContain(`${l.name}.html`);
  });
  test.each(pages)("%s: formulas, links, figures and headings hold", (file) => {
    const source = readFileSync(`lessons/${file}`, "utf8");
    const html = lessonPage(source, file.replace(/\.html$/, ""));
    expect(html).not.toMatch(/\\[([]/);
    expect(html.match(/<h1/g)?.length).toBe(1);
    for (const [, name] of source.matchAll(/data-figure="([^"]+)"/g))
      expect(Object.keys(FIGURES)).toContain(name);
    for (const [, target] of source.matchAll(/href="\.\/([^"#]+)"/g)) expect(pages).toContain(target);
    // Links to the code lead to files that exist.
    for (const [, path] of source.matchAll(/href="\.\.\/code\/([^"]+)\.html"/g))
      expect(existsSync(path), path).toBe(true);
    const ids = [...html.matchAll(/ id="([^"]+)"/g)].map((m) => m[1]);
    expect(new Set(ids).size).toBe(ids.length);
  });
});
