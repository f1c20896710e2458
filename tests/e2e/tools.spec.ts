/** Editing as a whole in a real browser: footsteps, links, files of every kind, and everything by keyboard. */
import { readFile } from "node:fs/promises";
import { expect, test } from "@playwright/test";
import { JOINT_NAMES } from "../../src/core/skeleton/joints.ts";
import { seriousViolations } from "../support/accessibility.ts";
import { answered, drop, openEditor } from "../support/editor-page.ts";

test("a footstep is selected and moved by keyboard, the plan answers; a link carries it all", async ({
  page,
  context,
}) => {
  await openEditor(page);
  for (let k = 0; k < 4; k++) await page.keyboard.press("]");
  const before = await page.evaluate(() => {
    const s = window.stepwright!.state();
    return { selection: s.selection, steps: s.plan!.steps.map((p) => [p.x, p.z]) };
  });
  expect(before.selection).toHaveLength(1);
  expect(before.selection[0].kind).toBe("step");
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("ArrowLeft");
  // Its plant is enforced: heel and toe rest from landing to lift.
  await page.keyboard.press("m");
  await page.waitForFunction(() => window.stepwright!.state().scene.edits[0]?.plant === "enforce");
  await expect(page.getByRole("group", { name: "Plant" }).getByRole("button", { pressed: true })).toHaveText(
    "Enforce",
  );
  await answered(page);
  const edit = await page.evaluate(() => window.stepwright!.state().scene.edits[0]);
  const near = await page.evaluate(
    ([x, z]) => Math.min(...window.stepwright!.state().plan!.steps.map((p) => Math.hypot(p.x - x, p.z - z))),
    [edit.position![0], edit.position![2]] as const,
  );
  expect(near).toBeLessThan(1e-6);
  await expect(page.getByRole("tab", { name: "Footstep" })).toBeVisible();

  // The link opens the same scene in a window that has never seen it.
  await page.getByRole("button", { name: "Share" }).click();
  await page.waitForFunction(() => location.hash.startsWith("#s="));
  const scene = await page.evaluate(() => window.stepwright!.state().scene);
  const address = page.url();
  const other = await context.browser()!.newContext({ reducedMotion: "reduce" });
  const fresh = await other.newPage();
  await fresh.goto(address);
  await fresh.waitForFunction(() => window.stepwright?.state().scene.edits.length === 1, null, {
    timeout: 60_000,
  });
  expect(await fresh.evaluate(() => window.stepwright!.state().scene)).toEqual(scene);
  await fresh.goto("about:blank");
  await other.close();

  // Undo gives the footstep back.
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  await page.waitForFunction(() => window.stepwright!.state().scene.edits.length === 0);
});

/** A GLB of ours as a VRM 1.0: its joints named as humanoid bones in the extension of that name. */
function asVrm(glb: Buffer): Buffer {
  const end = 20 + glb.readUInt32LE(12);
  const json = JSON.parse(glb.subarray(20, end).toString()) as {
    nodes: { name?: string }[];
    [key: string]: unknown;
  };
  const humanBones = Object.fromEntries(
    JOINT_NAMES.map((joint) => [joint, { node: json.nodes.findIndex((n) => n.name === joint) }]),
  );
  const meta = { name: "Me", authors: ["Nobody"], licenseUrl: "https://vrm.dev/licenses/1.0/" };
  json.extensions = { VRMC_vrm: { specVersion: "1.0", meta, humanoid: { humanBones } } };
  json.extensionsUsed = ["VRMC_vrm"];
  const text = Buffer.from(JSON.stringify(json));
  const padded = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, " ")]);
  const head = Buffer.from(glb.subarray(0, 20));
  head.writeUInt32LE(20 + padded.length + glb.length - end, 8);
  head.writeUInt32LE(padded.length, 12);
  return Buffer.concat([head, padded, glb.subarray(end)]);
}

test("exports are files that hold what they say; a scene and a character are dropped; damaged ones are named", async ({
  page,
}) => {
  await openEditor(page);
  const save = async (label: string | RegExp) => {
    await page.getByRole("button", { name: "Export" }).click();
    const [file] = await Promise.all([
      page.waitForEvent("download", { timeout: 60_000 }),
      page.getByRole("menuitem", { name: label }).click(),
    ]);
    return { name: file.suggestedFilename(), data: await readFile(await file.path()) };
  };
  const bvh = await save("Motion (BVH)");
  expect(bvh.name).toBe("two-tables.bvh");
  expect(bvh.data.toString().startsWith("HIERARCHY")).toBe(true);
  const footsteps = await save("Footsteps (CSV)");
  const planned = await page.evaluate(() => window.stepwright!.state().plan!.steps.length);
  expect(footsteps.data.toString().trim().split("\n")).toHaveLength(planned + 3);
  const glb = await save("Character with motion (GLB)");
  expect(glb.data.subarray(0, 4).toString()).toBe("glTF");
  const picture = await save("Picture of the room (PNG)");
  expect(picture.data.subarray(1, 4).toString()).toBe("PNG");
  const seen = await page.evaluate(async (b) => {
    const bytes = Uint8Array.from(atob(b), (c) => c.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const context = canvas.getContext("2d")!;
    context.drawImage(bitmap, 0, 0);
    return {
      size: [bitmap.width, bitmap.height],
      shades: new Set(context.getImageData(0, 0, bitmap.width, bitmap.height).data).size,
    };
  }, picture.data.toString("base64"));
  expect(seen.size).toEqual(
    await page.evaluate(() => {
      const c = document.querySelector<HTMLCanvasElement>("#stage")!;
      return [c.width, c.height];
    }),
  );
  expect(seen.shades).toBeGreaterThan(100);
  const frames = await page.evaluate(() => window.stepwright!.frames()!.filled);
  const contacts = await save("Contacts (CSV)");
  expect(contacts.data.toString().trim().split("\n")).toHaveLength(frames + 1);
  const result = JSON.parse((await save("Footsteps, contacts, figures (JSON)")).data.toString());
  expect(result.footsteps).toHaveLength(planned + 2);
  expect(result.contacts).toHaveLength(frames);
  const scene = await save(/^Scene \(JSON\)/);

  const moved = JSON.parse(scene.data.toString()) as { tasks: { id: string }[] };
  moved.tasks.splice(2);
  await drop(page, { name: "two.json", content: JSON.stringify({ version: 1, tasks: moved.tasks }) });
  await page.waitForFunction(() => window.stepwright!.state().scene.tasks.length === 2);
  await drop(page, { name: "me.glb", content: glb.data });
  await page.waitForFunction(() => window.stepwright!.state().scene.character.model === "me.glb", null, {
    timeout: 60_000,
  });
  await expect(page.getByText("joints found")).toBeVisible();
  await drop(page, { name: "me.vrm", content: asVrm(glb.data) });
  await page.waitForFunction(() => window.stepwright!.state().scene.character.model === "me.vrm", null, {
    timeout: 60_000,
  });
  await drop(page, { name: "broken.glb", content: "no" });
  await expect(page.getByText(/broken\.glb: no glTF document/).first()).toBeVisible();
  await drop(page, { name: "notes.docx", content: "no" });
  await expect(page.getByText(/notes\.docx: files of this kind are not read/).first()).toBeVisible();
});

test("every control is reached by keyboard, in order, with a name; the sheet lists the keys", async ({
  page,
}) => {
  // Wide enough for the panel to have an edge.
  await page.setViewportSize({ width: 1300, height: 760 });
  await openEditor(page);
  const seen: string[] = [];
  await page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
  for (let k = 0; k < 90; k++) {
    await page.keyboard.press("Tab");
    const name = await page.evaluate(() => {
      const e = document.activeElement;
      if (!e || e === document.body) return null;
      const label = (e as HTMLInputElement).labels?.[0]?.textContent;
      return `${e.tagName} ${e.getAttribute("aria-label") ?? (label || e.textContent)?.trim() ?? ""}`;
    });
    if (name === null) break;
    seen.push(name);
  }
  for (const s of seen)
    expect(s.split(" ").slice(1).join("").length, `a control without a name: ${s}`).toBeGreaterThan(0);
  const all = seen.join("\n");
  for (const wanted of [
    "Export",
    "Share",
    "Select",
    "Task",
    "Path",
    "Play",
    "Loop",
    "Size of the timeline",
    "Task 1: Write",
    "Height",
  ])
    expect(all).toContain(wanted);
  await page.keyboard.press("?");
  await page.getByRole("searchbox").fill("swap");
  await expect(page.getByText("Swap the foot")).toBeVisible();
  await expect(page.getByText("Duplicate")).toHaveCount(0);
  // Nothing behind the sheet is in reach, even when a click on its text has taken the focus away; Escape still closes it.
  await page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
  const before = await page.evaluate(() => JSON.stringify(window.stepwright!.state().scene));
  await page.keyboard.press("Control+d");
  await page.keyboard.press("p");
  expect(await page.evaluate(() => JSON.stringify(window.stepwright!.state().scene))).toBe(before);
  await page.keyboard.press("Escape");
  await expect(page.getByRole("searchbox")).toHaveCount(0);
});

test("without a pointer: a task, stones, a path and a wall are put on the floor with arrows and Enter", async ({
  page,
}) => {
  await openEditor(page);
  await drop(page, { name: "empty.json", content: '{ "version": 1 }' });
  await page.waitForFunction(() => window.stepwright!.state().scene.tasks.length === 0);
  const scene = () => page.evaluate(() => window.stepwright!.state().scene);
  const press = async (...keys: string[]) => {
    for (const key of keys) await page.keyboard.press(key);
  };
  // Given up in mid-press: nothing is left.
  await press("t", "6", "ArrowUp", "Enter", "ArrowUp", "Escape");
  expect((await scene()).tasks).toEqual([]);
  await press("t", "6", "ArrowUp", "Enter", "Shift+ArrowUp", "Enter");
  expect((await scene()).tasks.map((t) => t.category)).toEqual(["turn"]);

  await press("s", "Shift+ArrowLeft", "Enter", "Enter", "Shift+ArrowUp", "Enter", "Enter");
  const [a, b] = (await scene()).stones.map((s) => s.position);
  expect(b[0] - a[0]).toBeCloseTo(0, 6);
  expect(b[2] - a[2]).toBeCloseTo(0.25, 6);

  await press("p", "ArrowRight", "Enter", ...Array<string>(6).fill("Shift+ArrowRight"), "Enter");
  const [path] = (await scene()).paths;
  expect(path.points.at(-1)![0] - path.points[0][0]).toBeCloseTo(-1.5, 1);

  await press("c", "e", "ArrowDown", "Enter", ...Array<string>(4).fill("Shift+ArrowLeft"), "Enter");
  const wall = (await scene()).props.find((p) => p.kind === "wall");
  expect(wall?.size[0]).toBeCloseTo(1, 2);

  // One entry of the history each.
  await press("Escape", "Escape", ...Array<string>(5).fill("Control+z"));
  expect(await scene()).toMatchObject({ tasks: [], stones: [], paths: [], props: [] });
});

test("on a phone: nothing overlaps the tool bar, the sheet has three heights, no serious violation", async ({
  page,
}) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await openEditor(page);
  const rail = (await page.getByRole("toolbar", { name: "Tools" }).boundingBox())!;
  expect(rail.y + rail.height).toBeCloseTo(844, 0);
  const timeline = (await page.locator(".timeline:not(.desk-time)").boundingBox())!;
  expect(timeline.y + timeline.height).toBeLessThanOrEqual(rail.y + 1);
  for (const name of ["Select", "Task", "Path", "More"])
    expect(
      (await page.getByRole("button", { name, exact: true }).boundingBox())!.height,
    ).toBeGreaterThanOrEqual(44);
  const handle = page.getByRole("button", { name: /^Sheet/ });
  await handle.press("ArrowUp");
  await expect(page.locator("#app")).toHaveAttribute("data-sheet", "full");
  await handle.press("Enter");
  await expect(page.locator("#app")).toHaveAttribute("data-sheet", "peek");
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
  expect(await seriousViolations(page)).toEqual([]);
});
