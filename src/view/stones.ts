/** Stones and terrain: discs that rise from the ground to where they are stepped on; the ground itself; water in a bed. */
import {
  CylinderGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  PlaneGeometry,
  type Raycaster,
  RingGeometry,
} from "three";
import { groundHeight } from "../core/scene/terrain.ts";
import type { SceneStone, Terrain } from "../core/scene/types.ts";
import { ROOMS, type Theme } from "./tokens.ts";

/** Radius of a stone's disc, and of the ring round a chosen one; least height that is seen, metres. */
const RADIUS = 0.2;
const LEAST = 0.012;
/** The slope's and the field's mesh: half its side for a slope, points a metre. */
const SLOPE_HALF = 6;
/** Water stands this far under the banks. */
const WATER = 0.12;

export class StoneField {
  readonly group = new Group();
  private readonly discs = new Group();
  private readonly ground = new Group();
  private readonly stone = new MeshStandardMaterial({ roughness: 0.85 });
  private readonly earth = new MeshStandardMaterial({ roughness: 0.9 });
  private readonly water = new MeshStandardMaterial({ roughness: 0.15, transparent: true, opacity: 0.55 });
  private readonly ring = new MeshBasicMaterial();
  private shownTerrain: Terrain | null = null;

  constructor() {
    this.group.add(this.ground, this.discs);
  }

  setTheme(theme: Theme): void {
    const room = ROOMS[theme];
    this.stone.color.set(theme === "light" ? "#aeb2b4" : "#7b828b");
    this.earth.color.set(room.floor);
    this.water.color.set(theme === "light" ? "#8d99a2" : "#39424c");
    this.ring.color.set(room.ink);
  }

  /** Draws stones anew; `chosen` names those with a ring. */
  setStones(stones: readonly SceneStone[], terrain: Terrain, chosen: readonly string[]): void {
    clear(this.discs);
    for (const s of stones) {
      const [x, y, z] = s.position;
      const height = Math.max(LEAST, y - groundHeight(terrain, x, z));
      const disc = new Mesh(
        new CylinderGeometry(RADIUS, RADIUS * (height > 0.05 ? 1.12 : 1), height, 40),
        this.stone,
      );
      disc.position.set(x, y - height / 2 - 0.002, z);
      disc.castShadow = height > 0.05;
      disc.receiveShadow = true;
      disc.userData.stone = s.id;
      this.discs.add(disc);
      if (!chosen.includes(s.id)) continue;
      const ring = new Mesh(
        new RingGeometry(RADIUS + 0.025, RADIUS + 0.04, 48).rotateX(-Math.PI / 2),
        this.ring,
      );
      ring.position.set(x, y + 0.003, z);
      this.discs.add(ring);
    }
  }

  /** Draws the ground anew; nothing for flat ground, which is the room's floor. */
  setTerrain(terrain: Terrain): void {
    if (terrain === this.shownTerrain) return;
    this.shownTerrain = terrain;
    clear(this.ground);
    if (terrain.kind === "flat") return;
    const [w, d] = terrain.kind === "slope" ? [2 * SLOPE_HALF, 2 * SLOPE_HALF] : terrain.size;
    const [nx, nz] = terrain.kind === "slope" ? [1, 1] : terrain.cells;
    const plane = new PlaneGeometry(w, d, nx, nz).rotateX(-Math.PI / 2);
    const p = plane.getAttribute("position");
    let low = 0;
    for (let i = 0; i < p.count; i++) {
      const h = groundHeight(terrain, p.getX(i), p.getZ(i));
      low = Math.min(low, h);
      p.setY(i, h);
    }
    const flat = plane.toNonIndexed();
    flat.computeVertexNormals();
    const mesh = new Mesh(flat, this.earth);
    mesh.receiveShadow = true;
    this.ground.add(mesh);
    plane.dispose();
    if (terrain.kind === "heightfield" && low < -2 * WATER) {
      const pool = new Mesh(new PlaneGeometry(w, d).rotateX(-Math.PI / 2), this.water);
      pool.position.y = -WATER;
      this.ground.add(pool);
    }
  }

  /** Whether the ground is drawn here rather than as the room's floor. */
  get ownGround(): boolean {
    return this.ground.children.length > 0;
  }

  /** The stone under a ray. */
  pick(ray: Raycaster): string | null {
    const hit = ray.intersectObjects(this.discs.children, false).find((h) => h.object.userData.stone);
    return (hit?.object.userData.stone as string | undefined) ?? null;
  }

  dispose(): void {
    clear(this.discs);
    clear(this.ground);
    for (const m of [this.stone, this.earth, this.water, this.ring]) m.dispose();
  }
}

/** A column a landing: how far the blend alone would have missed, ten times as tall [Barycentric Figure 8]. */
export class ErrorColumns {
  readonly group = new Group();
  private readonly material = new MeshBasicMaterial();

  setTheme(theme: Theme): void {
    this.material.color.set(ROOMS[theme].ink);
  }

  set(columns: readonly { x: number; y: number; z: number; error: number }[]): void {
    clear(this.group);
    for (const c of columns) {
      const height = Math.max(0.004, 10 * c.error);
      const column = new Mesh(new CylinderGeometry(0.018, 0.018, height, 16), this.material);
      column.position.set(c.x, c.y + height / 2, c.z);
      this.group.add(column);
    }
  }

  dispose(): void {
    clear(this.group);
    this.material.dispose();
  }
}

function clear(group: Group): void {
  for (const o of group.children) if (o instanceof Mesh) o.geometry.dispose();
  group.clear();
}
