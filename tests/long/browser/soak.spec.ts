/**
 * Random editing for half an hour in a real browser: no error, memory flat within a tenth, nothing left behind on the graphics card, no
 * worker without an owner.
 *
 * STEPWRIGHT_SOAK_MINUTES (30) and STEPWRIGHT_SOAK_SEED (1) say how long and which. Memory is read at rest: the same scene opened, its
 * motion whole, garbage collected in page and workers. Before the first reading the history, which keeps five hundred scenes at
 * most, is filled, and a hundred and fifty edits are made without drawing: what grows until then is the browser's own compiled code.
 */
import { writeFileSync } from "node:fs";
import { expect, test } from "@playwright/test";
import { createRandom } from "../../../src/core/math/random.ts";
import { answered, drop } from "../../support/editor-page.ts";
import { watchHeaps } from "../../support/heaps.ts";

const MINUTES = Number(process.env.STEPWRIGHT_SOAK_MINUTES ?? 30);
const SEED = Number(process.env.STEPWRIGHT_SOAK_SEED ?? 1);
/** Scenes that the history keeps. */
const HISTORY = 500;
/** Edits at random before the first reading. */
const WARM = 150;
/** How far memory may rise above its first reading: the page's alone, and all together. */
const FLAT = 1.1;

interface Reading {
  minutes: number;
  edits: number;
  /** Bytes in use after collection: the page's own heap, and all workers'. */
  page: number;
  workers: number;
  /** Nodes of the document. */
  nodes: number;
  geometries: number;
  textures: number;
  programs: number;
  /** Kinds of workers that run. */
  running: string[];
}

test(`${MINUTES} minutes of random editing leave nothing behind (seed ${SEED})`, async ({ page }) => {
  const errors: string[] = [];
  page.on("pageerror", (e) => errors.push(e.stack ?? e.message));
  page.on("console", (m) => {
    if (m.type() === "error") errors.push(m.text());
  });
  page.on("dialog", (d) => void d.dismiss());
  const heaps = await watchHeaps(page);
  await page.goto("/");
  await answered(page);
  const { next: random, below: whole } = createRandom(SEED);
  // The scene of the readings, as it is read from a file.
  await drop(page, {
    name: "rest.json",
    content: await page.evaluate(() => JSON.stringify(window.stepwright!.state().scene)),
  });
  await page.waitForFunction(() => window.stepwright!.state().name === "rest");
  const rest = await page.evaluate(() => JSON.stringify(window.stepwright!.state().scene));

  const press = async (...keys: string[]): Promise<void> => {
    for (const key of keys) await page.keyboard.press(key);
  };
  const times = async (n: number, key: string): Promise<void> => {
    for (let k = 0; k < n; k++) await page.keyboard.press(key);
  };
  /** A place of the floor that nothing lies over, or null after some tries. */
  const floor = async (): Promise<{ x: number; y: number } | null> => {
    const tries = Array.from({ length: 20 }, () => [0.08 + 0.6 * random(), 0.35 + 0.5 * random()]);
    return page.evaluate((list) => {
      const box = document.querySelector("#stage")!.getBoundingClientRect();
      for (const [u, v] of list) {
        const [x, y] = [box.left + u * box.width, box.top + v * box.height];
        if (document.elementFromPoint(x, y)?.id === "stage") return { x, y };
      }
      return null;
    }, tries);
  };
  const marker = async () => {
    const all = page.locator('.marker[style*="visibility: visible"], .marker[style*="visibility:visible"]');
    const n = await all.count();
    return n === 0 ? null : all.nth(whole(n));
  };
  const drag = async (from: { x: number; y: number }, to: { x: number; y: number }): Promise<void> => {
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    for (let k = 1; k <= 6; k++)
      await page.mouse.move(from.x + ((to.x - from.x) * k) / 6, from.y + ((to.y - from.y) * k) / 6);
    if (random() < 0.15) await press("Escape");
    await page.mouse.up();
  };
  const pressButton = async (name: string | RegExp): Promise<void> => {
    const button = page.getByRole("button", { name }).first();
    if ((await button.isVisible()) && (await button.isEnabled())) await button.click({ timeout: 60_000 });
  };

  /** What a user may do, by name; each leaves the page ready for the next. */
  const acts: Record<string, () => Promise<void>> = {
    nudge: async () => {
      const m = await marker();
      if (!m) return;
      await m.focus();
      await times(1 + whole(4), ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "r"][whole(5)]);
    },
    drag: async () => {
      const box = await (await marker())?.boundingBox();
      const to = await floor();
      if (box && to) await drag({ x: box.x + box.width / 2, y: box.y + box.height / 2 }, to);
    },
    addTask: async () => {
      await press("v", `${1 + whole(6)}`);
      const at = await floor();
      if (at) await page.mouse.click(at.x, at.y);
    },
    path: async () => {
      await press("p");
      const [a, b] = [await floor(), await floor()];
      if (a && b) await drag(a, b);
    },
    stone: async () => {
      await press("s");
      const at = await floor();
      if (at) await page.mouse.click(at.x, at.y);
    },
    footstep: async () => {
      await press("v");
      await times(1 + whole(6), "]");
      await press(["ArrowLeft", "ArrowUp", "q", "i", "m", "r"][whole(6)]);
    },
    remove: () => press("Delete"),
    duplicate: () => press("Control+d"),
    copy: () => press("Control+c", "Control+v"),
    undo: () => times(1 + whole(6), "Control+z"),
    redo: () => times(1 + whole(4), "Control+y"),
    play: () => press("Space"),
    time: () => times(1 + whole(5), [",", ".", "n", "b"][whole(4)]),
    theme: () => pressButton(/^(Dark|Light) theme$/),
    example: async () => {
      await page.locator(".scene-name").click();
      const all = page.locator(".examples button");
      await all.nth(whole(await all.count())).click();
    },
    menus: async () => {
      await pressButton("Export");
      await press("Escape", "?", "Escape");
    },
    tabs: async () => {
      const all = page.getByRole("tab");
      const n = await all.count();
      if (n > 0) await all.nth(whole(n)).click({ timeout: 60_000 });
    },
    build: async () => {
      await page.evaluate(
        (v) => {
          const input = document.querySelector<HTMLInputElement>('.panel input[type="range"]');
          if (!input) return;
          input.value = String(v);
          input.dispatchEvent(new Event("input", { bubbles: true }));
          input.dispatchEvent(new Event("change", { bubbles: true }));
        },
        1.5 + 0.5 * random(),
      );
    },
    window: () => page.setViewportSize({ width: [700, 1100, 1300][whole(3)], height: [640, 720][whole(2)] }),
    planner: async () => {
      await page.evaluate(() => window.stepwright!.restartPlanner());
    },
    broken: () => drop(page, { name: "broken.json", content: '{ "version": 1, "tasks": [ {' }),
    desk: () => press("l", "v"),
    crowd: () => press("c", "v"),
  };
  const names = Object.keys(acts);
  let edits = 0;
  const done: string[] = [];
  const act = async (name: string): Promise<void> => {
    done.push(name);
    if (done.length > 40) done.shift();
    await acts[name]();
    edits++;
    // Focus is given back, as by a click on nothing: keys are the page's again.
    await page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
    await press("Escape");
  };

  let begun = Date.now();
  const readings: Reading[] = [];
  const read = async (): Promise<void> => {
    await page.setViewportSize({ width: 1100, height: 720 });
    await press("Escape", "Escape", "v");
    await page.evaluate(
      () =>
        document.documentElement.dataset.theme === "dark" &&
        document.querySelector<HTMLElement>('[aria-label="Light theme"]')?.click(),
    );
    await drop(page, { name: "rest.json", content: rest });
    await page.waitForFunction((text) => JSON.stringify(window.stepwright!.state().scene) === text, rest, {
      timeout: 60_000,
    });
    await answered(page);
    if (await page.evaluate(() => window.stepwright!.state().playing)) await press("Space");
    await page.evaluate(() => window.stepwright!.seek(3));
    await page.waitForTimeout(6500);
    const workers = page.workers();
    const graphics = await page.evaluate(() => window.stepwright!.graphics());
    readings.push({
      minutes: Number(((Date.now() - begun) / 60_000).toFixed(2)),
      edits,
      ...(await heaps.read()),
      nodes: await page.evaluate(() => document.querySelectorAll("*").length),
      ...graphics,
      running: workers.map((w) => w.url().replace(/^.*\/|-[\w-]{8}\.js$/g, "")).sort(),
    });
    console.log(JSON.stringify(readings.at(-1)));
    writeFileSync("artefacts/soak.json", JSON.stringify({ seed: SEED, minutes: MINUTES, readings }, null, 1));
  };

  // Everything once, every example too, and the history full: what is made when it is first needed stays.
  for (const name of names) await act(name);
  await page.locator(".scene-name").click();
  await page.locator(".examples button").first().waitFor();
  const examples = await page.locator(".examples button").count();
  await press("Escape");
  for (let k = 0; k < examples; k++) {
    await page.locator(".scene-name").click();
    await page.locator(".examples button").nth(k).click();
    await page.waitForTimeout(1500);
  }
  await drop(page, { name: "rest.json", content: rest });
  await page.locator('[data-marker="write"]').focus();
  for (let k = 0; k < HISTORY + 10; k++) await press(k % 2 ? "ArrowLeft" : "ArrowRight");
  await page.evaluate(() => window.stepwright!.draw(false));
  for (let k = 0; k < WARM; k++) await act(names[whole(names.length)]);
  await page.evaluate(() => window.stepwright!.draw(true));
  begun = Date.now();
  await read();
  const every = Math.max(30_000, (MINUTES * 60_000) / 10);
  while (Date.now() - begun < MINUTES * 60_000) {
    const until = Date.now() + every;
    while (Date.now() < until && errors.length === 0) await act(names[whole(names.length)]);
    expect(errors, `after ${done.join(", ")}`).toEqual([]);
    await read();
  }

  const [first, ...later] = readings;
  expect(first.workers).toBeGreaterThan(0);
  expect(later.length).toBeGreaterThan(0);
  for (const r of later) {
    expect
      .soft(r.page + r.workers, `memory after ${r.minutes} minutes`)
      .toBeLessThan(FLAT * (first.page + first.workers));
    expect.soft(r.page, `the page's own memory after ${r.minutes} minutes`).toBeLessThan(FLAT * first.page);
    for (const what of ["geometries", "textures", "programs", "nodes"] as const)
      expect
        .soft(r[what], `${what} after ${r.minutes} minutes`)
        .toBeLessThanOrEqual(Math.ceil(FLAT * first[what]));
    // One of a kind: whoever replaces a worker ends the one before.
    expect
      .soft(new Set(r.running).size, `workers after ${r.minutes} minutes: ${r.running}`)
      .toBe(r.running.length);
  }
  expect(errors).toEqual([]);
});
