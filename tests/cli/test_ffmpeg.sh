#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Films where FFmpeg is missing or fails: the exit code tells which, and no file is left.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

if ! command -v ffmpeg >"$logs/which" || ! command -v ffprobe >"$logs/which"; then
    skip "there is no FFmpeg"
fi
true_ffmpeg=$(command -v ffmpeg)
true_ffprobe=$(command -v ffprobe)
bash_path=$(command -v bash)
tools=$work/tools
mkdir "$tools"
film=("$hedron" render --backend c --samples 1 --depth 0 -o film.mp4)

# fake NAME BODY: a program of that name in the tools folder.
fake() {
    printf '#!%s\n%s\n' "$bash_path" "$2" >"$tools/$1"
    chmod +x "$tools/$1"
}

# expect_no_film CODE WHAT [WHAT_ELSE]: with the tools folder before everything else in PATH; the second
# film may fail with other words.
expect_no_film() {
    expect_exit "$1" timeout "$patience" env PATH="$tools:$PATH" "${film[@]}" --size 32x24 --frames 0-2
    expect_stderr_contains 'hedron: '
    expect_stderr_contains "$2"
    expect_stdout_lines 0
    # More than the buffers on the way hold.
    expect_exit "$1" timeout "$patience" env PATH="$tools:$PATH" "${film[@]}" --size 400x300 --frames 0-2
    expect_stderr_contains "${3:-$2}"
    expect_stdout_lines 0
    expect_files .
    rm -rf ./*
}

# ---- none, or only one of the two programs
alone=(env PATH="$tools" "${film[@]}" --size 32x24 --frames 0-2)
expect_refusal 3 "${alone[@]}"
expect_stderr_contains ffmpeg
expect_files .
ln -s "$true_ffmpeg" "$tools/ffmpeg"
expect_refusal 3 "${alone[@]}"
expect_stderr_contains ffprobe
expect_files .
rm "$tools/ffmpeg"
ln -s "$true_ffprobe" "$tools/ffprobe"
expect_refusal 3 "${alone[@]}"
expect_stderr_contains ffmpeg
expect_files .
rm "$tools/ffprobe"
# No program: a folder, a file that may not be run, an empty PATH.
mkdir "$tools/ffmpeg"
expect_refusal 3 "${alone[@]}"
rmdir "$tools/ffmpeg"
: >"$tools/ffmpeg"
expect_refusal 3 "${alone[@]}"
rm "$tools/ffmpeg"
expect_refusal 3 env PATH= "${film[@]}" --size 32x24 --frames 0-2
expect_files .
# Other films need it too, and where one cannot be made the run does not begin.
for name in film.mkv film.gif; do
    expect_refusal 3 env PATH="$tools" "$hedron" render --backend c "${small[@]}" --frames 0-2 -o '%d.data' -o "$name"
    expect_stderr_contains ffmpeg
    expect_files .
done
# Pictures need none of this.
expect_exit 0 env PATH="$tools" "$hedron" render --backend c "${small[@]}" --frames 0 -o picture.png
expect_png picture.png 32 24
rm picture.png

# ---- failures
fake ffmpeg 'exit 1'
expect_no_film 1 'exit code 1'
fake ffmpeg 'echo "first line of woe" >&2; echo "second line of woe" >&2; exit 7'
expect_no_film 1 'second line of woe'
expect_no_film 1 'exit code 7'
fake ffmpeg 'read -r -N 1000 -t 5 || true; echo "had enough" >&2; exit 3'
expect_no_film 1 'had enough'
fake ffmpeg 'kill -9 $$'
expect_no_film 1 'signal 9'
# Success is claimed, but there is no film.
fake ffmpeg 'cat >/dev/null; exit 0'
expect_no_film 1 'ffprobe'
fake ffmpeg 'exit 0'
expect_no_film 1 'film.mp4'
# shellcheck disable=SC2016 # for the script that is written
fake ffmpeg 'cat >/dev/null; for last; do :; done; echo nonsense >"${last#file:}"'
expect_no_film 1 'ffprobe'
# Words beside a good exit code tell why, as on a disk that gets full.
fake ffmpeg 'cat >/dev/null; echo "Error writing trailer: No space left on device" >&2'
expect_no_film 1 'FFmpeg had said: Error writing trailer: No space left on device'
# Not all of the frames.
fake ffmpeg "\"$true_ffmpeg\" \"\${@:1:\$#-1}\" -frames:v 2 \"\${@: -1}\""
expect_no_film 1 'expected 3' 'film.mp4'
rm "$tools/ffmpeg"
fake ffprobe 'echo 2'
expect_no_film 1 'expected 3'
fake ffprobe 'exit 1'
expect_no_film 1 'ffprobe'
fake ffprobe 'echo 3 frames'
expect_no_film 1 'ffprobe'
rm "$tools/ffprobe"
# No program that the system can start.
printf '#!/no/such/interpreter\n' >"$tools/ffmpeg"
chmod +x "$tools/ffmpeg"
expect_no_film 3 'cannot start'
printf '\177ELF' >"$tools/ffmpeg"
expect_no_film 3 'cannot start'
rm "$tools/ffmpeg"

# One film of two fails: neither stays, and the pictures do.
# shellcheck disable=SC2016 # for the script that is written
fake ffmpeg 'if [[ $* == *film.gif* ]]; then exit 1; fi; exec '"\"$true_ffmpeg\""' "$@"'
expect_exit 1 env PATH="$tools:$PATH" "$hedron" render --quiet --backend c "${small[@]}" --frames 0-2 \
    -o film.gif -o film.mkv -o '%d.data'
expect_stderr_contains 'exit code 1'
expect_stdout_lines 0
if [[ -e film.gif || -e film.mkv || -n $(find . -name '*tmp*') ]]; then
    fail "a film stayed: $(ls)"
fi
rm -rf ./*
rm "$tools/ffmpeg"

# An old film stays when the new one fails, and goes when it does not.
printf 'old' >film.mp4
cp film.mp4 "$work/old.mp4"
fake ffmpeg 'exit 1'
expect_exit 1 env PATH="$tools:$PATH" "${film[@]}" --size 32x24 --frames 0-2
expect_files . film.mp4
expect_same film.mp4 "$work/old.mp4"
rm "$tools/ffmpeg"
expect_exit 0 env PATH="$tools:$PATH" "${film[@]}" --size 32x24 --frames 0-2
expect_files . film.mp4
expect_different film.mp4 "$work/old.mp4"

# A talkative FFmpeg does not bring everything to a halt.
rm film.mp4
fake ffmpeg "head -c 1000000 /dev/zero | tr '\\0' x >&2; exec \"$true_ffmpeg\" \"\$@\""
expect_exit 0 timeout "$patience" env PATH="$tools:$PATH" "${film[@]}" --size 400x300 --frames 0-2
expect_files . film.mp4

finish
