/** Marks of the tasks in the room: a ring on the floor, dashed while its task is dragged, a dashed stem up to where the task is, a disc under those selected. */
import {
  BufferGeometry,
  CircleGeometry,
  Group,
  Line,
  LineDashedMaterial,
  LineLoop,
  Mesh,
  MeshBasicMaterial,
  Vector3,
} from "three";
import type { SceneTask } from "../core/scene/types.ts";

/** Radius of the ring, metres. */
const RADIUS = 0.3;
const CORNERS = 64;
const QUIET = 0.45;
/** Dashes of a ring that is dragged: 20 about it, metres. */
const DASH = (2 * Math.PI * RADIUS) / 40;

interface Mark {
  group: Group;
  stem: Line<BufferGeometry, LineDashedMaterial>;
  ring: LineLoop<BufferGeometry, LineDashedMaterial>;
  disc: Mesh<BufferGeometry, MeshBasicMaterial>;
  /** Height that the stem reaches, metres. */
  height: number;
}

export class TaskMarks {
  readonly group = new Group();
  private readonly marks = new Map<string, Mark>();
  private readonly circle = new BufferGeometry().setFromPoints(
    Array.from({ length: CORNERS }, (_, i) => {
      const a = (2 * Math.PI * i) / CORNERS;
      return new Vector3(RADIUS * Math.sin(a), 0, RADIUS * Math.cos(a));
    }),
  );
  private readonly plate = new CircleGeometry(RADIUS, 48).rotateX(-Math.PI / 2);

  constructor() {
    new LineLoop(this.circle).computeLineDistances();
  }

  /** @param selected ids of the tasks that are selected; `dragged` of those that are being dragged. */
  set(
    tasks: readonly SceneTask[],
    selected: readonly string[],
    ink: string,
    dragged: readonly string[] = [],
  ): void {
    const gone = new Set(this.marks.keys());
    for (const t of tasks) {
      gone.delete(t.id);
      const m = this.markOf(t.id);
      const chosen = selected.includes(t.id);
      const [x, y, z] = t.position;
      m.group.position.set(x, 0, z);
      if (m.height !== y) {
        m.height = y;
        m.stem.geometry.dispose();
        m.stem.geometry = new BufferGeometry().setFromPoints([
          new Vector3(0, 0.004, 0),
          new Vector3(0, y, 0),
        ]);
        m.stem.computeLineDistances();
      }
      for (const part of [m.stem, m.ring, m.disc]) part.material.color.set(ink);
      m.ring.material.opacity = chosen ? 1 : QUIET;
      m.ring.material.gapSize = dragged.includes(t.id) ? DASH : 0;
      m.disc.visible = chosen;
    }
    for (const id of gone) this.remove(id);
  }

  private markOf(id: string): Mark {
    const kept = this.marks.get(id);
    if (kept) return kept;
    const stem = new Line(
      new BufferGeometry(),
      new LineDashedMaterial({
        dashSize: 0.025,
        gapSize: 0.03,
        transparent: true,
        opacity: 0.5,
        depthTest: false,
      }),
    );
    const ring = new LineLoop(
      this.circle,
      new LineDashedMaterial({ transparent: true, dashSize: DASH, gapSize: 0 }),
    );
    ring.position.y = 0.006;
    const disc = new Mesh(
      this.plate,
      new MeshBasicMaterial({ transparent: true, opacity: 0.1, depthWrite: false }),
    );
    disc.position.y = 0.003;
    disc.renderOrder = 1;
    const mark: Mark = { group: new Group().add(disc, stem, ring), stem, ring, disc, height: Number.NaN };
    this.marks.set(id, mark);
    this.group.add(mark.group);
    return mark;
  }

  private remove(id: string): void {
    const m = this.marks.get(id);
    if (!m) return;
    this.group.remove(m.group);
    m.stem.geometry.dispose();
    for (const part of [m.stem, m.ring, m.disc]) part.material.dispose();
    this.marks.delete(id);
  }

  dispose(): void {
    for (const id of [...this.marks.keys()]) this.remove(id);
    this.circle.dispose();
    this.plate.dispose();
  }
}
