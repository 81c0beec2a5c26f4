// The robot in its box, seen without perspective: a slice of the flow is then a picture that is
// only sheared, and faces are painted from back to front.

function unpack(text, Kind) {
  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  return new Kind(bytes.buffer);
}

// Two colour maps that keep their order in grey: dark to light, and blue - white - red.
function sequential(x) {
  return [68 + 185 * x, 1 + 230 * x, 84 + 40 * Math.sin(3.14 * x) - 47 * x];
}
function diverging(x) { // -1 to 1
  const a = Math.abs(x), end = x < 0 ? [33, 60, 150] : [178, 24, 43];
  return end.map(c => 245 + (c - 245) * a);
}
const css = rgb => `rgb(${rgb.map(Math.round).join(",")})`;

class View {
  constructor(canvas, run) {
    this.canvas = canvas; this.run = run;
    this.yaw = -0.35; this.pitch = 0.2; this.zoom = 1; this.pan = [0, 0];
    this.colour = ""; this.showsFlow = true; this.time = 0;
    const b = run.bodies;
    if (b) {
      this.points = unpack(b.points, Uint16Array); this.faces = unpack(b.faces, Uint32Array);
      this.speeds = unpack(b.speeds, Uint8Array);
      if (b.magnetization) this.moment = unpack(b.magnetization.values, Int8Array);
    }
    if (run.flow) this.readSlices();
    const low = run.box ? [0, 0, 0] : b ? b.low : [0, 0, 0];
    const high = run.box || (b ? b.high : [1, 1, 1]);
    this.low = low; this.high = high;
    this.middle = low.map((v, d) => (v + high[d]) / 2);
    this.extent = Math.max(Math.hypot(...low.map((v, d) => high[d] - v)), 1e-9);
    this.listen();
  }

  readSlices() {
    const f = this.run.flow, values = unpack(f.values, Uint8Array), each = f.rows * f.columns;
    this.slices = f.times.map((_, i) => {
      const picture = document.createElement("canvas");
      picture.width = f.columns; picture.height = f.rows;
      const context = picture.getContext("2d"), image = context.createImageData(f.columns, f.rows);
      for (let k = 0; k < each; ++k) {
        const v = values[i * each + k];
        image.data.set([60, 120, 190, Math.min(235, 1.6 * v)], 4 * k);
      }
      context.putImageData(image, 0, 0);
      return picture;
    });
  }

  listen() {
    let from = null;
    const c = this.canvas;
    c.onpointerdown = e => { from = [e.clientX, e.clientY]; c.setPointerCapture(e.pointerId); };
    c.onpointerup = () => { from = null; };
    c.onpointermove = e => {
      if (!from) return;
      const [dx, dy] = [e.clientX - from[0], e.clientY - from[1]];
      if (e.shiftKey) { this.pan[0] += dx; this.pan[1] += dy; }
      else { this.yaw -= 0.008 * dx; this.pitch = Math.max(-1.57, Math.min(1.57, this.pitch + 0.008 * dy)); }
      from = [e.clientX, e.clientY]; this.draw();
    };
    c.onwheel = e => { e.preventDefault(); this.zoom *= Math.exp(-0.0012 * e.deltaY); this.draw(); };
    c.ondblclick = () => { this.zoom = 1; this.pan = [0, 0]; this.draw(); };
  }

  // [right, down, towards the viewer] in pixels.
  project(p) {
    const [x, y, z] = p.map((v, d) => v - this.middle[d]);
    const cy = Math.cos(this.yaw), sy = Math.sin(this.yaw);
    const right = cy * x + sy * y, away = -sy * x + cy * y;
    const cp = Math.cos(this.pitch), sp = Math.sin(this.pitch);
    return [this.width / 2 + this.pan[0] + this.scale * right,
            this.height / 2 + this.pan[1] - this.scale * (cp * z + sp * away),
            this.scale * (sp * z - cp * away)];
  }

  // Of the stored instants the last that is not after the time.
  frame(times) {
    let i = 0;
    while (i + 1 < times.length && times[i + 1] <= this.time + 1e-12) ++i;
    return i;
  }

  // A point of the surface [m], between the stored instants on a straight line.
  positions() {
    const b = this.run.bodies, i = this.frame(b.times), j = Math.min(i + 1, b.times.length - 1);
    const part = j > i ? Math.min(1, (this.time - b.times[i]) / (b.times[j] - b.times[i])) : 0;
    const all = new Float64Array(3 * b.nodes);
    for (let k = 0; k < all.length; ++k) {
      const a = this.points[i * all.length + k], e = this.points[j * all.length + k];
      all[k] = b.low[k % 3] + b.step * (a + part * (e - a));
    }
    return [all, i];
  }

  draw() {
    const ratio = window.devicePixelRatio || 1, c = this.canvas;
    this.width = c.clientWidth; this.height = c.clientHeight;
    c.width = Math.round(ratio * this.width); c.height = Math.round(ratio * this.height);
    this.scale = 0.92 * this.zoom * Math.min(this.width, this.height) / this.extent * 1.15;
    const context = this.context = c.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.ink = getComputedStyle(c).color;
    if (this.slices && this.showsFlow) this.drawSlice(ratio);
    if (this.run.box) this.drawBox();
    this.drawWires();
    if (this.points) this.drawBodies();
    this.drawField(); this.drawScale();
  }

  drawSlice(ratio) {
    const f = this.run.flow, across = [0, 1, 2].filter(d => d !== f.axis);
    const corner = (u, v) => {
      const p = [0, 0, 0];
      p[f.axis] = f.at; p[across[0]] = f.origin[0] + u * f.size[0]; p[across[1]] = f.origin[1] + v * f.size[1];
      return this.project(p);
    };
    const o = corner(0, 0), a = corner(1, 0), b = corner(0, 1), context = this.context;
    context.save();
    context.transform((a[0] - o[0]) / f.columns, (a[1] - o[1]) / f.columns,
                      (b[0] - o[0]) / f.rows, (b[1] - o[1]) / f.rows, o[0], o[1]);
    context.drawImage(this.slices[this.frame(f.times)], 0, 0);
    context.restore();
  }

  drawBox() {
    const context = this.context, { low, high } = this;
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

  drawBodies() {
    const [all, frame] = this.positions(), n = this.run.bodies.nodes, faces = this.faces;
    const seen = [], shown = [];
    for (let k = 0; k < n; ++k) seen.push(this.project([all[3 * k], all[3 * k + 1], all[3 * k + 2]]));
    for (let q = 0; q < faces.length; q += 4) {
      const corners = [0, 1, 2, 3].map(i => seen[faces[q + i]]);
      shown.push([corners.reduce((s, p) => s + p[2], 0), q / 4, corners]);
    }
    shown.sort((a, b) => a[0] - b[0]);
    for (const [, q, corners] of shown) {
      this.context.fillStyle = this.context.strokeStyle = this.faceColour(q, frame, corners);
      this.context.lineWidth = 0.6;
      this.context.beginPath();
      corners.forEach((p, i) => this.context[i ? "lineTo" : "moveTo"](p[0], p[1]));
      this.context.closePath(); this.context.fill(); this.context.stroke();
    }
  }

  faceColour(q, frame, corners) {
    const [a, b, , d] = corners;
    const u = [b[0] - a[0], b[1] - a[1], b[2] - a[2]], v = [d[0] - a[0], d[1] - a[1], d[2] - a[2]];
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const light = 0.62 + 0.38 * Math.abs(normal[2]) / (Math.hypot(...normal) || 1);
    let rgb = [219, 115, 51];
    if (this.colour === "magnetization") rgb = diverging(this.moment[q] / 127);
    if (this.colour === "speed") {
      let sum = 0;
      for (let i = 0; i < 4; ++i) sum += this.speeds[frame * this.run.bodies.nodes + this.faces[4 * q + i]];
      rgb = sequential(sum / 1020);
    }
    return css(rgb.map(c => c * light));
  }

  // The field now, as an arrow in the upper left corner; its length is its share of the largest.
  drawField() {
    const { field, fieldNow } = this;
    if (!field || fieldNow === undefined) return;
    const context = this.context, at = [60, 60], o = this.project(this.middle);
    const tip = this.project(this.middle.map((v, d) => v + field[d] * this.extent));
    const direction = [tip[0] - o[0], tip[1] - o[1]], whole = this.scale * this.extent;
    const x = 40 * fieldNow * direction[0] / whole, y = 40 * fieldNow * direction[1] / whole;
    const colour = getComputedStyle(document.documentElement).getPropertyValue("--field");
    context.strokeStyle = context.fillStyle = colour; context.lineWidth = 3;
    context.beginPath(); context.moveTo(at[0] - x, at[1] - y); context.lineTo(at[0] + x, at[1] + y);
    context.stroke();
    const length = Math.hypot(x, y);
    if (length > 2) {
      const e = [x / length, y / length];
      context.beginPath(); context.moveTo(at[0] + x + 9 * e[0], at[1] + y + 9 * e[1]);
      context.lineTo(at[0] + x - 6 * e[1], at[1] + y + 6 * e[0]);
      context.lineTo(at[0] + x + 6 * e[1], at[1] + y - 6 * e[0]); context.fill();
    }
    context.font = "13px system-ui, sans-serif"; context.fillText("B", 22, 24);
  }

  drawScale() {
    const wanted = 90 / this.scale, power = 10 ** Math.floor(Math.log10(wanted));
    const length = [5, 2, 1].map(m => m * power).find(l => l <= wanted), context = this.context;
    const y = this.height - 16, x = this.width - 20 - length * this.scale;
    context.strokeStyle = context.fillStyle = this.ink; context.lineWidth = 2;
    context.beginPath(); context.moveTo(x, y); context.lineTo(this.width - 20, y); context.stroke();
    context.font = "13px system-ui, sans-serif"; context.textAlign = "right";
    context.fillText(`${Number((1e3 * length).toPrecision(3))} mm`, this.width - 20, y - 6);
    context.textAlign = "left";
  }
}
