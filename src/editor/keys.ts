/** Keys of the whole page: one list that the page obeys and the help sheet shows. */
import type { Editor } from "./editor.ts";

export interface KeyBinding {
  /** "Space", ",", "Delete", "Ctrl+Z", "Shift+R", "?"; several may do the same. Empty: shown in the sheet, handled elsewhere. */
  keys: readonly string[];
  /** As the sheet shows it, where that differs: "arrows". */
  shown?: string;
  label: string;
  group: "Tools" | "Selected" | "Time" | "Scene" | "Labels";
  when?(e: Editor): boolean;
  run?(e: Editor): void;
}

/** Where arrows move things on the floor, x and z: up is away from the viewer. */
export const ARROWS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
  ArrowLeft: [1, 0],
  ArrowRight: [-1, 0],
};

/** "Ctrl+Shift+Z" of an event; Command counts as Ctrl, Shift only with letters and named keys. */
export function chord(ev: KeyboardEvent): string {
  const key = ev.key === " " ? "Space" : ev.key.length === 1 ? ev.key.toUpperCase() : ev.key;
  const shift = ev.shiftKey && (key.length > 1 || /[A-Z]/.test(key));
  return `${ev.ctrlKey || ev.metaKey ? "Ctrl+" : ""}${ev.altKey ? "Alt+" : ""}${shift ? "Shift+" : ""}${key}`;
}

/** Tools and choices may do without a key. */
const keyed = (key: string): string[] => (key === "" ? [] : [key]);

/** Every key, those of the tools first. */
export function allKeys(e: Editor): readonly KeyBinding[] {
  const tools: KeyBinding[] = e.registry.tools.flatMap((t) => [
    { keys: keyed(t.key), label: t.label, group: "Tools" as const, run: (x: Editor) => x.tools.use(t.id) },
    ...(t.choices ?? []).map((c) => ({
      keys: keyed(c.key),
      label: `${t.label}: ${c.label.toLowerCase()}`,
      group: "Tools" as const,
      run: (x: Editor) => x.tools.use(t.id, c.id),
    })),
  ]);
  return [...tools, ...e.registry.keys];
}

/** Handles a key of the page; fields, menus and dialogs keep theirs. */
export function pageKey(e: Editor, ev: KeyboardEvent): void {
  const target = ev.target as HTMLElement;
  if (target.closest("input, select, textarea, dialog") || ev.defaultPrevented) return;
  // Nothing behind an open dialog is in reach, wherever the focus is; Escape closes it.
  if (document.querySelector("dialog:modal")) return;
  const pressed = chord(ev);
  // A control that has the focus keeps its space bar; handles over the stage do not need it.
  if (pressed === "Space" && target.closest("button:not(.marker), [role=button], [role=slider]")) return;
  // Menus have keys of their own.
  if (pressed !== "Escape" && target.closest(".menu")) return;
  if (e.tools.keydown(ev)) {
    ev.preventDefault();
    return;
  }
  const binding = allKeys(e).find((b) => b.keys.includes(pressed) && b.run && b.when?.(e) !== false);
  if (!binding) return;
  ev.preventDefault();
  binding.run?.(e);
}
