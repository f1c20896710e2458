/**
 * The captures that ship: performances after the set-ups of [TaskLoco Figure 13, Tables 1 and 3].
 *
 * (a) columns of writing places along a board; (b) a task in the middle, come to and left in every direction, turning
 * about at a spot between; (c) tasks beside each other at many distances, with quick taps and a follow-up known.
 */
import { wrapAngle } from "../core/math/angle.ts";
import { toWorld } from "../core/math/frame2.ts";
import { DEFAULT_PROPORTIONS, REFERENCE_HEIGHT } from "../core/skeleton/skeleton.ts";
import { type Goal, perform } from "./choreography/tasks.ts";
import { createWalker, finish } from "./choreography/walker.ts";
import { cyclicScores } from "./cycles.ts";
import type { Actor, Score } from "./score.ts";
import { STYLES, styleScore } from "./styles.ts";

const DEG = Math.PI / 180;
const ADULT: Actor = { height: REFERENCE_HEIGHT, proportions: DEFAULT_PROPORTIONS };

/** A performance: where it starts and the goals in their order; `seed` varies one step from the next. */
export function performance(
  name: string,
  seed: number,
  start: { x: number; z: number; yaw: number },
  goals: Goal[],
  actor = ADULT,
): Score {
  const w = createWalker(name, seed, start, actor);
  goals.forEach((g, i) => {
    perform(w, g, goals[i + 1] ?? null);
  });
  return finish(w);
}

const write = (x: number, y: number, more: Partial<Goal> = {}): Goal => ({
  category: "write",
  x,
  y,
  z: 0,
  yaw: 0,
  hold: 1.4,
  ...more,
});

/** (a) Along a board at z = 0, faced along +Z: places by their x; the body's left is +X. */
function columns(): Score[] {
  const tours: [string, [number, number][]][] = [
    [
      "near",
      [
        [0, 1.35],
        [0.3, 1.2],
        [0.75, 1.5],
        [0.5, 1.3],
        [0, 1.4],
        [-0.4, 1.25],
        [-0.65, 1.45],
        [-0.2, 1.1],
      ],
    ],
    [
      "middle",
      [
        [0, 1.3],
        [0.95, 1.45],
        [0, 1.2],
        [-1.1, 1.35],
        [0.15, 1.5],
        [1.4, 1.3],
        [0.55, 1.2],
      ],
    ],
    [
      "far",
      [
        [0, 1.4],
        [1.7, 1.3],
        [-0.4, 1.2],
        [-2.5, 1.45],
        [0.3, 1.3],
        [2.2, 1.35],
      ],
    ],
    [
      "steps",
      [
        [0, 1.3],
        [0.18, 1.5],
        [0.6, 1.1],
        [1.15, 1.4],
        [0.75, 1.2],
        [0.2, 1.5],
        [-0.45, 1.3],
      ],
    ],
  ];
  return tours.map(([name, places], i) =>
    performance(
      `write-columns-${name}`,
      11 + i,
      { x: 0.2 - 0.3 * i, z: -1.9, yaw: 0.1 * i },
      places.map(([x, y], k) => write(x, y, k === 3 ? { hold: 2.6 } : {})),
    ),
  );
}

/** (b) A task in the middle; out to a spot in one direction, turn about, and back from there. */
function directions(
  category: Goal["category"],
  name: string,
  seed: number,
  from: number[],
  distance: number[],
  extra: Partial<Goal>,
): Score {
  const goals: Goal[] = [];
  const centre = (k: number): Goal => ({
    category,
    x: 0,
    z: 0,
    yaw: 0,
    ...extra,
    ...(category === "lift" && k % 2 === 1 ? { category: "place" as const } : {}),
  });
  // Where the body stands for it, the origin of the directions.
  const stand = category === "sit" ? 0.35 : -0.45;
  from.forEach((deg, k) => {
    const a = deg * DEG;
    const d = distance[k % distance.length];
    const x = Math.sin(a) * d;
    const z = stand + Math.cos(a) * d;
    goals.push(centre(k));
    // Out there, then facing back.
    const back = wrapAngle(Math.atan2(-x, stand - z));
    goals.push({ category: "turn", x, z, yaw: back });
  });
  goals.push(centre(from.length));
  const first = from[from.length - 1] * DEG;
  return performance(
    name,
    seed,
    { x: Math.sin(first) * 2.3, z: stand + Math.cos(first) * 2.3, yaw: wrapAngle(first + Math.PI) },
    goals,
  );
}

/** (c) Boxes between tables: beside, behind, across. */
function boxes(): Score[] {
  const box = (category: "lift" | "place", x: number, z: number, yawDeg: number, y = 0.87): Goal => ({
    category,
    x,
    z,
    yaw: yawDeg * DEG,
    y,
  });
  return [
    performance("boxes-beside", 41, { x: 0.3, z: -1.8, yaw: 0 }, [
      box("lift", 0, 0, 0),
      box("place", 0.5, 0, 0),
      box("lift", 0.5, 0, 0),
      box("place", -0.3, 0, 0, 0.95),
      box("lift", -0.3, 0, 0, 0.95),
      box("place", 1.0, 0, 0),
      box("lift", 1.0, 0, 0),
      box("place", -0.6, 0, 0),
    ]),
    performance("boxes-behind", 42, { x: -0.5, z: -2, yaw: 0.2 }, [
      box("lift", 0, 0, 0),
      box("place", 0.2, -2.4, 180),
      box("lift", 0.2, -2.4, 180, 0.75),
      box("place", 0.6, 0, 0),
      box("lift", 0.6, 0, 0),
      box("place", 2.4, -1.2, 90),
      box("lift", 2.4, -1.2, 90),
      box("place", -1.6, -1.1, -90, 1.05),
    ]),
    performance("boxes-across", 43, { x: 1.5, z: -2, yaw: -0.5 }, [
      box("lift", 0, 0, 0, 0.6),
      box("place", -1.5, -1.0, -90),
      box("lift", -1.5, -1.0, -90),
      box("place", 0.4, 0.1, 20),
      box("lift", 0.4, 0.1, 20),
      box("place", 1.7, -1.4, 110, 0.8),
      box("lift", 1.7, -1.4, 110, 0.8),
      box("place", 0, -3.6, 180),
    ]),
  ];
}

/** (c) Quick taps with what follows known. */
function taps(): Score[] {
  const tap = (x: number, y: number, more: Partial<Goal> = {}): Goal => write(x, y, { effort: 0, ...more });
  return [
    performance("taps-on-the-way", 51, { x: 2.8, z: -1.2, yaw: -1.2 }, [
      tap(1.2, 1.35),
      write(-0.9, 1.3),
      tap(0.6, 1.4),
      write(2.3, 1.3),
      tap(0.9, 1.3),
      tap(-0.5, 1.4),
      write(-2.2, 1.35),
    ]),
    performance("taps-beside", 52, { x: 0, z: -1.7, yaw: 0 }, [
      write(0, 1.35),
      tap(0.75, 1.4),
      write(-1.0, 1.3),
      tap(-1.7, 1.3),
      write(0.4, 1.35),
      tap(-0.2, 1.45),
      write(1.3, 1.3),
    ]),
    performance("taps-and-leave", 53, { x: -2.4, z: -1.4, yaw: 1.3 }, [
      tap(-0.3, 1.4),
      { category: "turn", x: 2.2, z: -1.4, yaw: Math.PI },
      tap(0.4, 1.35),
      { category: "sit", x: -1.6, z: -1.7, yaw: 0.5, hold: 2.4 },
      tap(0.2, 1.3),
      write(1.6, 1.3),
    ]),
  ];
}

/** Between categories, and small steps at tasks. */
function mixed(): Score[] {
  const sit = (x: number, z: number, yawDeg: number, more: Partial<Goal> = {}): Goal => ({
    category: "sit",
    x,
    z,
    yaw: yawDeg * DEG,
    y: 0.46,
    hold: 2.4,
    ...more,
  });
  return [
    performance("write-sit-lift", 61, { x: 0, z: -2.2, yaw: 0 }, [
      write(0, 1.3, { adjust: 0.12 }),
      sit(1.6, -1.8, 200),
      { category: "lift", x: -1.4, z: -1.4, yaw: -90 * DEG, y: 0.87 },
      { category: "place", x: 1.8, z: -0.6, yaw: 90 * DEG, y: 0.87 },
      sit(0, -2.6, 0),
      write(0.4, 1.4, { adjust: 0.1 }),
    ]),
    performance("sit-here-and-there", 62, { x: -1.6, z: -1.4, yaw: 0.6 }, [
      sit(0, 0, 180),
      sit(1.8, -1.6, -90, { hold: 2.2 }),
      write(0.2, 1.35, { adjust: -0.1 }),
      sit(-1.4, -1.6, 100),
      { category: "stand", x: -1.1, z: -1.6, yaw: 100 * DEG },
      sit(0.6, -3, 30),
    ]),
    performance("lift-write-turn", 63, { x: 1.4, z: -2.2, yaw: -0.4 }, [
      { category: "lift", x: 0, z: 0, yaw: 0, y: 0.87, adjust: 0.1 },
      { category: "place", x: 0, z: -2.6, yaw: 180 * DEG, y: 0.8, adjust: 0.1 },
      write(1.4, 1.35, { z: 0.2, adjust: 0.12 }),
      { category: "turn", x: 1.0, z: -1.8, yaw: -100 * DEG },
      sit(-1.6, -1.6, 60),
      { category: "lift", x: 0, z: -2.6, yaw: 180 * DEG, y: 0.8 },
      { category: "place", x: 0, z: 0, yaw: 0, y: 0.87 },
    ]),
    performance("small-steps", 64, { x: 0, z: -1.6, yaw: 0 }, [
      write(0, 1.35, { adjust: 0.14 }),
      write(0.02, 1.5, { z: 0.12 }),
      write(0, 1.2, { z: -0.05 }),
      write(0.1, 1.4, { z: 0.1 }),
      write(0.05, 1.3, { z: -0.08 }),
      write(0.4, 1.35, { z: -0.08, adjust: 0.1 }),
      { category: "lift", x: 1.6, z: -0.8, yaw: 90 * DEG, y: 0.87, adjust: 0.14 },
      { category: "place", x: 1.72, z: -0.8, yaw: 90 * DEG, y: 0.87 },
      { category: "lift", x: 1.6, z: -0.8, yaw: 90 * DEG, y: 0.87 },
      { category: "place", x: -1.2, z: -1, yaw: -90 * DEG, y: 0.87, adjust: 0.14 },
      { category: "lift", x: -1.1, z: -1, yaw: -90 * DEG, y: 0.87 },
      { category: "place", x: -1.24, z: -1, yaw: -90 * DEG, y: 0.87 },
    ]),
    performance("steps-closer", 65, { x: -1, z: -2, yaw: 0.4 }, [
      write(0, 1.35, { adjust: 0.13 }),
      { category: "lift", x: 1.5, z: -1, yaw: 90 * DEG, y: 0.87, adjust: 0.11 },
      { category: "place", x: -1.4, z: -1.2, yaw: -90 * DEG, y: 0.87, adjust: 0.12 },
      write(0.6, 1.3, { adjust: 0.15 }),
      { category: "turn", x: 0.4, z: -2.4, yaw: 180 * DEG },
      write(-0.8, 1.4, { adjust: 0.1 }),
    ]),
  ];
}

/** Walking: straight, curved either way, turning about by every angle. */
function walks(): Score[] {
  const turn = (x: number, z: number, yawDeg: number, curve = 0): Goal => ({
    category: "turn",
    x,
    z,
    yaw: wrapAngle(yawDeg * DEG),
    curve,
  });
  return [
    performance("walk-and-turn", 71, { x: 0, z: 0, yaw: 0 }, [
      turn(0, 5.5, 90),
      turn(3.2, 5.5, 180),
      turn(3.2, 0.5, -60),
      turn(-0.5, 2.5, 180),
      turn(-0.5, -2.5, 0),
    ]),
    performance("walk-curves", 72, { x: 0, z: 0, yaw: 0.3 }, [
      turn(0, 6, 135, 0.14),
      turn(4, 2, -90, 0.12),
      turn(-1, 2, 45, -0.13),
      turn(3, 6, 190, -0.12),
    ]),
    performance("turn-about", 73, { x: 0, z: 0, yaw: 0 }, [
      turn(0, 2.4, -135),
      turn(-1.6, 0.8, 20),
      turn(-0.8, 2.8, -170),
      turn(-1.1, 0.4, 45),
      turn(0.8, 2.2, 170),
      turn(1.1, 0.2, -45),
    ]),
  ];
}

/** From standing in the open in every direction, near and far: how a scene's first walk, or one after standing, sets off. */
function standing(): Score[] {
  const tour = (name: string, seed: number, ways: [number, number][]): Score => {
    let at = { x: 0, z: 0, yaw: 0 };
    const goals = ways.map(([deg, distance], i): Goal => {
      const course = at.yaw + deg * DEG;
      at = {
        x: at.x + distance * Math.sin(course),
        z: at.z + distance * Math.cos(course),
        yaw: wrapAngle(course + (i % 2 === 0 ? 0.3 : -0.4)),
      };
      return { category: "stand", ...at };
    });
    return performance(name, seed, { x: 0, z: 0, yaw: 0 }, goals);
  };
  return [
    tour("stand-directions-1", 81, [
      [85, 1.8],
      [150, 2.6],
      [35, 1.5],
      [-120, 1.9],
      [175, 2.4],
      [60, 2.6],
    ]),
    tour("stand-directions-2", 82, [
      [120, 2.7],
      [-60, 1.6],
      [165, 1.6],
      [105, 1.5],
      [-20, 2.5],
      [140, 1.7],
    ]),
  ];
}

/** Two more people, shorter and taller, at every kind of task. */
function others(): Score[] {
  const people: [string, Actor][] = [
    ["short", { height: 1.55, proportions: { leg: 0.97, arm: 0.98, torso: 1.02 } }],
    ["tall", { height: 1.92, proportions: { leg: 1.03, arm: 1.02, torso: 0.98 } }],
  ];
  return people.flatMap(([who, actor], i) => {
    const k = actor.height / REFERENCE_HEIGHT;
    return [
      performance(
        `${who}-write-sit`,
        301 + 10 * i,
        { x: 0.4, z: -2, yaw: 0 },
        [
          write(0, 1.35 * k),
          write(0.7, 1.3 * k),
          write(-0.9, 1.4 * k),
          { category: "sit", x: 1.4, z: -1.8, yaw: 200 * DEG, y: 0.46, hold: 2.2 },
          write(-0.2, 1.3 * k, { effort: 0 }),
          { category: "turn", x: 0.4, z: -2.4, yaw: -120 * DEG },
        ],
        actor,
      ),
      performance(
        `${who}-boxes`,
        302 + 10 * i,
        { x: -0.4, z: -2, yaw: 0.2 },
        [
          { category: "lift", x: 0, z: 0, yaw: 0, y: 0.87 },
          { category: "place", x: 1.4, z: -1.2, yaw: 90 * DEG, y: 0.8 },
          { category: "lift", x: 1.4, z: -1.2, yaw: 90 * DEG, y: 0.8 },
          { category: "place", x: 0, z: 0, yaw: 0, y: 0.87 },
        ],
        actor,
      ),
      performance(
        `${who}-walk`,
        303 + 10 * i,
        { x: 0, z: 0, yaw: 0 },
        [
          { category: "turn", x: 0, z: 4.5, yaw: 120 * DEG },
          { category: "turn", x: 2.4, z: 1.2, yaw: Math.PI, curve: 0.12 },
        ],
        actor,
      ),
    ];
  });
}

/** Every capture that ships: the tasks' set, the styles' straight samples, the cyclic clips, two more actors. */
export function everyScore(): { name: string; score: Score }[] {
  const more = [...STYLES.map(styleScore), ...cyclicScores(), ...others()];
  return [...studioSet(), ...more.map((score) => ({ name: score.name, score }))];
}

/** The scores of the task library, in a fixed order. */
export function studioSet(): { name: string; score: Score }[] {
  const centre = toWorld({ x: 0, z: 0, yaw: 0 }, { x: 0, z: 0, yaw: 0 });
  const scores = [
    ...columns(),
    directions("write", "write-directions-1", 21, [150, -120, 180, 95], [1.7, 2.4], {
      ...centre,
      y: 1.35,
      hold: 1.4,
    }),
    directions("write", "write-directions-2", 22, [-150, 120, -95, 165], [2.6, 1.6], {
      ...centre,
      y: 1.3,
      hold: 1.4,
      hand: "right",
    }),
    directions("lift", "box-directions-1", 31, [180, -110, 140], [1.8, 2.5], { ...centre, y: 0.87 }),
    directions("lift", "box-directions-2", 32, [110, -140, -165], [2.4, 1.7], { ...centre, y: 0.8 }),
    directions("sit", "sit-directions-1", 33, [0, 75, -120, 20], [1.9, 2.3], {
      ...centre,
      y: 0.46,
      hold: 2.4,
    }),
    directions("sit", "sit-directions-2", 34, [-45, 120, -80, 165], [2.2, 1.8], {
      ...centre,
      y: 0.48,
      hold: 2.4,
    }),
    ...boxes(),
    ...taps(),
    ...mixed(),
    ...walks(),
    ...standing(),
  ];
  return scores.map((score) => ({ name: score.name, score }));
}
