import { expect, type Page, test } from "@playwright/test";
import { createRandom } from "../../src/core/math/random.ts";
import { seriousViolations } from "../support/accessibility.ts";
import { finished, newestAsked, pageErrors } from "../support/editor-page.ts";

/** A view from the front of the log: what happened, in order. */
type Entry = { what: string; id: number };

const log = (page: Page): Promise<Entry[]> => page.evaluate(() => [...(window.stepwright?.log() ?? [])]);
const tasks = (page: Page) =>
  page.evaluate(
    () =>
      window.stepwright?.state().scene.tasks.map((t) => ({ id: t.id, position: t.position, yaw: t.yaw })) ??
      [],
  );
async function open(page: Page): Promise<void> {
  const errors = pageErrors(page);
  await page.goto("/");
  await finished(page, 1);
  await page.getByRole("button", { name: "Pause" }).click();
  expect(errors).toEqual([]);
}

test("opens to a character that moves, with footsteps planned", async ({ page }) => {
  await open(page);
  const state = await page.evaluate(() => {
    const s = window.stepwright?.state();
    return { steps: s?.plan?.steps.length ?? 0, time: s?.time ?? 0, skate: s?.quality?.skate ?? 99 };
  });
  expect(state.steps).toBeGreaterThan(20);
  expect(state.time).toBeGreaterThan(0);
  expect(state.skate).toBeLessThan(4);
  await page.screenshot({ path: "artefacts/editor-light.png" });
});

test("dragging the board with the mouse: footprints first, older requests dropped, feet on the ground stay", async ({
  page,
}) => {
  await open(page);
  await page.evaluate(() => window.stepwright?.seek(2.2));
  const before = await page.evaluate(() => window.stepwright?.feetAt(Math.floor(2.2 * 60)));
  const marker = page.locator('[data-marker="write"]');
  const box = (await marker.boundingBox())!;
  const from = (await tasks(page)).find((t) => t.id === "write")!;
  const asked = Math.max(...(await log(page)).map((e) => e.id));
  await page.mouse.move(box.x + 22, box.y + 22);
  await page.mouse.down();
  for (let k = 1; k <= 8; k++) await page.mouse.move(box.x + 22 - 26 * k, box.y + 22 + 4 * k);
  await page.mouse.up();
  const to = (await tasks(page)).find((t) => t.id === "write")!;
  expect(Math.hypot(to.position[0] - from.position[0], to.position[2] - from.position[2])).toBeGreaterThan(
    1.2,
  );
  const newest = await newestAsked(page);
  expect(newest).toBeGreaterThan(asked);
  await finished(page, newest);
  const entries = (await log(page)).filter((e) => e.id > asked);
  const at = (what: string, id: number) => entries.findIndex((e) => e.what === what && e.id === id);
  // The newest answer is drawn before its motion comes; whatever was overtaken never finishes.
  expect(at("drawn", newest)).toBeGreaterThan(at("planned", newest));
  expect(at("motion", newest)).toBeGreaterThan(at("drawn", newest));
  const dropped = entries.filter((e) => e.what === "dropped" || e.what === "overtaken").map((e) => e.id);
  const ended = entries.filter((e) => e.what === "finished").map((e) => e.id);
  for (const id of dropped) expect(ended).not.toContain(id);
  const after = await page.evaluate(() => window.stepwright?.feetAt(Math.floor(2.2 * 60)));
  expect(after?.contacts).toBe(before?.contacts);
  for (let i = 0; i < 3; i++)
    expect(Math.abs((after?.root[i] ?? 0) - (before?.root[i] ?? 9))).toBeLessThan(0.01);
  // The board came along, and the task is done at its new place.
  const done = await page.evaluate(() => window.stepwright?.state().quality?.reach ?? 99);
  expect(done).toBeLessThan(60);
  await page.screenshot({ path: "artefacts/board-dragged.png" });
});

test("the same with the keyboard; a hundred random edits, undone and done again, give the identical documents (seed 11)", async ({
  page,
}) => {
  await open(page);
  const start = (await tasks(page)).find((t) => t.id === "write")!;
  await page.locator('[data-marker="write"]').focus();
  for (let k = 0; k < 8; k++) await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("r");
  const write = async () => (await tasks(page)).find((t) => t.id === "write")!;
  await expect.poll(async () => (await write()).yaw).toBeCloseTo(Math.PI / 12, 5);
  const moved = await write();
  expect(moved.position[0]).toBeCloseTo(start.position[0] - 2, 5);
  expect(moved.yaw).toBeCloseTo(Math.PI / 12, 5);
  const newest = await newestAsked(page);
  await finished(page, newest);

  // Only the documents matter here.
  await page.evaluate(() => window.stepwright!.draw(false));
  const { below } = createRandom(11);
  const press = async (...keys: string[]) => {
    for (const key of keys) await page.keyboard.press(key);
  };
  const document = () => page.evaluate(() => JSON.stringify(window.stepwright!.state().scene));
  const held = ["", "Alt+", "Shift+"];
  const acts: readonly (() => Promise<void>)[] = [
    () => press(`${held[below(3)]}${["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"][below(4)]}`),
    () => press(below(2) ? "r" : "Shift+R"),
    () => press("Control+d"),
    () => press("Delete"),
    () => press("Control+c", "Control+v"),
    () => press("t", `${1 + below(6)}`, `Shift+${below(2) ? "ArrowUp" : "ArrowLeft"}`, "Enter", "Enter"),
    () => press("s", ["ArrowUp", "ArrowLeft", "ArrowRight"][below(3)], "Enter", "Enter", "Escape"),
    () => press("]", ["q", "i", "m", "ArrowUp", "r"][below(5)]),
  ];
  const documents = [await document()];
  for (let tries = 0; documents.length <= 100 && tries < 400; tries++) {
    // Something is selected by then: what was put down last, or a task.
    const task = page.locator('[data-kind="task"]').first();
    if (below(3) === 0 && (await task.count()) > 0) await task.focus();
    await acts[below(acts.length)]();
    const now = await document();
    if (now !== documents.at(-1)) documents.push(now);
  }
  expect(documents).toHaveLength(101);
  for (const before of documents.slice(0, -1).reverse()) {
    await press("Control+z");
    expect(await document()).toBe(before);
  }
  for (const after of documents.slice(1)) {
    await press("Control+y");
    expect(await document()).toBe(after);
  }
});

test("tasks are added, duplicated and deleted; a reload brings them back", async ({ page }) => {
  await open(page);
  await page.getByRole("button", { name: "Task", exact: true }).click();
  await page.getByRole("button", { name: "Add: Turn around" }).click();
  // A place on the floor that nothing lies over.
  const spot = await page.evaluate(() => {
    for (let y = 320; y < 520; y += 14)
      for (let x = 200; x < 700; x += 14)
        if (document.elementFromPoint(x, y)?.id === "stage") return { x, y };
    return { x: 0, y: 0 };
  });
  await page.mouse.click(spot.x, spot.y);
  const ids = async () => (await tasks(page)).map((t) => t.id);
  await expect.poll(ids).toContain("turn");
  await page.getByRole("button", { name: "Duplicate", exact: true }).click();
  await expect.poll(ids).toContain("turn-2");
  await page.getByRole("button", { name: "Delete", exact: true }).click();
  await expect.poll(ids).not.toContain("turn-2");
  await page.waitForFunction(
    () => window.stepwright?.state().saved === "saved" && window.stepwright.state().scene.tasks.length === 5,
  );
  await page.reload();
  await page.waitForFunction(() => (window.stepwright?.state().scene.tasks.length ?? 0) > 0);
  expect((await tasks(page)).map((t) => t.id)).toEqual(["write", "lift", "place", "sit", "turn"]);
});

test("in the dark: a planner that dies is replaced and nothing is lost", async ({ page }) => {
  await page.emulateMedia({ colorScheme: "dark" });
  await open(page);
  await page.screenshot({ path: "artefacts/editor-dark.png" });
  expect(await page.evaluate(() => document.documentElement.dataset.theme)).toBe("dark");
  const scene = await tasks(page);
  await page.evaluate(() => window.stepwright?.restartPlanner());
  await expect(page.getByText("The planner restarted. Nothing was lost.")).toBeVisible();
  await page.waitForFunction(
    () => window.stepwright!.log().filter((e) => e.what === "finished").length >= 2,
    null,
    { timeout: 60_000 },
  );
  expect(await tasks(page)).toEqual(scene);
});

test("no serious accessibility violation, with any tool at hand", async ({ page }) => {
  await open(page);
  expect(await seriousViolations(page)).toEqual([]);
  for (const tool of ["Task", "Path", "Stones", "Crowd", "Labels"]) {
    await page.getByRole("button", { name: tool, exact: true }).click();
    expect(await seriousViolations(page), tool).toEqual([]);
  }
});
