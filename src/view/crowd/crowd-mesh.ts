/**
 * Crowds drawn with a constant number of draw calls: one instanced mesh a level of detail, skinned on the graphics card from one
 * texture of bone matrices. Near bodies are meshed at 20 mm, far ones at 40 mm, the farthest are capsules with a face.
 */
import {
  BufferAttribute,
  BufferGeometry,
  CapsuleGeometry,
  CircleGeometry,
  Color,
  DataTexture,
  DynamicDrawUsage,
  FloatType,
  Group,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  NearestFilter,
  RGBAFormat,
} from "three";
import { JOINT_COUNT } from "../../core/skeleton/joints.ts";
import { PARTS } from "../character/body-shape.ts";
import type { CharacterMesh } from "../character/build-mesh.ts";
import { ROOMS, SHOES, type Theme } from "../tokens.ts";
import { type CrowdUniforms, crowdMaterial } from "./crowd-material.ts";

/** Distances from the camera beyond which the next coarser body is drawn, metres. */
const NEAR = 9;
const FAR = 24;
/** Agents differ in lightness by this much at most, never in hue. */
const LIGHTNESS = 0.06;
/** Floats of an agent in a frame's `places`. */
const PLACE = 5;

interface Level {
  mesh: Mesh<InstancedBufferGeometry>;
  /** Agent of each instance. */
  agents: InstancedBufferAttribute;
  count: number;
}

/** What a frame tells of everybody. */
export interface CrowdPoses {
  count: number;
  matrices: Float32Array;
  places: Float32Array;
  here: Uint8Array;
}

/** Draw calls of a crowd, whatever its size: three bodies and the shadows under them. */
export const CROWD_DRAWS = 4;

export class CrowdMesh {
  readonly group = new Group();
  private levels: Level[] = [];
  private texture: DataTexture;
  private readonly uniforms: CrowdUniforms;
  private readonly colours = PARTS.map(() => new Color());
  private readonly shadows: Level;
  private theme: Theme = "light";
  private capacity = 0;

  constructor(private readonly meshes: readonly CharacterMesh[]) {
    this.texture = boneTexture(1);
    this.uniforms = { uBones: { value: this.texture }, uLightness: { value: LIGHTNESS } };
    const shade = new MeshBasicMaterial({
      color: 0x000000,
      transparent: true,
      opacity: 0.22,
      depthWrite: false,
    });
    this.shadows = this.level(new CircleGeometry(0.3, 24).rotateX(-Math.PI / 2), shade, "place");
    this.shadows.mesh.renderOrder = 1;
    this.setTheme(this.theme);
  }

  /** One level over a geometry; bodies take their bones, the rest their place. */
  private level(
    geometry: BufferGeometry,
    material: MeshStandardMaterial | MeshBasicMaterial,
    how: "bones" | "place",
  ): Level {
    const instanced = new InstancedBufferGeometry();
    instanced.index = geometry.index;
    for (const [name, attribute] of Object.entries(geometry.attributes))
      instanced.setAttribute(name, attribute);
    crowdMaterial(material, this.uniforms, how);
    const mesh = new Mesh(instanced, material);
    mesh.frustumCulled = false;
    this.group.add(mesh);
    const level: Level = { mesh, agents: new InstancedBufferAttribute(new Float32Array(0), 1), count: 0 };
    return level;
  }

  private makeLevels(): void {
    for (const l of this.levels) this.remove(l);
    this.levels = [
      ...this.meshes.map((m) =>
        this.level(
          bodyGeometry(m, this.colours),
          new MeshStandardMaterial({ roughness: 0.62, vertexColors: true }),
          "bones",
        ),
      ),
      this.level(
        capsuleGeometry(this.colours),
        new MeshStandardMaterial({ roughness: 0.7, vertexColors: true }),
        "place",
      ),
    ];
    this.makeRoom(this.capacity);
  }

  private remove(l: Level): void {
    this.group.remove(l.mesh);
    l.mesh.geometry.dispose();
    (l.mesh.material as MeshStandardMaterial).dispose();
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    const colours: Record<string, string> = { body: ROOMS[theme].body, ivory: ROOMS[theme].ivory, ...SHOES };
    PARTS.forEach((part, i) => {
      this.colours[i].set(colours[part]);
    });
    this.makeLevels();
  }

  private makeRoom(count: number): void {
    this.capacity = count;
    for (const l of [...this.levels, this.shadows]) {
      l.agents = new InstancedBufferAttribute(new Float32Array(Math.max(1, count)), 1);
      l.agents.setUsage(DynamicDrawUsage);
      l.mesh.geometry.setAttribute("agent", l.agents);
    }
    this.texture.dispose();
    this.texture = boneTexture(Math.max(1, count));
    this.uniforms.uBones.value = this.texture;
  }

  /** Shows everybody as a frame has them; the camera's place decides how finely. */
  show(poses: CrowdPoses, camera: { x: number; y: number; z: number }): void {
    if (poses.count !== this.capacity) this.makeRoom(poses.count);
    const data = this.texture.image.data as Float32Array;
    const width = 4 * WIDTH;
    const rows = 12 * JOINT_COUNT;
    for (const l of [...this.levels, this.shadows]) l.count = 0;
    for (let i = 0; i < poses.count; i++) {
      if (poses.here[i] === 0) continue;
      const p = i * PLACE;
      data.set(poses.matrices.subarray(i * rows, (i + 1) * rows), i * width);
      for (let k = 0; k < PLACE - 1; k++) data[i * width + rows + k] = poses.places[p + k];
      data[i * width + rows + 4] = poses.places[p + 4];
      const away = Math.hypot(poses.places[p] - camera.x, camera.y - 1, poses.places[p + 2] - camera.z);
      const level = this.levels[away < NEAR ? 0 : away < FAR ? 1 : 2];
      level.agents.array[level.count++] = i;
      this.shadows.agents.array[this.shadows.count++] = i;
    }
    this.texture.needsUpdate = true;
    for (const l of [...this.levels, this.shadows]) {
      l.mesh.geometry.instanceCount = l.count;
      l.mesh.visible = l.count > 0;
      l.agents.needsUpdate = true;
    }
  }

  /** How many are drawn at each level, finest first. */
  get counts(): number[] {
    return this.levels.map((l) => l.count);
  }

  dispose(): void {
    for (const l of [...this.levels, this.shadows]) this.remove(l);
    this.texture.dispose();
  }
}

/** Texels a row of the texture: three a joint, and two with place and facing. */
export const WIDTH = 3 * JOINT_COUNT + 2;

function boneTexture(rows: number): DataTexture {
  const t = new DataTexture(new Float32Array(4 * WIDTH * rows), WIDTH, rows, RGBAFormat, FloatType);
  t.minFilter = t.magFilter = NearestFilter;
  t.needsUpdate = true;
  return t;
}

/** The character's mesh with a colour a vertex in place of materials: one draw call. */
function bodyGeometry(m: CharacterMesh, colours: readonly Color[]): BufferGeometry {
  const g = new BufferGeometry();
  const colour = new Float32Array(m.positions.length);
  m.groups.forEach(([start, count], part) => {
    for (let k = start; k < start + count; k++) colours[part].toArray(colour, 3 * m.indices[k]);
  });
  g.setAttribute("position", new BufferAttribute(m.positions, 3));
  g.setAttribute("normal", new BufferAttribute(m.normals, 3));
  g.setAttribute("color", new BufferAttribute(colour, 3));
  g.setAttribute("skinIndex", new BufferAttribute(Float32Array.from(m.skinIndices), 4));
  g.setAttribute("skinWeight", new BufferAttribute(m.skinWeights, 4));
  g.setIndex(new BufferAttribute(m.indices, 1));
  return g;
}

/** A capsule of a walker's size, its front above the chest in the face's colour. */
function capsuleGeometry(colours: readonly Color[]): BufferGeometry {
  const g = new CapsuleGeometry(0.2, 1.35, 4, 10);
  const at = g.getAttribute("position");
  const colour = new Float32Array(3 * at.count);
  const face = colours[PARTS.indexOf("ivory")];
  const body = colours[PARTS.indexOf("body")];
  for (let k = 0; k < at.count; k++)
    (at.getY(k) > 0.62 && at.getZ(k) > 0.05 ? face : body).toArray(colour, 3 * k);
  g.setAttribute("color", new BufferAttribute(colour, 3));
  // Its middle stands at half a walker's height.
  g.translate(0, 0.875, 0);
  return g;
}
