// The machine's records as the DST file holds them, one number each in parallel arrays.
const STITCH = 0, JUMP = 1, STOP = 2, END = 3;
const UNITS_PER_MM = 10;
const AHEAD = 60; // points of the wire, 1 mm apart, among which the next one is looked for

class SewnRecords {
  constructor(data) {
    const steps = unpack(data.steps);
    this.command = unpack(data.commands);
    this.count = this.command.length;
    this.x = new Float32Array(this.count);
    this.y = new Float32Array(this.count);
    this.block = new Uint16Array(this.count);
    this.stops = [];
    for (let i = 0, x = 0, y = 0; i < this.count; i++) {
      x += steps[2 * i];
      y += steps[2 * i + 1];
      if (this.command[i] === STOP) this.stops.push(i);
      this.x[i] = x / UNITS_PER_MM;
      this.y[i] = y / UNITS_PER_MM;
      this.block[i] = this.stops.length;
    }
    this.stitches = new Uint32Array(this.count + 1);
    for (let i = 0; i < this.count; i++) this.stitches[i + 1] = this.stitches[i] + (this.command[i] === STITCH);
    this.wires = data.blocks.map((block) => block.wire && { ...block.wire, points: unpack(block.wire.points) });
    this.laid = this.followed();
  }

  // First record of a block: the one after the stop before it.
  start(block) {
    return block === 0 ? 0 : this.stops[block - 1] + 1;
  }

  // How many points of its wire are laid after each record: those that its stitches have passed.
  followed() {
    const laid = new Uint32Array(this.count + 1);
    for (let i = 0, at = 0; i < this.count; i++) {
      const wire = this.wires[this.block[i]];
      if (!wire || this.command[i] === STOP) at = 0;
      else if (this.command[i] === STITCH && i && this.command[i - 1] === STITCH) {
        const x = (this.x[i] + this.x[i - 1]) / 2, y = (this.y[i] + this.y[i - 1]) / 2;
        const last = Math.min(at + AHEAD, wire.points.length / 2 - 1);
        let nearest = Infinity, found = at;
        for (let k = at; k <= last; k++) {
          const d = (wire.points[2 * k] - x) ** 2 + (wire.points[2 * k + 1] - y) ** 2;
          if (d < nearest) [nearest, found] = [d, k];
        }
        at = found;
        if (this.command[i + 1] !== STITCH) at = wire.points.length / 2 - 1;
      }
      laid[i + 1] = at;
    }
    return laid;
  }

  bounds() {
    const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    for (let i = 0; i < this.count; i++) {
      low[0] = Math.min(low[0], this.x[i]);
      low[1] = Math.min(low[1], this.y[i]);
      high[0] = Math.max(high[0], this.x[i]);
      high[1] = Math.max(high[1], this.y[i]);
    }
    return { low, high };
  }

  nearestNeedle(x, y, before) {
    let nearest = Infinity, found = -1;
    for (let i = 0; i < before; i++) {
      if (this.command[i] !== STITCH) continue;
      const d = (this.x[i] - x) ** 2 + (this.y[i] - y) ** 2;
      if (d < nearest) [nearest, found] = [d, i];
    }
    return { index: found, distance: Math.sqrt(nearest) };
  }
}
