#compdef hedron
# SPDX-License-Identifier: MIT
# Completion of hedron's arguments for zsh: the program says what may follow.

_hedron() {
    local line word about
    local -a lines shown
    lines=("${(@f)$("${(Q)words[1]}" complete -- "${(@Q)words[2,CURRENT]}" 2>/dev/null)}")
    for line in $lines; do
        if [[ $line == :* ]]; then
            if [[ $line == : ]]; then
                _files
            else
                _files -g "*${line#:}"
            fi
            continue
        fi
        word=${line%%$'\t'*}
        about=${${line#$word}#$'\t'}
        shown=("$word${about:+  -- $about}")
        if [[ $word == *[.=] ]]; then
            compadd -S '' -d shown -- "$word"
        else
            compadd -d shown -- "$word"
        fi
    done
}

# As a file of $fpath it is the function; sourced it says what it completes.
if [[ ${funcstack[1]} == _hedron ]]; then
    _hedron "$@"
else
    compdef _hedron hedron
fi
