// SPDX-License-Identifier: GPL-2.0-or-later
// Of no content: CMake compiles a precompiled header with a source of the same target.
