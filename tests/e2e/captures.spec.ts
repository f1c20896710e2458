import { readFileSync } from "node:fs";
import { basename } from "node:path";
import { expect, type Page, test } from "@playwright/test";
import { writeBvh } from "../../src/core/capture/bvh-write.ts";
import { renderScore } from "../../src/studio/render.ts";
import { styleScore } from "../../src/studio/styles.ts";
import { drop, pageErrors } from "../support/editor-page.ts";
import { captures, hasShared } from "../support/shared.ts";

// The motion does not start by itself: what is tested is the desk.
test.use({ contextOptions: { reducedMotion: "reduce" } });

async function exported(page: Page): Promise<string> {
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Export labels" }).click(),
  ]);
  return readFileSync(await download.path(), "utf8");
}

const walk = renderScore(styleScore("walking")).clip;
const cases = [{ name: "walk.bvh", text: () => writeBvh(walk), frames: walk.frames }];
const real = hasShared ? captures().find((f) => f.endsWith("dataset-2_walk_normal_001.bvh")) : undefined;
if (real) cases.push({ name: basename(real), text: () => readFileSync(real, "utf8"), frames: 273 });

for (const c of cases)
  test(`${c.name} is dropped, labelled with the keyboard, retrained, exported, and kept over a reload`, async ({
    page,
  }) => {
    const errors = pageErrors(page);
    await page.goto("/");
    await page.getByRole("button", { name: "Labels", exact: true }).waitFor();
    await drop(page, { name: c.name, content: c.text() });
    await expect(page.getByRole("button", { name: "Confirm and next" })).toBeVisible({ timeout: 60_000 });
    await expect(page.getByText("Reading")).toHaveCount(0);
    const before = await exported(page);
    expect(before.trim().split("\n")).toHaveLength(c.frames + 1);

    // The left toe is painted over ten frames from the segment's start, then its end is set with a key.
    await page.locator("canvas").first().focus();
    await page.keyboard.press("2");
    await expect(page.getByRole("button", { name: "Left toe" })).toHaveAttribute("aria-pressed", "true");
    await page.keyboard.press("Home");
    await page.keyboard.press("Space");
    await expect(page.getByText(/Brush (plants|lifts)/)).toBeVisible();
    for (let k = 0; k < 20; k++) await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Space");
    const painted = await exported(page);
    expect(painted).not.toBe(before);
    await page.locator("canvas").first().focus();
    await page.keyboard.press("Control+z");
    expect(await exported(page)).toBe(before);
    await page.locator("canvas").first().focus();
    await page.keyboard.press("Control+Shift+z");
    expect(await exported(page)).toBe(painted);
    // Labels as a file, which is one change too.
    await drop(page, { name: c.name.replace(/\.bvh$/, ".csv"), content: before });
    await expect.poll(() => exported(page), { timeout: 60_000 }).toBe(before);
    await page.locator("canvas").first().focus();
    await page.keyboard.press("Control+z");
    expect(await exported(page)).toBe(painted);

    await page.locator("canvas").first().focus();
    await page.keyboard.press("Enter");
    await expect(page.getByText(/(Up|Down) .* by the last segment/)).toBeVisible({ timeout: 60_000 });
    await page.getByRole("tab", { name: "Model" }).click();
    await expect(page.getByText(/You have added \d+ frames/)).toBeVisible();
    await page.getByRole("tab", { name: "Labels" }).click();
    const after = await exported(page);
    const rows = (text: string): string[] => text.trim().split("\n").slice(1, 10);
    expect(rows(after)).toEqual(rows(painted));

    await page.reload();
    await page.getByRole("button", { name: "Labels", exact: true }).click();
    await expect(page.getByRole("button", { name: "Confirm and next" })).toBeVisible({ timeout: 60_000 });
    await expect(page.getByRole("img", { name: /sure of/ })).toBeVisible({ timeout: 60_000 });
    expect(rows(await exported(page))).toEqual(rows(painted));
    expect(errors).toEqual([]);
  });

test("what is wrong with a file is one sentence; a skeleton without toes goes on, and its joints can be named", async ({
  page,
}) => {
  await page.goto("/");
  await page.getByRole("button", { name: "Labels", exact: true }).waitFor();
  const bvh = writeBvh(walk);
  const toast = page.locator(".toast");
  await drop(page, { name: "broken.bvh", content: bvh.slice(0, 3000) });
  await expect(toast).toContainText(/broken\.bvh, line \d+:/);
  await drop(page, { name: "thing.bvh", content: bvh.replaceAll(/(left|right)Toes/g, "$1Thing") });
  await expect(toast).toContainText("This skeleton has no toes.", { timeout: 60_000 });
  await expect(page.getByRole("button", { name: "Confirm and next" })).toBeVisible({ timeout: 60_000 });
  await drop(page, {
    name: "other.csv",
    content: "frame,left_heel,left_toe,right_heel,right_toe\n0,1,1,1,1\n",
  });
  await expect(toast).toContainText("these are labels of another clip");
  await drop(page, {
    name: "bad.csv",
    content: "frame,left_heel,left_toe,right_heel,right_toe\n0,1,7,1,1\n",
  });
  await expect(toast).toContainText("bad.csv, line 2");
  await page.getByRole("tab", { name: "Clip" }).click();
  await expect(page.getByText("2 not recognised")).toBeVisible();
  await page.getByLabel("leftToes").selectOption("leftThing");
  await expect(page.getByText("1 not recognised")).toBeVisible({ timeout: 60_000 });
});

test("a public capture is fetched at a click with its licence beside it, cleaned, and joins the library", async ({
  page,
}) => {
  await page.route("**/captures.json", (route) =>
    route.fulfill({
      json: {
        captures: [{ name: "A walk", file: "walk.bvh", url: "/served/walk.bvh", licence: "CC0, our own." }],
      },
    }),
  );
  await page.route("**/served/walk.bvh", (route) => route.fulfill({ body: writeBvh(walk) }));
  await page.goto("/");
  await page.getByRole("button", { name: "Labels", exact: true }).click();
  await expect(page.getByText("CC0, our own.")).toBeVisible();
  await page.getByRole("button", { name: "Fetch A walk" }).click();
  await expect(page.getByRole("button", { name: "Confirm and next" })).toBeVisible({ timeout: 60_000 });
  await page.getByRole("tab", { name: "Clip" }).click();
  await page.getByRole("button", { name: "Clean", exact: true }).click();
  await expect(page.getByText(/skate .* mm, now .* mm/)).toBeVisible({ timeout: 60_000 });
  await expect(page.getByRole("button", { name: "After" })).toHaveAttribute("aria-pressed", "true");
  await page.getByRole("button", { name: "Turn", exact: true }).click();
  await expect(page.getByText(/^Turn, .* s$/)).toBeVisible();
  await page.getByRole("button", { name: "Join the library" }).click();
  await expect(page.locator(".toast")).toContainText(
    /walk\.bvh joined the library: \d+ templates and [1-9]\d* walks/,
    {
      timeout: 60_000,
    },
  );
});
