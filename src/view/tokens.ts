/** Colours of the three-dimensional scene, light and dark. The same palette of categories in both. */
import type { StepCategory } from "../core/steps/types.ts";

export type Theme = "light" | "dark";

/** Fill of each step category; its mark is white or dark, whichever contrasts more. */
export const CATEGORY_COLOURS: Record<StepCategory, { fill: string; mark: string; code: string }> = {
  HeelPivot: { fill: "#64348a", mark: "#ffffff", code: "HP" },
  ToePivot: { fill: "#c8aff6", mark: "#14181d", code: "TP" },
  SideStep: { fill: "#f2c52e", mark: "#14181d", code: "SS" },
  TurnAndStep: { fill: "#d7652f", mark: "#14181d", code: "TS" },
  Walk: { fill: "#688ca3", mark: "#14181d", code: "W" },
  ForwardStepDuringTask: { fill: "#55d3b0", mark: "#14181d", code: "FT" },
  BackwardStepDuringTask: { fill: "#1f5e45", mark: "#ffffff", code: "BT" },
};

export const CATEGORY_WORDS: Record<StepCategory, string> = {
  HeelPivot: "Heel pivot",
  ToePivot: "Toe pivot",
  SideStep: "Side step",
  TurnAndStep: "Turn and step",
  Walk: "Walk",
  ForwardStepDuringTask: "Forward, at task",
  BackwardStepDuringTask: "Back, at task",
};

export interface RoomColours {
  wall: string;
  side: string;
  floor: string;
  fog: string;
  environment: number;
  hemisphere: [string, string, number];
  key: [string, number];
  fill: [string, number];
  shadow: number;
  grid: [string, number, number];
  exposure: number;
  body: string;
  ivory: string;
  hairline: string;
  hairlineOpacity: number;
  ink: string;
  paper: string;
}

export const ROOMS: Record<Theme, RoomColours> = {
  light: {
    wall: "#e7e6e2",
    side: "#e3e2df",
    floor: "#cbced0",
    fog: "#e5e4e1",
    environment: 0.34,
    hemisphere: ["#f3f7ff", "#cfc8bc", 0.8],
    key: ["#fff7ec", 1.75],
    fill: ["#eef2ff", 1.0],
    shadow: 0.6,
    grid: ["#1a2430", 0.1, 0.19],
    exposure: 0.92,
    body: "#77828e",
    ivory: "#f6f2ea",
    hairline: "#16191d",
    hairlineOpacity: 0.82,
    ink: "#16191d",
    paper: "#fbfbfa",
  },
  dark: {
    wall: "#555b64",
    side: "#50565f",
    floor: "#4a5059",
    fog: "#33373d",
    environment: 0.26,
    hemisphere: ["#9fb4d6", "#4a463f", 1.05],
    key: ["#ffe6c4", 1.9],
    fill: ["#8aa6d8", 0.8],
    shadow: 0.75,
    grid: ["#ffffff", 0.022, 0.05],
    exposure: 1.0,
    body: "#aab3bd",
    ivory: "#f1ece2",
    hairline: "#fbfbfa",
    hairlineOpacity: 0.9,
    ink: "#f2f1ed",
    paper: "#1d2025",
  },
};

/** Shoes: heel and toe piece of each foot. */
export const SHOES = {
  leftHeel: "#414d80",
  leftToe: "#8592c6",
  rightHeel: "#a0763f",
  rightToe: "#dcb981",
} as const;
