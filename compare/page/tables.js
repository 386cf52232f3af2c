// SPDX-License-Identifier: MIT
'use strict';

// ---- Tables: aligns decimal points, and stores the column's head in each cell, for narrow pages that
// show rows as lists.

const plainNumber = /^-?\d+(\.\d+)?(e[+-]?\d+)?( ?(%|[KMGT]?i?B|\u00b0))?$/;
const fraction = text => text.length - (text.match(/^-?\d+/)?.[0].length ?? text.length);

function prepareTable(table) {
  const heads = [...table.querySelectorAll('thead th, tr:first-child th')].map(head => head.textContent);
  const columns = [];
  for (const row of table.rows) {
    let column = 0;
    for (const cell of row.cells) {
      if (cell.matches('td')) {
        if (heads[column]) cell.dataset.head = heads[column];
        if (cell.matches('.n') && plainNumber.test(cell.textContent)) (columns[column] ??= []).push(cell);
      }
      column += cell.colSpan;
    }
  }
  for (const cells of columns.filter(Boolean)) {
    const widths = cells.map(cell => fraction(cell.textContent)), most = Math.max(...widths);
    const pad = i => Object.assign(document.createElement('span'), { className: 'pad', textContent: '\u00a0'.repeat(most - widths[i]) });
    cells.forEach((cell, i) => { if (widths[i] < most) cell.append(pad(i)); });
  }
}

// ---- One tab stop for a table, a list, a row of buttons or a plot; arrows move inside.

const groups = 'table, .buttons, .worst ol, svg.chart';
const stops = 'a[href], button, .point[tabindex]';
const stopsOf = group => [...group.querySelectorAll(stops)];

// Adds a link that skips a table or plot with arrow keys; it is visible while it has the focus.
function addSkip(group) {
  const whole = group.closest('.scroll') ?? group, after = document.createElement('span'), link = document.createElement('a');
  after.tabIndex = -1;
  after.id = 'after-' + document.querySelectorAll('.skip').length;
  Object.assign(link, { className: 'skip here', href: '#' + after.id, textContent: `Skip the ${group.matches('svg') ? 'plot' : 'table'}` });
  // Keeps the address.
  link.addEventListener('click', event => { event.preventDefault(); after.focus(); });
  whole.before(link);
  whole.after(after);
}

// At once, except for tables of more than 500 rows, which wait until the page is loaded.
function soonFor(element, then) {
  if (!(element.rows?.length > 500)) then(element);
  else if (document.readyState === 'complete') setTimeout(then, 0, element);
  else addEventListener('load', () => setTimeout(then, 0, element));
}

function prepareGroup(group) {
  const inside = stopsOf(group);
  inside.forEach((stop, i) => { stop.tabIndex = i ? -1 : 0; });
  if (inside.length > 1 && group.matches('table, svg')) addSkip(group);
}

function prepare(root) {
  for (const table of root.querySelectorAll('table')) soonFor(table, prepareTable);
  for (const group of root.querySelectorAll(groups)) soonFor(group, prepareGroup);
}

addEventListener('focusin', event => {
  const group = event.target.matches(stops) && event.target.closest(groups);
  if (!group) return;
  for (const stop of stopsOf(group)) stop.tabIndex = -1;
  event.target.tabIndex = 0;
});

const middle = element => {
  const box = element.getBoundingClientRect();
  return [box.left + box.width / 2, box.top + box.height / 2];
};

// Left and right: the neighbour in reading order, in a plot the next in time. Up and down: the nearest one
// above or below.
function neighbour(group, from, key) {
  const seen = stopsOf(group).filter(stop => stop.getBoundingClientRect().height > 0);
  const [x, y] = middle(from), across = { ArrowLeft: -1, ArrowRight: 1 }[key], down = { ArrowUp: -1, ArrowDown: 1 }[key];
  if (key === 'Home' || key === 'End') return seen.at(key === 'Home' ? 0 : -1);
  if (across) {
    if (group.matches('svg')) seen.sort((a, b) => middle(a)[0] - middle(b)[0]);
    return seen[seen.indexOf(from) + across];
  }
  if (!down) return undefined;
  const far = stop => (middle(stop)[1] - y) * down;
  const least = group.matches('svg') ? 0 : from.getBoundingClientRect().height / 2;
  const beyond = seen.filter(stop => stop !== from && far(stop) > least);
  const cost = stop => far(stop) * 4 + Math.abs(middle(stop)[0] - x);
  return beyond.sort((a, b) => cost(a) - cost(b))[0];
}

addEventListener('keydown', event => {
  const group = event.target.matches?.(stops) && event.target.closest(groups);
  if (!group || event.ctrlKey || event.metaKey || event.altKey) return;
  const next = neighbour(group, event.target, event.key);
  if (!next) return;
  event.preventDefault();
  event.stopImmediatePropagation();
  next.focus();
});

// ---- The page's choices are stored in its address, before the "#", so that a link restores them.

const choices = new URLSearchParams(location.search);
let writing;
function choose(name, value) {
  if ((choices.get(name) ?? '') === value) return;
  if (value) choices.set(name, value);
  else choices.delete(name);
  clearTimeout(writing);  // delayed: browsers reject frequent changes of the address
  writing = setTimeout(() => history.replaceState(null, '', (choices.size ? '?' + choices : location.pathname) + location.hash), 200);
}

// Makes a table sortable by its heads. `sort`: name of the first column to sort by, with "-" for
// descending. `down`: the first click on a head sorts in descending order.
function sortable(table, down) {
  const body = table.tBodies[0], heads = [...table.tHead.rows[0].cells];
  const sort = (head, order) => {
    for (const other of heads) other.removeAttribute('aria-sort');
    head.setAttribute('aria-sort', order < 0 ? 'descending' : 'ascending');
    const key = row => row.cells[head.cellIndex].dataset.value ?? row.cells[head.cellIndex].textContent;
    const compared = (a, b) => isNaN(key(a)) || isNaN(key(b)) ? key(a).localeCompare(key(b)) : key(a) - key(b);
    body.append(...[...body.rows].sort((a, b) => compared(a, b) * order));
    choose('sort', (order < 0 ? '-' : '') + head.textContent);
  };
  table.tHead.addEventListener('click', event => {
    const head = event.target.closest('th');
    if (!head) return;
    const now = head.getAttribute('aria-sort');
    sort(head, now ? (now === 'ascending' ? -1 : 1) : down && head.matches('.n') ? -1 : 1);
  });
  const asked = choices.get('sort') ?? '', head = asked && heads.find(head => head.textContent === asked.replace(/^-/, ''));
  if (head) sort(head, asked.startsWith('-') ? -1 : 1);
  // Sorts again by the same head after values have changed.
  return () => heads.filter(head => head.hasAttribute('aria-sort')).forEach(head => sort(head, head.getAttribute('aria-sort') === 'ascending' ? 1 : -1));
}

prepare(document);
// That of comparisons has columns to fill before (index.js).
for (const table of document.querySelectorAll('table.sortable')) if (!table.closest('.index')) sortable(table, false);
