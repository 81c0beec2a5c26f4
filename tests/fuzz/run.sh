#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Fuzzes a reader of files: tests/fuzz/run.sh [READER [SECONDS]], READER one of scene, table (CSV),
# grid, surface (STL), mesh (Gmsh's) and state (of a checkpoint), or all, each for SECONDS (600).
# Needs clang 16 or newer with libFuzzer and OpenMP (Debian 13: clang, libclang-rt-dev, libomp-dev; 12:
# clang-16, libclang-rt-16-dev, libomp-16-dev, and CXX=clang++-16) and, for seeds, the programs of
# build/release. Starts from files of the tutorials and of the tests. Ends with 0 if no input
# crashed, hung (10 s) or took more than 2 GiB; else the input lies in build/fuzz/found: fix what
# it shows and keep it in tests/fuzz/found, or as a case of the reader's unit test.
set -eu
reader=${1:-scene}
seconds=${2:-600}
top=$(cd "$(dirname "$0")/../.." && pwd)
cd "$top"
if [ "$reader" = all ]; then
    for each in scene table grid surface mesh state; do "$0" $each "$seconds"; done
    exit
fi

[ -f build/fuzz/build.ninja ] || cmake --preset fuzz -DCMAKE_CXX_COMPILER="${CXX:-clang++}"
ninja -C build/fuzz -j "${JOBS:-1}" "fuzz_$reader"

corpus=build/fuzz/corpus_$reader
mkdir -p "$corpus" build/fuzz/found
# seeds FOLDER PATTERN ...: small files of these names.
seeds() {
    local folder=$1 file
    shift
    for pattern in "$@"; do
        find "$folder" -name "$pattern" -size -64k | while read -r file; do
            cp "$file" "$corpus/seed-$(echo "$file" | tr / -)"
        done
    done
}
longest=8192 most_mib=2048 rounds=1 words=()
case $reader in
    scene)
        seeds tutorials '*.yaml' && seeds tests '*.yaml'
        # Keys and words of the scene's language.
        grep -oE '[A-Za-z_][A-Za-z0-9_/]+' docs/scene.md | sort -u | sed 's/.*/"&"/' >build/fuzz/words
        words=(-dict=build/fuzz/words) ;;
    table | grid) seeds tutorials '*.csv' && seeds tests '*.csv' && seeds docs '*.csv' ;;
    surface) seeds tutorials '*.stl' && seeds tests '*.stl' ;;
    mesh)
        seeds tutorials '*.msh' && seeds tests '*.msh'
        most_mib=8192 rounds=6 ;;  # Gmsh does not free 0.5 MiB a file; one allocation has 2 GiB
    state)
        run=$(mktemp -d)
        build/release/bin/magfsi run tests/scenes/small_swimmer.yaml --out "$run" --set time.end='50 us' \
            --set checkpoint.every='50 us' --set fluid.spacing='1 mm' --set time.step='50 us' >/dev/null
        cp "$run"/*.h5 "$corpus"
        rm -r "$run"
        longest=200000 ;;
esac

# Gmsh and HDF5 do not free what they allocated for a file that turns out to be damaged.
printf 'leak:libgmsh\nleak:libhdf5\n' >build/fuzz/leaks_of_libraries
export LSAN_OPTIONS=suppressions=$PWD/build/fuzz/leaks_of_libraries:print_suppressions=0

for ((round = 0; round < rounds; ++round)); do
    "build/fuzz/bin/fuzz_$reader" "$corpus" -max_total_time=$((seconds / rounds)) -timeout=10 \
        -rss_limit_mb=$most_mib -malloc_limit_mb=2048 -max_len=$longest "${words[@]}" \
        -artifact_prefix=build/fuzz/found/ -print_final_stats=1 -close_fd_mask=1
done
