// SPDX-License-Identifier: MIT
// The button beside a command line.
async function copy(button) {
  const code = button.parentElement.querySelector('code');
  getSelection().selectAllChildren(code);  // without access to the clipboard the user only has to press Ctrl+C
  try {
    await navigator.clipboard.writeText(code.textContent);
    button.textContent = 'copied';
  } catch {
    button.textContent = 'selected';
  }
}
