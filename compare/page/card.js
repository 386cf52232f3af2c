// SPDX-License-Identifier: MIT
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
// Per side: each is shown twice a second, below the three flashes a second that can harm.
const flickerMs = 250;

// ---- A card: both images and their difference under one transform.

const cards = new WeakMap();
let current = null;  // the card that keys act on: the last one hovered over or opened by a link

function cardOf(node) {
  const element = node && node.closest && node.closest('.card');
  if (!element || !element.querySelector('.panel')) return null;  // its images may be omitted
  if (!cards.has(element)) cards.set(element, new Card(element));
  return cards.get(element);
}

// In a single-file report both sides may share one image.
function fillShared(root) {
  for (const image of root.querySelectorAll('img[data-same]')) image.src = image.closest('.pair').querySelector('.left img').src;
}

class Card {
  constructor(element) {
    this.element = element;
    this.pair = element.querySelector('.pair');
    this.slider = element.querySelector('.pair input');
    this.panels = [...element.querySelectorAll('.panel')];
    this.readout = element.querySelector('.readout');
    const image = element.querySelector('.panel img');
    this.width = +image.getAttribute('width');
    this.height = +image.getAttribute('height');
    this.mode = 'side';
    this.still = 'side';   // the mode to return to after flicker
    this.at = 50;          // wipe position, percent
    this.zoom = 1;
    this.x = this.y = 0;   // offset of the image's corner, in image widths and heights; at most 0
    this.worst = -1;       // index of the visible worst pixel
    this.pixel = null;     // the pixel whose values are shown
    this.pinned = null;    // the pixel that was clicked or linked to; part of the address
  }

  // Modes: left, right, wipe, side, flicker.
  show(mode, at) {
    if (!this.pair) return;
    clearInterval(this.timer);
    if (mode === 'flicker' && this.mode === 'flicker') mode = this.still;
    if (mode !== 'flicker') this.still = mode;
    this.mode = mode;
    if (mode === 'wipe') this.at = clamp(at ?? this.at, 0, 100);
    this.pair.className = 'pair ' + (mode === 'side' ? 'side' : 'wipe');
    this.pair.dataset.mode = mode;
    this.wipeTo(mode === 'right' ? 0 : mode === 'wipe' ? this.at : 100);
    if (mode === 'flicker') {
      let left = true;
      this.timer = setInterval(() => this.wipeTo((left = !left) ? 100 : 0), flickerMs);
    }
    for (const button of this.element.querySelectorAll('[data-show]')) {
      button.classList.toggle('on', button.dataset.show === mode);
      button.setAttribute('aria-pressed', button.dataset.show === mode);
    }
    remember(this);
  }
  wipeTo(at) {
    this.pair.style.setProperty('--w', at + '%');
    this.slider.value = at;
  }

  // Zooms so that the point at (fromX, fromY) of the panel moves to (fx, fy); at most 48 screen pixels per
  // image pixel.
  zoomTo(zoom, fx = 0.5, fy = 0.5, fromX = fx, fromY = fy) {
    const u = fromX / this.zoom - this.x, v = fromY / this.zoom - this.y;
    this.zoom = clamp(zoom, 1, this.mostZoom());
    this.moveTo(fx / this.zoom - u, fy / this.zoom - v);
  }
  moveTo(x, y) {
    this.x = clamp(x, 1 / this.zoom - 1, 0);
    this.y = clamp(y, 1 / this.zoom - 1, 0);
    for (const [name, value] of [['--z', this.zoom], ['--x', this.x], ['--y', this.y]])
      this.element.style.setProperty(name, value);
    this.element.classList.toggle('zoomed', this.zoom > 1);
    this.panels.forEach(panel => this.sharpen(panel));
    remember(this);
  }
  // The offset that centres pixel (x, y), clamped to the image.
  corner(x, y) {
    const along = (at, size) => clamp(0.5 / this.zoom - (at + 0.5) / size, 1 / this.zoom - 1, 0);
    return [along(x, this.width), along(y, this.height)];
  }
  centre(x, y) { this.moveTo(...this.corner(x, y)); }
  // Shows pixels as squares once they are larger than a screen pixel.
  sharpen(panel) {
    panel.classList.toggle('enlarged', panel.clientWidth * this.zoom > this.width);
  }
  // Position in a panel, 0 to 1.
  place(panel, event) {
    const box = panel.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  }
  point(panel, event) {
    const [fx, fy] = this.place(panel, event);
    this.pointAt(Math.floor((fx / this.zoom - this.x) * this.width), Math.floor((fy / this.zoom - this.y) * this.height));
  }
  pointAt(x, y) {
    this.pixel = [clamp(x, 0, this.width - 1), clamp(y, 0, this.height - 1)];
    if (!this.element.classList.contains('pointed')) {
      this.element.classList.add('pointed');
      for (const panel of this.panels) panel.append(Object.assign(document.createElement('i'), { className: 'ring cursor' }));
    }
    this.element.style.setProperty('--u', (this.pixel[0] + 0.5) / this.width);
    this.element.style.setProperty('--v', (this.pixel[1] + 0.5) / this.height);
    this.read();
  }
  mostZoom() { return Math.max(1, 48 * this.width / Math.max(this.panels[0].clientWidth, 1)); }
  // The zoom to a pixel shows 24 pixels across.
  lookZoom() { return clamp(this.width / 24, 1, this.mostZoom()); }
  looksAt(x, y) {
    const [left, top] = this.corner(x, y);
    return Math.abs(this.zoom - this.lookZoom()) < 1e-6 && Math.abs(this.x - left) < 1e-6 && Math.abs(this.y - top) < 1e-6;
  }
  look(x, y) {
    this.zoomTo(this.lookZoom());
    this.centre(x, y);
    this.pointAt(x, y);
    this.pinned = this.pixel;
  }
  step(by) {
    const links = [...this.element.querySelectorAll('[data-pixel]')];
    if (!links.length) return;
    this.worst = (this.worst < 0 && by < 0 ? links.length - 1 : this.worst + by + links.length) % links.length;
    links.forEach((link, i) => link.classList.toggle('on', i === this.worst));
    this.look(...links[this.worst].dataset.pixel.split(',').map(Number));
  }

  // ---- The numbers under the cursor.
  showRows(...rows) {
    this.readout.replaceChildren(...rows.map(([name, text]) => {
      const row = document.createElement('span');
      row.append(Object.assign(document.createElement('b'), { textContent: name }), ' ' + text);
      return row;
    }));
  }
  read() {
    const name = this.readout && this.readout.dataset.values, there = `${this.pixel[0]}, ${this.pixel[1]}`;
    if (!name) return;
    const file = values.get(name);
    if (file) return this.showValues(file, there);
    if (!window.DecompressionStream) return this.showRows([there, 'this browser cannot unpack the values']);
    if (values.has(name)) return;
    values.set(name, null);
    waiting.set(name, [() => this.read()]);
    this.showRows([there, 'loading the values']);
    addScript(name, () => this.showRows([there, `${name} is missing beside this page`]));
  }
  showValues(file, there) {
    const pixel = this.pixel[1] * this.width + this.pixel[0];
    const names = JSON.parse(this.readout.dataset.names);
    const rows = names.map((name, i) => [name, file.of(i, pixel).map(v => file.text(v)).join(' ')]);
    if (names.length > 1) {
      const error = file.error(pixel);
      rows.push(['difference', error === 0 ? '0' : +error.toPrecision(4) + this.readout.dataset.unit]);
    }
    this.showRows([there, file.file.exact ? 'exact' : 'quantised: float16, 11 bits'], ...rows);
  }
}
