// SPDX-License-Identifier: MIT
// ---- Several comparisons: one line each; the section of a comparison is loaded on demand.

const arriving = new Map();  // comparison -> what to do once its section is there

window.diptychSection = (index, html) => {
  const sections = document.getElementById('sections');
  sections.insertAdjacentHTML('beforeend', html);
  prepare(sections.lastElementChild);
  fillShared(sections.lastElementChild);
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

fillShared(document);
arrive();

const index = document.querySelector('.index');
if (index) {
  const lines = [...index.querySelectorAll('tbody tr')], shown = index.querySelector('.shown');
  const filter = index.querySelector('[type=search]');
  const narrow = () => {
    const words = filter.value.toLowerCase().split(/\s+/);
    let count = 0;
    for (const line of lines) {
      line.search_text ??= line.textContent.toLowerCase();
      line.hidden = !words.every(word => line.search_text.includes(word));
      count += !line.hidden;
    }
    shown.textContent = count === lines.length ? '' : `${count} of ${lines.length}`;
    choose('filter', filter.value);
  };
  filter.addEventListener('input', narrow);
  filter.value = choices.get('filter') ?? '';
  if (filter.value) narrow();
  sortable(index.querySelector('table'), true);
}
