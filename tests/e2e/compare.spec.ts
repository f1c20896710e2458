/** What stands beside a plan: the studio's left-out sequence, a capture that is dropped, a result document. */
import { readFileSync } from "node:fs";
import { expect, type Page, test } from "@playwright/test";
import { writeBvh } from "../../src/core/capture/bvh-write.ts";
import { renderScore } from "../../src/studio/render.ts";
import { studioSet } from "../../src/studio/set.ts";
import { drop, pageErrors } from "../support/editor-page.ts";

test.use({ contextOptions: { reducedMotion: "reduce" } });

const planOf = (page: Page) => page.evaluate(() => window.stepwright?.state().plan);

/** Metres that the panel tells as the median to the nearest planned footstep. */
async function toldDistance(page: Page): Promise<number> {
  const told = page.locator(".row", { hasText: "To the nearest planned" });
  await expect(told).toContainText("cm", { timeout: 30_000 });
  return Number(/(\d+) cm/.exec((await told.textContent()) ?? "")?.[1]) / 100;
}

test("the left-out sequence stands beside its plan, and leaves with another scene", async ({ page }) => {
  const errors = pageErrors(page);
  await page.goto("/");
  await page.locator(".scene-name").click();
  await page.getByText("A left-out performance beside its plan").click();
  await page.waitForFunction(() => window.stepwright?.state().plan?.tasks.length === 5, null, {
    timeout: 60_000,
  });
  expect((await planOf(page))?.tasks.map((t) => t.id)).toEqual([1, 2, 3, 4, 5].map((i) => `performed-${i}`));
  expect(await toldDistance(page)).toBeLessThan(0.5);
  await page.evaluate(() => window.stepwright?.seek(6));
  await page.screenshot({ path: "artefacts/compare-left-out.png" });
  await page.getByRole("button", { name: "Show the plan alone" }).click();
  await expect(page.getByText("Performed and planned")).toHaveCount(0);
  expect(errors).toEqual([]);
});

test("a capture that is dropped stands beside the plan of its tasks", async ({ page }) => {
  const errors = pageErrors(page);
  const turning = studioSet().find((p) => p.name === "walk-and-turn") ?? studioSet()[0];
  const { clip } = renderScore(turning.score);
  await page.goto("/");
  await page.getByRole("button", { name: "Labels", exact: true }).waitFor();
  await drop(page, { name: "turning.bvh", content: writeBvh(clip) });
  await expect(page.getByRole("button", { name: "Confirm and next" })).toBeVisible({ timeout: 60_000 });
  await page.getByRole("tab", { name: "Clip" }).click();
  await page.getByRole("button", { name: "Compare with the plan" }).click();
  await expect(page.getByText(/turning: mark what is done in it first/).first()).toBeVisible();
  // The turn is over where the capture ends.
  await page.locator("canvas").first().focus();
  await page.keyboard.press("End");
  await page.getByRole("button", { name: "Turn", exact: true }).click();
  await expect(page.getByText(/^Turn, \d/)).toBeVisible();
  await page.getByRole("button", { name: "Compare with the plan" }).click();
  await page.waitForFunction(() => window.stepwright?.state().plan?.tasks[0]?.id === "performed-1", null, {
    timeout: 60_000,
  });
  expect(await toldDistance(page)).toBeLessThan(0.6);
  await page.screenshot({ path: "artefacts/compare-capture.png" });
  expect(errors).toEqual([]);
});

test("a result that is dropped opens its scene, with its footsteps beside the plan made now", async ({
  page,
}) => {
  const errors: string[] = [];
  page.on("pageerror", (e) => errors.push(e.message));
  await page.goto("/");
  await page.waitForFunction(() => window.stepwright?.log().some((e) => e.what === "finished"), null, {
    timeout: 120_000,
  });
  // The editor's own export.
  await page.getByRole("button", { name: "Export" }).click();
  const download = page.waitForEvent("download");
  await page.getByText("Footsteps, contacts, figures (JSON)").click();
  const result = JSON.parse(readFileSync(await (await download).path(), "utf8")) as {
    scene: { tasks: { position: number[] }[] };
    footsteps: { position: number[] }[];
  };
  const drop = async (name: string, value: unknown): Promise<void> => {
    const data = await page.evaluateHandle(
      ([n, t]) => {
        const d = new DataTransfer();
        d.items.add(new File([t], n));
        return d;
      },
      [name, JSON.stringify(value)] as const,
    );
    await page.dispatchEvent("body", "drop", { dataTransfer: data });
  };
  await drop("broken.json", { ...result, footsteps: [{}, ...result.footsteps.slice(1)] });
  await expect(
    page.getByText("broken.json: footsteps[0].foot: this field is needed, found nothing.").first(),
  ).toBeVisible();
  // As if it had been planned otherwise: every footstep half a metre on.
  for (const f of result.footsteps.slice(2)) f.position[0] += 0.5;
  await drop("before.json", result);
  await expect(page.getByText("The file's plan and this one")).toBeVisible();
  await expect(page.locator(".scene-name")).toContainText("before");
  await expect.poll(async () => (await planOf(page))?.tasks.length).toBe(4);
  await expect(page.locator(".row", { hasText: "Footsteps in the file" })).toContainText(
    String(result.footsteps.length - 2),
  );
  expect(await toldDistance(page)).toBeGreaterThan(0.1);
  await page.evaluate(() => window.stepwright?.seek(6));
  await page.screenshot({ path: "artefacts/compare-result.png" });
  await page.getByRole("button", { name: "Show the plan alone" }).click();
  await expect(page.getByText("The file's plan and this one")).toHaveCount(0);
  expect(errors).toEqual([]);
});
