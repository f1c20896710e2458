/**
 * Paths on the floor: a band 20 cm wide a style, with the style's line in it, under the footprints. Unlit, so that the floor
 * shows the exact colours.
 */
import {
  BufferGeometry,
  Color,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  Mesh,
  MeshBasicMaterial,
  RingGeometry,
  ShaderMaterial,
} from "three";
import type { ScenePath } from "../core/scene/types.ts";
import { createPath, type MotionPath, placeOnPath, readPath } from "../core/styles/path.ts";
import { STYLE_PATTERNS, type StyleLook } from "./style-look.ts";

/** Half width of a band and its height over the floor, metres; how much of it covers the floor. */
const HALF = 0.1;
const OVER = 0.004;
const COVER = 0.62;
const LINE_COVER = 0.75;
/** Metres between the rows of a band. */
const STEP = 0.04;
/** Band and line are drawn after contact blobs and before prints. */
const ORDER = 2;

/** A stretch of a path in one style, metres along it. */
export interface BandSpan {
  from: number;
  to: number;
  style: string;
}

/** The stretches of a path by style; from its start it is walking unless painted otherwise. */
export function bandSpans(path: ScenePath, length: number): BandSpan[] {
  const changes = path.styles[0]?.at === 0 ? path.styles : [{ at: 0, style: "walking" }, ...path.styles];
  return changes
    .map((c, i) => ({ from: c.at * length, to: (changes[i + 1]?.at ?? 1) * length, style: c.style }))
    .filter((s) => s.to - s.from > 1e-6);
}

/** The curve of a scene's path; null when it is too short to follow. */
export function curveOf(path: ScenePath): MotionPath | null {
  const [a] = path.points;
  if (!a || path.points.every((q) => Math.hypot(q[0] - a[0], q[1] - a[1]) < 1e-3)) return null;
  return createPath(path.points, path.smooth);
}

const VERTEX = `
varying vec2 vAt;
void main() {
  vAt = uv;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

/* vAt: metres along the path and across it. Each pattern is a distance to its line, metres. */
const FRAGMENT = `
uniform vec3 colour;
uniform vec3 line;
uniform int pattern;
uniform float cover;
uniform float lineCover;
varying vec2 vAt;
float wave(float u) { return abs(fract(u) * 2.0 - 1.0); }
float far(vec2 p) {
  float u = p.x;
  float v = p.y;
  if (pattern == 0) return abs(v);
  if (pattern == 1) return max(abs(v), (mod(u, 0.3) - 0.19));
  if (pattern == 2) return abs(v - (abs(sin(u * 3.14159 / 0.2)) * 0.09 - 0.045)) * 0.65;
  if (pattern == 3) return length(vec2(mod(u, 0.12) - 0.06, v)) - 0.008;
  if (pattern == 4) return abs(v - (wave(u / 0.15) - 0.5) * (0.05 + 0.09 * wave(u / 0.41))) * 0.6;
  if (pattern == 5) return abs(v - (wave(u / 0.2) - 0.5) * 0.1) * 0.7;
  if (pattern == 6) return abs(v - 0.045 * sin(u * 6.28318 / 0.55 + 0.5 * sin(u * 6.28318 / 0.55)));
  if (pattern == 7) return max(abs(mod(u, 0.1) - 0.05), abs(v) - 0.05);
  if (pattern == 8) return abs(abs(v) - 0.03);
  vec2 q = vec2(mod(u, 0.16) - 0.08, v);
  return max(min(abs(q.x - q.y), abs(q.x + q.y)) * 0.7, max(abs(q.x), abs(q.y)) - 0.035);
}
void main() {
  float edge = fwidth(vAt.y);
  float side = 1.0 - smoothstep(${HALF.toFixed(3)} - edge, ${HALF.toFixed(3)}, abs(vAt.y));
  float d = far(vAt);
  float w = max(fwidth(d), 1e-4);
  float on = (1.0 - smoothstep(0.0055 - w, 0.0055 + w, d)) * lineCover;
  gl_FragColor = vec4(mix(colour, line, on), side * max(cover, on));
  #include <colorspace_fragment>
}`;

const material = (look: StyleLook): ShaderMaterial =>
  new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: {
      colour: { value: new Color(look.colour) },
      line: { value: new Color(look.line) },
      pattern: { value: STYLE_PATTERNS.indexOf(look.pattern) },
      cover: { value: COVER },
      lineCover: { value: LINE_COVER },
    },
    transparent: true,
    depthWrite: false,
    toneMapped: false,
    fog: false,
    side: DoubleSide,
  });

function ribbon(path: MotionPath, span: BandSpan): BufferGeometry {
  const n = Math.max(2, Math.ceil((span.to - span.from) / STEP) + 1);
  const places: number[] = [];
  const at: number[] = [];
  const index: number[] = [];
  const p = new Float64Array(2);
  for (let k = 0; k < n; k++) {
    const s = span.from + ((span.to - span.from) * k) / (n - 1);
    placeOnPath(p, path, s);
    const t = readPath(path, path.heading, s);
    for (const side of [-1, 1]) {
      places.push(p[0] + side * HALF * Math.cos(t), OVER, p[1] - side * HALF * Math.sin(t));
      at.push(s, side * HALF);
    }
    if (k > 0) index.push(2 * k - 2, 2 * k - 1, 2 * k, 2 * k, 2 * k - 1, 2 * k + 1);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(places, 3));
  geometry.setAttribute("uv", new Float32BufferAttribute(at, 2));
  geometry.setIndex(index);
  return geometry;
}

export class PathBands {
  readonly group = new Group();
  /** Called before each picture is drawn: for what is laid over the bands. */
  onDraw: () => void = () => undefined;
  private mark: Mesh | null = null;
  /** One material a look, kept: a drag changes geometry many times a second and must not compile shaders anew. */
  private readonly materials = new Map<string, ShaderMaterial>();

  private materialOf(look: StyleLook): ShaderMaterial {
    const key = `${look.colour} ${look.pattern}`;
    const kept = this.materials.get(key) ?? material(look);
    this.materials.set(key, kept);
    return kept;
  }

  /** Draws paths anew; one that is too short to follow is left out. */
  set(
    paths: readonly { curve: MotionPath; spans: readonly BandSpan[] }[],
    look: (style: string) => StyleLook,
  ): void {
    this.clear();
    for (const { curve, spans } of paths)
      for (const span of spans) {
        const mesh = new Mesh(ribbon(curve, span), this.materialOf(look(span.style)));
        mesh.renderOrder = ORDER;
        mesh.frustumCulled = false;
        mesh.onBeforeRender = () => this.onDraw();
        this.group.add(mesh);
      }
  }

  /** A ring on the floor where the next point or change would be; null takes it away. */
  point(at: readonly [number, number] | null, colour: string): void {
    if (this.mark) {
      this.group.remove(this.mark);
      this.mark.geometry.dispose();
      (this.mark.material as MeshBasicMaterial).dispose();
      this.mark = null;
    }
    if (!at) return;
    const ring = new RingGeometry(0.045, 0.06, 32);
    ring.rotateX(-Math.PI / 2);
    this.mark = new Mesh(
      ring,
      new MeshBasicMaterial({ color: colour, toneMapped: false, depthWrite: false, transparent: true }),
    );
    this.mark.position.set(at[0], OVER + 0.002, at[1]);
    this.mark.renderOrder = ORDER + 1;
    this.group.add(this.mark);
  }

  private clear(): void {
    for (const o of this.group.children)
      if (o instanceof Mesh) {
        o.geometry.dispose();
        if (o === this.mark) (o.material as MeshBasicMaterial).dispose();
      }
    this.group.clear();
    this.mark = null;
  }

  dispose(): void {
    this.clear();
    for (const m of this.materials.values()) m.dispose();
  }
}
