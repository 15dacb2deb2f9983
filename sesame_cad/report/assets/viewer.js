// The 3-D view: orbit, zoom, slider, colour scales, and dimensions on the model.

const SLOW_MS = 34, SLOW_FRAMES = 3; // after so many slower frames, motion is drawn coarser
const REST_MS = 350; // after so long without motion it is drawn finer
// The most triangles to draw in motion and at rest, where the processor draws them and where not.
const MOST_TRIANGLES = { slow: [35000, 200000], quick: [700000, 3000000] };

class Viewer {
  constructor(root, view, colours) {
    this.root = root;
    this.shapes = view.kind === 'cell' ? new CellShapes(view) : new SheetShapes(view);
    this.canvas = root.querySelector('canvas');
    this.overlay = root.querySelector('.overlay');
    this.slider = root.querySelector('[name=place]');
    this.quantity = root.querySelector('[name=quantity]');
    this.slowly = drawsSlowly();
    this.painter = new Painter(this.canvas, !this.slowly);
    this.painter.colours('fabric', colours.fabric);
    this.painter.colours('wire', colours.wire);
    this.colours = colours;
    [this.coarse, this.finest] = MOST_TRIANGLES[this.slowly ? 'slow' : 'quick'].map((most) => this.within(most));
    this.slider.max = this.shapes.states.length - 1;
    this.slider.step = this.shapes.step;
    this.heating = view.heating;
    this.root.querySelector('.degrees').innerHTML = degrees(this.shapes.states, view.heating);
    this.home();
    this.listen();
    this.place(this.stop('cold'));
  }

  // The finest level of detail with no more triangles.
  within(most) {
    const fits = this.shapes.levels.findIndex((level) => level.total <= most);
    return fits < 0 ? this.shapes.levels.length - 1 : fits;
  }

  stop(name) {
    return this.shapes.states.findIndex((state) => state.stop === name);
  }

  home() {
    this.azimuth = -60;
    this.elevation = 32;
    this.zoom = 1;
    this.shift = [0, 0];
    const bounds = ['flat', 'cold', 'hot'].map((name) => this.bounds(this.stop(name)));
    this.radius = Math.max(...bounds.map(([, , reach]) => reach));
    this.half = [0, 1].map((k) => Math.max(...bounds.map((one) => one[k])));
  }

  // How far anything is from the middle, at most: as seen to the side, up or down, and in space.
  bounds(s) {
    const { chain, places, pitchMm } = this.shapes.at(s, 'stretch', this.shapes.levels.length - 1);
    const [right, up] = this.axes();
    const farthest = (points, length) => points.reduce((most, point) => Math.max(most, length(point)), 0);
    const loop = Array.from({ length: chain.length / 3 }, (_, k) => chain.subarray(3 * k, 3 * k + 3));
    const seen = [right, up].map((axis) => (p) => Math.abs(axis[0] * p[0] + axis[1] * p[1] + axis[2] * (p[2] || 0)));
    return [...seen, (p) => Math.hypot(...p)].map(
      (length) => farthest(loop, length) + pitchMm * farthest(places, length),
    );
  }

  listen() {
    this.slider.addEventListener('input', () => this.place(Number(this.slider.value)));
    this.quantity.addEventListener('change', () => this.place(this.s));
    for (const button of this.root.querySelectorAll('[data-stop]')) {
      button.addEventListener('click', () => this.travel(this.stop(button.dataset.stop)));
    }
    this.root.querySelector('[data-do=home]').addEventListener('click', () => {
      this.home();
      this.soon();
    });
    this.root.querySelector('[data-do=nearer]').addEventListener('click', () => this.zoomBy(1.25));
    this.root.querySelector('[data-do=farther]').addEventListener('click', () => this.zoomBy(0.8));
    this.canvas.addEventListener('keydown', (event) => this.key(event));
    this.canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoomBy(Math.exp(-event.deltaY / 500));
    }, { passive: false });
    dragged(this.canvas, (dx, dy, event, pinch) => {
      if (pinch) this.zoomBy(pinch);
      else if (event.shiftKey || event.buttons === 4) this.pan(dx, dy);
      else this.orbit(-dx / 3, dy / 3);
    });
    new ResizeObserver(() => this.soon()).observe(this.canvas);
    window.addEventListener('beforeprint', () => this.rest());
  }

  key(event) {
    const turns = { ArrowLeft: [6, 0], ArrowRight: [-6, 0], ArrowUp: [0, 6], ArrowDown: [0, -6] };
    if (turns[event.key] && event.shiftKey) this.pan(...turns[event.key].map((v) => -4 * v));
    else if (turns[event.key]) this.orbit(...turns[event.key]);
    else if (event.key === '+' || event.key === '=') this.zoomBy(1.25);
    else if (event.key === '-') this.zoomBy(0.8);
    else if (event.key === '0') this.home();
    else return;
    event.preventDefault();
    this.soon();
  }

  orbit(azimuth, elevation) {
    this.azimuth = (this.azimuth + azimuth) % 360;
    this.elevation = Math.max(-90, Math.min(90, this.elevation + elevation));
    this.soon();
  }

  pan(dx, dy) {
    this.shift = [this.shift[0] + dx, this.shift[1] + dy];
    this.soon();
  }

  zoomBy(factor) {
    this.zoom = Math.max(0.3, Math.min(20, this.zoom * factor));
    this.soon();
  }

  // Moves the slider along the solved way, so that nothing jumps.
  travel(goal) {
    const from = this.s, start = performance.now();
    const length = this.shapes.step < 1 && !matchMedia('(prefers-reduced-motion: reduce)').matches ? 900 : 0;
    const ticket = (this.ticket = {});
    const step = (now) => {
      if (this.ticket !== ticket) return;
      const share = length ? Math.min(1, (now - start) / length) : 1;
      this.move(share === 1 ? goal : from + (goal - from) * share);
      if (share < 1) requestAnimationFrame(step);
    };
    step(start);
  }

  place(s) {
    this.ticket = null;
    this.move(s);
  }

  move(s) {
    this.s = s;
    this.slider.value = s;
    this.loaded = false;
    this.tell();
    this.soon();
  }

  load() {
    const quantity = this.quantity.value;
    this.loaded = true;
    this.now = this.shapes.at(this.s, quantity, this.detail);
    this.painter.put(this.now.places);
    this.painter.fill('fabric', this.now.fabric, this.shapes.ranges[quantity]);
    this.painter.fill('wire', this.now.wire, this.shapes.ranges.curvature);
    this.legend('fabric', quantity);
    this.legend('wire', 'curvature');
  }

  legend(what, quantity) {
    const { name, unit: of, digits } = QUANTITIES[quantity];
    const range = this.shapes.ranges[quantity];
    const box = this.root.querySelector(`.scale[data-of=${what}]`);
    const stops = this.colours[what].map((c) => `rgb(${c.join(' ')})`);
    box.querySelector('.bar').style.backgroundImage = `linear-gradient(to right, ${stops.join(', ')})`;
    box.querySelector('.name').textContent = `${name}, ${of}`;
    box.querySelector('.low').textContent = range[0].toFixed(digits);
    box.querySelector('.high').textContent = range[1].toFixed(digits);
  }

  tell() {
    const { heightMm, pitchMm, modulusGPa, austenite } = this.shapes.numbers(this.s);
    const state = this.shapes.states[this.s];
    const say = (name, text) => (this.root.querySelector(`[data-say=${name}]`).textContent = text);
    say('height', `${heightMm.toFixed(2)} mm`);
    say('pitch', pitchMm === null ? 'no loops touch' : `${pitchMm.toFixed(2)} mm`);
    const where = state && state.stop ? state.stop : this.s < this.stop('cold') ? 'being released' : 'being heated';
    const stiff = modulusGPa === null ? '' : `, wire of ${modulusGPa.toFixed(1)} GPa`;
    say('state', { flat: 'flat, as it is sewn', cold: 'cold', hot: 'hot' }[where] || where);
    say('modulus', modulusGPa === null ? 'held flat by the hoop' : `${modulusGPa.toFixed(1)} GPa`);
    const warm = temperature(where, austenite, this.heating);
    say('temperature', warm);
    this.slider.setAttribute('aria-valuetext', `${where}, ${warm}${stiff}, ${heightMm.toFixed(2)} mm high`);
    for (const button of this.root.querySelectorAll('[data-stop]')) {
      button.setAttribute('aria-pressed', String(button.dataset.stop === where));
    }
  }

  soon() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame((now) => {
      this.waiting = false;
      this.judge(now - this.before);
      this.before = now;
      this.show(this.coarse, false);
      clearTimeout(this.resting);
      this.resting = setTimeout(() => this.rest(), REST_MS);
    });
  }

  // Frames that follow one another slowly make the next ones coarser.
  judge(interval) {
    if (interval > REST_MS) this.late = 0;
    else this.late = interval > SLOW_MS ? (this.late || 0) + 1 : 0;
    if (this.late < SLOW_FRAMES || this.coarse === this.shapes.levels.length - 1) return;
    this.coarse++;
    this.late = 0;
  }

  rest() {
    this.before = -Infinity;
    this.show(this.finest, true);
  }

  show(detail, fine) {
    if (detail !== this.detail) this.loaded = false;
    this.detail = detail;
    this.fine = fine;
    if (!this.loaded) this.load();
    this.draw();
  }

  // Rows: right, up, toward the eye.
  axes() {
    const a = (this.azimuth * Math.PI) / 180, e = (this.elevation * Math.PI) / 180;
    const toward = [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)];
    const right = [-Math.sin(a), Math.cos(a), 0];
    return [right, cross(toward, right), toward];
  }

  draw() {
    const own = window.devicePixelRatio || 1;
    const ratio = this.fine ? Math.max(own, 2) : this.slowly ? 0.8 : Math.min(own, 2);
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    const [columns, rows] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.canvas.width !== columns) this.canvas.width = columns;
    if (this.canvas.height !== rows) this.canvas.height = rows;
    const [right, up, toward] = this.axes();
    // pixels of the page for a millimetre
    this.scale = this.zoom * Math.min((0.43 * width) / this.half[0], (0.36 * height) / this.half[1]);
    const x = (2 * this.scale) / width, y = (2 * this.scale) / height, z = -1 / (4 * this.radius);
    const [moved, raised] = [(2 * this.shift[0]) / width, (-2 * this.shift[1]) / height];
    const moves = [0, 1, 2].flatMap((k) => [x * right[k], y * up[k], z * toward[k], 0]);
    const turn = [0, 1, 2].flatMap((k) => [right[k], up[k], toward[k]]);
    this.painter.draw([...moves, moved, raised, 0, 1], turn, this.now.pitchMm);
    this.dimensions(width, height, right, up);
  }

  dimensions(width, height, right, up) {
    const seen = (p) => [
      width / 2 + this.shift[0] + this.scale * (p[0] * right[0] + p[1] * right[1] + p[2] * right[2]),
      height / 2 + this.shift[1] - this.scale * (p[0] * up[0] + p[1] * up[1] + p[2] * up[2]),
    ];
    const { chain, places, pitchMm } = this.now;
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < chain.length; i++) {
      low[i % 3] = Math.min(low[i % 3], chain[i]);
      high[i % 3] = Math.max(high[i % 3], chain[i]);
    }
    const spread = [0, 1].map((k) => Math.max(...places.map((p) => p[k])) * pitchMm);
    const numbers = this.shapes.numbers(this.s);
    const gap = 0.07 * this.radius;
    // on the side that is turned to the eye
    const side = Math.sin((this.azimuth * Math.PI) / 180) < 0 ? -1 : 1;
    const edge = side * (spread[1] + (side < 0 ? -low[1] : high[1]) + gap);
    const end = side * right[0] < 0 ? 1 : -1;
    const corner = end * (spread[0] + (end < 0 ? -low[0] : high[0]) + gap);
    const parts = [];
    if (numbers.heightMm > 0.01) {
      parts.push(dimension(seen([corner, edge, low[2]]), seen([corner, edge, high[2]]), `height ${numbers.heightMm.toFixed(2)} mm`));
    }
    const row = places.filter((p) => p[1] === (side < 0 ? Math.min : Math.max)(...places.map((q) => q[1])));
    const pair = row.map((p) => p[0]).sort((a, b) => a - b);
    const first = pair.findIndex((v, k) => k + 1 < pair.length && pair[k + 1] - v === 1);
    if (pitchMm && numbers.pitchMm !== null) {
      const from = first < 0 ? pair[0] - 0.5 : pair[first];
      const ends = [from, from + 1].map((v) => seen([v * pitchMm, edge, low[2]]));
      parts.push(dimension(...ends, `pitch ${numbers.pitchMm.toFixed(2)} mm`));
    } else {
      const ends = [low[0], high[0]].map((v) => seen([v, edge, low[2]]));
      parts.push(dimension(...ends, `${(high[0] - low[0]).toFixed(1)} mm wide`));
    }
    this.overlay.setAttribute('viewBox', `0 0 ${width} ${height}`);
    this.overlay.innerHTML = parts.join('') + scaleBar(this.scale, width, height);
  }
}

const BARS_MM = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

function scaleBar(scale, width, height) {
  const length = BARS_MM.filter((mm) => mm * scale <= width / 5).pop() || BARS_MM[0];
  const left = 14, foot = height - 14;
  return `<path d="M${left},${foot - 5}V${foot}H${(left + length * scale).toFixed(1)}V${foot - 5}"/>` +
    `<text x="${left + 4}" y="${foot - 5}">${length} mm</text>`;
}

// A line with a tick at both ends and its words beside the middle.
function dimension([x1, y1], [x2, y2], words) {
  const length = Math.hypot(x2 - x1, y2 - y1);
  if (length < 2) return '';
  const [nx, ny] = [(-5 * (y2 - y1)) / length, (5 * (x2 - x1)) / length];
  const f = (v) => v.toFixed(1);
  const tick = (x, y) => `M${f(x - nx)},${f(y - ny)}L${f(x + nx)},${f(y + ny)}`;
  const level = Math.abs(x2 - x1) > Math.abs(y2 - y1);
  const [tx, ty] = level ? [(x1 + x2) / 2, Math.max(y1, y2) + 19] : [(x1 + x2) / 2 + 9, (y1 + y2) / 2 + 4];
  return `<path d="M${f(x1)},${f(y1)}L${f(x2)},${f(y2)}${tick(x1, y1)}${tick(x2, y2)}"/>` +
    `<text x="${f(tx)}" y="${f(ty)}" text-anchor="${level ? 'middle' : 'start'}">${words}</text>`;
}
