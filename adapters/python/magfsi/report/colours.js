// SPDX-License-Identifier: GPL-2.0-or-later
// Colours, numbers and units. MAPS: 256 colours each, from matplotlib (report/colours.py).

const DARK = matchMedia("(prefers-color-scheme: dark)");
const GLASS = 0.85; // how opaque a slice is, on the picture and in its bar
const TABLES = Object.fromEntries(Object.entries(MAPS).map(([kind, text]) => [kind, unpack(text, Uint8Array)]));
// On dark paper magnitudes of the flow begin dark, too.
const mapOf = colour => TABLES[colour.signed ? "signed" : colour.of === "pixels" && !DARK.matches ? "flow" : "magnitude"];
function gradient(colour) {
  const map = mapOf(colour), at = i => `rgb(${map[3 * i]},${map[3 * i + 1]},${map[3 * i + 2]})`;
  return `linear-gradient(to right,${Array.from({ length: 18 }, (_, i) => at(15 * i)).join(",")})`;
}

// Okabe and Ito's, without the yellow and the black.
const LINES = () => DARK.matches ? ["#56b4e9", "#f0a04b", "#3ec79a", "#e39ac4"] : ["#0072b2", "#c85000", "#00805f", "#b0568c"];
const BODIES = [[219, 115, 51], [0, 114, 178], [0, 158, 115], [204, 121, 167], [86, 180, 233], [230, 159, 0]];
const line = i => LINES()[i % 4];

function unpack(text, Kind) {
  const letters = atob(text), bytes = new Uint8Array(letters.length); // a call for each letter takes ten times as long
  for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
  return new Kind(bytes.buffer);
}

const ROUNDED = 5e-4; // what three digits write as 1 is not 1000 of the smaller unit

// A unit as a reader is to see it, as magfsi.units.typeset does it: "1/s^2" as s⁻², "m2/s" as m²/s, "1" as nothing.
const raised = power => power.replace(/[-0-9]/g, c => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);
function typeset(unit) {
  if (unit === "" || unit === "1") return "";
  const over = /^1\/([A-Za-z]+)\^?(\d*)$/.exec(unit);
  if (over) return over[1] + raised(`-${over[2] || 1}`);
  return unit.replace(/\bdeg\b/g, "°").replace(/([A-Za-z])\^?(-?\d+)/g, (_, letter, power) => letter + raised(power));
}
// The unit as it stands behind a number.
const behind = shown => shown === "" || shown === "°" ? shown : ` ${shown}`;

// [factor, unit as it is shown] in which the largest is between 1 and 1000.
function scaled(largest, unit) {
  const prefixes = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"], [1e-12, "p"]];
  if (!(largest > 0) || !["m", "s", "m/s", "N", "J", "T", "Pa", "W", "A/m", "N m", "N s"].includes(unit)) return [1, typeset(unit)];
  const known = unit === "s" ? prefixes.slice(3) : prefixes; // nobody says kiloseconds
  const [size, prefix] = known.find(([s]) => s <= largest * (1 + ROUNDED)) || known.at(-1);
  return [1 / size, prefix + unit];
}
const round3 = v => String(Math.abs(v) >= 1000 ? Math.round(v) : Number(v.toPrecision(3)));
function number(v) {
  const a = Math.abs(v);
  return a === 0 ? "0" : a < 1e-3 || a >= 1e5 ? v.toExponential(1).replace(".0e", "e") : round3(v);
}
function quantity(v, unit) {
  const [factor, shown] = scaled(Math.abs(v), unit);
  return `${number(factor * v)}${behind(shown)}`;
}
