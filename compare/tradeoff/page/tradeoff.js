// SPDX-License-Identifier: MIT
// After compare/page/tables.js and copy.js.
const $ = (selector, from = document) => from.querySelector(selector);
const $$ = (selector, from = document) => [...from.querySelectorAll(selector)];

// ---- The card of a row: hovering shows it; a click or the focus pins it.

const first = $('.row-card:not([hidden])')?.dataset.row;
let kept = $(`.row-card[data-row="${CSS.escape(choices.get('row') ?? '')}"]`)?.dataset.row ?? first;

function show(row) {
  for (const card of $$('.row-card')) card.hidden = card.dataset.row !== row;
  for (const element of $$('.point[data-row], tr[data-row]')) element.classList.toggle('on', element.dataset.row === row);
}
function keep(row) {
  show(kept = row);
  choose('row', row === first ? '' : row);
}
const rowOf = event => event.target.closest?.('.point[data-row], tr[data-row]')?.dataset.row;

addEventListener('pointerover', event => { if (event.target.closest?.('svg')) show(rowOf(event) ?? kept); });
addEventListener('focusin', event => { if (event.target.matches('.point')) keep(rowOf(event)); });
addEventListener('click', event => {
  const row = rowOf(event);
  if (!row || event.target.closest('a, button, code')) return;
  keep(row);
  if (event.target.closest('.rows')) $('.plots').scrollIntoView({ block: 'nearest' });
});
addEventListener('keydown', event => {
  if (!event.target.matches('.point') || event.key !== 'Enter' && event.key !== ' ') return;
  event.preventDefault();
  keep(rowOf(event));
});

// ---- The error metric of plots and cards.

function showError(button) {
  for (const other of $$('[data-shows]')) {
    other.classList.toggle('on', other === button);
    other.setAttribute('aria-pressed', other === button);
  }
  for (const element of $$('[data-figure]')) element.hidden = element.dataset.figure !== button.dataset.shows;
  show(kept);
  choose('error', button === $('[data-shows]') ? '' : button.dataset.shows);
}
for (const button of $$('[data-shows]')) button.addEventListener('click', () => showError(button));
showError($$('[data-shows]').find(button => button.dataset.shows === choices.get('error')) ?? $('[data-shows]'));
