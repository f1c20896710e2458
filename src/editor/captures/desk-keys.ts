/** Keys of the labelling desk; the help sheet shows the same list. */
import type { KeyBinding } from "../keys.ts";
import type { CaptureSession } from "./session.ts";

/** What a key does at the desk. */
interface DeskKey {
  shown: string;
  label: string;
  matches(ev: KeyboardEvent): boolean;
  run(s: CaptureSession, ev: KeyboardEvent): void;
}

const plain = (ev: KeyboardEvent): boolean => !ev.ctrlKey && !ev.metaKey && !ev.altKey;
const is =
  (...keys: string[]) =>
  (ev: KeyboardEvent): boolean =>
    plain(ev) && keys.includes(ev.key);
const ctrl =
  (key: string, shift: boolean) =>
  (ev: KeyboardEvent): boolean =>
    (ev.ctrlKey || ev.metaKey) && ev.shiftKey === shift && ev.key.toLowerCase() === key;

const KEYS: readonly DeskKey[] = [
  {
    shown: "1 to 4, up, down",
    label: "Track: left heel, left toe, right heel, right toe",
    matches: is("1", "2", "3", "4", "ArrowUp", "ArrowDown"),
    run(s, ev) {
      const edits = s.current?.edits;
      if (!edits) return;
      const by = ev.key === "ArrowUp" ? -1 : 1;
      edits.pick(ev.key.startsWith("Arrow") ? (edits.track + by + 4) % 4 : Number(ev.key) - 1);
      s.edited();
    },
  },
  {
    shown: "left, right; with Shift by 10",
    label: "Frame back, ahead",
    matches: is("ArrowLeft", "ArrowRight"),
    run(s, ev) {
      const by = (ev.key === "ArrowLeft" ? -1 : 1) * (ev.shiftKey ? 10 : 1);
      s.moveTo((s.current?.edits.cursor ?? 0) + by);
    },
  },
  {
    shown: "Home, End",
    label: "First, last frame of the segment",
    matches: is("Home", "End"),
    run: (s, ev) => s.moveTo(ev.key === "Home" ? s.stretch.first : s.stretch.last - 1),
  },
  {
    shown: "Space",
    label: "Brush down, up: arrows paint",
    matches: is(" "),
    run(s) {
      s.current?.edits.toggleBrush();
      s.edited();
    },
  },
  {
    shown: "[",
    label: "The plant begins here",
    matches: is("["),
    run(s) {
      s.current?.edits.startHere();
      s.edited();
    },
  },
  {
    shown: "]",
    label: "The plant ends here",
    matches: is("]"),
    run(s) {
      s.current?.edits.endHere();
      s.edited();
    },
  },
  {
    shown: "Delete",
    label: "Take the plant at the cursor away",
    matches: is("Delete", "Backspace"),
    run(s) {
      s.current?.edits.clearHere();
      s.edited();
    },
  },
  { shown: "K", label: "Play, pause the segment", matches: is("k", "K"), run: (s) => s.clock.toggle() },
  {
    shown: "Enter",
    label: "Confirm the segment, retrain, next",
    matches: is("Enter"),
    run: (s) => void s.confirm(),
  },
  { shown: "S", label: "Skip to the next segment", matches: is("s", "S"), run: (s) => s.skip() },
  {
    shown: "Ctrl Z",
    label: "Undo a label",
    matches: ctrl("z", false),
    run: (s) => s.step("undo"),
  },
  {
    shown: "Ctrl Shift Z",
    label: "Redo a label",
    matches: (ev) => ctrl("z", true)(ev) || ctrl("y", false)(ev),
    run: (s) => s.step("redo"),
  },
];

/** For the help sheet. */
export const deskKeySheet: readonly KeyBinding[] = KEYS.map((k) => ({
  keys: [],
  shown: k.shown,
  label: k.label,
  group: "Labels",
}));

/** @returns whether the key was used. */
export function deskKey(s: CaptureSession, ev: KeyboardEvent): boolean {
  if (!s.current) return false;
  const key = KEYS.find((k) => k.matches(ev));
  if (!key) return false;
  key.run(s, ev);
  return true;
}
