// SPDX-License-Identifier: MIT
// ---- Pointers: hover shows values, drag wipes or pans, two fingers zoom.

const panelOf = event => event.target.closest && event.target.closest('.card .panel');
const pointers = new Map();
let drag = null;  // { card, panel, kind, last }

function spread() {
  const [a, b] = [...pointers.values()];
  return { clientX: (a.clientX + b.clientX) / 2, clientY: (a.clientY + b.clientY) / 2,
           size: Math.max(Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY), 1) };
}

addEventListener('pointerdown', event => {
  const panel = panelOf(event), card = cardOf(panel);
  if (!card || event.button > 0) return;
  current = card;
  pointers.set(event.pointerId, event);
  if (event.isTrusted) panel.setPointerCapture(event.pointerId);  // a drag may leave the window
  card.point(panel, event);
  card.pinned = card.pixel;
  remember(card);
  (card.slider || panel).focus({ preventScroll: true });
  if (pointers.size === 2) {
    drag = { card, panel, kind: 'pinch', last: spread() };
    return;
  }
  const [fx] = card.place(panel, event), width = panel.clientWidth;
  const wipes = card.pair && card.pair.contains(panel) && card.mode !== 'side' &&
    (card.zoom === 1 || card.mode === 'wipe' && Math.abs(fx - card.at / 100) * width < 20);
  drag = { card, panel, kind: wipes ? 'wipe' : 'pan', last: event };
  if (wipes && event.pointerType !== 'touch') card.show('wipe', 100 * fx);
});

addEventListener('pointermove', event => {
  if (pointers.has(event.pointerId)) pointers.set(event.pointerId, event);
  const panel = panelOf(event);
  if (panel) (current = cardOf(panel)).point(panel, event);
  if (!drag || !pointers.has(event.pointerId)) return;
  const { card, last } = drag, now = drag.kind === 'pinch' ? spread() : event;
  const [fx, fy] = card.place(drag.panel, now);
  if (drag.kind === 'wipe') card.show('wipe', 100 * fx);
  else {
    const [lx, ly] = card.place(drag.panel, last);
    card.zoomTo(card.zoom * (drag.kind === 'pinch' ? now.size / last.size : 1), fx, fy, lx, ly);
  }
  drag.last = now;
});

for (const end of ['pointerup', 'pointercancel'])
  addEventListener(end, event => {
    if (!pointers.delete(event.pointerId) || !drag) return;
    drag = pointers.size === 1 ? { ...drag, kind: 'pan', last: [...pointers.values()][0] } : null;
  });
addEventListener('dragstart', event => { if (panelOf(event)) event.preventDefault(); });

// The wheel scrolls the page, unless the card has the focus or Ctrl is held.
addEventListener('wheel', event => {
  const panel = panelOf(event), card = cardOf(panel);
  if (!card || !(event.ctrlKey || card.element.contains(document.activeElement))) return;
  event.preventDefault();
  current = card;
  card.zoomTo(card.zoom * 2 ** (-event.deltaY * (event.deltaMode ? 16 : 1) / 240), ...card.place(panel, event));
}, { passive: false });

addEventListener('input', event => {
  if (event.target.matches('.pair input')) cardOf(event.target).show('wipe', +event.target.value);
});

// ---- Buttons and keys, listed in the page's legend.

const actions = {
  in: card => card.zoomTo(card.zoom * 1.5),
  out: card => card.zoomTo(card.zoom / 1.5),
  fit: card => card.zoomTo(1),
  next: card => card.step(1),
  previous: card => card.step(-1),
};

addEventListener('click', event => {
  const link = event.target.closest('[data-pixel]'), button = event.target.closest('button');
  const card = cardOf(event.target);
  if (link && card && !event.ctrlKey && !event.metaKey) {
    event.preventDefault();
    current = card;
    card.worst = [...card.element.querySelectorAll('[data-pixel]')].indexOf(link) - 1;
    card.step(1);
    card.element.querySelector('.pictures').scrollIntoView({ block: 'nearest' });
  }
  const opened = event.target.closest('.card:not([open]) > summary');
  if (card && (button || opened)) current = card;
  if (card && opened) remember(card);
  if (!button) return;
  if (button.dataset.show) card.show(button.dataset.show, button.dataset.show === 'wipe' ? 50 : undefined);
  else actions[button.dataset.do]?.(card);
});

// No animation starts by itself if the user prefers reduced motion.
const calm = matchMedia('(prefers-reduced-motion: reduce)');
const keys = {
  1: card => card.show('left'), 2: card => card.show('right'), w: card => card.show('wipe'),
  s: card => card.show('side'), f: card => { if (!calm.matches) card.show('flicker'); },
  Escape: card => { if (card.mode === 'flicker') card.show('flicker'); },
  '+': actions.in, '=': actions.in, '-': actions.out, 0: actions.fit, n: actions.next, p: actions.previous,
};
const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

addEventListener('keydown', event => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches?.('[type=search]')) return;
  const focused = cardOf(document.activeElement), card = focused || current;
  if (!card || !card.element.open) return;
  if (keys[event.key]) {
    keys[event.key](card);
  } else if (arrows[event.key] && focused && document.activeElement.matches('.panel, .pair input')) {
    const [dx, dy] = arrows[event.key], step = event.shiftKey ? 0.25 : 0.05;
    if (card.zoom > 1) card.moveTo(card.x - dx * step / card.zoom, card.y - dy * step / card.zoom);
    else if (card.mode === 'wipe' && dx) card.show('wipe', card.at + dx * (event.shiftKey ? 10 : 1));
    else return;
  } else {
    return;
  }
  event.preventDefault();
});

addEventListener('visibilitychange', () => {
  if (document.hidden && current && current.mode === 'flicker') current.show('flicker');
}, true);
addEventListener('toggle', event => {
  const card = event.target.matches('.card') && !event.target.open && cards.get(event.target);
  if (card && card.mode === 'flicker') card.show('flicker');
}, true);
addEventListener('beforeprint', () => {
  for (const numbers of document.querySelectorAll('.card[open] .more')) numbers.open = true;
});
addEventListener('load', event => {
  const panel = event.target.closest && event.target.closest('.panel');
  if (panel) cardOf(panel).sharpen(panel);
}, true);
addEventListener('resize', () => {
  for (const panel of document.querySelectorAll('.card[open] .panel')) cardOf(panel).sharpen(panel);
});
