#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Films that survive: a run that was ended goes on behind the last whole segment, and the film has the
# bytes of an undisturbed run. A third argument says how often a run is killed at a random instant.
# shellcheck disable=SC2317 # wait_until calls functions by their names
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
kills=${3:-3}

if ! command -v ffmpeg >"$logs/which" || ! command -v ffprobe >"$logs/which"; then
    skip "there is no FFmpeg"
fi
true_ffmpeg=$(command -v ffmpeg)
bash_path=$(command -v bash)
frames=80 # 30 a second: three segments
film=("$hedron" render --backend c --size 64x48 --samples 1 --depth 2 --frames "0-$((frames - 1))")

# signal NAME: from now on the FFmpeg of the third segment sends it to hedron first, once the second one
# is whole. One whose hedron is
# killed does not begin: it might make its file at any time.
signal() {
    mkdir -p "$work/tools"
    cat >"$work/tools/ffmpeg" <<SCRIPT
#!$bash_path
if [[ \$* == *.part-0002* ]]; then
    until compgen -G '*.part-0001-????????????????' >/dev/null; do
        sleep 0.01
    done
    kill -$1 \$PPID
    [[ $1 != KILL ]] || exit 1
fi
exec "$true_ffmpeg" "\$@"
SCRIPT
    chmod +x "$work/tools/ffmpeg"
}
with_signal=(env PATH="$work/tools:$PATH")

# times FILE: of its frames, in order.
times() {
    ffprobe -v error -show_entries packet=pts_time -of csv=p=0 "$1" | tr -d , | sort -n
}

# expect_segments NAME COUNT: so many whole ones, and nothing that is being written.
expect_segments() {
    local found
    found=$(find . -name "$1.part-*" | grep -c -E 'part-[0-9]{4}-[0-9a-f]{16}$' || true)
    if ((found != $2)) || compgen -G './*.tmp-*' >"$logs/temporary"; then
        fail "there are $found segments, expected $2, and nothing else: $(echo ./*)"
    fi
}

# ---- joined, a film is what it is in one go, which fast arithmetic has; of plain C it is the same
for ending in mkv mp4 gif; do
    expect_exit 0 "${film[@]}" --quiet -o "film.$ending"
    expect_exit 0 "${film[@]}" --quiet --math fast -o "whole.$ending"
    if [[ $(times "film.$ending") != "$(times "whole.$ending")" || $(times "film.$ending" | wc -l) != "$frames" ]]; then
        fail "the frames of film.$ending have other times"
    fi
    mv "film.$ending" "$work/undisturbed.$ending"
done
for ending in mkv gif; do
    for name in "$work/undisturbed.$ending" "whole.$ending"; do
        ffmpeg -nostdin -v error -i "$name" -f framemd5 - >"$name.sums"
    done
    expect_same "$work/undisturbed.$ending.sums" "whole.$ending.sums"
done
rm -f ./*
expect_exit 0 "${film[@]}" --quiet -o film.mp4
expect_same film.mp4 "$work/undisturbed.mp4"
rm film.mp4

# ---- ended within the third segment, it goes on there
for ending in mp4 mkv gif; do
    signal TERM
    expect_exit 143 "${with_signal[@]}" "${film[@]}" -o "film.$ending"
    expect_stderr_contains 'of 80 frames; the same command goes on, with 60 of them finished'
    expect_segments "film.$ending" 2
    expect_exit 0 "${film[@]}" -o "film.$ending"
    expect_stderr_contains 'hedron: 60 of 80 frames were finished already'
    expect_files . "film.$ending"
    expect_same "film.$ending" "$work/undisturbed.$ending"
    rm "film.$ending"
done
# Killed, it leaves what it was writing to, which goes with the next run.
signal KILL
expect_exit 137 "${with_signal[@]}" "${film[@]}" -o film.mkv
signal TERM
expect_exit 143 "${with_signal[@]}" "${film[@]}" -o film.mkv
expect_stderr_contains 'hedron: 60 of 80 frames were finished already'
expect_segments film.mkv 2
# Two films, of which one is further: frames of both are needed until the other is as far.
expect_exit 0 "${film[@]}" -o film.mkv -o "it's.mp4"
expect_files . film.mkv "it's.mp4"
expect_same film.mkv "$work/undisturbed.mkv"
expect_same "it's.mp4" "$work/undisturbed.mp4"
rm ./*

# ---- with pictures beside it
expect_exit 143 "${with_signal[@]}" "${film[@]}" -o film.mkv -o 'out/%02d.png'
expect_stderr_contains 'of 80 frames; the same command goes on, with '
expect_exit 0 "${film[@]}" -o film.mkv -o 'out/%02d.png'
expect_stderr_contains 'of 80 frames were finished already'
expect_same film.mkv "$work/undisturbed.mkv"
rm -r ./*

# ---- segments of another film are not taken, and go once there is a new one; --again takes none
expect_exit 143 "${with_signal[@]}" "${film[@]}" -o film.mkv
for change in '--depth 3' '--set output.frames_per_second=15' '--again'; do
    # shellcheck disable=SC2086 # several words
    expect_exit 143 "${with_signal[@]}" "${film[@]}" $change -o film.mkv
    if grep -q 'finished already' "$logs/stderr"; then
        fail "with $change segments of another film are taken"
    fi
done
expect_exit 0 "${film[@]}" --quiet --again -o film.mkv
expect_files . film.mkv
expect_same film.mkv "$work/undisturbed.mkv"
rm film.mkv

# ---- a segment that was emptied is made anew
expect_exit 143 "${with_signal[@]}" "${film[@]}" -o film.mkv
: >"$(find . -name 'film.mkv.part-0001-*')"
expect_exit 0 "${film[@]}" -o film.mkv
expect_stderr_contains 'hedron: 30 of 80 frames were finished already'
expect_same film.mkv "$work/undisturbed.mkv"
rm film.mkv


# ---- where they cannot be joined they stay; then only the first one is missing
cat >"$work/tools/ffmpeg" <<SCRIPT
#!$bash_path
if [[ \$* == *concat* ]]; then
    exit 1
fi
exec "$true_ffmpeg" "\$@"
SCRIPT
expect_exit 1 "${with_signal[@]}" "${film[@]}" -o film.mkv
expect_stderr_contains 'film.mkv'
expect_segments film.mkv 3
rm film.mkv.part-0000-*
expect_exit 0 "${film[@]}" -o film.mkv
expect_stderr_contains 'hedron: 50 of 80 frames were finished already'
expect_files . film.mkv
expect_same film.mkv "$work/undisturbed.mkv"
rm film.mkv

# ---- killed at random instants
begin=$(date +%s%N)
expect_exit 0 "${film[@]}" --quiet -o film.mkv
duration=$((($(date +%s%N) - begin) / 1000000))
rm film.mkv
for ((kill = 1; kill <= kills; kill++)); do
    start "${film[@]}" --quiet -o film.mkv
    pause=$((RANDOM * duration / 32768))
    sleep "$((pause / 1000)).$(printf '%03d' $((pause % 1000)))"
    kill -KILL "$pid" 2>/dev/null || true
    wait "$pid" 2>/dev/null || true
    echo "kill $kill after $pause ms: $(find . -name 'film.mkv.part-*' | grep -c -E 'part-[0-9]{4}-[0-9a-f]{16}$' || true) segments, $(find . -name film.mkv | wc -l) film"
    if [[ -e film.mkv ]]; then
        expect_same film.mkv "$work/undisturbed.mkv"
        rm film.mkv
    fi
done
# An FFmpeg whose hedron was killed may end, and make its file, only now.
is_clean() {
    expect_exit 0 "${film[@]}" --quiet -o film.mkv
    expect_same film.mkv "$work/undisturbed.mkv"
    [[ $(echo ./*) == ./film.mkv ]]
}
if ! wait_until 60 is_clean; then
    fail "there are other files: $(echo ./*)"
fi

finish
