#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# chain.sh N [options of sbatch] -- SCENE [options of magfsi run]: N jobs of run.slurm, each after the
# one before has ended in order. Those that find the run complete end at once.
set -euo pipefail
jobs=${1:?"usage: chain.sh N [options of sbatch] -- SCENE [options of magfsi run]"}
shift
[[ $jobs =~ ^[1-9][0-9]*$ ]] || { echo "chain.sh: found '$jobs'; allowed is a number of jobs" >&2; exit 2; }
options=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do options+=("$1"); shift; done
[ $# -ge 2 ] || { echo "chain.sh: after -- comes the scene" >&2; exit 2; }
shift
script=$(dirname "$(readlink -f "$0")")/run.slurm
before=""
for ((n = 1; n <= jobs; ++n)); do
    after=()
    [ -z "$before" ] || after=(--dependency="afterok:$before")
    before=$(sbatch --parsable ${options[@]+"${options[@]}"} ${after[@]+"${after[@]}"} "$script" "$@")
    before=${before%%;*} # with the cluster's name behind it
    echo "job $n of $jobs: $before"
done
