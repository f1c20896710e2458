/** What is wrong to the eye on a page, found by measuring it: controls covered or off the page, text cut off, a page wider than its window. */
import type { Page } from "@playwright/test";

/** Letters of pictures that shrink with their box are not smaller than this, CSS pixels. */
const SMALLEST = 7.5;

/**
 * Sentences about a page as it stands, empty when nothing is wrong.
 *
 * A control counts as covered when none of five points of its visible part is its own: what is scrolled out of sight and what
 * floats in the three-dimensional view (handles may lie over each other there) is left out. Text counts as cut off when its box
 * hides what overflows and has no ellipsis, or when a picture ends in it. Letters of pictures have a least size.
 */
export function pageFaults(page: Page): Promise<string[]> {
  return page.evaluate((SMALLEST) => {
    const out: string[] = [];
    const name = (e: Element): string =>
      `${e.tagName.toLowerCase()} "${(e.getAttribute("aria-label") ?? e.textContent ?? "").trim().replace(/\s+/g, " ").slice(0, 40)}"`;
    const wide = document.documentElement.scrollWidth - window.innerWidth;
    if (wide > 0) out.push(`the page is ${wide} px wider than its window`);
    // A body that scrolls in a page that scrolls too leaves a blank end.
    const { body, documentElement } = document;
    const inner =
      getComputedStyle(documentElement).overflowY !== "visible" &&
      /auto|scroll/.test(getComputedStyle(body).overflowY) &&
      body.scrollHeight > body.clientHeight + 1;
    if (inner && documentElement.scrollHeight > window.innerHeight + 1)
      out.push("the page scrolls inside itself");

    /** The part of an element that its scrolling and clipping ancestors leave to be seen. */
    const above = (e: Element): Element | null =>
      e.parentElement ??
      (e.getRootNode() instanceof ShadowRoot ? (e.getRootNode() as ShadowRoot).host : null);
    const seen = (e: Element): DOMRect | null => {
      let box = e.getBoundingClientRect();
      for (let p = above(e); p && p !== document.documentElement; p = above(p)) {
        const { overflowX, overflowY } = getComputedStyle(p);
        if (overflowX === "visible" && overflowY === "visible") continue;
        const b = p.getBoundingClientRect();
        const left = overflowX === "visible" ? box.left : Math.max(box.left, b.left);
        const right = overflowX === "visible" ? box.right : Math.min(box.right, b.right);
        const top = overflowY === "visible" ? box.top : Math.max(box.top, b.top);
        const bottom = overflowY === "visible" ? box.bottom : Math.min(box.bottom, b.bottom);
        if (right - left < 2 || bottom - top < 2) return null;
        box = new DOMRect(left, top, right - left, bottom - top);
      }
      return box.width < 2 || box.height < 2 ? null : box;
    };
    /** Whether what is cut of a control at its side cannot be scrolled to. */
    const cut = (e: Element): boolean => {
      const box = e.getBoundingClientRect();
      for (let p = above(e); p && p !== document.documentElement; p = above(p)) {
        const { overflowX } = getComputedStyle(p);
        if (overflowX === "auto" || overflowX === "scroll") return false;
        const b = p.getBoundingClientRect();
        if (overflowX !== "visible" && (box.right > b.right + 2 || box.left < b.left - 2)) return true;
      }
      return false;
    };
    const hidden = (e: Element): boolean =>
      !e.checkVisibility({ opacityProperty: true, visibilityProperty: true });

    const roots: (Document | ShadowRoot)[] = [document];
    for (const root of roots)
      for (const e of root.querySelectorAll("*")) if (e.shadowRoot) roots.push(e.shadowRoot);
    const modal = document.querySelector("dialog[open], [role=dialog]");
    for (const root of roots) {
      for (const e of root.querySelectorAll<HTMLElement>(
        "button, input, select, a[href], summary, [role=slider]",
      )) {
        if (hidden(e) || e.closest(".overlay, svg") || (modal && !modal.contains(e))) continue;
        const box = seen(e);
        if (!box) continue;
        // A page is scrolled up and down; to the side nothing may stand.
        if (box.right > window.innerWidth + 0.5 || box.left < -0.5)
          out.push(`${name(e)} stands beyond the window's side`);
        if (cut(e)) out.push(`${name(e)} is cut off by what it lies in`);
        if (box.bottom < 0 || box.top > window.innerHeight) continue;
        const inset = 3;
        const points: [number, number][] = [
          [box.left + box.width / 2, box.top + box.height / 2],
          [box.left + inset, box.top + inset],
          [box.right - inset, box.top + inset],
          [box.left + inset, box.bottom - inset],
          [box.right - inset, box.bottom - inset],
        ];
        let own = 0;
        let by: Element | null = null;
        for (const [x, y] of points) {
          if (x < 0 || y < 0 || x >= window.innerWidth || y >= window.innerHeight) continue;
          const top = root.elementFromPoint(x, y);
          const label = (e as HTMLInputElement).labels?.[0];
          if (top && (e.contains(top) || top.contains(e) || label?.contains(top))) own++;
          else if (top) by ??= top;
        }
        if (own === 0 && by) out.push(`${name(e)} lies under ${name(by)}`);
      }
      for (const e of root.querySelectorAll<SVGTextElement>("svg text")) {
        const svg = e.ownerSVGElement;
        if (!svg || hidden(e) || getComputedStyle(svg).overflowX === "visible") continue;
        const [box, room] = [e.getBoundingClientRect(), svg.getBoundingClientRect()];
        if (box.width > 1 && room.width > 1 && (box.left < room.left - 1.5 || box.right > room.right + 1.5))
          out.push(`text "${e.textContent?.trim()}" is cut off by its picture`);
        const scale = e.getScreenCTM();
        const size =
          Number.parseFloat(getComputedStyle(e).fontSize) * Math.hypot(scale?.a ?? 1, scale?.b ?? 0);
        if (box.width > 1 && size < SMALLEST)
          out.push(`text "${e.textContent?.trim()}" is drawn ${size.toFixed(1)} px small`);
      }
      for (const e of root.querySelectorAll<HTMLElement>(
        "button, label, h1, h2, h3, p, span, td, th, figcaption, a",
      )) {
        if (hidden(e) || e.closest(".visually-hidden, svg, math")) continue;
        const s = getComputedStyle(e);
        if (s.overflowX === "visible" || s.textOverflow === "ellipsis" || s.display === "inline") continue;
        if (s.overflowX === "auto" || s.overflowX === "scroll") continue;
        if (e.scrollWidth > e.clientWidth + 1 && e.clientWidth > 4)
          out.push(`${name(e)} is cut off at its side`);
      }
    }
    return [...new Set(out)];
  }, SMALLEST);
}
