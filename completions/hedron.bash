# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Completion of hedron's arguments for bash: the program says what may follow.

# Names of files; with an argument those that end so, and folders.
_hedron_files() {
    compopt -o filenames 2>/dev/null || true
    if [[ -z $1 ]]; then
        mapfile -t COMPREPLY < <(compgen -f -- "$2")
    else
        mapfile -t COMPREPLY < <(compgen -d -- "$2" || true
            compgen -f -X "!*$1" -- "$2")
    fi
}

_hedron() {
    local i word line cut quoted words=()
    COMPREPLY=()
    # Bash makes words of its own of equals signs and colons.
    for ((i = 1; i <= COMP_CWORD; i++)); do
        word=${COMP_WORDS[i]//[\"\'\\]/}
        if ((${#words[@]} > 0)) && [[ $word == [=:]* || ${words[-1]} == *[=:] ]]; then
            words[-1]+=$word
        else
            words+=("$word")
        fi
    done
    cut=${words[-1]%"${words[-1]##*[=:]}"}
    while IFS= read -r line; do
        if [[ $line == :* ]]; then
            _hedron_files "${line#:}" "${words[-1]#"$cut"}"
            continue
        fi
        line=${line%%$'\t'*}
        quoted=${line#"$cut"}
        [[ ${COMP_WORDS[COMP_CWORD]} == [\"\']* || $quoted != *[' []'* ]] || printf -v quoted %q "$quoted"
        COMPREPLY+=("$quoted")
        [[ $line != *[.=] ]] || compopt -o nospace 2>/dev/null || true
    done < <("${COMP_WORDS[0]}" complete -- "${words[@]}" 2>/dev/null)
}

complete -F _hedron hedron
