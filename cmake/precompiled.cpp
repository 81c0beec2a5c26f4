// SPDX-License-Identifier: GPL-2.0-or-later
// An empty source: CMake compiles a precompiled header with a source of the same target.
