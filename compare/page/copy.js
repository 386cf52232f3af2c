// SPDX-License-Identifier: MIT
// The button beside a command line, and that of a difference that may be accepted.
addEventListener('click', event => {
  const button = event.target.closest('button');
  if (button?.dataset.do === 'copy') copy(button);
  if (button?.dataset.do === 'accept') accept(button);
});

async function copy(button) {
  const code = button.parentElement.querySelector('code');
  // Without access to the clipboard, the user only has to press Ctrl+C.
  getSelection().selectAllChildren(code);
  try {
    await navigator.clipboard.writeText(code.textContent);
    button.textContent = 'copied';
  } catch {
    button.textContent = 'selected';
  }
}

// Copies the command that writes rules for a scene's differences; without clipboard access, shows it.
async function accept(button) {
  const quoted = text => /^[\w+=:,./@%-]+$/.test(text) ? text : "'" + text.replaceAll("'", "'\\''") + "'";
  const report = location.protocol === 'file:' ? decodeURIComponent(location.pathname).replace(/\/[^/]*$/, '') : 'diptych-report';
  const command = `diptych accept ${quoted(report)} ${quoted(button.closest('tr').dataset.scene)} -o accepted.json`;
  try {
    await navigator.clipboard.writeText(command);
    button.textContent = 'copied';
  } catch {
    const code = Object.assign(document.createElement('code'), { textContent: command });
    button.replaceWith(code);
    getSelection().selectAllChildren(code);  // the user only has to press Ctrl+C
  }
}
