# SPDX-License-Identifier: MIT
# Completion of hedron's arguments for fish: the program says what may follow.

function __hedron_complete
    set -l words (commandline -opc)
    set -l current (commandline -ct)
    for line in ($words[1] complete -- $words[2..-1] "$current" 2>/dev/null)
        if string match -q ':*' -- $line
            __fish_complete_suffix "$current" (string sub -s 2 -- $line)
        else
            echo $line
        end
    end
end

complete -c hedron -f -a '(__hedron_complete)'
