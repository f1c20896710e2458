/** The element's style sheet: put in with `adoptedStyleSheets`, which strict policies allow. Tokens as on the editor's page. */
export const STYLES = `
:host {
  --paper: #fbfbfa; --raised: #fff; --well: #ededea; --line: #e2e2df; --edge: #8c9197;
  --ink: #16191d; --ink-2: #474d55; --ink-3: #666d76; --on: #fff; --danger: #b3261e; --room: #e5e4e1;
  display: flex; flex-direction: column; position: relative; box-sizing: border-box; overflow: hidden;
  aspect-ratio: 16 / 9; min-height: 200px; background: var(--paper); color: var(--ink);
  font: 400 13px/20px system-ui, sans-serif; font-variant-numeric: tabular-nums; container-type: inline-size;
}
:host([hidden]) { display: none; }
:host([data-theme="dark"]) {
  --paper: #1d2025; --raised: #272b31; --well: #15181c; --line: #30353c; --edge: #6f7680;
  --ink: #f2f1ed; --ink-2: #bcc1c8; --ink-3: #959ca5; --on: #16191d; --danger: #ff9389; --room: #33373d;
}
* { box-sizing: border-box; }
.view { position: relative; flex: 1 1 auto; min-height: 0; background: var(--room); overflow: hidden; }
canvas { position: absolute; inset: 0; width: 100%; height: 100%; display: block; touch-action: pan-y; outline-offset: -4px; }
svg.plan { position: absolute; inset: 0; width: 100%; height: 100%; stroke: none; background: var(--room); }
.plan .floor line { stroke: var(--ink); stroke-opacity: 0.1; stroke-width: 0.01; }
.plan .prop { fill: var(--raised); stroke: var(--edge); stroke-width: 0.02; }
.plan .wall, .plan .pillar { fill: var(--edge); }
.plan .stone { fill: var(--well); stroke: var(--edge); stroke-width: 0.02; }
.plan .path { fill: none; stroke: var(--edge); stroke-width: 0.06; }
.plan .ring { fill: none; stroke: var(--ink); stroke-width: 0.012; stroke-opacity: 0.45; }
.plan .ring.chosen { stroke-opacity: 1; fill: var(--ink); fill-opacity: 0.1; }
.plan .print { stroke: var(--ink); stroke-opacity: 0.82; stroke-width: 8; }
.plan .figure { fill: var(--ink-3); stroke: var(--paper); stroke-width: 0.015; }
.view .note { position: absolute; left: 12px; bottom: 10px; margin: 0; padding: 2px 8px; border-radius: 6px; background: var(--paper); color: var(--ink-2); font-size: 12px; line-height: 18px; max-width: calc(100% - 24px); }
.view .note[hidden] { display: none; }
.overlay { position: absolute; inset: 0; pointer-events: none; overflow: hidden; }
.overlay > * { pointer-events: auto; }
.marker {
  position: absolute; left: -22px; top: -22px; width: 44px; height: 44px; padding: 0; border: 0; background: none;
  color: var(--ink); cursor: grab; display: grid; place-items: center; touch-action: none; border-radius: 50%;
}
.marker .ball {
  width: 28px; height: 28px; border-radius: 50%; background: var(--paper); border: 1.5px solid var(--ink);
  display: grid; place-items: center; box-shadow: 0 1px 4px rgb(0 0 0 / 18%); grid-area: 1 / 1;
}
.marker:hover .ball { box-shadow: 0 0 0 8px color-mix(in srgb, var(--ink) 12%, transparent); border-width: 2px; }
.marker:focus-visible .ball, .marker.dragging .ball { background: var(--ink); color: var(--on); box-shadow: 0 0 0 2.5px var(--paper), 0 0 0 4px var(--ink); }
.marker.dragging { cursor: grabbing; }
.marker .tick {
  grid-area: 1 / 1; width: 12px; height: 11px; background: var(--ink); clip-path: polygon(50% 0, 100% 100%, 0 100%); cursor: crosshair;
}
.marker svg { width: 16px; height: 16px; }
svg { fill: none; stroke: currentColor; stroke-width: 1.5; stroke-linecap: round; stroke-linejoin: round; }
svg.solid { fill: currentColor; stroke: none; }
.tip {
  position: absolute; left: 0; top: 0; padding: 3px 10px; border-radius: 9px; background: var(--ink); color: var(--on);
  white-space: nowrap; pointer-events: none; font-size: 12px;
}
.tip[hidden] { display: none; }
.bar {
  flex: 0 0 48px; display: flex; align-items: center; gap: 12px; padding: 0 10px;
  border-top: 1px solid var(--line); background: var(--paper); min-width: 0;
}
.bar[hidden] { display: none; }
button.tool {
  flex: none; height: 32px; min-width: 36px; padding: 0 10px; display: inline-flex; align-items: center; justify-content: center; gap: 8px;
  font: 500 13px/20px system-ui, sans-serif; border: 0; border-radius: 7px; background: none; color: var(--ink); cursor: pointer;
}
button.tool svg { width: 18px; height: 18px; }
button.tool:hover { background: color-mix(in srgb, var(--ink) 5.5%, transparent); }
button.tool.primary { background: var(--ink); color: var(--on); }
button.tool.primary:hover { background: color-mix(in srgb, var(--ink) 88%, var(--paper)); }
button.tool.outlined { box-shadow: inset 0 0 0 1px var(--line); }
button.tool:disabled { color: color-mix(in srgb, var(--ink) 38%, transparent); cursor: default; background: none; }
a.tool {
  flex: none; height: 32px; padding: 0 10px; display: inline-flex; align-items: center; gap: 8px; border-radius: 7px;
  font-weight: 500; color: var(--ink); text-decoration: none; box-shadow: inset 0 0 0 1px var(--line);
}
a.tool svg { width: 18px; height: 18px; }
a.tool:hover { background: color-mix(in srgb, var(--ink) 5.5%, transparent); }
:focus-visible { outline: 2px solid var(--ink); outline-offset: 2px; }
.strip { flex: 1 1 auto; min-width: 0; height: 35px; cursor: pointer; touch-action: none; border-radius: 4px; overflow: hidden; }
.strip svg { display: block; }
.strip rect { stroke: color-mix(in srgb, var(--ink) 55%, transparent); stroke-width: .8; }
.strip rect.start { fill: var(--well); }
.strip .halo { stroke: var(--paper); stroke-width: 4.5; stroke-linecap: butt; }
.strip .now { stroke: var(--ink); stroke-width: 1.5; stroke-linecap: butt; }
.clock { flex: none; font: 500 12px/16px ui-monospace, monospace; white-space: nowrap; margin-inline-start: auto; }
.clock span { color: var(--ink-3); font-weight: 400; }
.say {
  position: absolute; left: 12px; right: 12px; top: 12px; max-width: 480px; margin: 0 auto; padding: 8px 12px; border-radius: 9px;
  background: var(--paper); box-shadow: 0 0 0 1px var(--line), 0 4px 14px rgb(0 0 0 / 10%); color: var(--danger); z-index: 2;
}
.say[hidden] { display: none; }
.wait { position: absolute; left: 12px; bottom: 10px; font-size: 12px; color: var(--ink-2); pointer-events: none; }
.wait[hidden] { display: none; }
.panels { flex: none; display: flex; gap: 24px; padding: 10px 16px 12px; border-top: 1px solid var(--line); overflow-x: auto; background: var(--paper); }
.panels[hidden] { display: none; }
.panels section { flex: 1 1 240px; min-width: 220px; max-width: 320px; }
.panels h3 { margin: 0 0 4px; font: 600 12px/16px system-ui, sans-serif; }
.panels p { margin: 2px 0 0; color: var(--ink-3); font-size: 12px; line-height: 16px; }
.panels svg { width: 100%; height: auto; display: block; stroke: none; font: 11px system-ui, sans-serif; color: var(--ink); }
.panels svg text { fill: var(--ink-3); }
.panels svg text.strong { fill: var(--ink); font-weight: 600; }
.panels svg .axis { stroke: var(--line); }
.panels table { border-collapse: collapse; width: 100%; font-size: 12px; }
.panels td { padding: 1px 6px 1px 0; color: var(--ink-2); }
.panels td:last-child { text-align: right; }
.panels .swatch { width: 10px; height: 10px; display: inline-block; border-radius: 3px; margin-inline-end: 6px; }
img.still { position: absolute; inset: 0; width: 100%; height: 100%; object-fit: cover; display: none; }
@media print { img.still { display: block; } .bar, .overlay, .wait { display: none; } }
.hidden { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
@container (max-width: 419px) { .strip { display: none; } a.tool span, button.tool span { display: none; } }
@media (pointer: coarse) { button.tool, a.tool { height: 44px; min-width: 44px; } }
@media (forced-colors: active) { button.tool.primary { border: 1px solid; } .marker .ball { border-color: ButtonText; } }
`;
