// SPDX-License-Identifier: GPL-2.0-or-later
// The robot in its box, seen without perspective: a slice of the flow is then a picture that is
// only sheared, and faces are painted from back to front, those before the slice after it.
// docs/report.md says why this and not WebGL.

const YAW = -0.35, PITCH = 0.2, SEAM = 0.6, SHARE = 0.85, MOST_EDGES = 1500; // rad, rad, pixels, of the view, faces
const FIRST_VIEW = [Math.cos(YAW), Math.abs(Math.sin(YAW)), Math.cos(PITCH), Math.sin(PITCH)];

class View {
  constructor(canvas) {
    this.canvas = canvas;
    this.aim = "robot"; this.reset();
    this.colour = ""; this.flow = ""; this.time = 0; this.range = 1;
    this.listen();
  }

  // Several runs: the first has colours and flow, the others are laid over it as grids of lines,
  // in the colours of their curves.
  show(runs) {
    this.runs = runs; this.run = runs[0];
    this.shapes = runs.filter(run => run.bodies).map(run => new Shape(run, runs.indexOf(run)));
    this.pictured = null;
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const run of runs) {
      const ends = run.box ? [[0, 0, 0], run.box] : run.bodies ? [run.bodies.low, run.bodies.high] : [];
      for (const p of ends) p.forEach((v, d) => { low[d] = Math.min(low[d], v); high[d] = Math.max(high[d], v); });
    }
    this.empty = !(high[0] >= low[0]);
    this.box = this.empty ? [[0, 0, 0], [1, 1, 1]] : [low, high];
    this.extent = Math.max(Math.hypot(...low.map((v, d) => high[d] - v)), 1e-9);
    this.vortices = this.run.vortices ? new Vortices(this.run.vortices) : null;
    this.sources = runs[0].sources.filter(source => !source.missing).map(source => new Source(source));
  }

  reset() { this.yaw = YAW; this.pitch = PITCH; this.zoom = 1; this.pan = [0, 0]; }

  // Lowest and highest corner of what fills the view: the robots over their whole course, the first
  // one now, the box, or all with the magnets.
  framed() {
    const bodies = this.runs.map(run => run.bodies).filter(Boolean);
    if (this.aim === "follow" && bodies[0]) {
      const b = bodies[0], i = this.frame(b.times), j = Math.min(i + 1, b.times.length - 1), part = this.part(b.times);
      const at = b.centres[i].map((v, d) => v + part * (b.centres[j][d] - v));
      return [at.map(v => v - b.size / 2), at.map(v => v + b.size / 2)];
    }
    const parts = this.aim === "robot" && bodies.length ? bodies.map(b => [b.low, b.high]) : [this.box];
    if (this.aim === "all") for (const source of this.sources) parts.push(source.ends());
    return [0, 1].map(end => [0, 1, 2].map(d => Math[end ? "max" : "min"](...parts.map(p => p[end][d]))));
  }

  // The first robot's length takes this share of the view's width, framed on its course.
  share() {
    if (!this.run.bodies || !this.canvas.clientWidth) return 1;
    this.width = this.canvas.clientWidth; this.height = this.canvas.clientHeight;
    this.look();
    return this.scale * this.run.bodies.size / this.width;
  }

  zoomAt(x, y, factor) { // what is at this place of the view stays there
    const p = [x - this.width / 2, y - this.height / 2];
    this.pan = this.pan.map((v, d) => p[d] - (p[d] - v) * factor);
    this.zoom *= factor; this.draw();
  }

  listen() {
    const c = this.canvas, touching = new Map();
    c.onpointerdown = e => { touching.set(e.pointerId, [e.clientX, e.clientY]); c.setPointerCapture(e.pointerId); };
    c.onpointerup = c.onpointercancel = e => touching.delete(e.pointerId);
    c.onpointermove = e => {
      const from = touching.get(e.pointerId);
      if (!from) return;
      const [dx, dy] = [e.clientX - from[0], e.clientY - from[1]], others = [...touching.keys()].filter(k => k !== e.pointerId);
      if (others.length) { // two fingers: their distance
        const o = touching.get(others[0]), far = p => Math.hypot(p[0] - o[0], p[1] - o[1]) || 1;
        const r = c.getBoundingClientRect();
        this.zoomAt((o[0] + e.clientX) / 2 - r.x, (o[1] + e.clientY) / 2 - r.y, far([e.clientX, e.clientY]) / far(from));
      } else if (e.shiftKey) { this.pan[0] += dx; this.pan[1] += dy; }
      else { this.yaw -= 0.008 * dx; this.pitch = Math.max(-1.57, Math.min(1.57, this.pitch + 0.008 * dy)); }
      touching.set(e.pointerId, [e.clientX, e.clientY]); this.draw();
    };
    c.onwheel = e => { e.preventDefault(); this.zoomAt(e.offsetX, e.offsetY, Math.exp(-0.0012 * e.deltaY)); };
    c.ondblclick = () => { this.reset(); this.draw(); };
  }

  // Of the stored instants the last that is not after the time.
  frame(times) {
    let a = 0, b = times.length - 1;
    while (a < b) { const m = (a + b + 1) >> 1; if (times[m] <= this.time * (1 + 1e-9) + 1e-12) a = m; else b = m - 1; }
    return a;
  }

  // How far the time is between that instant and the next, from 0 to 1.
  part(times) {
    const i = this.frame(times), j = Math.min(i + 1, times.length - 1);
    return j > i ? Math.max(0, Math.min(1, (this.time - times[i]) / (times[j] - times[i]))) : 0;
  }

  look() {
    const cy = Math.cos(this.yaw), sy = Math.sin(this.yaw), cp = Math.cos(this.pitch), sp = Math.sin(this.pitch);
    // What is framed fills its share of the first view; it does not grow and shrink as it turns.
    const [low, high] = this.framed(), size = low.map((v, d) => Math.max(high[d] - v, 1e-9)), [cy0, sy0, cp0, sp0] = FIRST_VIEW;
    this.middle = low.map((v, d) => (v + high[d]) / 2);
    const s = this.scale = SHARE * this.zoom * Math.min(this.width / (cy0 * size[0] + sy0 * size[1]),
      this.height / (sp0 * sy0 * size[0] + sp0 * cy0 * size[1] + cp0 * size[2]));
    const x0 = this.width / 2 + this.pan[0], y0 = this.height / 2 + this.pan[1], [mx, my, mz] = this.middle;
    // Rows: right, down, towards the viewer [pixels].
    const m = [s * cy, s * sy, 0, s * sp * sy, -s * sp * cy, -s * cp, s * cp * sy, -s * cp * cy, s * sp];
    this.matrix = [...m, x0 - m[0] * mx - m[1] * my, y0 - m[3] * mx - m[4] * my - m[5] * mz, -m[6] * mx - m[7] * my - m[8] * mz];
  }
  project(p) {
    const m = this.matrix, [x, y, z] = p;
    return [m[0] * x + m[1] * y + m[2] * z + m[9], m[3] * x + m[4] * y + m[5] * z + m[10], m[6] * x + m[7] * y + m[8] * z + m[11]];
  }

  draw() {
    const ratio = window.devicePixelRatio || 1, c = this.canvas;
    this.width = c.clientWidth; this.height = c.clientHeight;
    const [w, h] = [Math.round(ratio * this.width), Math.round(ratio * this.height)];
    if (c.width !== w || c.height !== h) { c.width = w; c.height = h; }
    const context = this.context = c.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    this.ink = getComputedStyle(c).color; this.paper = getComputedStyle(c).backgroundColor;
    if (!this.run || this.empty) return;
    this.look();
    if (this.run.box) this.drawBox();
    this.drawWires();
    // Of two faces the one further away first; the slice between those behind and before it.
    const flow = this.run.flow, cut = flow?.quantities[this.flow] ? flow : null, far = [], near = [];
    for (const shape of this.shapes) shape.faces(this, cut, far, near);
    this.paint(far);
    if (cut) this.drawSlice(cut);
    this.paint(near);
    if (this.vortices && this.flow === "vortices") this.vortices.draw(this);
    this.marks = [];
    for (const source of this.sources) source.draw(this);
    this.drawField(); this.drawAxes(); this.drawScale();
  }

  paint(list) {
    list.sort((a, b) => a.depth - b.depth);
    const context = this.context;
    for (const { style, edge, wire, thin, corners: p } of list) {
      context.beginPath();
      context.moveTo(p[0], p[1]); context.lineTo(p[2], p[3]); context.lineTo(p[4], p[5]); context.lineTo(p[6], p[7]);
      context.closePath();
      if (!wire) { context.fillStyle = style; context.fill(); }
      if (wire || thin || edge) { context.lineWidth = wire ? 1 : SEAM; context.strokeStyle = edge || style; context.stroke(); }
    }
  }

  // The slice at the time as a picture, between the stored instants on straight lines.
  slice(flow) {
    const q = flow.quantities[this.flow], each = flow.rows * flow.columns, map = mapOf(q), i = this.frame(flow.times);
    const part = this.part(flow.times), [a, b] = [i, Math.min(i + 1, flow.times.length - 1)].map(n => n * each);
    q.unpacked ||= unpack(q.values, Uint8Array);
    const picture = this.picture ||= document.createElement("canvas"), key = `${this.flow} ${i} ${part} ${this.range} ${DARK.matches}`;
    if (this.pictured === key) return picture;
    this.pictured = key;
    picture.width = flow.columns; picture.height = flow.rows;
    const context = picture.getContext("2d"), image = context.createImageData(flow.columns, flow.rows);
    const pixels = new Uint32Array(image.data.buffer); // low byte first
    const palette = Uint32Array.from({ length: 256 }, (_, v) => 0xff000000 | map[3 * v + 2] << 16 | map[3 * v + 1] << 8 | map[3 * v]);
    // What is shown is the part of the range that the viewer chose.
    const share = 1 / this.range, middle = q.signed ? 127.5 : 0;
    for (let k = 0; k < each; ++k) {
      const stored = q.unpacked[a + k] + part * (q.unpacked[b + k] - q.unpacked[a + k]);
      pixels[k] = palette[Math.max(0, Math.min(255, Math.round(middle + share * (stored - middle))))];
    }
    context.putImageData(image, 0, 0);
    return picture;
  }

  drawSlice(f) {
    const across = [0, 1, 2].filter(d => d !== f.axis), corner = (u, v) => {
      const p = [0, 0, 0];
      p[f.axis] = f.at; p[across[0]] = f.origin[0] + u * f.size[0]; p[across[1]] = f.origin[1] + v * f.size[1];
      return this.project(p);
    };
    const o = corner(0, 0), a = corner(1, 0), b = corner(0, 1), context = this.context;
    context.save();
    context.transform((a[0] - o[0]) / f.columns, (a[1] - o[1]) / f.columns, (b[0] - o[0]) / f.rows, (b[1] - o[1]) / f.rows, o[0], o[1]);
    context.globalAlpha = GLASS;
    context.drawImage(this.slice(f), 0, 0);
    context.restore();
    if (this.arrows && f.arrows) this.drawArrows(f, corner);
  }

  // Velocities in the plane at the time; the largest reach the next place.
  drawArrows(f, corner) {
    const a = f.arrows, each = a.rows * a.columns, i = this.frame(f.times), j = Math.min(i + 1, f.times.length - 1), part = this.part(f.times);
    a.unpacked ||= unpack(a.values, Int8Array);
    this.context.strokeStyle = this.context.fillStyle = this.ink;
    for (let k = 0; k < each; ++k) {
      const [u, v] = [0, 1].map(c => {
        const at = n => a.unpacked[(2 * n + c) * each + k];
        return (at(i) + part * (at(j) - at(i))) / 127 * a.stride;
      });
      if (Math.hypot(u, v) < 0.05 * a.stride) continue;
      const x = a.stride * (k % a.columns) + a.stride / 2, y = a.stride * Math.floor(k / a.columns) + a.stride / 2;
      const [from, to] = [corner(x / f.columns, y / f.rows), corner((x + u) / f.columns, (y + v) / f.rows)];
      this.arrow(from[0], from[1], to[0], to[1], 1);
    }
  }

  drawBox() {
    const context = this.context, [low, high] = this.box;
    const corner = n => this.project([0, 1, 2].map(d => (n >> d) & 1 ? high[d] : low[d]));
    context.strokeStyle = this.ink; context.globalAlpha = 0.35; context.lineWidth = 1;
    context.beginPath();
    for (let n = 0; n < 8; ++n) for (const bit of [1, 2, 4]) {
      if (n & bit) continue;
      context.moveTo(...corner(n).slice(0, 2)); context.lineTo(...corner(n | bit).slice(0, 2));
    }
    context.stroke(); context.globalAlpha = 1;
  }

  // Obstacles and the platform.
  drawWires() {
    const context = this.context;
    context.strokeStyle = this.ink; context.globalAlpha = 0.6; context.lineWidth = 1;
    context.beginPath();
    for (const line of this.run.wires) line.forEach((p, i) => {
      const [x, y] = this.project(p);
      if (i) context.lineTo(x, y); else context.moveTo(x, y);
    });
    context.stroke(); context.globalAlpha = 1;
  }

  // Words on a rim of the paper's colour: the flow behind them has any.
  write(text, x, y) {
    const context = this.context, ink = context.strokeStyle;
    context.strokeStyle = this.paper; context.lineWidth = 4; context.lineJoin = "round";
    context.strokeText(text, x, y); context.fillText(text, x, y);
    context.strokeStyle = ink;
  }

  arrow(x0, y0, x1, y1, width) {
    const context = this.context, length = Math.hypot(x1 - x0, y1 - y0), head = Math.min(9, length / 2);
    context.lineWidth = width;
    context.beginPath(); context.moveTo(x0, y0); context.lineTo(x1, y1); context.stroke();
    if (length < 3) return;
    const [ex, ey] = [(x1 - x0) / length, (y1 - y0) / length];
    context.beginPath(); context.moveTo(x1 + 0.6 * head * ex, y1 + 0.6 * head * ey);
    context.lineTo(x1 - 0.4 * head * ex - 0.5 * head * ey, y1 - 0.4 * head * ey + 0.5 * head * ex);
    context.lineTo(x1 - 0.4 * head * ex + 0.5 * head * ey, y1 - 0.4 * head * ey - 0.5 * head * ex); context.fill();
  }

  direction(v) { // of a vector, as seen, for length 1
    const m = this.matrix, s = this.scale;
    return [(m[0] * v[0] + m[1] * v[1] + m[2] * v[2]) / s, (m[3] * v[0] + m[4] * v[1] + m[5] * v[2]) / s];
  }

  // The field now, in the upper left corner; its length is its share of the largest. A ring is a
  // field towards the viewer.
  drawField() {
    if (!this.field) return;
    const context = this.context, [x, y] = this.direction(this.field.map(b => b / this.run.field.largest));
    context.strokeStyle = context.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--field");
    this.arrow(62 - 38 * x, 62 - 38 * y, 62 + 38 * x, 62 + 38 * y, 3);
    context.globalAlpha = 0.4; context.lineWidth = 1;
    context.beginPath(); context.arc(62, 62, 46, 0, 7); context.stroke(); context.globalAlpha = 1;
    context.font = "13px system-ui, sans-serif"; context.textAlign = "left"; context.textBaseline = "alphabetic";
    this.write(`B ${quantity(Math.hypot(...this.field), "T")}${this.run.field.at ? ` at ${this.run.field.at}` : ""}`, 116, 26);
  }

  drawAxes() {
    const context = this.context, x0 = 40, y0 = this.height - 40;
    context.strokeStyle = context.fillStyle = this.ink; context.font = "12px system-ui, sans-serif";
    context.textAlign = "center"; context.textBaseline = "middle";
    [[1, 0, 0], [0, 1, 0], [0, 0, 1]].forEach((v, d) => {
      const [x, y] = this.direction(v), long = Math.hypot(x, y), end = 22 + 13 / long; // past the arrow's head
      this.arrow(x0, y0, x0 + 22 * x, y0 + 22 * y, 1.2);
      if (long > 0.25) this.write("xyz"[d], x0 + end * x, y0 + end * y);
    });
  }

  drawScale() {
    const wanted = 90 / this.scale, power = 10 ** Math.floor(Math.log10(wanted));
    const length = [5, 2, 1].map(m => m * power).find(l => l <= wanted), context = this.context;
    const y = this.height - 16, x = this.width - 20 - length * this.scale;
    context.strokeStyle = context.fillStyle = this.ink; context.lineWidth = 2;
    context.beginPath(); context.moveTo(x, y); context.lineTo(this.width - 20, y); context.stroke();
    context.font = "13px system-ui, sans-serif"; context.textAlign = "right"; context.textBaseline = "alphabetic";
    this.write(quantity(length, "m"), this.width - 20, y - 6);
  }
}

// The bodies of one run.
class Shape {
  constructor(run, number) {
    const b = this.bodies = run.bodies;
    this.number = number;
    this.points = unpack(b.points, Uint16Array); this.quads = unpack(b.faces, Uint32Array);
    this.body = unpack(b.body, Uint8Array);
    this.seen = new Float64Array(3 * b.nodes);
    this.list = Array.from({ length: this.quads.length / 4 },
      () => ({ depth: 0, style: "", wire: number > 0, thin: false, corners: new Float64Array(8) }));
  }

  // Where the nodes are seen, between the stored instants on straight lines.
  move(view) {
    const b = this.bodies, n = 3 * b.nodes, i = view.frame(b.times), j = Math.min(i + 1, b.times.length - 1), part = view.part(b.times);
    const p = this.points, [lx, ly, lz] = b.low, at = [0, 0, 0];
    for (let k = 0; k < n; k += 3) {
      const s = i * n + k, e = j * n + k;
      at[0] = lx + b.step * (p[s] + part * (p[e] - p[s]));
      at[1] = ly + b.step * (p[s + 1] + part * (p[e + 1] - p[s + 1]));
      at[2] = lz + b.step * (p[s + 2] + part * (p[e + 2] - p[s + 2]));
      const q = view.project(at);
      this.seen[k] = q[0]; this.seen[k + 1] = q[1]; this.seen[k + 2] = q[2];
    }
    this.frame = i; this.next = j; this.part = part;
  }

  // Adds its faces to those before or behind the plane of a slice.
  faces(view, cut, far, near) {
    this.move(view);
    const s = this.seen, q = this.quads, colour = this.number === 0 ? this.bodies.colours[view.colour] : null;
    if (colour) colour.unpacked ||= unpack(colour.values, Uint8Array);
    // Depth of the slice at a place of the view: its plane, solved for it.
    const plane = cut && this.planeOf(view, cut);
    for (let f = 0; f < this.list.length; ++f) {
      const item = this.list[f], c = item.corners;
      let depth = 0, x = 0, y = 0;
      for (let i = 0; i < 4; ++i) {
        const k = 3 * q[4 * f + i];
        c[2 * i] = s[k]; c[2 * i + 1] = s[k + 1]; depth += s[k + 2] / 4; x += s[k] / 4; y += s[k + 1] / 4;
      }
      // Bodies are closed: a face that looks away (its corners go round the other way) is hidden.
      if ((c[4] - c[0]) * (c[7] - c[3]) - (c[5] - c[1]) * (c[6] - c[2]) > 0) continue;
      // A little larger than it is: edges of neighbours, each smoothed by itself, would let through
      // what is behind. Filling alone costs half of filling and drawing the edge, which long thin
      // faces take.
      const [ax, ay, bx, by] = [c[4] - c[0], c[5] - c[1], c[6] - c[2], c[7] - c[3]];
      item.thin = Math.abs(ax * by - ay * bx) < 0.5 * Math.hypot(ax, ay) * Math.hypot(bx, by);
      for (let i = 0; i < 8 && !item.thin && !item.wire; i += 2) {
        const dx = c[i] - x, dy = c[i + 1] - y, more = SEAM / (Math.abs(dx) + Math.abs(dy) + SEAM);
        c[i] += more * dx; c[i + 1] += more * dy;
      }
      item.depth = depth;
      item.edge = colour && this.list.length < MOST_EDGES ? "#0004" : ""; // shape, where no light shows it
      item.style = this.number ? line(this.number) : this.style(f, colour);
      (plane && depth < plane(x, y) ? far : near).push(item);
    }
  }

  planeOf(view, cut) {
    const across = [0, 1, 2].filter(d => d !== cut.axis), at = (u, v) => {
      const p = [0, 0, 0];
      p[cut.axis] = cut.at; p[across[0]] = u; p[across[1]] = v;
      return view.project(p);
    };
    const o = at(0, 0), a = at(view.extent, 0), b = at(0, view.extent);
    const [ax, ay, az] = a.map((v, d) => v - o[d]), [bx, by, bz] = b.map((v, d) => v - o[d]);
    const det = ax * by - ay * bx;
    if (Math.abs(det) < 1e-9) return null; // seen on its edge
    return (x, y) => {
      const u = ((x - o[0]) * by - (y - o[1]) * bx) / det, v = (ax * (y - o[1]) - ay * (x - o[0])) / det;
      return o[2] + u * az + v * bz;
    };
  }

  // What has a bar of colours has these and no light; plain bodies are lit from the viewer, by how far
  // the face looks towards it.
  style(f, colour) {
    const q = this.quads, s = this.seen;
    if (colour) {
      const map = mapOf(colour), values = colour.unpacked, faces = q.length / 4;
      const each = colour.frames > 1 ? colour.of === "faces" ? faces : this.bodies.nodes : 0;
      const stored = n => values[this.frame * each + n] + this.part * (values[this.next * each + n] - values[this.frame * each + n]);
      const v = Math.round(colour.of === "faces" ? stored(f) :
        (stored(q[4 * f]) + stored(q[4 * f + 1]) + stored(q[4 * f + 2]) + stored(q[4 * f + 3])) / 4);
      return `rgb(${map[3 * v]},${map[3 * v + 1]},${map[3 * v + 2]})`;
    }
    const a = 3 * q[4 * f], b = 3 * q[4 * f + 1], d = 3 * q[4 * f + 3];
    const ux = s[b] - s[a], uy = s[b + 1] - s[a + 1], uz = s[b + 2] - s[a + 2];
    const vx = s[d] - s[a], vy = s[d + 1] - s[a + 1], vz = s[d + 2] - s[a + 2];
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const light = 0.62 + 0.38 * Math.abs(nz) / (Math.hypot(nx, ny, nz) || 1);
    return `rgb(${BODIES[this.body[f] % BODIES.length].map(v => Math.round(light * v)).join()})`;
  }
}
