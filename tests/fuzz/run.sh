#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Fuzzes the scene reader: tests/fuzz/run.sh SECONDS (600). Needs clang with libFuzzer
# (Debian: clang, libclang-rt-dev). Starts from the scenes of the tutorials and of the tests.
# Ends with 0 if no input crashed, hung (10 s) or took more than 2 GiB; else the input lies
# in build/fuzz/found: fix what it shows and keep it in tests/fuzz/found.
set -eu
seconds=${1:-600}
top=$(cd "$(dirname "$0")/../.." && pwd)
cd "$top"

[ -f build/fuzz/build.ninja ] || cmake --preset fuzz
ninja -C build/fuzz -j "${JOBS:-1}" fuzz_scene

mkdir -p build/fuzz/corpus build/fuzz/found
for scene in tutorials/*/*.yaml tests/scenes/*.yaml tests/unit/scene/{complete,wrong}/*.yaml; do
    cp "$scene" "build/fuzz/corpus/seed-$(echo "$scene" | tr / -)"
done
# Keys and words of the scene's language.
grep -oE '[A-Za-z_][A-Za-z0-9_/]+' docs/scene.md | sort -u | sed 's/.*/"&"/' > build/fuzz/words

exec build/fuzz/bin/fuzz_scene build/fuzz/corpus -max_total_time="$seconds" -timeout=10 \
    -rss_limit_mb=2048 -max_len=8192 -dict=build/fuzz/words -artifact_prefix=build/fuzz/found/ \
    -print_final_stats=1
