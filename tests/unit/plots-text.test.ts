// @vitest-environment happy-dom
/** Names that people give to files, tasks, captures and styles stay text in every plot that shows them. */
import { expect, it } from "vitest";
import { figureBars } from "../../src/plots/figure-bars.ts";
import { figureLines } from "../../src/plots/figure-lines.ts";
import { footSpacePlot, weightBar } from "../../src/plots/foot-space.ts";
import { layerLine } from "../../src/plots/layer-line.ts";
import { learningCurve } from "../../src/plots/learning-curve.ts";
import { safe } from "../../src/plots/markup.ts";
import { objectivePlot } from "../../src/plots/objective.ts";
import { stylesSvg, trackSvg } from "../../src/plots/path-lanes.ts";
import { tasksSvg } from "../../src/plots/timeline-strip.ts";

const EVIL = `x"'><img src=x onerror="window.injected=true"></title></text><script>window.injected=true</script>&amp;`;
const x = (seconds: number): number => 100 * seconds;
const look = { colour: "red", line: "blue", pattern: "dashes" };
const points = [
  [1, 2],
  [2, 3],
] as const;

const plots: [name: string, markup: string][] = [
  [
    "figure bars",
    figureBars(
      [{ name: EVIL, unit: EVIL, value: 2, peer: { name: EVIL, value: 4 }, goal: EVIL, ok: true }],
      EVIL,
    ),
  ],
  ["figure lines", figureLines([{ name: EVIL, points }], EVIL, EVIL, EVIL)],
  [
    "foot space",
    footSpacePlot({
      points: [0, 0, 1, 0, 0, 1],
      triangles: [0, 1, 2],
      hull: [0, 1, 2],
      names: [EVIL, EVIL, EVIL],
      title: EVIL,
      hit: {
        query: [0.2, 0.2],
        landing: [0.2, 0.2],
        root: [0, 0],
        triangle: 0,
        clips: [0, 1, 2],
        weights: [0.6, 0.2, 0.2],
      },
    }),
  ],
  ["layer line", layerLine([[0, 1, 0]], EVIL, EVIL)],
  [
    "learning curve",
    learningCurve({
      width: 300,
      height: 200,
      range: [0, 5],
      xName: EVIL,
      last: EVIL,
      finding: EVIL,
      series: [{ name: EVIL, dashed: false, points }],
    }),
  ],
  [
    "objective",
    objectivePlot({
      rows: [
        [2, 1],
        [1, 0.5],
      ],
      names: [EVIL, EVIL],
    }),
  ],
  [
    "styles of a path",
    `<svg>${stylesSvg(
      [{ from: 0, to: 9, style: EVIL, look, change: EVIL, selected: false }],
      [{ from: 2, to: 3, change: EVIL, words: EVIL }],
      x,
    )}</svg>`,
  ],
  [
    "a track",
    `<svg>${trackSvg(
      { title: EVIL, unit: EVIL, values: new Float32Array([0, 1]), range: [0, 1], write: () => EVIL },
      x,
      40,
    )}</svg>`,
  ],
  [
    "tasks",
    `<svg>${tasksSvg([{ id: EVIL, word: EVIL, contact: 1, end: 9, selected: false, shape: "" }], x)}</svg>`,
  ],
];

it.each(plots)("%s", (_, markup) => {
  const page = document.createElement("div");
  page.innerHTML = markup;
  expect(page.querySelectorAll("img, script")).toHaveLength(0);
  expect([...page.querySelectorAll("*")].filter((el) => el.hasAttribute("onerror"))).toHaveLength(0);
  expect(markup).toContain(safe(EVIL));
  expect(markup).not.toContain(EVIL);
});

it("labels of weights neither leave the bar nor run into each other", () => {
  for (const lambda of [
    [0.88, 0.02, 0.1],
    [0.1, 0.1, 0.8],
    [1, 0, 0],
    [0.34, 0.33, 0.33],
  ]) {
    const places = [
      ...weightBar({ lambda, lambda4: 0, beta: 1 }).matchAll(/x="([\d.]+)" y="40">([^<]+)</g),
    ].map(([, at, text]) => [Number(at), Number(at) + 6 * text.length]);
    expect(places.length).toBeGreaterThan(0);
    places.forEach(([from, to], k) => {
      expect(from).toBeGreaterThanOrEqual(k === 0 ? 0 : places[k - 1][1]);
      expect(to).toBeLessThanOrEqual(272);
    });
  }
});
