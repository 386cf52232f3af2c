// SPDX-License-Identifier: MIT
// ---- Several comparisons: one line each; the section of a comparison is loaded on demand.

const arriving = new Map();  // comparison -> what to do once its section is there

window.diptychSection = (index, html) => {
  document.getElementById('sections').insertAdjacentHTML('beforeend', html);
  for (const then of arriving.get(index) || []) then();
  arriving.delete(index);
};

function fetchSection(index, then) {
  const line = document.querySelector(`tr[data-comparison="${index}"]`);
  const inPage = document.getElementById('section-' + index);
  if (!line || arriving.has(index)) return;
  arriving.set(index, [then]);
  if (inPage) window.diptychSection(index, inPage.textContent);
  else if (line.dataset.section) addScript(line.dataset.section, () => { line.title = line.dataset.section + ' is not beside this page'; });
}

// Where the address leads: "#c0-lit" or "#c0-lit@247,89", a pixel of it.
function arrive() {
  const [, id, x, y] = location.hash.match(/^#?(.*?)(?:@(\d+),(\d+))?$/);
  const element = document.getElementById(id), comparison = /^(?:c|s|eye-)(\d+)/.exec(id);
  if (!element && comparison)
    return fetchSection(+comparison[1], () => { if (document.getElementById(id)) location.replace(location.href), arrive(); });
  if (!element) return;
  const card = element.matches('.card') && cardOf(element);
  if (card) {
    current = card;
    element.open = true;
    if (x !== undefined) card.look(+x, +y);
  }
  if (card && x !== undefined || comparison) element.scrollIntoView({ behavior: 'instant' });
}
addEventListener('hashchange', arrive);
arrive();

const index = document.querySelector('.index');
if (index) {
  const body = index.querySelector('tbody'), lines = [...body.rows], shown = index.querySelector('.shown');
  const filter = index.querySelector('[type=search]');
  filter.addEventListener('input', () => {
    const words = filter.value.toLowerCase().split(/\s+/);
    let count = 0;
    for (const line of lines) {
      line.search_text ??= line.textContent.toLowerCase();
      line.hidden = !words.every(word => line.search_text.includes(word));
      count += !line.hidden;
    }
    shown.textContent = count === lines.length ? '' : `${count} of ${lines.length}`;
  });
  index.querySelector('thead').addEventListener('click', event => {
    const head = event.target.closest('th');
    if (!head) return;
    const down = head.getAttribute('aria-sort') !== 'descending';
    for (const other of index.querySelectorAll('th')) other.removeAttribute('aria-sort');
    head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
    const key = line => line.cells[head.cellIndex].dataset.value ?? line.cells[head.cellIndex].textContent;
    const order = (a, b) => (isNaN(key(a)) || isNaN(key(b)) ? key(a).localeCompare(key(b)) : key(b) - key(a)) * (down ? 1 : -1);
    body.append(...lines.sort(order));
  });
}
