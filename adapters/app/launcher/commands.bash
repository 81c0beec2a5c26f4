# SPDX-License-Identifier: GPL-2.0-or-later
# The words of `magfsi`: their list, help, version, suggestions and what each starts. Sourced by the
# launcher of a checkout (./magfsi) and by that of an installation (cmake/install/magfsi.in), which
# set before: version, share (tutorials, and this file's folder as `launcher`), MAGFSI_BIN (the
# programs), PYTHONPATH; and define say() and prepare COMMAND ARGUMENT ..., which builds where there is
# something to build.

python=/usr/bin/python3 # -P: no modules from the folder where it is called

# WORD|KIND|MEANING. KIND: program (a word of the program magfsi), module (the Python module
# magfsi.WORD), own (a function below). A line that starts with "=" is a heading of the help.
command_table="\
=scenes
new|own|start a scene of your own: new NAME --like swimmer
check|program|one clear error, or \"good\"
explain|program|what a scene will run, and with what numbers, memory and time
run|program|run a scene: a file, or a folder with scene.yaml
schema|program|JSON Schema of the scene file, for editors
=results
report|module|a page of a run to play with, or of several laid over each other
watch|module|that page of a run while it goes on
plot|module|one picture of any run: shapes and every probe
compare|module|a scene with both fluids, or two runs: how far apart they are, and what each cost
figure|module|curves of runs for a paper: PDF and SVG, width and fonts for print
render|module|an instant of any run, lit, with vortices
film|module|any run as a film (MP4)
gallery|module|docs/index.html: every tutorial's page, picture and cost
cite|module|magfsi and the paper whose model it computes, as BibTeX
=accuracy and search
cost|module|the error bars of a scene, and what 10, 5, 2 and 1 % cost
study|module|a scene over a product of settings: error against seconds
witness|module|a run's plane flow again by OpenFOAM on a mesh fitted to the body: agreement with bars
optimize|module|the best settings of a scene for an objective
fit-material|module|elastic constants and Maxwell branches from measured curves, as YAML with a plot
design|module|the magnetisation that gives the shapes that are wanted
=other programs
lammps|own|LAMMPS with the magttice's styles, for plain input scripts
lattice|program|bodies of a scene as files for such scripts; of a lattice file, a mesh for a scene
python|own|Python with the package magfsi
=this machine
doctor|program|is this machine fit for runs?
bench|own|measure the solvers: bench lbm, bench structure; bench --calibrate for predictions
test|own|run the tests; test --installed: a short set for an installation
build|own|install what is missing and build, nothing else
completion|own|completion for a shell: source <(magfsi completion bash), or zsh"

commands() { sed -n 's/|.*//p' <<<"$command_table"; }
kind_of() { sed -n "s/^$1|\([a-z]*\)|.*/\1/p" <<<"$command_table"; }
meaning_of() { sed -n "s/^$1|[a-z]*|//p" <<<"$command_table"; }

help() {
    local line word kind meaning
    echo "magfsi $version: hard-magnetic soft robots in a fluid, simulated together"
    echo "usage: magfsi COMMAND ...    magfsi COMMAND --help    magfsi --version"
    while IFS= read -r line; do
        if [ "${line:0:1}" = = ]; then
            printf '\n%s:\n' "${line#=}"
            continue
        fi
        IFS='|' read -r word kind meaning <<<"$line"
        printf '  %-12s %s\n' "$word" "$meaning"
    done <<<"$command_table"
}

# distance A B: how many letters to put in, drop or change, or neighbours to exchange
distance() {
    local a=$1 b=$2 i j cost best
    local -A d
    for ((i = 0; i <= ${#a}; ++i)); do d[$i,0]=$i; done
    for ((j = 0; j <= ${#b}; ++j)); do d[0,$j]=$j; done
    for ((i = 1; i <= ${#a}; ++i)); do
        for ((j = 1; j <= ${#b}; ++j)); do
            cost=1
            [ "${a:i-1:1}" != "${b:j-1:1}" ] || cost=0
            best=$((d[$((i - 1)),$j] + 1))
            ((d[$i,$((j - 1))] + 1 >= best)) || best=$((d[$i,$((j - 1))] + 1))
            ((d[$((i - 1)),$((j - 1))] + cost >= best)) ||
                best=$((d[$((i - 1)),$((j - 1))] + cost))
            if ((i > 1 && j > 1)) && [ "${a:i-1:1}${a:i-2:1}" = "${b:j-2:1}${b:j-1:1}" ] &&
                ((d[$((i - 2)),$((j - 2))] + 1 < best)); then
                best=$((d[$((i - 2)),$((j - 2))] + 1))
            fi
            d[$i,$j]=$best
        done
    done
    echo "${d[${#a},${#b}]}"
}

unknown_command() {
    local word near="" best=3 d
    for word in $(commands); do
        d=$(distance "$1" "$word")
        # A third of the letters: "rn" may be run, "xyz" is nothing.
        if ((d < best && 3 * d <= ${#word} + 1)); then best=$d near=$word; fi
    done
    say "found the command '$1'; allowed is one of" $(commands)
    [ -z "$near" ] || say "did you mean $near?"
    exit 2
}

command_python() { exec $python "$@"; }
command_lammps() { exec "$MAGFSI_BIN/magfsi-lammps" "$@"; }

# What both launchers have of it; that of a checkout defines more.
command_build() { say "build: belongs to a checkout; this is an installation"; exit 2; }
command_bench() {
    [ "${1:-}" = --calibrate ] || { say "bench: found '${1:-}'; allowed here is --calibrate"; exit 2; }
    exec $python -P -m magfsi.calibrate
}
command_test() {
    [ "${1:-}" = --installed ] || { say "test: found '${1:-}'; allowed here is --installed"; exit 2; }
    shift
    exec $python -P -m magfsi.installed "$@"
}

command_completion() {
    case "${1:-}" in
        bash | zsh) cat "$launcher/completion.$1" ;;
        *) say "completion: found '${1:-}'; allowed is bash or zsh"; exit 2 ;;
    esac
}

# new NAME [--like TUTORIAL]: its scene with its scripts and shapes, under a name of one's own.
command_new() {
    local name="" like=swimmer known
    while [ $# -gt 0 ]; do
        case "$1" in
            --like) like=${2:-} && shift $(($# > 1 ? 2 : 1)) ;;
            -*) say "new: found '$1'; allowed is new NAME --like TUTORIAL"; exit 2 ;;
            *) [ -z "$name" ] || { say "new: found '$1' after the name '$name'"; exit 2; }
               name=$1 && shift ;;
        esac
    done
    known=$(cd "$share/tutorials" && ls -d -- */scene.yaml | sed 's|/.*||' | tr '\n' ' ')
    [[ $(basename -- "$name") =~ ^[A-Za-z][A-Za-z0-9_-]*$ ]] || {
        say "new: found the name '$name'; allowed are letters, digits, _ and -, a letter first"
        exit 2
    }
    [ -n "$like" ] && [ -f "$share/tutorials/$like/scene.yaml" ] || {
        say "new: found --like '$like'; allowed is one of $known"
        exit 2
    }
    [ ! -e "$name" ] || { say "new: $name is there already; take another name"; exit 2; }
    start_scene "$name" "$share/tutorials/$like"
    say "$name is a copy of the tutorial $like: magfsi explain $name, magfsi run $name"
}

# start_scene FOLDER TUTORIAL: with its scripts, and all that these and the scene name, also in comments
start_scene() {
    local file
    mkdir -p "$1"
    for file in "$2"/*; do
        case "$file" in
            */scene.yaml | *.md | *.png) ;;
            *.py) cp "$file" "$1/" ;;
            *) ! grep -qsF -- "$(basename "$file")" "$2"/scene.yaml "$2"/*.py || cp "$file" "$1/" ;;
        esac
    done
    {
        # Editors with a YAML language server complete and check the keys by it.
        if [ -x "$MAGFSI_BIN/magfsi" ] && "$MAGFSI_BIN/magfsi" schema >"$1/scene.schema.json"; then
            echo '# yaml-language-server: $schema=scene.schema.json'
        fi
        sed "s/^name: .*/name: $(basename -- "$1")/" "$2/scene.yaml"
    } >"$1/scene.yaml"
}

# Says what a command is and has; builds and writes nothing.
help_of() {
    local kind
    kind=$(kind_of "$1")
    [ -n "$kind" ] || unknown_command "$1"
    case "$kind" in
        program)
            [ ! -x "$MAGFSI_BIN/magfsi" ] || exec "$MAGFSI_BIN/magfsi" "$1" --help
            echo "magfsi $1: $(meaning_of "$1")"
            say "its options are listed once the programs are built: ./magfsi build"
            ;;
        # -B: not even bytecode is written.
        module) exec $python -P -B -m "magfsi.${1//-/_}" --help ;;
        *) echo "magfsi $1: $(meaning_of "$1")" ;;
    esac
}

# A tutorial may be named as in a checkout, wherever this is called.
existing_scene() {
    if [[ $1 == tutorials/* && ! -e $1 && -e $share/$1 ]]; then echo "$share/$1"; else echo "$1"; fi
}

# is_design FILE ...: whether the first of them that is a file is one of designs, whose top level has poses.
is_design() {
    local word
    for word in "$@"; do
        [ ! -f "$word" ] || { grep -qs '^poses *:' "$word"; return; }
    done
    return 1
}

dispatch() {
    local word=${1:-} argument arguments=()
    case "$word" in
        "" | -h | --help) help; exit 0 ;;
        help) shift; [ $# -gt 0 ] && help_of "$1" || help; exit 0 ;;
        --version) echo "magfsi $version"; exit 0 ;;
        --commands) commands; exit 0 ;; # for the completions
    esac
    [ -n "$(kind_of "$word")" ] || unknown_command "$word"
    shift
    case "${1:-}" in
        # What other programs have under --help is theirs to say.
        -h | --help) [ "$word" = lammps ] || [ "$word" = python ] || { help_of "$word"; exit 0; } ;;
    esac
    case "$word" in
        new | completion | python | cite) ;;
        *) prepare "$word" "$@" ;;
    esac
    for argument in "$@"; do arguments+=("$(existing_scene "$argument")"); done
    set -- ${arguments[@]+"${arguments[@]}"}
    # A design file has its own check and explanation.
    case "$word" in
        check | explain) ! is_design "$@" || exec $python -P -m magfsi.design "$@" "--$word" ;;
    esac
    # A page when the run has ended; only for a person's run, not for tests and searches.
    [ "$word" != run ] || export MAGFSI_PAGE=${MAGFSI_PAGE:-yes}
    case "$(kind_of "$word")" in
        program) exec "$MAGFSI_BIN/magfsi" "$word" "$@" ;;
        module) exec $python -P -m "magfsi.${word//-/_}" "$@" ;;
        *) "command_$word" "$@" ;;
    esac
}
