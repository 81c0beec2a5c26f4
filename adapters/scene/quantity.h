// Numbers with units to SI.
#pragma once

#include <string>
#include <string_view>

namespace magfsi::scene {

// "17 mT" with the SI unit "T" gives 0.017. The decimal exponent of the unit is folded
// into the number's text before it is rounded, so that 0.2 mm, 200 um and 2e-4 m are the
// same double. si_unit "" wants a plain number. Throws Complaint naming the expected
// dimension and the one found.
double parse_quantity(std::string_view text, std::string_view si_unit);

// "a length such as 0.2 mm"
std::string dimension_expectation(std::string_view si_unit);

}  // namespace magfsi::scene
