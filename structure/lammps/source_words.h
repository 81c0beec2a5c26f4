// SPDX-License-Identifier: GPL-2.0-or-later
// Sources of the magnetic field as the words of one LAMMPS argument, and back. Shapes,
// strengths and motions are laws in the words of law_words.h.
#pragma once

#include <string>
#include <vector>

#include "structure/source_options.h"

namespace magfsi::structure {

// Sources are separated by semicolons. Each begins with its kind:
//   dipole MX MY MZ
//   cuboid SX SY SZ JX JY JZ
//   cylinder DIAMETER HEIGHT AX AY AZ JX JY JZ
//   coil DIAMETER AX AY AZ CURRENT TURNS
//   pair DIAMETER AX AY AZ CURRENT TURNS DISTANCE, or opposed_pair with the same numbers
//   system [times T1 T2 ... | repeat_times T1 T2 ...]
//       member PX PY PZ DIAMETER AX AY AZ TURNS CURRENT1 CURRENT2 ...  (for each coil)
//       or member PX PY PZ DIAMETER AX AY AZ TURNS current FORMULA
//   grid FILE
// Place, strength, motion and turning follow, each if given:
//   at X Y Z
//   rotated AX AY AZ ANGLE
//   strength oscillation FREQUENCY PHASE, table TIME F ..., repeat_table TIME F ..., ramp
//   TIME, or formula FORMULA
//   motion oscillation DX DY DZ FREQUENCY PHASE, ramp DX DY DZ TIME, path TIME DX DY DZ
//   ..., repeat_path TIME DX DY DZ ..., or formula FORMULA FORMULA FORMULA
//   turning AX AY AZ FREQUENCY [X Y Z], or angle AX AY AZ FORMULA [X Y Z]
//   (about the source, or about a point)
// All numbers are in SI, angles in radians, J is the remanence [T]. Formulas are
// functions of t [s] without blanks (structure/formula.h). Numbers are exact when read
// back; names of sources are not kept. Both functions throw std::invalid_argument on
// words that are no sources.
std::string source_words(const std::vector<FieldSource>& sources);
std::vector<FieldSource> parse_source_words(const std::string& text);

}  // namespace magfsi::structure
