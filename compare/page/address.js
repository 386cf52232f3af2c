// SPDX-License-Identifier: MIT
// ---- The page's address encodes the view, so that a link restores it: "#c0-lit", "#c0-lit@247,89" (a
// pixel, enlarged), "#c0-lit@247,89?zoom=8&at=240.5,90&mode=right". at: the centre, in pixels; wipe:
// percent.

const rounded = number => +number.toFixed(2);

function addressOf(card) {
  const words = [], place = card.pinned ? '@' + card.pinned : '';
  if (card.zoom > 1 && !(card.pinned && card.looksAt(...card.pinned))) {
    const at = [(0.5 / card.zoom - card.x) * card.width - 0.5, (0.5 / card.zoom - card.y) * card.height - 0.5];
    words.push('zoom=' + rounded(card.zoom), 'at=' + at.map(rounded));
  } else if (card.zoom === 1 && card.pinned) {
    words.push('zoom=1');
  }
  if (card.mode === 'wipe') words.push('wipe=' + rounded(card.at));
  else if (card.mode !== 'side') words.push('mode=' + card.mode);
  return '#' + card.element.id + place + (words.length ? '?' + words.join('&') : '');
}

// Delayed: a drag changes much, and browsers reject frequent changes of the address.
let remembering;
function remember(card) {
  if (card !== current) return;
  clearTimeout(remembering);
  remembering = setTimeout(() => history.replaceState(null, '', addressOf(card)), 200);
}

function restore(card, pixel, words) {
  const mode = words.get('mode') ?? (words.has('wipe') ? 'wipe' : 'side'), zoom = +words.get('zoom'), at = words.get('at')?.split(',').map(Number);
  if (mode !== 'flicker' || !calm.matches && card.mode !== mode) card.show(mode, +(words.get('wipe') ?? 50));
  if (pixel && !zoom) return card.look(...pixel);
  if (pixel) card.pointAt(...pixel);
  card.pinned = pixel && card.pixel;
  card.zoomTo(zoom || 1);
  if (at) card.centre(...at);
}

function arrive() {
  const [, name, x, y, words] = location.hash.match(/^#?(.*?)(?:@(\d+),(\d+))?(?:\?(.*))?$/), id = decodeURIComponent(name);
  const element = document.getElementById(id), comparison = /^(?:c|s|eye-)(\d+)/.exec(id);
  if (!element && comparison)
    return fetchSection(+comparison[1], () => { if (document.getElementById(id)) location.replace(location.href), arrive(); });
  if (!element) return;
  const pixel = x === undefined ? null : [+x, +y];
  if (element.matches('.card')) element.open = true;
  const card = element.matches('.card') && cardOf(element);
  if (card) {
    current = card;
    if (pixel || words) restore(card, pixel, new URLSearchParams(words));
  }
  if (card && (pixel || words) || comparison) element.scrollIntoView({ behavior: 'instant' });
}
addEventListener('hashchange', arrive);
