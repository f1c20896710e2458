/** How styles look: a colour and, as second cue, a line drawn in the band. */

/** Lines of bands, in the order in which the shader numbers them. */
export const STYLE_PATTERNS = [
  "straight",
  "dashes",
  "arches",
  "beads",
  "jagged",
  "zigzag",
  "wave",
  "rungs",
  "rails",
  "crosses",
] as const;
export type StylePattern = (typeof STYLE_PATTERNS)[number];

export interface StyleLook {
  colour: string;
  pattern: StylePattern;
  /** Colour of the line on it: dark or light, whichever stands out more. */
  line: string;
}

const DARK = "#14181d";
const LIGHT = "#ffffff";

const SHIPPED: Record<string, StyleLook> = {
  walking: { colour: "#9da4b9", pattern: "straight", line: DARK },
  jogging: { colour: "#1a70c6", pattern: "dashes", line: LIGHT },
  excited: { colour: "#d64961", pattern: "arches", line: DARK },
  balancing: { colour: "#78dab1", pattern: "beads", line: DARK },
  distressed: { colour: "#4a305c", pattern: "jagged", line: LIGHT },
  energetic: { colour: "#f9a51d", pattern: "zigzag", line: DARK },
  tired: { colour: "#773f12", pattern: "wave", line: LIGHT },
};

/**
 * Hues for a visitor's own styles: each at least 12 (CIEDE2000) from the seven above and from each other, for normal and
 * for protan, deutan and tritan sight [Machado 2009, full severity].
 */
const OWN: readonly (readonly [string, string])[] = [
  ["#d6e0eb", DARK],
  ["#1111d4", LIGHT],
  ["#bf89f5", DARK],
  ["#f5f589", DARK],
  ["#bd758d", DARK],
];
const OWN_PATTERNS: readonly StylePattern[] = ["rungs", "rails", "crosses", "dashes", "beads", "zigzag"];

/**
 * The look of a style.
 *
 * @param own the visitor's own styles in the order they came: the first ones take free hues, later ones the next line.
 */
export function styleLook(style: string, own: readonly string[] = []): StyleLook {
  const shipped = SHIPPED[style];
  if (shipped) return shipped;
  const k = Math.max(0, own.indexOf(style));
  const [colour, line] = OWN[k % OWN.length];
  return { colour, line, pattern: OWN_PATTERNS[Math.floor(k / OWN.length) % OWN_PATTERNS.length] };
}
