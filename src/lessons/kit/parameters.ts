/**
 * What a reader can change in a lesson: named numbers with bounds. An address may preset them (`?k=5`), lock them (`&lock=k`, or `all`),
 * and the present state can be written as such an address again. Nothing is stored.
 */

export interface ParameterSpec {
  name: string;
  value: number;
  min: number;
  max: number;
  step: number;
}

interface Parameter extends ParameterSpec {
  /** The lesson's own value, without the address. */
  original: number;
  /** What reset goes back to. */
  start: number;
}

export class Parameters {
  private readonly all = new Map<string, Parameter>();
  private readonly listeners = new Map<string, Set<() => void>>();
  private readonly locks: Set<string>;

  /** @param query of the page's address. */
  constructor(private readonly query: URLSearchParams) {
    this.locks = new Set((query.get("lock") ?? "").split(",").filter(Boolean));
  }

  /** Makes a parameter known. Presets outside of its bounds are held to them; those that are no numbers are ignored. */
  declare(spec: ParameterSpec): void {
    const preset = Number(this.query.get(spec.name) ?? Number.NaN);
    const start = Number.isFinite(preset) ? Math.max(spec.min, Math.min(spec.max, preset)) : spec.value;
    this.all.set(spec.name, { ...spec, original: spec.value, start, value: start });
  }

  private of(name: string): Parameter {
    const p = this.all.get(name);
    if (!p) throw new Error(`${name}: no such parameter was declared.`);
    return p;
  }

  get(name: string): number {
    return this.of(name).value;
  }
  spec(name: string): ParameterSpec {
    return this.of(name);
  }
  locked(name: string): boolean {
    return this.locks.has("all") || this.locks.has(name) || this.locks.has(name.split(".")[0]);
  }

  /** Sets a value, held to its bounds; a locked one stays. @returns whether anything changed. */
  set(name: string, value: number): boolean {
    const p = this.of(name);
    if (this.locked(name) || !Number.isFinite(value)) return false;
    const held = Math.max(p.min, Math.min(p.max, value));
    if (held === p.value) return false;
    p.value = held;
    this.tell(name);
    return true;
  }

  /** Calls back when any of the names changes; a name stands for all that begin with it and a dot. */
  watch(names: readonly string[], heard: () => void): void {
    for (const name of names) {
      const set = this.listeners.get(name) ?? new Set();
      set.add(heard);
      this.listeners.set(name, set);
    }
  }

  private tell(name: string): void {
    const heard = new Set([
      ...(this.listeners.get(name) ?? []),
      ...(this.listeners.get(name.split(".")[0]) ?? []),
    ]);
    for (const f of heard) f();
  }

  /** Back to where the page began: all, or those of a list. */
  reset(names: readonly string[] = [...this.all.keys()]): void {
    for (const name of names) {
      const p = this.of(name);
      if (p.value === p.start) continue;
      p.value = p.start;
      this.tell(name);
    }
  }

  /** The part of an address that presets the present state; locks stay. */
  queryText(): string {
    const out = new URLSearchParams();
    for (const p of this.all.values())
      if (p.value !== p.original) out.set(p.name, String(Math.round(p.value * 1000) / 1000));
    if (this.locks.size > 0) out.set("lock", [...this.locks].join(","));
    return out.toString();
  }
}
