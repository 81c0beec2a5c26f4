#compdef magfsi
# SPDX-License-Identifier: GPL-2.0-or-later
# Completion of magfsi for zsh: source <(magfsi completion zsh), after compinit; or this file as
# _magfsi in a folder of fpath. Commands with their meaning, options, files.
_magfsi() {
    local program=${words[1]}
    local -a found
    if (( CURRENT == 2 )); then
        found=(${(f)"$($program --help 2>/dev/null | sed -n 's/^  \([a-z]*\)  *\(.*\)/\1:\2/p')"})
        _describe command found
    elif [[ ${words[CURRENT]} == -* ]]; then
        found=(${(f)"$($program ${words[2]} --help 2>/dev/null | grep -oE -- '--[a-z][a-z-]*' | sort -u)"})
        compadd -- $found
    elif [[ ${words[2]} == completion ]]; then
        compadd bash zsh
    else
        _files
    fi
}
if [ "$funcstack[1]" = _magfsi ]; then _magfsi "$@"; else compdef _magfsi magfsi ./magfsi; fi
