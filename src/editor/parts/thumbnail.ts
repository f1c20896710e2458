/** A scene seen from above, small: furniture, tasks, paths, stones, people. Drawn from the document, so it is never out of date. */
import { html, type SVGTemplateResult, svg, type TemplateResult } from "lit";
import type { Scene } from "../../core/scene/types.ts";

const WIDTH = 88;
const HEIGHT = 56;

export function thumbnail(scene: Scene): TemplateResult {
  const places: [number, number][] = [
    scene.start.position,
    ...scene.tasks.map((t): [number, number] => [t.position[0], t.position[2]]),
    ...scene.props.map((p): [number, number] => [p.position[0], p.position[2]]),
    ...scene.paths.flatMap((p) => p.points),
    ...scene.stones.map((s): [number, number] => [s.position[0], s.position[2]]),
    ...(scene.crowd?.agents.map((a) => a.position) ?? []),
    ...(scene.crowd?.regions.flatMap((r): [number, number][] => [
      [r.bounds[0], r.bounds[2]],
      [r.bounds[1], r.bounds[3]],
    ]) ?? []),
  ];
  const xs = places.map((p) => p[0]);
  const zs = places.map((p) => p[1]);
  const [x0, x1] = [Math.min(...xs) - 0.8, Math.max(...xs) + 0.8];
  const [z0, z1] = [Math.min(...zs) - 0.8, Math.max(...zs) + 0.8];
  const scale = Math.min(WIDTH / (x1 - x0), HEIGHT / (z1 - z0));
  // As the room is first seen: +X to the left, +Z away.
  const x = (v: number): number => WIDTH / 2 - (v - (x0 + x1) / 2) * scale;
  const y = (v: number): number => HEIGHT / 2 - (v - (z0 + z1) / 2) * scale;
  const box = (p: Scene["props"][number]): SVGTemplateResult =>
    svg`<rect x=${-(p.size[0] * scale) / 2} y=${-Math.max(1, p.size[2] * scale) / 2} width=${p.size[0] * scale} height=${Math.max(1, p.size[2] * scale)} rx="1" transform="translate(${x(p.position[0])} ${y(p.position[2])}) rotate(${(-p.yaw * 180) / Math.PI})" class=${p.kind} />`;
  return html`<svg class="thumbnail" viewBox="0 0 ${WIDTH} ${HEIGHT}" width=${WIDTH} height=${HEIGHT} aria-hidden="true">
    ${scene.props.map(box)}
    ${scene.paths.map((p) => svg`<polyline points=${p.points.map((q) => `${x(q[0]).toFixed(1)},${y(q[1]).toFixed(1)}`).join(" ")} />`)}
    ${scene.stones.map((s) => svg`<circle cx=${x(s.position[0])} cy=${y(s.position[2])} r=${Math.max(1.4, 0.2 * scale)} class="stone" />`)}
    ${scene.crowd?.regions.map((r) => svg`<rect x=${Math.min(x(r.bounds[0]), x(r.bounds[1]))} y=${Math.min(y(r.bounds[2]), y(r.bounds[3]))} width=${Math.abs(x(r.bounds[1]) - x(r.bounds[0]))} height=${Math.abs(y(r.bounds[3]) - y(r.bounds[2]))} class="region" />`)}
    ${scene.crowd?.agents.slice(0, 300).map((a) => svg`<circle cx=${x(a.position[0])} cy=${y(a.position[1])} r="1.3" />`)}
    ${scene.tasks.map((t) => svg`<circle cx=${x(t.position[0])} cy=${y(t.position[2])} r="2.6" />`)}
    <circle cx=${x(scene.start.position[0])} cy=${y(scene.start.position[1])} r="2.2" class="start" />
  </svg>`;
}
