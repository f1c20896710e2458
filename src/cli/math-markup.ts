/**
 * Formulas as they are written in the lessons, made into MathML when the site is built: a small part of TeX.
 *
 * Known: letters, numbers, `+ - = < > ( ) [ ] | , . : ; / !`, `_`, `^`, `{ }`, Greek letters and the names in the tables here,
 * `\frac{}{}`, `\sqrt{}`, `\hat{}`, `\bar{}`, `\text{}`, `\op{}` (a name set upright), `\cases{a & b \\ c & d}`, and for live
 * figures `\val{name}` (a number that a figure fills in) and `\term{name}{...}` (a part that a figure points out).
 */

const SYMBOLS: Record<string, [tag: "mi" | "mo", text: string]> = {
  alpha: ["mi", "α"],
  beta: ["mi", "β"],
  gamma: ["mi", "γ"],
  delta: ["mi", "δ"],
  epsilon: ["mi", "ε"],
  theta: ["mi", "θ"],
  kappa: ["mi", "κ"],
  lambda: ["mi", "λ"],
  mu: ["mi", "μ"],
  pi: ["mi", "π"],
  rho: ["mi", "ρ"],
  sigma: ["mi", "σ"],
  tau: ["mi", "τ"],
  phi: ["mi", "φ"],
  psi: ["mi", "ψ"],
  omega: ["mi", "ω"],
  Delta: ["mi", "Δ"],
  infty: ["mi", "∞"],
  dots: ["mi", "…"],
  cdot: ["mo", "·"],
  times: ["mo", "×"],
  le: ["mo", "≤"],
  ge: ["mo", "≥"],
  lt: ["mo", "<"],
  gt: ["mo", ">"],
  ne: ["mo", "≠"],
  approx: ["mo", "≈"],
  in: ["mo", "∈"],
  to: ["mo", "→"],
  sum: ["mo", "∑"],
  partial: ["mo", "∂"],
  nabla: ["mo", "∇"],
  pm: ["mo", "±"],
  norm: ["mo", "‖"],
  cup: ["mo", "∪"],
  cap: ["mo", "∩"],
  min: ["mi", "min"],
  max: ["mi", "max"],
  sin: ["mi", "sin"],
  cos: ["mi", "cos"],
  tan: ["mi", "tan"],
  exp: ["mi", "exp"],
  log: ["mi", "log"],
};
const SPACES: Record<string, string> = { quad: "1em", ",": "0.17em", ";": "0.28em", " ": "0.25em" };
const ACCENTS: Record<string, string> = {
  hat: "^",
  bar: "\u00af",
  dot: "\u02d9",
  ddot: "\u00a8",
  vec: "\u2192",
};
const FUNCTIONS = new Set(["sin", "cos", "tan", "exp", "log", "min", "max"]);

const safe = (s: string): string => s.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

class Reader {
  private at = 0;

  constructor(
    private readonly text: string,
    private readonly display: boolean,
  ) {}

  private fail(what: string): never {
    throw new Error(`formula "${this.text}", character ${this.at + 1}: ${what}.`);
  }

  private skip(): void {
    while (/\s/.test(this.text[this.at] ?? "")) this.at++;
  }

  private name(): string {
    const letters = /^[A-Za-z]+/.exec(this.text.slice(this.at));
    const name = letters ? letters[0] : (this.text[this.at] ?? "");
    this.at += name.length;
    return name;
  }

  /** The raw text of a `{...}` group. */
  private raw(): string {
    this.skip();
    if (this.text[this.at] !== "{") this.fail("a group in braces is needed");
    let depth = 0;
    const from = this.at + 1;
    for (; this.at < this.text.length; this.at++) {
      if (this.text[this.at] === "{") depth++;
      else if (this.text[this.at] === "}" && --depth === 0) {
        this.at++;
        return this.text.slice(from, this.at - 1);
      }
    }
    return this.fail("a brace is not closed");
  }

  private group(): string {
    return new Reader(this.raw(), this.display).row();
  }

  private command(): string {
    const name = this.name();
    const symbol = SYMBOLS[name];
    if (symbol) {
      const [tag, text] = symbol;
      if (name === "norm") return `<mo stretchy="false">${text}</mo>`;
      return `<${tag}>${safe(text)}</${tag}>${FUNCTIONS.has(name) ? "<mo>&#x2061;</mo>" : ""}`;
    }
    if (name in SPACES) return `<mspace width="${SPACES[name]}"></mspace>`;
    if (name in ACCENTS)
      return `<mover accent="true">${this.group()}<mo stretchy="false">${ACCENTS[name]}</mo></mover>`;
    switch (name) {
      case "frac":
        return `<mfrac>${this.group()}${this.group()}</mfrac>`;
      case "sqrt":
        return `<msqrt>${this.group()}</msqrt>`;
      case "text":
        return `<mtext>${safe(this.raw())}</mtext>`;
      case "op":
        return `<mi mathvariant="normal">${safe(this.raw())}</mi>`;
      case "val":
        return `<mn data-value="${safe(this.raw())}">–</mn>`;
      case "term":
        return `<mrow data-term="${safe(this.raw())}">${this.group()}</mrow>`;
      case "cases":
        return this.cases();
      case "{":
      case "}":
        return `<mo stretchy="false">${name}</mo>`;
      default:
        return this.fail(`\\${name} is not known`);
    }
  }

  private cases(): string {
    const rows = this.raw()
      .split("\\\\")
      .map((line) => {
        const cells = line.split("&").map((cell) => `<mtd>${new Reader(cell, false).row()}</mtd>`);
        return `<mtr>${cells.join("")}</mtr>`;
      });
    return `<mrow><mo stretchy="true">{</mo><mtable columnalign="left">${rows.join("")}</mtable></mrow>`;
  }

  private atom(): string {
    this.skip();
    const c = this.text[this.at] ?? "";
    if (c === "{") return this.group();
    if (c === "\\") {
      this.at++;
      return this.command();
    }
    const number = /^\d+(?:\.\d+)?/.exec(this.text.slice(this.at));
    if (number) {
      this.at += number[0].length;
      return `<mn>${number[0]}</mn>`;
    }
    this.at++;
    if (/[A-Za-z]/.test(c)) return `<mi>${c}</mi>`;
    if (c === "-") return "<mo>−</mo>";
    if ("()[]".includes(c)) return `<mo stretchy="false">${c}</mo>`;
    // Bars stand close: which of two opens is not known, and as operators they would keep their distance.
    if (c === "|") return '<mo stretchy="false" lspace="0em" rspace="0em">|</mo>';
    if ("+=<>,.:;/!*°".includes(c)) return `<mo>${safe(c)}</mo>`;
    this.at--;
    return this.fail(`${JSON.stringify(c)} is not known`);
  }

  /** A base with its scripts. */
  private scripted(): string {
    // What follows a function's name (its invisible "apply") must stay outside of the scripts.
    const base = this.atom();
    const [core, after] = base.endsWith("<mo>&#x2061;</mo>")
      ? [base.slice(0, -"<mo>&#x2061;</mo>".length), "<mo>&#x2061;</mo>"]
      : [base, ""];
    let below: string | null = null;
    let above: string | null = null;
    for (;;) {
      this.skip();
      const c = this.text[this.at];
      if (c === "'") {
        this.at++;
        above = above === null ? "<mo>′</mo>" : `<mrow>${above}<mo>′</mo></mrow>`;
      } else if (c === "_" && below === null) {
        this.at++;
        below = this.atom();
      } else if (c === "^" && above === null) {
        this.at++;
        above = this.atom();
      } else break;
    }
    const limits = core === "<mo>∑</mo>" || core === "<mi>min</mi>" || core === "<mi>max</mi>";
    const under = limits && this.display;
    if (below !== null && above !== null)
      return `${under ? `<munderover>${core}${below}${above}</munderover>` : `<msubsup>${core}${below}${above}</msubsup>`}${after}`;
    if (below !== null)
      return `${under ? `<munder>${core}${below}</munder>` : `<msub>${core}${below}</msub>`}${after}`;
    if (above !== null) return `<msup>${core}${above}</msup>${after}`;
    return base;
  }

  row(): string {
    const out: string[] = [];
    this.skip();
    while (this.at < this.text.length) {
      out.push(this.scripted());
      this.skip();
    }
    return `<mrow>${out.join("")}</mrow>`;
  }
}

/** One formula as MathML. @throws Error that names the formula and the character. */
export function formula(text: string, display: boolean): string {
  const body = new Reader(text.trim(), display).row();
  return `<math${display ? ' display="block"' : ""}>${body}</math>`;
}

/** Every `\( ... \)` and `\[ ... \]` of a page made into MathML. */
export function withFormulas(html: string): string {
  return html
    .replace(/\\\[([\s\S]*?)\\\]/g, (_, text: string) => formula(plain(text), true))
    .replace(/\\\(([\s\S]*?)\\\)/g, (_, text: string) => formula(plain(text), false));
}

const plain = (s: string): string => s.replace(/&lt;/g, "<").replace(/&gt;/g, ">").replace(/&amp;/g, "&");
