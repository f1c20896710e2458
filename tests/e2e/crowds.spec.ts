import { readFileSync } from "node:fs";
import { expect, type Page, test } from "@playwright/test";
import { crowdOfScene } from "../../src/core/crowd/from-scene.ts";
import { hashCrowd } from "../../src/core/crowd/track-hash.ts";
import { readScene } from "../../src/core/scene/schema.ts";

const crowd = (page: Page) => page.evaluate(() => window.stepwright?.crowd());
const ready = (page: Page) =>
  page.waitForFunction(() => window.stepwright?.crowd().ready === true, undefined, { timeout: 120_000 });
const reached = (page: Page, seconds: number) =>
  page.waitForFunction((t) => (window.stepwright?.crowd().seconds ?? 0) >= t, seconds, { timeout: 120_000 });
/** A file let go over the page. */
const drop = (page: Page, name: string, text: string) =>
  page.evaluate(
    ([n, t]) => {
      const data = new DataTransfer();
      data.items.add(new File([t], n));
      window.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
    },
    [name, text],
  );

test("a crowd runs in its worker as it does in Node, bit for bit; a walker's plan is told; walls are drawn while it runs", async ({
  page,
}) => {
  const errors: string[] = [];
  page.on("pageerror", (e) => errors.push(e.message));
  await page.goto("/");
  await page.waitForFunction(() => window.stepwright !== undefined);
  const text = readFileSync("assets/scenes/crowd-doorway.json", "utf8");
  await drop(page, "doorway.json", text);
  await ready(page);
  expect((await crowd(page))?.agents).toBe(4);
  const browser = await page.evaluate(() => window.stepwright?.crowdHash(60));
  expect(browser).toBe(hashCrowd(crowdOfScene(readScene(text, "doorway.json"), "scene"), 60).hash);

  await page.evaluate(() => window.stepwright?.pickWalker(0));
  await page.waitForFunction(() => (window.stepwright?.crowd().nodes ?? 0) > 10, undefined, {
    timeout: 60_000,
  });
  await expect(page.getByText("Plan of walker 1")).toBeVisible();

  await page.keyboard.press("c");
  await page.getByRole("button", { name: "Pillar" }).click();
  const box = (await page.locator("canvas").first().boundingBox())!;
  await page.mouse.click(box.x + 0.3 * box.width, box.y + 0.55 * box.height);
  expect(await page.evaluate(() => window.stepwright?.state().scene.props.length)).toBe(3);
  // It goes on from where it is.
  const { seconds } = (await crowd(page))!;
  await reached(page, seconds + 1);
  expect((await crowd(page))?.agents).toBe(4);
  expect(errors).toEqual([]);
});

test("a SteerSuite case dropped on the page runs; a broken one is answered by one sentence", async ({
  page,
}) => {
  await page.goto("/");
  await page.waitForFunction(() => window.stepwright !== undefined);
  const agent = (x: number, gx: number): string =>
    `<agent><initialConditions><position><x>${x}</x><y>0</y><z>0.2</z></position><direction><x>1</x><y>0</y><z>0</z></direction><radius>0.5</radius><speed>0</speed></initialConditions><goalSequence><seekStaticTarget><targetLocation><x>${gx}</x><y>0</y><z>0</z></targetLocation><desiredSpeed>1.3</desiredSpeed><timeDuration>1000</timeDuration></seekStaticTarget></goalSequence></agent>`;
  await drop(page, "two.xml", `<SteerBenchTestCase>${agent(-3, 3)}${agent(3, -3)}</SteerBenchTestCase>`);
  await ready(page);
  expect((await crowd(page))?.agents).toBe(2);
  await drop(page, "broken.xml", "<SteerBenchTestCase><agent></SteerBenchTestCase>");
  await expect(
    page.getByText("broken.xml, line 1: </SteerBenchTestCase> closes <agent>.").first(),
  ).toBeVisible();
});
