import { describe, expect, test } from "vitest";
import { PLATE_HEIGHT, type PlateWish, placePlates } from "../../src/editor/layers/plate-places.ts";

const ROOM = { left: 56, top: 40, right: 900, bottom: 500 };
const wish = (x: number, y: number, side = 1): PlateWish => ({ x, y, side, width: 100 });

describe("names on plates", () => {
  test("a plate with nothing in its way stands above its place, on the side that it wished for", () => {
    expect(placePlates([wish(400, 300, 1)], [], ROOM)).toEqual([[34, -47]]);
    expect(placePlates([wish(400, 300, -1)], [], ROOM)).toEqual([[-34, -47]]);
  });

  test("plates whose places are near each other do not lie over each other", () => {
    const wishes = [wish(400, 300), wish(410, 306), wish(395, 312)];
    const at = placePlates(wishes, [], ROOM).map(([dx, dy], i) => [wishes[i].x + dx, wishes[i].y + dy]);
    for (let i = 0; i < 3; i++)
      for (let k = 0; k < i; k++)
        expect(
          Math.abs(at[i][0] - at[k][0]) >= 100 || Math.abs(at[i][1] - at[k][1]) >= PLATE_HEIGHT,
          `plates ${k} and ${i}`,
        ).toBe(true);
  });

  test("a plate leaves a handle free", () => {
    const [[dx, dy]] = placePlates([wish(400, 300)], [[434, 253]], ROOM);
    expect([dx, dy]).not.toEqual([34, -47]);
  });

  test("a plate at the view's edge stays inside it, as far as its place allows", () => {
    for (const [x, y] of [
      [60, 300],
      [895, 300],
      [400, 45],
      [400, 495],
    ]) {
      const [[dx, dy]] = placePlates([wish(x, y)], [], ROOM);
      expect(x + dx - 50).toBeGreaterThanOrEqual(ROOM.left);
      expect(x + dx + 50).toBeLessThanOrEqual(ROOM.right);
      expect(y + dy - PLATE_HEIGHT / 2).toBeGreaterThanOrEqual(ROOM.top);
      expect(y + dy + PLATE_HEIGHT / 2).toBeLessThanOrEqual(ROOM.bottom);
    }
  });
});
