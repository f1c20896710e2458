/**
 * "Predict the next foot": some footsteps are shown, the reader points at where the next one will be, and sees where it is and
 * how far off the guess was. Nothing is kept or sent.
 */
import { extent } from "d3-array";
import { el, svgEl } from "../../embed/dom.ts";
import { Floor, type FloorPrint } from "./floor.ts";
import { fixed } from "./numbers.ts";

export interface NextFoot {
  /** Footsteps in order of landing; the last one is asked for. */
  steps: readonly FloorPrint[];
  /** Why it lands there, a sentence or two. */
  because: string;
  /** Drawn behind the footprints, when there is something to aim at. */
  scenery?: (floor: Floor) => void;
}

/** Good enough to have understood, metres. */
const NEAR = 0.15;
/** Room around what is in the picture, metres. */
const AROUND = 0.6;

/** Puts one question after another into a box. */
export function nextFootCheckpoint(box: HTMLElement, questions: readonly NextFoot[]): void {
  let at = 0;
  const ask = (): void => {
    box.replaceChildren(
      question(
        questions[at],
        questions.length > 1
          ? () => {
              at = (at + 1) % questions.length;
              ask();
            }
          : null,
      ),
    );
  };
  if (questions.length > 0) ask();
}

function question(q: NextFoot, onwards: (() => void) | null): HTMLElement {
  const answer = q.steps[q.steps.length - 1];
  const shown = q.steps.slice(0, -1);
  const last = shown[shown.length - 1];
  let guess: [number, number] = [last.x, last.z + 0.3];
  // All of the last footprints are in the picture, and the cross where it begins.
  const seen = [...q.steps.slice(-5), { x: guess[0], z: guess[1] }];
  const [left, right] = extent(seen, (s) => s.x) as [number, number];
  const [near, far] = extent(seen, (s) => s.z) as [number, number];
  const aspect = 0.56;
  const floor = new Floor(
    {
      x: (left + right) / 2,
      z: (near + far) / 2,
      width: Math.max(3.4, right - left + AROUND, (far - near + AROUND) / aspect),
      aspect,
    },
    `Footsteps seen from above. Where does the ${answer.foot} foot come down next?`,
  );
  q.scenery?.(floor);
  for (const s of shown)
    floor.prints.append(floor.print(s, { fill: s.foot === "left" ? "var(--left)" : "var(--right)" }));
  const cross = svgEl("g", { class: "handle" });
  const arm = 9;
  cross.append(svgEl("path", { class: "ink", d: `M-${arm} 0H${arm}M0-${arm}V${arm}`, "stroke-width": 2 }));
  const verdict = el("p", { role: "status" });
  const place = (): void =>
    cross.setAttribute("transform", `translate(${floor.px(guess[0])} ${floor.py(guess[1])})`);
  const check = el("button", { class: "act", type: "button" }, "Check");
  const row = el("div", { class: "row" }, check);
  let done = false;
  floor.svg.setAttribute("tabindex", "0");
  floor.svg.setAttribute("role", "application");
  floor.svg.addEventListener("pointerdown", (e) => {
    if (done) return;
    guess = floor.at(e);
    place();
  });
  floor.svg.addEventListener("keydown", (e) => {
    const way = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[e.key];
    if (done || (!way && e.key !== "Enter")) return;
    e.preventDefault();
    if (!way) {
      check.click();
      return;
    }
    guess = [guess[0] + way[0] * 0.05, guess[1] + way[1] * 0.05];
    place();
  });
  check.addEventListener("click", () => {
    if (done) return;
    done = true;
    check.disabled = true;
    floor.front.append(
      floor.print(answer, { fill: answer.foot === "left" ? "var(--left)" : "var(--right)", class: "strong" }),
    );
    const off = Math.hypot(guess[0] - answer.x, guess[1] - answer.z);
    const how = off <= NEAR ? "Well seen" : off <= 2 * NEAR ? "Nearly" : "Not there";
    verdict.textContent = `${how}: ${fixed(off, 2)} m away. ${q.because}`;
    if (onwards) {
      const more = el("button", { class: "act", type: "button" }, "Another");
      more.addEventListener("click", onwards);
      row.append(more);
      more.focus({ preventScroll: true });
    }
  });
  place();
  floor.handles.append(cross);
  return el(
    "div",
    { class: "checkpoint" },
    el("h3", {}, "Predict the next foot"),
    el(
      "span",
      {},
      `Point at where the ankle of the ${answer.foot} foot comes to rest, or move the cross with the arrow keys.`,
    ),
    floor.svg,
    row,
    verdict,
  );
}
