import { readFileSync } from "node:fs";
import { expect, type Page, test } from "@playwright/test";
import { createCrowd, stepCrowd, stepsOf } from "../../src/core/crowd/crowd.ts";
import { crowdOfScene } from "../../src/core/crowd/from-scene.ts";
import { KIND, P } from "../../src/core/crowd/state.ts";
import { hashCrowd } from "../../src/core/crowd/track-hash.ts";
import { TICK } from "../../src/core/crowd/types.ts";
import { readScene } from "../../src/core/scene/schema.ts";
import { drop, pageErrors } from "../support/editor-page.ts";

const crowd = (page: Page) => page.evaluate(() => window.stepwright?.crowd());
const ready = (page: Page) =>
  page.waitForFunction(() => window.stepwright?.crowd().ready === true, undefined, { timeout: 120_000 });
/** So many frames more. */
const drawn = (page: Page, frames: number) =>
  page.evaluate(async (n) => {
    for (let k = 0; k < n; k++) await new Promise(requestAnimationFrame);
  }, frames);
const reached = (page: Page, seconds: number) =>
  page.waitForFunction((t) => (window.stepwright?.crowd().seconds ?? 0) >= t, seconds, { timeout: 120_000 });
test("a crowd runs in its worker as it does in Node, bit for bit; a walker's plan is told; walls are drawn while it runs", async ({
  page,
}) => {
  const errors = pageErrors(page);
  await page.goto("/");
  await page.waitForFunction(() => window.stepwright !== undefined);
  const text = readFileSync("assets/scenes/crowd-doorway.json", "utf8");
  await drop(page, { name: "doorway.json", content: text });
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

/** Two who meet at a door that lets one through. */
const DOOR = JSON.stringify({
  version: 1,
  seed: 3,
  props: [-1, 1].map((side) => ({
    id: `wall-${side}`,
    kind: "wall",
    position: [side * 2.5, 0, 0],
    yaw: 0,
    // Low, so that feet behind them are seen.
    size: [4, 0.3, 0.16],
  })),
  crowd: {
    agents: [
      { position: [-0.17, -4], yaw: 0, goals: [[-0.17, 5]], speed: 1.3 },
      { position: [0.17, 4], yaw: Math.PI, goals: [[0.17, -5]], speed: 1.3 },
    ],
    regions: [],
  },
});

/** When somebody first steps aside without turning, who, and until when; from the same crowd in Node. */
function yielding(): { agent: number; from: number; to: number } {
  const crowd = createCrowd(crowdOfScene(readScene(DOOR, "door.json"), "scene"));
  const found: { agent: number; from: number; to: number }[] = [];
  crowd.onStep = (agent) => {
    const { steps } = crowd;
    const p = stepsOf(agent);
    const aside = steps[p + P.px] * steps[p + P.fromHeadZ] - steps[p + P.pz] * steps[p + P.fromHeadX];
    if (steps[p + P.kind] === KIND.shift && steps[p + P.along] > 0.2 && Math.abs(aside) > 0.9)
      found.push({ agent, from: steps[p + P.start], to: steps[p + P.start] + steps[p + P.duration] });
  };
  for (let t = 0; t < 10 / TICK && found.length === 0; t++) stepCrowd(crowd);
  expect(found.length).toBe(1);
  return found[0];
}

test("two meet at a door that lets one through: one steps aside, in the picture of that moment", async ({
  page,
}) => {
  const { agent, from, to } = yielding();
  // The crowd waits for Run until the camera is where it should be.
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.goto("/");
  await page.waitForFunction(() => window.stepwright !== undefined);
  await drop(page, { name: "door.json", content: DOOR });
  await ready(page);
  await page.evaluate((a) => window.stepwright?.pickWalker(a), agent);
  const stage = (await page.locator("canvas").first().boundingBox())!;
  const [x, y] = [stage.x + stage.width / 2, stage.y + stage.height / 2];
  await page.mouse.move(x, y);
  for (let n = 0; n < 7; n++) {
    await page.mouse.wheel(0, -240);
    await drawn(page, 2);
  }
  // From higher up, and from the side.
  await page.mouse.move(stage.x + 0.2 * stage.width, y + 60);
  await page.mouse.down();
  await page.mouse.move(stage.x + 0.22 * stage.width, y + 96, { steps: 4 });
  await page.mouse.up();
  // Where the room is drawn in software it is not drawn until then: the clock would crawl.
  await page.evaluate(() => window.stepwright?.draw(false));
  await page.getByRole("button", { name: "Run" }).click();
  await reached(page, from + 0.6 * (to - from));
  // The crowd's own, beside that of the timeline.
  await page.locator(".panel").getByRole("button", { name: "Pause" }).click();
  await page.evaluate(() => window.stepwright?.draw(true));
  const shown = (await crowd(page))!;
  expect(shown.picked).toBe(agent);
  expect(shown.left).toBe(2);
  expect(shown.seconds).toBeGreaterThan(from);
  expect(shown.seconds).toBeLessThan(to + 0.5);
  await drawn(page, 10);
  await page.screenshot({ path: "artefacts/crowd-yields.png" });
});

test("a SteerSuite case dropped on the page runs; a broken one is answered by one sentence", async ({
  page,
}) => {
  await page.goto("/");
  await page.waitForFunction(() => window.stepwright !== undefined);
  const agent = (x: number, gx: number): string =>
    `<agent><initialConditions><position><x>${x}</x><y>0</y><z>0.2</z></position><direction><x>1</x><y>0</y><z>0</z></direction><radius>0.5</radius><speed>0</speed></initialConditions><goalSequence><seekStaticTarget><targetLocation><x>${gx}</x><y>0</y><z>0</z></targetLocation><desiredSpeed>1.3</desiredSpeed><timeDuration>1000</timeDuration></seekStaticTarget></goalSequence></agent>`;
  await drop(page, {
    name: "two.xml",
    content: `<SteerBenchTestCase>${agent(-3, 3)}${agent(3, -3)}</SteerBenchTestCase>`,
  });
  await ready(page);
  expect((await crowd(page))?.agents).toBe(2);
  await drop(page, { name: "broken.xml", content: "<SteerBenchTestCase><agent></SteerBenchTestCase>" });
  await expect(
    page.getByText("broken.xml, line 1: </SteerBenchTestCase> closes <agent>.").first(),
  ).toBeVisible();
});
