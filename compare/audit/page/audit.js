// SPDX-License-Identifier: MIT
// After compare/page/tables.js and copy.js.
addEventListener('click', event => {
  const button = event.target.closest('button[data-do=copy]');
  if (button) copy(button);
});
for (const table of document.querySelectorAll('.rows table')) sortable(table, false);
