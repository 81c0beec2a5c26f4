// SPDX-License-Identifier: GPL-2.0-or-later
// A rotation whose frequency rises, from `frequency` by `rate` each second.
struct SweptField {
    double magnitude_t = 0, start_rad = 0;
    double frequency_hz = 0, rate_hz_s = 0;
};
