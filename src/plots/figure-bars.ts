/** Measured figures beside their peers as bars: pure data in, SVG markup out. */
import { max } from "d3-array";
import { scaleLinear } from "d3-scale";
import { safe } from "./markup.ts";

export interface FigureBar {
  name: string;
  unit: string;
  value: number;
  /** What it is compared with; null when with nothing. */
  peer: { name: string; value: number } | null;
  goal: string | null;
  ok: boolean | null;
}

const short = (v: number): string => (Math.abs(v) >= 100 ? v.toFixed(0) : v.toPrecision(3));

/** SVG markup that stands alone, 720 wide: for each figure its bar and its peer's on a scale of their own, from 0. */
export function figureBars(bars: readonly FigureBar[], title: string): string {
  const width = 720;
  const left = 12;
  const row = 58;
  const height = 40 + row * bars.length;
  const out: string[] = [`<text x="${left}" y="24" font-size="16" font-weight="600">${safe(title)}</text>`];
  bars.forEach((b, i) => {
    const y = 40 + i * row;
    const x = scaleLinear([0, max([b.value, b.peer?.value ?? 0]) || 1], [0, 420]);
    const goal = b.goal === null ? "" : `, goal ${b.goal}: ${b.ok ? "met" : "not met"}`;
    out.push(
      `<text x="${left}" y="${y + 12}">${safe(`${b.name}${goal}`)}</text>`,
      `<rect x="${left}" y="${y + 18}" width="${x(b.value).toFixed(1)}" height="12" rx="3" fill="#2f6f8f"/>`,
      `<text x="${(left + x(b.value) + 6).toFixed(1)}" y="${y + 28}">${safe(`${short(b.value)} ${b.unit}`)}</text>`,
    );
    if (b.peer)
      out.push(
        `<rect x="${left}" y="${y + 34}" width="${x(b.peer.value).toFixed(1)}" height="12" rx="3" fill="#b9bec4"/>`,
        `<text x="${(left + x(b.peer.value) + 6).toFixed(1)}" y="${y + 44}">${safe(`${short(b.peer.value)} ${b.unit}, ${b.peer.name}`)}</text>`,
      );
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" font-family="system-ui, sans-serif" font-size="12" fill="#16191d" role="img" aria-label="${safe(title)}"><rect width="${width}" height="${height}" fill="#fff"/>${out.join("")}</svg>\n`;
}
