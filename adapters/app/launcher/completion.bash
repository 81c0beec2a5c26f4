# SPDX-License-Identifier: GPL-2.0-or-later
# Completion of magfsi for bash: source <(magfsi completion bash). Commands, their options (those
# that COMMAND --help names), files.
_magfsi() {
    local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]}
    local words
    if [ "$COMP_CWORD" = 1 ]; then
        words="$("$program" --commands 2>/dev/null) --help --version"
    elif [[ $word == -* ]]; then
        words=$("$program" "${COMP_WORDS[1]}" --help 2>/dev/null | grep -oE -- '--[a-z][a-z-]*' | sort -u)
    elif [ "${COMP_WORDS[1]}" = completion ]; then
        words="bash zsh"
    else
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
        return
    fi
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -o filenames -o bashdefault -F _magfsi magfsi ./magfsi
