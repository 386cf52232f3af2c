// SPDX-License-Identifier: MIT
// After compare/page/tables.js.
const $ = (selector, from = document) => from.querySelector(selector);
const $$ = (selector, from = document) => [...from.querySelectorAll(selector)];

// ---- The card of a row: shown by pointing at it, kept by a click.

let kept = $('.row-card:not([hidden])')?.dataset.row;

function show(row) {
  for (const card of $$('.row-card')) card.hidden = card.dataset.row !== row;
  for (const element of $$('.point[data-row], .rows tbody tr')) element.classList.toggle('on', element.dataset.row === row);
}
const rowOf = event => event.target.closest?.('.point[data-row], .rows tbody tr')?.dataset.row;

addEventListener('pointerover', event => { if (event.target.closest?.('svg')) show(rowOf(event) ?? kept); });
addEventListener('focusin', event => { if (event.target.matches('.point')) show(kept = rowOf(event)); });
addEventListener('click', event => {
  if (event.target.closest('button[data-do=copy]')) return copy(event.target.closest('button'));
  const row = rowOf(event);
  if (!row || event.target.closest('a, button, code')) return;
  show(kept = row);
  if (event.target.closest('.rows')) $('.plots').scrollIntoView({ block: 'nearest' });
});
addEventListener('keydown', event => {
  if (!event.target.matches('.point') || event.key !== 'Enter' && event.key !== ' ') return;
  event.preventDefault();
  show(kept = rowOf(event));
});

async function copy(button) {
  const code = $('code', button.parentElement);
  getSelection().selectAllChildren(code);  // without access to the clipboard the user only has to press Ctrl+C
  try {
    await navigator.clipboard.writeText(code.textContent);
    button.textContent = 'copied';
  } catch {
    button.textContent = 'selected';
  }
}

// ---- Which error is shown.

for (const button of $$('[data-shows]'))
  button.addEventListener('click', () => {
    for (const other of $$('[data-shows]')) {
      other.classList.toggle('on', other === button);
      other.setAttribute('aria-pressed', other === button);
    }
    for (const element of $$('[data-figure]')) element.hidden = element.dataset.figure !== button.dataset.shows;
    show(kept);
  });

// ---- The table in another order.

const body = $('.rows tbody');
for (const head of $$('.rows th'))
  head.addEventListener('click', () => {
    const down = head.getAttribute('aria-sort') === 'ascending';
    for (const other of $$('.rows th')) other.removeAttribute('aria-sort');
    head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
    const key = line => line.cells[head.cellIndex].dataset.value ?? line.cells[head.cellIndex].textContent;
    const order = (a, b) => isNaN(key(a)) || isNaN(key(b)) ? key(a).localeCompare(key(b)) : key(a) - key(b);
    body.append(...[...body.rows].sort((a, b) => order(a, b) * (down ? -1 : 1)));
  });

show(kept);
