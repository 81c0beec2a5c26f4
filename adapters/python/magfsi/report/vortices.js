// SPDX-License-Identifier: GPL-2.0-or-later
// Vortices: translucent surfaces of equal |curl u|, of the stored instant that is nearest. A canvas
// would show the seam of each translucent triangle, so they are filled here, pixel by pixel, each once.
// Colours of what lies over each other are weighted means: no order is needed (McGuire and Bavoil 2013).
// The robot hides what is behind it.
class Vortices {
  constructor(found) { Object.assign(this, found); }

  // On dark paper the strongest is the brightest.
  colour(level) { return this.levels[DARK.matches ? this.levels.length - 1 - level : level].colour; }

  nearest(time) {
    return this.times.reduce((best, t, i) => Math.abs(t - time) < Math.abs(this.times[best] - time) ? i : best, 0);
  }

  // Triangles of an instant, and the normals of their points.
  unpacked(frame) {
    if (frame.triangles instanceof Uint16Array) return frame;
    frame.triangles = unpack(frame.triangles, Uint16Array); frame.points = unpack(frame.points, Uint16Array);
    const p = frame.points, n = frame.normals = new Float32Array(p.length), t = frame.triangles;
    for (let k = 0; k < t.length; k += 3) {
      const [a, b, c] = [3 * t[k], 3 * t[k + 1], 3 * t[k + 2]];
      const u = [0, 1, 2].map(d => p[b + d] - p[a + d]), v = [0, 1, 2].map(d => p[c + d] - p[a + d]);
      const across = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      for (const corner of [a, b, c]) across.forEach((w, d) => { n[corner + d] += w; });
    }
    return frame;
  }

  draw(view) {
    const [w, h] = [Math.round(view.width), Math.round(view.height)], each = w * h;
    this.shown = this.nearest(view.time);
    if (!(each > 0)) return;
    if (this.clear?.length !== each) {
      this.clear = new Float32Array(each); this.weight = new Float32Array(each);
      this.sum = new Float32Array(3 * each); this.robot = new Float32Array(each);
      this.picture = document.createElement("canvas"); this.picture.width = w; this.picture.height = h;
    }
    this.clear.fill(1); this.weight.fill(0); this.sum.fill(0); this.robot.fill(-Infinity);
    this.hide(view, w, h);
    this.blend(view, w, h);
    const context = this.picture.getContext("2d"), image = context.createImageData(w, h), out = image.data;
    for (let k = 0; k < each; ++k) {
      if (this.clear[k] === 1) continue;
      for (let c = 0; c < 3; ++c) out[4 * k + c] = this.sum[3 * k + c] / this.weight[k];
      out[4 * k + 3] = 255 * (1 - this.clear[k]);
    }
    context.putImageData(image, 0, 0);
    view.context.drawImage(this.picture, 0, 0, view.width, view.height);
  }

  // Depth of the nearest face of the bodies.
  hide(view, w, h) {
    const depth = this.robot;
    for (const { seen, quads, number } of view.shapes) if (!number) for (let f = 0; f < quads.length; f += 4)
      for (const [i, j] of [[1, 2], [2, 3]]) {
        const corner = n => { const k = 3 * quads[f + n]; return [seen[k], seen[k + 1], seen[k + 2], 0]; };
        fill(w, h, corner(0), corner(i), corner(j), (at, count, z, dz) => {
          for (let k = at; k < at + count; ++k, z += dz) if (z > depth[k]) depth[k] = z;
        });
      }
  }

  blend(view, w, h) {
    const { points, triangles, normals, counts } = this.unpacked(this.frames[this.shown]), m = view.matrix;
    const { clear, weight, sum, robot } = this, places = [];
    for (let k = 0; k < points.length; k += 3) {
      const nx = normals[k], ny = normals[k + 1], nz = normals[k + 2];
      const towards = Math.abs(m[6] * nx + m[7] * ny + m[8] * nz) / (view.scale * Math.hypot(nx, ny, nz) || 1);
      const [x, y, z] = view.project([0, 1, 2].map(d => this.low[d] + this.step * points[k + d]));
      places.push([x, y, z, 0.62 + 0.38 * towards]); // light from the viewer, as on plain bodies
    }
    let k = 0;
    counts.forEach((count, level) => {
      const opacity = this.levels[level].opacity, [red, green, blue] = this.colour(level).map(v => 255 * v * opacity);
      for (const end = k + 3 * count; k < end; k += 3)
        fill(w, h, places[triangles[k]], places[triangles[k + 1]], places[triangles[k + 2]], (at, pixels, z, dz, light, dlight) => {
          for (let i = at; i < at + pixels; ++i, z += dz, light += dlight) {
            if (z < robot[i]) continue;
            const l = Math.max(0.62, Math.min(1, light));
            clear[i] *= 1 - opacity; weight[i] += opacity;
            sum[3 * i] += l * red; sum[3 * i + 1] += l * green; sum[3 * i + 2] += l * blue;
          }
        });
    });
  }
}

// The pixels whose middles are in a triangle of corners [x, y, depth, light], row by row: row(first pixel,
// number of them, depth there, its change from pixel to pixel, light, its change). Neighbours share none.
function fill(w, h, a, b, c, row) {
  const [bx, by, cx, cy] = [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]], det = bx * cy - by * cx;
  if (Math.abs(det) < 1e-9) return;
  const slope = d => [((b[d] - a[d]) * cy - (c[d] - a[d]) * by) / det, ((c[d] - a[d]) * bx - (b[d] - a[d]) * cx) / det];
  const [zx, zy] = slope(2), [lx, ly] = slope(3);
  const first = Math.max(0, Math.ceil(Math.min(a[1], b[1], c[1]) - 0.5)), last = Math.min(h - 1, Math.ceil(Math.max(a[1], b[1], c[1]) - 0.5) - 1);
  for (let y = first; y <= last; ++y) {
    let left = Infinity, right = -Infinity;
    for (const [p, q] of [[a, b], [b, c], [c, a]]) {
      const [low, high] = p[1] < q[1] ? [p, q] : [q, p]; // the same for both triangles at an edge
      if (y + 0.5 < low[1] || y + 0.5 >= high[1]) continue;
      const x = low[0] + (high[0] - low[0]) * (y + 0.5 - low[1]) / (high[1] - low[1]);
      left = Math.min(left, x); right = Math.max(right, x);
    }
    const from = Math.max(0, Math.ceil(left - 0.5)), to = Math.min(w - 1, Math.ceil(right - 0.5) - 1);
    const dx = from + 0.5 - a[0], dy = y + 0.5 - a[1];
    if (to >= from) row(y * w + from, to - from + 1, a[2] + zx * dx + zy * dy, zx, a[3] + lx * dx + ly * dy, lx);
  }
}
