// SPDX-License-Identifier: GPL-2.0-or-later
template <>
constexpr const char* law_name<SweptField> = "swept";

namespace {

ConstantField polar(const SweptField& course, double time_s) {
    const double turns =
        course.frequency_hz * time_s + 0.5 * course.rate_hz_s * time_s * time_s;
    return {course.magnitude_t, course.start_rad + 2 * std::numbers::pi * turns};
}

}  // namespace
