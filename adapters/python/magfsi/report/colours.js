// SPDX-License-Identifier: GPL-2.0-or-later
// Colour maps whose lightness rises from end to end, so that they are read in grey, and that do
// not hang on telling red from green: viridis for magnitudes, cividis for what has two signs.
// Nine stops each, in between on straight lines.

const VIRIDIS = ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"];
const CIVIDIS = ["#00224e", "#123570", "#3b496c", "#575d6d", "#707173", "#8a8678", "#a59c74", "#c3b369", "#fee838"];

function table(stops) { // 256 colours, three numbers each
  const parts = stops.map(s => [1, 3, 5].map(i => parseInt(s.slice(i, i + 2), 16))), all = new Uint8Array(768);
  for (let i = 0; i < 256; ++i) {
    const at = i / 255 * (parts.length - 1), k = Math.min(parts.length - 2, Math.floor(at));
    for (let c = 0; c < 3; ++c) all[3 * i + c] = Math.round(parts[k][c] + (at - k) * (parts[k + 1][c] - parts[k][c]));
  }
  return all;
}
const MAGNITUDE = table(VIRIDIS), SIGNED = table(CIVIDIS);
const mapOf = colour => colour.signed ? SIGNED : MAGNITUDE;
const gradient = colour => `linear-gradient(to right,${(colour.signed ? CIVIDIS : VIRIDIS).join(",")})`;

const DARK = matchMedia("(prefers-color-scheme: dark)");
// Okabe and Ito's, without the yellow and the black.
const LINES = () => DARK.matches ? ["#56b4e9", "#f0a04b", "#3ec79a", "#e39ac4"] : ["#0072b2", "#c85000", "#00805f", "#b0568c"];
const BODIES = [[219, 115, 51], [0, 114, 178], [0, 158, 115], [204, 121, 167], [86, 180, 233], [230, 159, 0]];
const line = i => LINES()[i % 4];

function unpack(text, Kind) {
  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  return new Kind(bytes.buffer);
}

// [factor, unit] in which the largest is between 1 and 1000.
function scaled(largest, unit) {
  const prefixes = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"], [1e-12, "p"]];
  if (!(largest > 0) || !["m", "s", "m/s", "N", "J", "T", "Pa", "W", "A/m"].includes(unit)) return [1, unit];
  const known = unit === "s" ? prefixes.slice(3) : prefixes; // nobody says kiloseconds
  const [size, prefix] = known.find(([s]) => s <= largest * (1 + 1e-9)) || known.at(-1);
  return [1 / size, prefix + unit];
}
const round3 = v => String(Math.abs(v) >= 1000 ? Math.round(v) : Number(v.toPrecision(3)));
function number(v) {
  const a = Math.abs(v);
  return a === 0 ? "0" : a < 1e-3 || a >= 1e5 ? v.toExponential(1).replace(".0e", "e") : round3(v);
}
function quantity(v, unit) {
  const [factor, shown] = scaled(Math.abs(v), unit);
  return `${number(factor * v)}${shown === "1" ? "" : ` ${shown}`}`;
}
