// Draws the first so many records. What is sewn stays on a picture of its own, to which only the
// newest stitches are added; copies of it on the way make going back quick.

const COPIES = 16;
const SETTLE_MS = 120; // after so long without motion the picture is drawn anew
const FABRIC = '#E6DFD2', INK = '#33312C', OUTLINE = '#B0A894', TRAVEL = '#A79F8F';
const THREAD_MM = 0.4;

class SewingCanvas {
  constructor(canvas, records, data) {
    this.canvas = canvas;
    this.records = records;
    this.blocks = data.blocks;
    this.rings = data.rings.map(unpack);
    this.sewn = document.createElement('canvas');
    this.copies = [];
    this.drawn = -1;
    this.fit();
  }

  fit() {
    const { low, high } = this.records.bounds();
    this.middle = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
    this.size = [high[0] - low[0] + 10, high[1] - low[1] + 10];
    this.zoom = 1;
    this.clear();
  }

  // What is drawn belongs to another view; while that moves, it is shown shifted and scaled.
  clear() {
    this.stale = true;
    this.moved = performance.now();
  }

  renew() {
    this.stale = false;
    this.drawn = -1;
    this.copies = [];
    this.seen = { middle: this.middle, scale: this.scale };
  }

  pan(dx, dy) {
    this.middle = [this.middle[0] - dx / this.scale, this.middle[1] + dy / this.scale];
    this.clear();
  }

  // Keeps what is below a point of the page where it is.
  zoomBy(factor, at = [this.canvas.clientWidth / 2, this.canvas.clientHeight / 2]) {
    const before = this.inPlan(at);
    this.zoom = Math.max(0.5, Math.min(200, this.zoom * factor));
    this.measure();
    const after = this.inPlan(at);
    this.middle = [this.middle[0] + before[0] - after[0], this.middle[1] + before[1] - after[1]];
    this.clear();
  }

  measure() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    [this.width, this.height] = [width, height];
    this.scale = this.zoom * Math.min(width / this.size[0], height / this.size[1]);
    const [columns, rows] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.sewn.width !== columns || this.sewn.height !== rows) {
      for (const one of [this.sewn, this.canvas]) [one.width, one.height] = [columns, rows];
      this.stale = true;
      this.drawn = -1;
    }
    this.ratio = ratio;
  }

  inPlan([x, y]) {
    return [this.middle[0] + (x - this.width / 2) / this.scale, this.middle[1] - (y - this.height / 2) / this.scale];
  }

  onPage(x, y) {
    return [this.width / 2 + (x - this.middle[0]) * this.scale, this.height / 2 - (y - this.middle[1]) * this.scale];
  }

  // Gives whether all is as it should be; else it is to be drawn again when the view has settled.
  draw(done, over, atOnce) {
    this.measure();
    if (!this.width || !this.height) return true;
    const settled = atOnce || this.drawn < 0 || performance.now() - this.moved >= SETTLE_MS;
    if (this.stale && settled) this.renew();
    if (!this.stale) this.sew(done);
    const context = this.canvas.getContext('2d');
    context.setTransform(1, 0, 0, 1, 0, 0);
    if (this.stale) this.shift(context);
    else context.drawImage(this.sewn, 0, 0);
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    over(context);
    return !this.stale;
  }

  shift(context) {
    const factor = this.scale / this.seen.scale, [x, y] = this.onPage(...this.seen.middle);
    const [left, top] = [x - (factor * this.width) / 2, y - (factor * this.height) / 2];
    context.fillStyle = FABRIC;
    context.fillRect(0, 0, this.canvas.width, this.canvas.height);
    const size = [factor * this.sewn.width, factor * this.sewn.height];
    context.drawImage(this.sewn, this.ratio * left, this.ratio * top, ...size);
  }

  // Brings the picture of what is sewn to a number of records.
  sew(done) {
    const context = this.sewn.getContext('2d');
    if (this.drawn < 0 || done < this.drawn) this.goBack(context, done);
    const every = Math.max(1, Math.ceil(this.records.count / COPIES));
    while (this.drawn < done) {
      const next = Math.min(done, (Math.floor(this.drawn / every) + 1) * every);
      this.add(context, this.drawn, next);
      this.drawn = next;
      if (next % every === 0 && !this.copies[next / every]) this.keep(next / every);
    }
  }

  keep(k) {
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [this.sewn.width, this.sewn.height];
    copy.getContext('2d').drawImage(this.sewn, 0, 0);
    this.copies[k] = copy;
  }

  goBack(context, done) {
    const every = Math.max(1, Math.ceil(this.records.count / COPIES));
    let k = Math.floor(done / every);
    while (k > 0 && !this.copies[k]) k--;
    context.setTransform(1, 0, 0, 1, 0, 0);
    if (k > 0) context.drawImage(this.copies[k], 0, 0);
    else this.background(context);
    this.drawn = k * every;
  }

  background(context) {
    context.fillStyle = FABRIC;
    context.fillRect(0, 0, this.sewn.width, this.sewn.height);
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.strokeStyle = OUTLINE;
    context.lineWidth = 1;
    context.setLineDash([5, 3]);
    context.beginPath();
    for (const ring of this.rings) {
      for (let i = 0; i < ring.length; i += 2) {
        const [x, y] = this.onPage(ring[i], ring[i + 1]);
        if (i) context.lineTo(x, y);
        else context.moveTo(x, y);
      }
      context.closePath();
    }
    context.stroke();
    context.setLineDash([]);
  }

  // Draws records from one to before another: wire first, then the thread over it.
  add(context, from, to) {
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.lineJoin = context.lineCap = 'round';
    for (let start = from; start < to; ) {
      const block = this.records.block[start];
      let end = start;
      while (end < to && this.records.block[end] === block) end++;
      this.addWire(context, block, start, end);
      this.addJumps(context, start, end);
      this.addThread(context, block, start, end);
      start = end;
    }
  }

  addWire(context, block, from, to) {
    const wire = this.records.wires[block];
    if (!wire) return;
    const first = Math.max(0, this.records.laid[from] - 1), last = this.records.laid[to];
    context.strokeStyle = wire.colour;
    context.lineWidth = Math.max(1.2, wire.diameterMm * this.scale);
    context.beginPath();
    for (let k = first; k <= last; k++) {
      const [x, y] = this.onPage(wire.points[2 * k], wire.points[2 * k + 1]);
      if (k > first) context.lineTo(x, y);
      else context.moveTo(x, y);
    }
    context.stroke();
  }

  addJumps(context, from, to) {
    context.strokeStyle = TRAVEL;
    context.lineWidth = 0.7;
    this.lines(context, from, to, JUMP);
  }

  addThread(context, block, from, to) {
    context.strokeStyle = this.blocks[block].colour;
    context.lineWidth = Math.max(0.8, THREAD_MM * this.scale);
    this.lines(context, from, to, STITCH);
    if (this.scale < 4) return;
    context.fillStyle = INK;
    const size = Math.min(2.5, this.scale / 5);
    for (let i = from; i < to; i++) {
      if (this.records.command[i] !== STITCH) continue;
      const [x, y] = this.onPage(this.records.x[i], this.records.y[i]);
      if (x < 0 || y < 0 || x > this.width || y > this.height) continue;
      context.fillRect(x - size / 2, y - size / 2, size, size);
    }
  }

  lines(context, from, to, command) {
    const { records } = this;
    context.beginPath();
    let drawing = false;
    for (let i = from; i < to; i++) {
      if (records.command[i] !== command) {
        drawing = false;
        continue;
      }
      if (!drawing) context.moveTo(...(i ? this.onPage(records.x[i - 1], records.y[i - 1]) : this.onPage(0, 0)));
      context.lineTo(...this.onPage(records.x[i], records.y[i]));
      drawing = true;
    }
    context.stroke();
  }
}
