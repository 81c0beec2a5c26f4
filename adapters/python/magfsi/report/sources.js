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

  draw(view) {
    const context = view.context, i = view.frame(this.t), part = view.part(this.t), of = p => this.place(p, i, part);
    context.strokeStyle = context.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--field");
    context.lineWidth = 1.5; context.font = "13px system-ui, sans-serif"; context.textBaseline = "alphabetic";
    context.beginPath();
    for (const line of this.lines) line.forEach((p, n) => context[n ? "lineTo" : "moveTo"](...view.project(of(p)).slice(0, 2)));
    context.stroke();
    // A coil is named at a point of each loop, a magnet at its middle.
    if (this.flows) this.lines.forEach((line, k) => this.mark(view, of(line[0]), `${this.name} ${quantity(this.flows[k][i], "A turns")}`));
    else {
      const size = Math.hypot(...this.moment), from = of([0, 0, 0]), to = of(this.moment.map(v => Math.sign(this.strength[i]) * v / size));
      this.mark(view, from, `${this.name} ${quantity(size * this.strength[i], "A m2")}`, to.map((v, d) => v - from[d]));
    }
  }

  mark(view, place, words, moment) {
    const context = view.context, [x, y] = view.project(place), [mx, my] = [view.width / 2, view.height / 2], [dx, dy] = [x - mx, y - my];
    if (Math.abs(dx) < mx - 10 && Math.abs(dy) < my - 10) {
      const [ax, ay] = moment ? view.direction(moment) : [0, 0];
      if (moment) view.arrow(x - 18 * ax, y - 18 * ay, x + 18 * ax, y + 18 * ay, 3);
      context.textAlign = dx > 0 ? "right" : "left";
      view.write(words, x + (dx > 0 ? -24 : 24), y - 8);
      return;
    }
    // Towards it, from the middle of the view to before its edge.
    const reach = Math.min((mx - 26) / Math.max(1e-9, Math.abs(dx)), (my - 140) / Math.max(1e-9, Math.abs(dy))), long = Math.hypot(dx, dy);
    const [ex, ey] = [mx + reach * dx, my + reach * dy], away = Math.hypot(...place.map((v, d) => v - view.middle[d]));
    view.arrow(ex - 22 * dx / long, ey - 22 * dy / long, ex, ey, 2);
    context.textAlign = Math.abs(dx) < mx / 3 ? "center" : dx > 0 ? "right" : "left";
    // Above and below each has a line of its own.
    const side = reach * Math.abs(dx) > mx - 30 ? null : Math.sign(dy), before = side ? view.marks.filter(s => s === side).length : 0;
    view.marks.push(side);
    view.write(`${words}, ${quantity(away, "m")} away`, ex, ey + (dy > 0 ? 18 + 16 * before : -8 - 16 * before));
  }
}
