#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# format.sh REPOSITORY: every C++ file is as clang-format would write it.
cd "$1" || exit 1
if ! command -v clang-format >/dev/null; then
    echo "skipped: clang-format is not installed (apt install clang-format)"
    exit 77
fi
find base structure fluid_lbm coupler adapters tests \( -name '*.h' -o -name '*.cpp' \) -print0 |
    xargs -0 clang-format --dry-run -Werror
