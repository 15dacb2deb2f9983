// The stitch player: plays, stops where the machine stops, and measures.

const SNAP_PX = 12;

class Player {
  constructor(root, data) {
    this.root = root;
    this.data = data;
    this.records = new SewnRecords(data);
    this.picture = new SewingCanvas(root.querySelector('canvas'), this.records, data);
    this.scrub = root.querySelector('[name=record]');
    this.scrub.max = this.records.count;
    this.speed = root.querySelector('[name=speed]');
    this.waits = root.querySelector('[name=waits]');
    this.measured = [];
    this.listen();
    this.go(this.records.count);
  }

  listen() {
    const canvas = this.picture.canvas;
    const actions = {
      play: () => this.toggle(),
      first: () => this.pause(0),
      last: () => this.pause(this.records.count),
      back: () => this.pause(this.stopBefore()),
      onward: () => this.pause(this.stopAfter()),
      nearer: () => this.zoomBy(1.5),
      farther: () => this.zoomBy(1 / 1.5),
      fit: () => { this.picture.fit(); this.soon(); },
    };
    for (const [name, act] of Object.entries(actions)) {
      this.root.querySelector(`[data-do=${name}]`).addEventListener('click', act);
    }
    this.scrub.addEventListener('input', () => this.pause(Number(this.scrub.value)));
    for (const button of this.root.querySelectorAll('[data-block]')) {
      button.addEventListener('click', () => this.pause(this.records.start(Number(button.dataset.block))));
    }
    canvas.addEventListener('keydown', (event) => this.key(event));
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoomBy(Math.exp(-event.deltaY / 400), [event.offsetX, event.offsetY]);
    }, { passive: false });
    dragged(canvas, (dx, dy, event, pinch) => {
      if (pinch) this.picture.zoomBy(pinch, [event.offsetX, event.offsetY]);
      else this.picture.pan(dx, dy);
      this.soon();
    }, (event) => this.measure([event.offsetX, event.offsetY]));
    new ResizeObserver(() => this.soon()).observe(canvas);
    window.addEventListener('beforeprint', () => this.draw(true));
  }

  key(event) {
    const moves = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] };
    if (event.key === ' ') this.toggle();
    else if (event.key === ',') this.pause(Math.max(0, this.done - 1));
    else if (event.key === '.') this.pause(Math.min(this.records.count, this.done + 1));
    else if (event.key === 'Home') this.pause(0);
    else if (event.key === 'End') this.pause(this.records.count);
    else if (event.key === '+' || event.key === '=') this.zoomBy(1.5);
    else if (event.key === '-') this.zoomBy(1 / 1.5);
    else if (event.key === '0') this.picture.fit();
    else if (event.key === 'Escape') this.measured = [];
    else if (moves[event.key]) this.picture.pan(...moves[event.key]);
    else return;
    event.preventDefault();
    this.tell();
    this.soon();
  }

  zoomBy(factor, at) {
    this.picture.zoomBy(factor, at);
    this.soon();
  }

  stopBefore() {
    const stops = this.records.stops.filter((i) => i + 1 < this.done);
    return stops.length ? stops.pop() + 1 : 0;
  }

  stopAfter() {
    const next = this.records.stops.find((i) => i + 1 > this.done);
    return next === undefined ? this.records.count : next + 1;
  }

  pause(done) {
    this.playing = false;
    this.go(done);
  }

  toggle() {
    this.playing = !this.playing;
    if (this.playing && this.done === this.records.count) this.done = 0;
    this.owed = 0;
    this.before = performance.now();
    if (this.playing) requestAnimationFrame((now) => this.run(now));
    this.tell();
  }

  run(now) {
    if (!this.playing) return;
    this.owed += (Math.max(0, now - this.before) / 1000) * Number(this.speed.value);
    this.before = now;
    const whole = Math.floor(this.owed);
    this.owed -= whole;
    const wanted = Math.min(this.records.count, this.done + whole), stop = this.stopAfter();
    if (this.waits.checked && stop <= wanted) return this.pause(stop);
    if (wanted === this.records.count) return this.pause(wanted);
    this.go(wanted);
    requestAnimationFrame((next) => this.run(next));
  }

  go(done) {
    this.done = done;
    this.scrub.value = done;
    this.tell();
    this.soon();
  }

  tell() {
    const { records, data, done } = this;
    const last = Math.max(0, done - 1), block = records.block[last];
    const say = (name, text) => {
      const place = this.root.querySelector(`[data-say=${name}]`);
      if (place.textContent !== text) place.textContent = text;
    };
    const kind = done ? ['stitch', 'jump', 'stop', 'end'][records.command[last]] : 'start';
    const at = done ? [records.x[last], records.y[last]] : [0, 0];
    say('record', `record ${done} of ${records.count}: ${kind}`);
    say('stitch', `stitch ${records.stitches[done]} of ${records.stitches[records.count]}`);
    say('needle', `at ${at[0].toFixed(1)}, ${at[1].toFixed(1)} mm`);
    const stopped = done === 0 || records.command[last] === STOP;
    const one = data.blocks[block];
    say('block', `${stopped ? 'Stop before block' : 'Block'} ${block + 1} of ${data.blocks.length}: ${one.material}`);
    say('instruction', one.instruction);
    say('distance', this.distance());
    this.scrub.setAttribute('aria-valuetext', `record ${done}, block ${block + 1}, ${one.material}`);
    this.root.querySelector('[data-do=play]').textContent = this.playing ? 'Pause' : 'Play';
    for (const button of this.root.querySelectorAll('[data-block]')) {
      button.setAttribute('aria-current', String(Number(button.dataset.block) === block));
    }
  }

  // A first click sets one end, a second the other; both take the needle point they are near.
  measure(at) {
    const [x, y] = this.picture.inPlan(at);
    const { index, distance } = this.records.nearestNeedle(x, y, this.done);
    const near = index >= 0 && distance * this.picture.scale <= SNAP_PX;
    const point = near ? [this.records.x[index], this.records.y[index]] : [x, y];
    this.measured = this.measured.length === 1 ? [this.measured[0], point] : [point];
    this.tell();
    this.soon();
  }

  distance() {
    if (this.measured.length === 0) return 'Click two places to measure between them.';
    const [[x, y], to] = this.measured;
    if (!to) return `from ${x.toFixed(1)}, ${y.toFixed(1)} mm to …`;
    return `${Math.hypot(to[0] - x, to[1] - y).toFixed(2)} mm from ${x.toFixed(1)}, ${y.toFixed(1)} to ${to[0].toFixed(1)}, ${to[1].toFixed(1)} mm`;
  }

  soon() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  draw(atOnce = false) {
    const whole = this.picture.draw(this.done, (context) => this.over(context), atOnce);
    clearTimeout(this.settling);
    if (!whole) this.settling = setTimeout(() => this.soon(), SETTLE_MS);
  }

  over(context) {
    const { records, done, picture } = this;
    context.lineCap = 'butt';
    for (const { xMm, yMm } of this.data.violations) {
      context.strokeStyle = '#D00000';
      context.lineWidth = 2;
      context.beginPath();
      context.arc(...picture.onPage(xMm, yMm), 9, 0, 2 * Math.PI);
      context.stroke();
    }
    if (done && done < records.count) {
      const [x, y] = picture.onPage(records.x[done - 1], records.y[done - 1]);
      context.strokeStyle = INK;
      context.lineWidth = 1.5;
      context.beginPath();
      context.arc(x, y, 5, 0, 2 * Math.PI);
      context.moveTo(x - 11, y);
      context.lineTo(x + 11, y);
      context.moveTo(x, y - 11);
      context.lineTo(x, y + 11);
      context.stroke();
    }
    const ends = this.measured.map(([x, y]) => picture.onPage(x, y));
    context.strokeStyle = context.fillStyle = '#B00050';
    context.lineWidth = 1.5;
    context.beginPath();
    for (const [x, y] of ends) context.fillRect(x - 3, y - 3, 6, 6);
    if (ends.length === 2) {
      context.moveTo(...ends[0]);
      context.lineTo(...ends[1]);
    }
    context.stroke();
  }
}
