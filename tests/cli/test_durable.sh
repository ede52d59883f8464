#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Stored frames survive a power cut: files are synced, with all their bytes, before they get their names, folders afterwards,
# checked call by call. output/test_store_order checks that a frame is reported only then.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

! is_sanitized || skip "sanitizers do not see the calls of preloaded libraries"
build=$(realpath "${2:?the build folder is the second argument}")
watched=(env SYNC_LOG="$work/log" LD_PRELOAD="$build/tests/failing/libfailing_system.so")
frames=(render --quiet --backend c "${small[@]}")

# unsynced: errors of the log, one a line: a name given to a file that was not synced with as many bytes, or whose folder was
# not synced afterwards. Names are as on the command line, all below this folder.
unsynced() {
    awk -v here="$(pwd -P)/" '
        $1 == "sync" { synced[$2] = $3 }
        $1 == "rename" {
            if (synced[$2] != $4) print "not synced before its name: " $3
            folder = here $3; sub(/\/[^\/]*$/, "", folder)
            open[$3] = folder
        }
        $1 == "folder" { for (name in open) if (open[name] == $2) delete open[name] }
        END { for (name in open) print "its folder was not synced: " name }' "$work/log"
}

expect_synced() { # KIND PATH
    grep -q "^$1 $(realpath "$2") [0-9]*$" "$work/log" || fail "$2 was not synced"
}

# expect_durable COMMAND...: it succeeds, gives names, and each of them correctly.
expect_durable() {
    local faults
    rm -f "$work/log"
    expect_exit 0 "${watched[@]}" "$@"
    faults=$(unsynced)
    [[ -z $faults ]] || fail "of $* $faults"
    grep -q '^rename ' "$work/log" || fail "of $* nothing was renamed"
}

# ---- each kind of output; folders that are new, and those above them; the statistics' own file
expect_durable "$hedron" "${frames[@]}" --frames 0-19 -o new/deep/%d.png -o new/%d.pfm --stats told/stats.jsonl
for folder in new/deep new . told; do
    expect_synced folder "$folder"
done
expect_synced sync told/stats.jsonl
if has_ffmpeg; then
    expect_durable "$hedron" "${frames[@]}" --frames 0-3 -o film.mkv
fi
# Frames of an earlier run: their names may be younger than the last sync.
rm "$work/log"
expect_exit 0 "${watched[@]}" "$hedron" "${frames[@]}" --frames 0-19 -o new/deep/%d.png
expect_synced folder new/deep
expect_durable "$hedron" convert -o scene.json <<<"$("$hedron" --default)"
# Exit code 1 is that of --fail-above.
expect_durable "$hedron" compare new/deep/0.png new/deep/1.png --diff heat.png

# ---- without
rm "$work/log"
expect_exit 0 "${watched[@]}" "$hedron" "${frames[@]}" --frames 0-3 -o unsynced/%d.png --stats unsynced.jsonl --no-sync
! grep -v '^rename ' "$work/log" || fail "--no-sync syncs"

# ---- a disk that fails: earlier frames stay, later ones are gone, nothing is incomplete
for when in 1 7 30; do
    rm -rf failing
    expect_exit 1 env SYNC_FAIL=$when LD_PRELOAD="$build/tests/failing/libfailing_system.so" \
        "$hedron" "${frames[@]}" --frames 0-59 -o failing/%d.png --stats failing.jsonl
    expect_sentence
    expect_stderr_contains 'to the disk: Input/output error'
    ! find failing -name '*.tmp-*' | grep . || fail 'temporary files are left'
    (($(find failing -name '*.png' | wc -l) >= $(wc -l <failing.jsonl))) || fail 'more frames were reported than stored'
done

finish
