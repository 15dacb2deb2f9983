// The shapes of a design: where fabric and wire are at a place of the slider.

const QUANTITIES = {
  stretch: { name: 'stretch of the fabric', unit: '%', digits: 1 },
  tension: { name: 'tension in the fabric', unit: 'N/m', digits: 1 },
  curvature: { name: 'curvature of the wire', unit: '1/mm', digits: 4 },
};

function extent(arrays) {
  let low = Infinity, high = -Infinity;
  for (const array of arrays) {
    for (const value of array) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  // what is the same everywhere must not show the last bit as a pattern
  const least = 1e-3 * Math.max(Math.abs(low), Math.abs(high), 1e-9);
  return high - low < least ? [low - least, high + least] : [low, high];
}

// Equal loops: one loop's points, straight between neighbours of the solved shapes.
class CellShapes {
  constructor(view) {
    this.view = view;
    this.states = view.states;
    this.loops = view.places.length;
    this.step = 0.01;
    this.packed = {};
    for (const key of ['points', 'stretch', 'tension', 'curvature']) this.packed[key] = unpack(view[key]);
    this.ranges = Object.fromEntries(
      ['stretch', 'tension', 'curvature'].map((key) => [key, extent([this.packed[key]])]),
    );
    this.levels = [this.level(1, 1, 12), this.level(2, 2, 8), this.level(4, 4, 5), this.level(8, 6, 2)];
  }

  // A level of detail keeps every so many rings and segments, and so many sides of the wire.
  level(ringStep, segmentStep, sides) {
    const { rings, segments } = this.view;
    const kept = [0], around = [];
    for (let k = 0; k < segments; k += segmentStep) around.push(k);
    for (let ring = ringStep; ring <= rings; ring += ringStep) {
      for (const k of around) kept.push(1 + (ring - 1) * segments + k);
    }
    const triangles = discTriangles(rings / ringStep, around.length);
    const total = this.loops * (triangles.length / 3 + 2 * (sides > 2 ? sides : 1) * around.length);
    return { kept, around, triangles, sides, total };
  }

  mixed(key, items, width, s) {
    const source = this.packed[key], size = source.length / this.states.length;
    const k = Math.min(Math.floor(s), this.states.length - 2), share = s - k;
    const out = new Float32Array(items.length * width);
    for (let i = 0; i < items.length; i++) {
      for (let c = 0; c < width; c++) {
        const at = k * size + items[i] * width + c;
        out[i * width + c] = (1 - share) * source[at] + share * source[at + size];
      }
    }
    return out;
  }

  numbers(s) {
    const k = Math.min(Math.floor(s), this.states.length - 2), share = s - k;
    const [one, other] = [this.states[k], this.states[k + 1]];
    const mix = (key) =>
      one[key] === null || other[key] === null
        ? (share === 1 ? other[key] : share === 0 ? one[key] : null)
        : (1 - share) * one[key] + share * other[key];
    return Object.fromEntries(['heightMm', 'pitchMm', 'modulusGPa', 'austenite'].map((key) => [key, mix(key)]));
  }

  at(s, quantity, detail) {
    const { kept, around, triangles, sides } = this.levels[detail];
    const points = this.mixed('points', kept, 3, s);
    const fabric = {
      points, triangles, normals: vertexNormals(points, triangles),
      values: this.mixed(quantity, kept, 1, s),
    };
    const chain = points.slice(points.length - 3 * around.length);
    const wire = tube(chain, this.mixed('curvature', around, 1, s), this.view.wireDiameterMm, sides);
    return { fabric, wire, chain, pitchMm: this.numbers(s).pitchMm, places: this.view.places };
  }
}

// Loops that differ: three meshes, and nothing between them.
class SheetShapes {
  constructor(view) {
    this.view = view;
    this.loops = 1;
    this.step = 1;
    this.states = view.states.map((state) => ({
      ...state,
      points: unpack(state.points), triangles: unpack(state.triangles),
      stretch: unpack(state.stretch), tension: unpack(state.tension),
      wires: state.wires.map(unpack), curvature: state.curvature.map(unpack),
    }));
    this.ranges = Object.fromEntries(
      ['stretch', 'tension'].map((key) => [key, extent(this.states.map((state) => state[key]))]),
    );
    this.ranges.curvature = extent(this.states.flatMap((state) => state.curvature));
    this.levels = [{ total: 0 }];
  }

  numbers(s) {
    return this.states[Math.round(s)];
  }

  at(s, quantity) {
    const state = this.states[Math.round(s)];
    const { points, triangles } = state;
    const fabric = {
      points, triangles, normals: vertexNormals(points, triangles), values: state[quantity],
    };
    const chains = state.wires.map((wire) =>
      Float32Array.from({ length: 3 * wire.length }, (_, i) => points[3 * wire[Math.floor(i / 3)] + (i % 3)]),
    );
    const tubes = chains.map((chain, k) => tube(chain, state.curvature[k], this.view.wireDiametersMm[k], 8));
    const chain = Float32Array.from(chains.flatMap((one) => Array.from(one)));
    return { fabric, wire: joined(tubes), chain, pitchMm: 0, places: [[0, 0]] };
  }
}
