// SPDX-License-Identifier: GPL-2.0-or-later
// A magnet or a coil: its lines, the arrow of its moment, its name; where it is out of sight, an arrow
// towards it at the edge of the view.
class Source {
  constructor(source) {
    Object.assign(this, source);
    this.t = unpack(source.times, Float32Array); this.placed = unpack(source.matrices, Float32Array);
    this.strength = unpack(source.factor, Float32Array);
    this.flows = source.currents?.map(current => unpack(current, Float32Array));
  }

  // A point of its frame in space, at a stored instant and a part of the way to the next.
  place(p, i, part) {
    const m = this.placed, j = i + 1 < this.t.length ? i + 1 : i;
    return [0, 1, 2].map(d => {
      const at = n => m[12 * n + 9 + d] + m[12 * n + 3 * d] * p[0] + m[12 * n + 3 * d + 1] * p[1] + m[12 * n + 3 * d + 2] * p[2];
      return at(i) + part * (at(j) - at(i));
    });
  }

  ends() {
    const all = [];
    for (let i = 0; i < this.t.length; ++i) for (const line of [...this.lines, [[0, 0, 0]]]) for (const p of line) all.push(this.place(p, i, 0));
    return [Math.min, Math.max].map(most => [0, 1, 2].map(d => all.reduce((v, p) => most(v, p[d]), all[0][d])));
  }

  said(i) {
    if (this.flows) return `${this.name} ${[...new Set(this.flows.map(f => quantity(f[i], "A")))].join(", ")}`;
    return `${this.name} ${quantity(Math.hypot(...this.moment) * this.strength[i], "A m²")}`;
  }

  draw(view) {
    const context = view.context, i = view.frame(this.t), part = view.part(this.t), where = view.project(this.place([0, 0, 0], i, part));
    context.strokeStyle = context.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--field");
    context.lineWidth = 1.5; context.font = "13px system-ui, sans-serif"; context.textBaseline = "alphabetic";
    context.beginPath();
    for (const line of this.lines) line.forEach((p, n) => context[n ? "lineTo" : "moveTo"](...view.project(this.place(p, i, part)).slice(0, 2)));
    context.stroke();
    const [x, y] = where, inside = x > 10 && x < view.width - 10 && y > 10 && y < view.height - 10;
    context.textAlign = x > view.width / 2 ? "right" : "left";
    if (inside) {
      if (this.moment) {
        const tip = this.place(this.moment.map(v => Math.sign(this.strength[i]) * v / Math.hypot(...this.moment)), i, part);
        const [dx, dy] = view.direction(tip.map((v, d) => v - this.place([0, 0, 0], i, part)[d]));
        view.arrow(x - 18 * dx, y - 18 * dy, x + 18 * dx, y + 18 * dy, 3);
      }
      view.write(this.said(i), x + (context.textAlign === "left" ? 24 : -24), y - 8);
      return;
    }
    // Towards it, from the middle of the view to just before its edge.
    const [mx, my] = [view.width / 2, view.height / 2], [dx, dy] = [x - mx, y - my];
    const reach = Math.min((mx - 26) / Math.max(1e-9, Math.abs(dx)), (my - 140) / Math.max(1e-9, Math.abs(dy)));
    const [ex, ey] = [mx + reach * dx, my + reach * dy], long = Math.hypot(dx, dy);
    view.arrow(ex - 22 * dx / long, ey - 22 * dy / long, ex, ey, 2);
    const away = Math.hypot(...this.place([0, 0, 0], i, part).map((v, d) => v - view.middle[d]));
    context.textAlign = Math.abs(dx) < mx / 3 ? "center" : dx > 0 ? "right" : "left";
    view.write(`${this.said(i)}, ${quantity(away, "m")} away`, ex, ey + (dy > 0 ? 16 : -8));
  }
}
