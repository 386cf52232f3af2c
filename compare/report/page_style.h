// SPDX-License-Identifier: MIT
// The page's style and script, as they stand in it.
#pragma once

namespace diptych {

inline constexpr const char* pageStyle = R"css(
:root {
  color-scheme: light dark;
  --paper: #f6f6f4; --card: #ffffff; --ink: #1b1c1f; --soft: #63666d; --line: #e0e0dc; --well: #eeeeea;
  --pass: #1a7f4b; --fail: #c62f2f; --only: #6b6f76; --accent: #2f62c4; --first: #4477c9; --second: #d08a2e;
}
@media (prefers-color-scheme: dark) {
  :root {
    --paper: #131416; --card: #1b1d20; --ink: #e6e7e9; --soft: #9a9ea6; --line: #2c2f34; --well: #24272b;
    --pass: #4cc38a; --fail: #ff6b66; --only: #8b9098; --accent: #86abf5; --first: #6f9be8; --second: #e0a552;
  }
}
* { box-sizing: border-box; }
html { scroll-behavior: smooth; -webkit-text-size-adjust: 100%; }
body { margin: 0 auto; max-width: 1320px; padding: 28px 24px 64px; background: var(--paper); color: var(--ink);
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", sans-serif; }
a { color: var(--accent); text-decoration: none; } a:hover { text-decoration: underline; }
h1 { font-size: 27px; line-height: 1.2; font-weight: 650; letter-spacing: -.015em; margin: 6px 0 4px; }
h2 { font-size: 19px; font-weight: 650; letter-spacing: -.01em; margin: 44px 0 12px; }
h3 { font-size: 17px; font-weight: 650; margin: 0; }
h4 { font-size: 12px; font-weight: 600; text-transform: uppercase; letter-spacing: .06em; color: var(--soft); margin: 0 0 8px; }
header { overflow-wrap: anywhere; }
p { margin: 0; } .soft { color: var(--soft); }
.mono, td.n, dd, .values { font-family: ui-monospace, "SF Mono", "Cascadia Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace;
  font-size: .88em; font-variant-numeric: tabular-nums; }
.brand { font-size: 12px; font-weight: 650; letter-spacing: .16em; text-transform: uppercase; color: var(--soft); }
.verdict { display: inline-block; padding: 2px 9px; border-radius: 99px; font-size: 12px; font-weight: 650; line-height: 1.45;
  color: var(--only); border: 1px solid currentColor; white-space: nowrap; }
.verdict.pass { color: var(--pass); } .verdict.fail { color: #fff; background: var(--fail); border-color: var(--fail); }
@media (prefers-color-scheme: dark) { .verdict.fail { color: #180606; } }
h1 .verdict { font-size: 17px; padding: 2px 14px; vertical-align: 3px; margin-right: 10px; }
.box { background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: 16px 18px; }
.failures { border-left: 4px solid var(--fail); margin-top: 20px; } .notes { border-left: 4px solid var(--line); margin-top: 14px; }
.failures ul, .notes ul { margin: 0; padding-left: 18px; } li + li { margin-top: 4px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; }
th { text-align: left; font-size: 12px; font-weight: 600; color: var(--soft); padding: 0 12px 6px 0; white-space: nowrap; }
td { padding: 6px 12px 6px 0; border-top: 1px solid var(--line); vertical-align: middle; white-space: nowrap; }
td:last-child, th:last-child { padding-right: 0; } td.n + td:not(.n), th.n + th:not(.n) { padding-left: 10px; } th.n, td.n { text-align: right; } td.wide { white-space: normal; }
tr.differs td { color: var(--accent); }
.meter { display: block; height: 6px; min-width: 90px; border-radius: 3px; background: var(--well); overflow: hidden; }
.meter i { display: block; height: 100%; background: var(--pass); } .meter.fail i { background: var(--fail); }
.card { margin-top: 16px; padding: 0; overflow: hidden; scroll-margin-top: 10px; } .card.fail { border-color: var(--fail); }
.card > summary { list-style: none; cursor: pointer; display: flex; flex-wrap: wrap; align-items: baseline; gap: 4px 12px; padding: 13px 18px; }
.card > summary::-webkit-details-marker { display: none; }
.card > summary .soft { font-size: 13px; } .card > summary .verdict { margin-left: auto; align-self: center; }
.card > summary:hover h3 { color: var(--accent); }
.card .body { padding: 0 18px 18px; } .card .reason { color: var(--fail); font-weight: 600; padding-bottom: 10px; }
.pictures { display: grid; grid-template-columns: minmax(0, 2fr) minmax(0, 1fr); gap: 18px; align-items: start; }
.pictures.one { grid-template-columns: minmax(0, 2fr); }
figure { margin: 0; } figcaption { font-size: 13px; color: var(--soft); margin-top: 7px; display: flex; flex-wrap: wrap; gap: 4px 12px; align-items: center; }
.stage { position: relative; overflow: hidden; border-radius: 5px; background: #000; line-height: 0; touch-action: pan-y; }
.stage { display: grid; align-items: center; min-height: 56px; }
.stage img { width: 100%; height: auto; display: block; } img.enlarged { image-rendering: pixelated; }
.pair { display: grid; gap: 3px; } .pair.wipe > .stage { grid-area: 1 / 1; }
.pair.wipe .left { z-index: 1; clip-path: inset(0 calc(100% - var(--w)) 0 0); }
.pair.side { grid-template-columns: 1fr 1fr; } .pair.side .divider, .pair.side input { display: none; }
.pair { position: relative; }
.pair .divider { position: absolute; z-index: 2; top: 0; bottom: 0; left: var(--w); width: 2px; margin-left: -1px; background: #fff;
  box-shadow: 0 0 0 1px #0006; pointer-events: none; }
.pair .divider::after { content: ""; position: absolute; top: 50%; left: 50%; width: 26px; height: 26px; margin: -13px; border-radius: 50%;
  background: #fff linear-gradient(90deg, #555, #555) center / 2px 12px no-repeat; box-shadow: 0 1px 4px #0008; }
.pair input { position: absolute; z-index: 3; inset: 0; width: 100%; height: 100%; margin: 0; opacity: 0; cursor: ew-resize; }
.pair input:focus-visible ~ .divider::after { outline: 3px solid var(--accent); }
.tag { position: absolute; top: 8px; padding: 1px 8px; border-radius: 4px; background: #000a; color: #fff; font-size: 12px; line-height: 1.6; }
.left .tag { left: 8px; } .right .tag { right: 8px; }
.worst { position: absolute; z-index: 2; width: 18px; height: 18px; margin: -9px; border: 2px solid #fff; border-radius: 50%;
  box-shadow: 0 0 0 1px #000, inset 0 0 0 1px #000; pointer-events: none; }
.buttons { display: inline-flex; border: 1px solid var(--line); border-radius: 6px; overflow: hidden; }
.buttons button { font: inherit; font-size: 12.5px; color: var(--soft); background: none; border: 0; padding: 3px 10px; cursor: pointer; }
.buttons button + button { border-left: 1px solid var(--line); }
.buttons button:hover, .buttons button.on { background: var(--well); color: var(--ink); }
.legend { flex: 1 1 100%; } .ramp { height: 9px; border-radius: 3px; } .ends { display: flex; justify-content: space-between; font-size: 12px; }
.swatch { display: inline-block; width: 10px; height: 10px; border-radius: 2px; margin-right: 5px; border: 1px solid #0004; vertical-align: -1px; }
dl { display: grid; grid-template-columns: auto 1fr; gap: 3px 14px; margin: 14px 0 0; font-size: 14px; }
dt { color: var(--soft); } dd { margin: 0; text-align: right; }
.because { margin-top: 14px; padding-top: 12px; border-top: 1px solid var(--line); font-size: 14px; }
.loupes { display: flex; flex-wrap: wrap; gap: 14px; margin-top: 14px; } .loupes figure { min-width: 180px; } .loupes figcaption { display: block; max-width: 300px; }
.loupe { position: relative; display: block; width: 136px; height: 136px; overflow: hidden; border-radius: 5px; background: var(--well); }
.loupe img { position: absolute; max-width: none; image-rendering: pixelated; }
.loupe::after { content: ""; position: absolute; left: 64px; top: 64px; width: 8px; height: 8px; outline: 1px solid #fff; box-shadow: 0 0 0 2px #000; }
.equal { padding: 26px 14px; text-align: center; border: 1px dashed var(--line); border-radius: 5px; color: var(--soft); font-size: 14px; }
.columns { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 440px), 1fr)); gap: 16px; align-items: start; }
.bar { display: block; height: 9px; border-radius: 2px; min-width: 1px; } .bar.a { background: var(--first); } .bar.b { background: var(--second); }
td.bars { width: 60%; } .settings { margin-top: 16px; } .settings .scroll { margin-top: 10px; } .camera { margin: 12px 2px; font-size: 13.5px; }
svg.sources { position: absolute; }
.marks { scroll-margin-top: 10px; } .marks > p { margin-bottom: 14px; }
.view { display: none; margin-bottom: 16px; padding: 14px; scroll-margin-top: 14px; }
.view:target, .views:not(:has(:target)) > .view:first-child { display: block; }
.view svg { display: block; width: 100%; max-height: 70vh; } .view.near svg { image-rendering: pixelated; }
.view rect { fill: none; vector-effect: non-scaling-stroke; } .view .under { stroke: #0009; stroke-width: 3px; }
.view .edge { stroke: #fff; stroke-width: 1px; }
.view figcaption { justify-content: space-between; font-size: 14px; color: var(--ink); } .view .legend { color: var(--soft); overflow-wrap: anywhere; }
.walk a { margin-left: 10px; }
.marks td { vertical-align: top; padding-right: 18px; } .marks td.wide { min-width: 240px; } .marks td br + .soft { font-size: 13px; } .marks tr.more td { border-top: 0; padding-top: 0; }
.place { display: inline-block; margin-right: 14px; } .place > * { overflow-wrap: anywhere; }
.place > * + * { margin-left: 5px; padding: 0 5px; border: 1px solid var(--line); border-radius: 4px; font-size: 12px; }
footer { margin-top: 48px; padding-top: 16px; border-top: 1px solid var(--line); font-size: 13px; color: var(--soft); }
footer a + a::before { content: "\00b7"; color: var(--soft); margin: 0 7px; }
@media (max-width: 800px) {
  body { padding: 18px 14px 48px; } h1 { font-size: 22px; }
  .pictures { grid-template-columns: minmax(0, 1fr); } .card .body { padding: 0 12px 14px; } .card > summary { padding: 12px; }
  .optional { display: none; }
  .box { padding: 12px; } th, td { padding-right: 8px; } th:first-child, td:first-child { white-space: normal; overflow-wrap: anywhere; }
  .view .pair.side { grid-template-columns: 1fr; } .walk a { margin: 0 10px 0 0; }
  .marks tr, .marks td { display: block; } .marks th, .marks tr.more td:first-child { display: none; }
  .marks td { border-top: 0; padding: 1px 0; } .marks tr + tr { border-top: 1px solid var(--line); padding: 8px 0; } .marks tr.more { border-top: 0; }
  .verdict { padding: 1px 6px; font-size: 11px; } td.n + td:not(.n), th.n + th:not(.n) { padding-left: 4px; }
}
@media print { .card { break-inside: avoid; } .buttons { display: none; } }
)css";

inline constexpr const char* pageScript = R"js(
for (const figure of document.querySelectorAll('.flip')) {
  const pair = figure.querySelector('.pair'), slider = figure.querySelector('input');
  const buttons = [...figure.querySelectorAll('button')];
  const show = (mode, at) => {
    pair.className = 'pair ' + mode;
    pair.style.setProperty('--w', at + '%');
    slider.value = at;
    buttons.forEach(b => b.classList.toggle('on', b.dataset.mode === mode && +b.dataset.at === at));
  };
  slider.addEventListener('input', () => show('wipe', +slider.value));
  buttons.forEach(b => b.addEventListener('click', () => show(b.dataset.mode, +b.dataset.at)));
}
const pixelate = img => img.classList.toggle('enlarged', img.clientWidth > +img.getAttribute('width'));
const sizes = new ResizeObserver(entries => entries.forEach(e => pixelate(e.target)));
document.querySelectorAll('.stage img').forEach(img => sizes.observe(img));
const open = () => { const card = document.getElementById(location.hash.slice(1)); if (card && card.tagName === 'DETAILS') card.open = true; };
addEventListener('hashchange', open); open();
)js";

}  // namespace diptych
