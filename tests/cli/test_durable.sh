#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What was told as stored outlives a power cut: files are synced before they get their names, folders
# afterwards, and only then statistics tell a frame. Watched call by call; and, for root where there are
# loop devices, on a disk that is looked at as it was at random instants.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build=$(realpath "${2:?the build folder is the second argument}")
cuts=${3:-5}
watched=(env SYNC_LOG="$work/log" LD_PRELOAD="$build/tests/failing/libfailing_sync.so")
frames=(render --quiet --backend c "${small[@]}")

# unsynced [FRAMES_TOLD]: what the log lacks, one complaint a line: a name given to a file that was not synced,
# or whose folder was not synced afterwards. Names are as on the command line, all below this folder.
unsynced() {
    awk -v here="$(pwd -P)/" '
        $1 == "sync" { synced[$2] = 1 }
        $1 == "rename" {
            if (!synced[$2]) print "not synced before its name: " $3
            folder = here $3; sub(/\/[^\/]*$/, "", folder)
            open[$3] = folder
        }
        $1 == "folder" { for (name in open) if (open[name] == $2) delete open[name] }
        END { for (name in open) print "its folder was not synced: " name }' "$work/log"
}

# expect_durable COMMAND...: it ends well, gave names, and all of them as they should be.
expect_durable() {
    local faults
    rm -f "$work/log"
    expect_exit 0 "${watched[@]}" "$@"
    faults=$(unsynced)
    if [[ -n $faults ]] || ! grep -q '^rename ' "$work/log"; then
        fail "of $* ${faults:-nothing was renamed}"
    fi
}

if is_sanitized; then
    echo "not tested: the order of calls, for sanitizers do not see them in preloaded libraries"
else
    # ---- each kind of output; folders that are new, and those above them; the statistics' own file
    expect_durable "$hedron" "${frames[@]}" --frames 0-19 -o new/deep/%d.png -o new/%d.pfm --stats told/stats.jsonl
    for folder in new/deep new . told; do
        grep -q -x -F "folder $(realpath "$folder")" "$work/log" || fail "the folder $folder was not synced"
    done
    grep -q -x -F "sync $(realpath told/stats.jsonl)" "$work/log" || fail "the statistics were not synced"
    if has_ffmpeg; then
        expect_durable "$hedron" "${frames[@]}" --frames 0-3 -o film.mkv
    fi
    # Frames that were finished before: their names may be younger than the last sync.
    rm "$work/log"
    expect_exit 0 "${watched[@]}" "$hedron" "${frames[@]}" --frames 0-19 -o new/deep/%d.png
    grep -q -x -F "folder $(realpath new/deep)" "$work/log" || fail "the folder of finished frames was not synced"
    expect_durable "$hedron" convert -o scene.json <<<"$("$hedron" --default)"
    # Exit code 1 is that of --fail-above.
    expect_durable "$hedron" compare new/deep/0.png new/deep/1.png --diff heat.png

    # ---- without
    rm "$work/log"
    expect_exit 0 "${watched[@]}" "$hedron" "${frames[@]}" --frames 0-3 -o fleeting/%d.png --stats fleeting.jsonl --no-sync
    ! grep -v '^rename ' "$work/log" || fail "--no-sync syncs"

    # ---- statistics tell only frames whose names were on the disk: the program dies before it syncs a folder
    for when in 1 3 5 8; do # the second is that of the folder above
        rm -rf killed "$work/log"
        expect_exit 137 "${watched[@]}" SYNC_KILL=$when "$hedron" "${frames[@]}" --frames 0-199 -o killed/%d.png \
            --stats killed/stats.jsonl
        unsynced | sed -n 's/^its folder was not synced: //p' | sort >"$work/at_risk"
        sed 's|^{"frame":\([0-9]*\),.*|killed/\1.png|' killed/stats.jsonl | sort >"$work/told"
        if [[ ! -s $work/at_risk ]] || comm -12 "$work/at_risk" "$work/told" | grep .; then
            fail "frames were told that a power cut could take, or none was at risk at sync $when"
        fi
    done

    # ---- a disk that fails: the frames before stay, later ones are gone, nothing is half-done
    for when in 1 7 30; do
        rm -rf failing
        expect_exit 1 env SYNC_FAIL=$when LD_PRELOAD="$build/tests/failing/libfailing_sync.so" \
            "$hedron" "${frames[@]}" --frames 0-59 -o failing/%d.png --stats failing.jsonl
        expect_sentence
        expect_stderr_contains 'to the disk: Input/output error'
        if find failing -name '*.tmp-*' | grep . ||
            (($(find failing -name '*.png' | wc -l) < $(wc -l <failing.jsonl))); then
            fail "temporary files are left, or more frames were told than there are"
        fi
    done
fi

# ---- power cuts: copies of a disk, the program standing still, are mounted and looked at
can_mount() {
    ((EUID == 0)) && command -v mkfs.ext4 >"$logs/which" && truncate -s 48M "$work/disk" &&
        mkfs.ext4 -q "$work/disk" && mkdir "$work/mounted" "$work/looked_at" &&
        mount -o loop "$work/disk" "$work/mounted"
} 2>"$logs/mount"
if ! can_mount; then
    echo "not tested: power cuts, for only root can mount disks, where there are loop devices"
    finish
fi
trap 'umount -q "$work/looked_at" "$work/mounted" || true; clean_up' EXIT

expect_exit 0 "$hedron" "${frames[@]}" --frames 0-239 -o whole/%d.png

# The disk as it is at this moment: nothing may be written to it while it is copied.
copy_disk() {
    local before=none
    until [[ $before == "$(stat -c %y "$work/disk")" ]]; do
        before=$(stat -c %y "$work/disk")
        cp "$work/disk" "$work/copy"
    done
}

# check_disk WHEN: each frame that was told is on the copy, whole.
check_disk() {
    local frame
    cp "$work/stats.jsonl" "$work/told"
    copy_disk
    mount -o loop "$work/copy" "$work/looked_at"
    while read -r frame; do
        cmp -s "whole/$frame.png" "$work/looked_at/out/$frame.png" ||
            fail "$1: frame $frame was told as stored, and is not whole after a power cut"
    done < <(sed -n 's/^{"frame":\([0-9]*\),.*}$/\1/p' "$work/told")
    umount "$work/looked_at"
    echo "$1: $(wc -l <"$work/told") frames were told, and looked at"
}

for ((cut = 1; cut <= cuts; cut++)); do
    rm -rf "$work/mounted/out"
    : >"$work/stats.jsonl"
    sync -f "$work/mounted"
    start "$hedron" "${frames[@]}" --frames 0-239 -o "$work/mounted/out/%d.png" --stats "$work/stats.jsonl"
    sleep "0.$((RANDOM % 90 + 10))"
    if kill -STOP "$pid" 2>/dev/null; then
        check_disk "power cut $cut"
        kill -CONT "$pid"
    fi
    expect_end 0
done
check_disk "after the end"
finish
