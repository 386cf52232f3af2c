// SPDX-License-Identifier: MIT
// ---- Several comparisons: one line each; the section of a comparison is loaded on demand.

const arriving = new Map();  // comparison -> what to do once its section is there

window.diptychSection = (index, html) => {
  const sections = document.getElementById('sections');
  sections.insertAdjacentHTML('beforeend', html);
  prepare(sections.lastElementChild);
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
