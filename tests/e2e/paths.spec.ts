import { expect, type Page, test } from "@playwright/test";
import { writeBvh } from "../../src/core/capture/bvh-write.ts";
import { renderScore } from "../../src/studio/render.ts";
import { styleScore } from "../../src/studio/styles.ts";
import { answered, drop, openEditor, pageErrors } from "../support/editor-page.ts";

const path = (page: Page) => page.evaluate(() => window.stepwright?.state().scene.paths[0]);
const seek = (page: Page, share: number) =>
  page.evaluate((u) => {
    const s = window.stepwright;
    s?.seek(u * (s.state().plan?.duration ?? 0));
  }, share);

async function open(page: Page): Promise<(u: number, v: number) => [number, number]> {
  await openEditor(page);
  // An empty room: the path is all there is to do.
  await drop(page, { name: "empty.json", content: '{ "version": 1 }' });
  await page.waitForFunction(() => window.stepwright?.state().scene.tasks.length === 0);
  await answered(page);
  await page.getByRole("button", { name: "Path", exact: true }).click();
  const box = (await page.locator("canvas").first().boundingBox())!;
  return (u, v) => [box.x + u * box.width, box.y + v * box.height];
}

test("a path drawn freehand is followed; three styles painted along it; a change dragged; undo", async ({
  page,
}) => {
  const errors = pageErrors(page);
  const at = await open(page);
  await page.mouse.move(...at(0.25, 0.72));
  await page.mouse.down();
  for (let k = 1; k <= 12; k++) await page.mouse.move(...at(0.25 + 0.03 * k, 0.72 - 0.06 * Math.sin(k / 2)));
  await page.mouse.up();
  await answered(page);
  const drawn = await page.evaluate(() => {
    const s = window.stepwright?.state();
    return {
      points: s?.scene.paths[0]?.points.length ?? 0,
      steps: s?.plan?.steps.length ?? 0,
      skate: s?.quality?.skate ?? 99,
    };
  });
  expect(drawn.points).toBeGreaterThan(2);
  expect(drawn.steps).toBeGreaterThan(3);
  expect(drawn.skate).toBeLessThan(4);

  // The whole of it energetic, then two changes from the playhead on.
  await page.getByRole("button", { name: "Energetic: paint" }).click();
  for (const [share, style] of [
    [0.4, "Tired"],
    [0.75, "Walking"],
  ] as const) {
    await answered(page);
    await seek(page, share);
    await page.getByRole("button", { name: "Change style here" }).click();
    await page.getByRole("button", { name: `${style}: paint` }).click();
  }
  await answered(page);
  const painted = (await path(page))?.styles ?? [];
  expect(painted.map((s) => s.style)).toEqual(["energetic", "tired", "walking"]);

  // The first change is dragged earlier by its edge in the timeline.
  const edge = (await page.getByRole("slider", { name: "Change from energetic to tired" }).boundingBox())!;
  await page.mouse.move(edge.x + edge.width / 2, edge.y + edge.height / 2);
  await page.mouse.down();
  for (const dx of [-10, -25, -45]) await page.mouse.move(edge.x + edge.width / 2 + dx, edge.y + 12);
  await page.mouse.up();
  await answered(page);
  const moved = (await path(page))?.styles ?? [];
  expect(moved[1].at).toBeLessThan(painted[1].at);
  expect(moved[2]).toEqual(painted[2]);
  await page.screenshot({ path: "artefacts/path-styles.png" });

  await page.keyboard.press("Control+z");
  expect((await path(page))?.styles).toEqual(painted);
  for (let k = 0; k < 6; k++) await page.keyboard.press("Control+z");
  await answered(page);
  expect(await page.evaluate(() => window.stepwright?.state().scene.paths.length)).toBe(0);
  expect(errors).toEqual([]);
});

test("a path set point by point is bent and thinned; a sample dropped becomes a style; refinements go off", async ({
  page,
}) => {
  const at = await open(page);
  await page.getByRole("button", { name: "Add: Points" }).click();
  for (const [u, v] of [
    [0.3, 0.8],
    [0.5, 0.7],
    [0.6, 0.85],
  ])
    await page.mouse.click(...at(u, v));
  await page.keyboard.press("Enter");
  await answered(page);
  const points = (await path(page))?.points ?? [];
  expect(points).toHaveLength(3);

  const handle = page.locator('[data-kind="point"][data-index="1"]');
  await handle.focus();
  await page.keyboard.press("ArrowUp");
  await answered(page);
  expect((await path(page))?.points[1]).not.toEqual(points[1]);
  await handle.dblclick();
  await answered(page);
  expect((await path(page))?.points).toHaveLength(2);

  // The studio's own jog, as somebody's file.
  const { clip } = renderScore(styleScore("jogging"));
  await drop(page, { name: "My-Trot.bvh", content: writeBvh(clip) });
  await page.getByRole("button", { name: "My trot: paint" }).click();
  await answered(page);
  expect((await path(page))?.styles.map((s) => s.style)).toEqual(["my trot"]);
  const before = await page.evaluate(() => window.stepwright?.state().quality?.skate ?? 0);
  await page.getByRole("switch", { name: "Plant the feet" }).click();
  await answered(page);
  const after = await page.evaluate(() => window.stepwright?.state().quality?.skate ?? 0);
  expect(after).toBeGreaterThan(before + 5);
});
