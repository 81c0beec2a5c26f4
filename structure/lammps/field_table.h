// Piecewise linear tables of time, as values and as LAMMPS formulas.
#pragma once

#include <span>
#include <string>

#include "structure/lammps/field_program.h"

namespace magfsi::structure {

void check_table(const FieldTable& table);

// t, or for a repeated table t brought into its rows: t - T floor((t - t0) / T).
double fold_time(const FieldTable& table, double time_s);
std::string fold_formula(const FieldTable& table);

// Linear between the rows, end values outside.
double interpolate(std::span<const double> time_s, std::span<const double> value,
                   double t);

// The same as a formula of v_t: with slopes s that are zero outside the rows,
// f(t) = f_first + 1/2 sum (s_after - s_before)_i (|t - t_i| - t_i), plus the jumps.
// LAMMPS reads its formulas anew in every step, so this shortest form is also the
// fastest.
std::string table_formula(std::span<const double> time_s, std::span<const double> value);

// A number that reads back exactly.
std::string number(double value);

}  // namespace magfsi::structure
