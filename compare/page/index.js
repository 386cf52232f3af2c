// SPDX-License-Identifier: MIT
// ---- Several comparisons: one row each; sections are loaded on demand.

const arriving = new Map();  // comparison -> function to call once its section is loaded

const escaped = text => text.replace(/[&<>"]/g, c => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);

// `which`: a comparison's index. In a report joined from parts: the section's file, which contains no
// index and title.
window.diptychSection = (which, html) => {
  const line = isNaN(which) && document.querySelector(`tr[data-section="${CSS.escape(which)}"]`);
  const index = line ? +line.dataset.comparison : which;
  if (line) html = html.replaceAll('\x01', index).replaceAll('\x02', escaped(line.dataset.title));
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
  else if (line.dataset.section) addScript(line.dataset.section, () => { line.title = line.dataset.section + ' is missing beside this page'; });
}

fillShared(document);
arrive();

// ---- The table of comparisons: filters, and the metrics of one channel in a column.

// A channel's entry: its verdict, then these.
const figures = ['of its limit', 'max', 'mean', 'rmse', 'p99', 'p99.9', 'FLIP'];
const threeDigits = value => value >= 1e300 ? 'inf' : value === 0 || Math.abs(value) >= 1e-4 && Math.abs(value) < 1e4 ? String(+value.toPrecision(3)) : value.toExponential(2).replace(/\.?0+e/, 'e');

class Index {
  constructor(element) {
    this.element = element;
    this.table = element.querySelector('table');
    this.lines = [...element.querySelectorAll('tbody tr')];
    this.shown = element.querySelector('.shown');
    this.filter = element.querySelector('[type=search]');
    this.heads = [...this.table.tHead.rows[0].cells];
    this.column = this.heads.findIndex(head => head.textContent === 'lit max');
    this.selects = Object.fromEntries([...element.querySelectorAll('select')].map(select => [select.dataset.by, select]));
    for (const [name, select] of Object.entries(this.selects)) {
      if (choices.has(name)) select.value = choices.get(name);
      select.addEventListener('change', () => this.chosen());
    }
    this.filter.value = choices.get('filter') ?? '';
    this.filter.addEventListener('input', () => this.narrow());
    if (this.selects.channel.value || this.selects.figure.value !== 'max') this.fill();
    if ([...choices.keys()].some(name => name === 'filter' || this.selects[name])) this.narrow();
  }

  // Parsed at first use.
  get all() { return this.figures ??= JSON.parse(document.getElementById('figures').textContent); }

  // The channel in the metric column; lit by default.
  get channel() { return this.selects.channel.value || 'lit'; }

  of(line) { return this.all[line.dataset.comparison]?.[this.channel]; }

  chosen() {
    for (const [name, select] of Object.entries(this.selects)) choose(name, name === 'figure' && select.value === 'max' ? '' : select.value);
    this.fill();
    this.narrow();
  }

  fill() {
    if (this.column < 0) return;
    const figure = this.selects.figure.value, at = figures.indexOf(figure) + 1;
    const name = figure === 'of its limit' ? `${this.channel}, of its limit` : `${this.channel} ${figure}`;
    this.heads[this.column].querySelector('button').textContent = name;
    for (const line of this.lines) {
      const cell = line.cells[this.column], value = this.of(line)?.[at] ?? 0;
      cell.dataset.value = Math.max(value, 0);
      cell.dataset.head = name;
      cell.textContent = value < 0 ? '' : figure === 'of its limit' ? (value < 1e300 ? threeDigits(100 * value) + ' %' : 'beyond') : threeDigits(value);
    }
    if (this.heads[this.column].hasAttribute('aria-sort')) this.sorted?.();
  }

  // If a channel is chosen, pass and fail are the channel's.
  has(line, verdict) {
    if (!verdict) return true;
    const channel = this.selects.channel.value;
    const fails = channel ? this.of(line)?.[0] === 1 : line.querySelector('.verdict').textContent === 'fail';
    return fails === (verdict === 'fail');
  }

  narrow() {
    const words = this.filter.value.toLowerCase().split(/\s+/), verdict = this.selects.verdict.value;
    const wanted = ['camera', 'cause', 'since'].filter(name => this.selects[name]?.value).map(name => [name, this.selects[name].value]);
    let count = 0;
    for (const line of this.lines) {
      line.search_text ??= line.textContent.toLowerCase();
      line.hidden = !words.every(word => line.search_text.includes(word)) || !this.has(line, verdict) ||
        !wanted.every(([name, value]) => line.dataset[name] === value);
      count += !line.hidden;
    }
    this.shown.textContent = count === this.lines.length ? '' : `${count} of ${this.lines.length}`;
    choose('filter', this.filter.value);
  }
}

const index = document.querySelector('.index');
if (index) {
  const table = new Index(index);
  table.sorted = sortable(index.querySelector('table'), true);
}
