/** The lines of styles' bands as SVG: pattern and colours in, markup out. The floor draws the same lines in its shader. */

export interface BandLook {
  colour: string;
  line: string;
  /** A pattern's name; an unknown one is drawn straight. */
  pattern: string;
}

const n = (v: number): string => v.toFixed(1);
const wave = (u: number): number => Math.abs(2 * (u - Math.floor(u)) - 1);

/** Height of a pattern's line about the band's middle, as a share of the band's height; u in band heights along it. */
const LINES: Record<string, (u: number) => number> = {
  arches: (u) => 0.22 - 0.44 * Math.abs(Math.sin((u * Math.PI) / 0.62)),
  jagged: (u) => (wave(u / 0.45) - 0.5) * (0.28 + 0.42 * wave(u / 1.23)),
  zigzag: (u) => (wave(u / 0.62) - 0.5) * 0.5,
  wave: (u) => -0.2 * Math.sin((u * 2 * Math.PI) / 1.9 + 0.5 * Math.sin((u * 2 * Math.PI) / 1.9)),
};

/** The line of a pattern from x = `left` on over `width`, in a band of `height` whose top is `top`. */
export function patternSvg(look: BandLook, left: number, top: number, width: number, height: number): string {
  const middle = top + height / 2;
  const right = left + width;
  if (width < 2) return "";
  const stroke = `fill="none" stroke="${look.line}" stroke-opacity="0.75" stroke-width="1.4"`;
  const line = LINES[look.pattern];
  if (line) {
    const points: string[] = [];
    const step = look.pattern === "zigzag" || look.pattern === "jagged" ? height * 0.0775 : 2;
    for (let x = left; x < right; x += step)
      points.push(`${n(x)} ${n(middle + height * line((x - left) / height))}`);
    return `<path d="M${points.join("L")}" ${stroke} stroke-linejoin="round"/>`;
  }
  switch (look.pattern) {
    case "dashes":
      return `<path d="M${n(left)} ${n(middle)}H${n(right)}" ${stroke} stroke-dasharray="${n(height * 0.55)} ${n(height * 0.3)}"/>`;
    case "beads":
      return `<path d="M${n(left + 3)} ${n(middle)}H${n(right)}" ${stroke} style="stroke-width:4;stroke-linecap:round;stroke-dasharray:0.1 ${n(height * 0.4)}"/>`;
    case "rails":
      return `<path d="M${n(left)} ${n(middle - 3)}H${n(right)}M${n(left)} ${n(middle + 3)}H${n(right)}" ${stroke}/>`;
    case "rungs":
      return `<path d="M${n(left)} ${n(middle)}H${n(right)}" fill="none" stroke="${look.line}" stroke-opacity="0.75" stroke-width="${n(height * 0.5)}" stroke-dasharray="1.4 6"/>`;
    case "crosses": {
      const marks: string[] = [];
      for (let x = left + 8; x < right - 4; x += 14)
        marks.push(`M${n(x - 3)} ${n(middle - 3)}l6 6M${n(x + 3)} ${n(middle - 3)}l-6 6`);
      return `<path d="${marks.join("")}" ${stroke}/>`;
    }
    default:
      return `<path d="M${n(left)} ${n(middle)}H${n(right)}" ${stroke}/>`;
  }
}

/** A swatch: band and line in a small rounded rectangle. */
export function swatchSvg(look: BandLook, width: number, height: number): string {
  return `<svg width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" aria-hidden="true"><rect width="${width}" height="${height}" rx="4" fill="${look.colour}"/>${patternSvg(look, 0, 0, width, height)}</svg>`;
}
