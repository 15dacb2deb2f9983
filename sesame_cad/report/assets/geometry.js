// Triangles and normals of fabric and wire. Points are flat arrays x, y, z, x, y, z, ...

function discTriangles(rings, segments) {
  const out = [];
  for (let k = 0; k < segments; k++) out.push(0, 1 + k, 1 + ((k + 1) % segments));
  for (let ring = 0; ring < rings - 1; ring++) {
    for (let k = 0; k < segments; k++) {
      const next = (k + 1) % segments;
      const inner = 1 + ring * segments;
      const outer = inner + segments;
      out.push(inner + k, outer + k, outer + next, inner + k, outer + next, inner + next);
    }
  }
  return Uint32Array.from(out);
}

function vertexNormals(points, triangles) {
  const normals = new Float32Array(points.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [i, j, k] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const ax = points[j] - points[i], ay = points[j + 1] - points[i + 1], az = points[j + 2] - points[i + 2];
    const bx = points[k] - points[i], by = points[k + 1] - points[i + 1], bz = points[k + 2] - points[i + 2];
    const x = ay * bz - az * by, y = az * bx - ax * bz, z = ax * by - ay * bx;
    for (const v of [i, j, k]) {
      normals[v] += x;
      normals[v + 1] += y;
      normals[v + 2] += z;
    }
  }
  return normals;
}

function unit(v) {
  const length = Math.hypot(v[0], v[1], v[2]) || 1;
  return [v[0] / length, v[1] / length, v[2] / length];
}

function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

// A tube of so many sides along a closed chain of points; values are repeated around it. Of two
// sides it is a band, which stands at 45 degrees and so is seen from above and from the side.
function tube(chain, values, diameter, sides) {
  const count = chain.length / 3;
  const points = new Float32Array(3 * count * sides);
  const normals = new Float32Array(3 * count * sides);
  const repeated = new Float32Array(count * sides);
  const quads = sides > 2 ? sides : 1;
  const triangles = new Uint32Array(6 * count * quads);
  for (let k = 0; k < count; k++) {
    const before = 3 * ((k + count - 1) % count), after = 3 * ((k + 1) % count);
    const along = unit([0, 1, 2].map((c) => chain[after + c] - chain[before + c]));
    const pole = Math.abs(along[2]) > 0.999 ? [1, 0, 0] : [0, 0, 1];
    const aside = unit(cross(pole, along));
    const up = cross(along, aside);
    for (let s = 0; s < sides; s++) {
      const turn = (2 * Math.PI * s) / sides + (sides > 2 ? 0 : Math.PI / 4), at = k * sides + s;
      for (let c = 0; c < 3; c++) {
        const normal = Math.cos(turn) * up[c] + Math.sin(turn) * aside[c];
        normals[3 * at + c] = normal;
        points[3 * at + c] = chain[3 * k + c] + (diameter / 2) * normal;
      }
      repeated[at] = values[k];
      const onward = ((k + 1) % count) * sides, next = (s + 1) % sides;
      const corners = [at, onward + s, onward + next, at, onward + next, k * sides + next];
      if (s < quads) triangles.set(corners, 6 * (k * quads + s));
    }
  }
  return { points, normals, values: repeated, triangles };
}

function joined(parts) {
  const out = {};
  for (const key of ['points', 'normals', 'values']) {
    out[key] = new Float32Array(parts.reduce((sum, part) => sum + part[key].length, 0));
    let start = 0;
    for (const part of parts) {
      out[key].set(part[key], start);
      start += part[key].length;
    }
  }
  out.triangles = new Uint32Array(parts.reduce((sum, part) => sum + part.triangles.length, 0));
  let place = 0, first = 0;
  for (const part of parts) {
    out.triangles.set(part.triangles.map((v) => v + first), place);
    place += part.triangles.length;
    first += part.points.length / 3;
  }
  return out;
}
