#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A sequence on a real Slurm of two nodes. Renderers are held after their first frame, so that kills always hit them at work.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
# shellcheck source=slurm_cluster.sh
source "$cli_folder/slurm_cluster.sh"

need_slurm
command -v ffmpeg >"$logs/which" || skip "there is no ffmpeg"
time_limit=600 # seconds, for a busy machine
submit=$project/farm/slurm/hedron-submit
report=$project/farm/slurm/hedron-report

# ---- a renderer controlled by files in a folder
gate=$work/gate
mkdir "$gate"
cat >"$work/the renderer" <<SCRIPT
#!/usr/bin/env bash
# hold-A-B: the frames A-B are held once, after the first of them, by a pipe for statistics without a reader. move-A-B: has no
# device on the node that comes first.
set -euo pipefail
gate=$gate
frames=\$(printf '%s\n' "\$@" | sed -n '/^--frames\$/{n;p;q}')
if [[ -e \$gate/move-\$frames ]]; then
    [[ -s \$gate/move-\$frames ]] || echo "\$SLURMD_NODENAME" >"\$gate/move-\$frames"
    [[ \$(<"\$gate/move-\$frames") != "\$SLURMD_NODENAME" ]] || exit 3
fi
if [[ -e \$gate/hold-\$frames ]]; then
    rm "\$gate/hold-\$frames"
    mkfifo "\$gate/pipe-\$frames"
    "$hedron" "\${@/#\$frames/\${frames%-*}}"
    echo \$\$ >"\$gate/pid-\$frames"
    exec "$hedron" "\$@" --stats "\$gate/pipe-\$frames"
fi
exec "$hedron" "\$@"
SCRIPT
chmod +x "$work/the renderer"
export HEDRON="$work/the renderer"

frame_path() {
    printf 'the out/%%frame %03d.png' "$1"
}

# wait_for_held A B: hedron has stored frame A, and is held before frame B or earlier. Sets `held`.
wait_for_held() {
    if ! wait_until "$time_limit" test -s "$(frame_path "$1")" -a -s "$gate/pid-$1-$2"; then
        fail "the frames $1-$2 are not held"
        tail -n 30 "the out"/hedron-farm/*/*.log "$cluster/log/slurmctld" >&2 || true
        exit 1
    fi
    held=$(<"$gate/pid-$1-$2")
}

parent_of() {
    sed -n 's/^PPid:\t//p' "/proc/$1/status"
}

wait_for_empty_queue() {
    if ! wait_until "$time_limit" queue_is_empty; then
        fail "Slurm still has jobs"
        squeue >&2 || true
        tail -n 30 "$cluster"/log/* >&2 || true
        exit 1
    fi
}

# expect_report CODE LINE_PATTERN...: the report of the pictures' folder.
expect_report() {
    local expected=$1 pattern
    shift
    expect_exit "$expected" "$report" "the out"
    cat "$logs/stdout"
    for pattern in "$@"; do
        grep -q -x -E -e "$pattern" "$logs/stdout" || fail "the report has no line $pattern"
    done
}

# ---- the same on one machine
cp "$project/scenes/default.json" "my scene.json"
options=("my scene.json" --backend c --threads 1 "${small[@]}")
expect_exit 0 "$hedron" render --quiet "${options[@]}" --frames 0-14 -o 'alone/%%frame %03d.png' -o 'alone.mp4'

start_cluster
echo "Slurm: $(sinfo --version), $(sinfo -h -N -o '%N %T' | tr '\n' ' ')"

# ---- 5 tasks, of which 1 is killed with its renderer, 2 as a whole, 3 is cancelled, 4 has to move
touch "$gate"/hold-3-5 "$gate"/hold-6-8 "$gate"/hold-9-11 "$gate"/move-12-14
farm=("$submit" "${options[@]}" --frames 0-14 --chunk 3 --retries 1 -o 'the out/%%frame %03d.png' --film 'the film.mp4')
expect_exit 0 "${farm[@]}"
run_folder="the out/hedron-farm/1"
job=$(head -n 1 "$run_folder/jobs")

wait_for_held 3 5
echo "killing the renderer of task 1, process $held"
kill -KILL "$held"
wait_for_held 6 8
echo "killing task 2, process $(parent_of "$held")"
kill -KILL "$(parent_of "$held")"
wait_until "$time_limit" is_gone "$held" || fail "the renderer outlives its task"
wait_for_held 9 11
echo "cancelling task 3"
expect_exit 0 scancel "${job}_3"
wait_for_empty_queue
expect_report 1 'frames   11 of 15 there, missing 7-8,10-11' \
    'task 0 +frames 0-2: 3 of 3, done on node[12] in [0-9]+ s' \
    'task 1 +frames 3-5: 3 of 3, done on node[12] in [0-9]+ s, try 2' \
    'task 2 +frames 6-8: 1 of 3, killed on node[12]' \
    'task 3 +frames 9-11: 1 of 3, stopped on node[12] after [0-9]+ s, exit code [0-9]+' \
    'task 4 +frames 12-14: 3 of 3, done on node[12] in [0-9]+ s, try 2' \
    'film     the film\.mp4: never started'
[[ ! -e "the film.mp4" ]] || fail "there is a film of a sequence that is not whole"
expect_same <(sed -n 's/^start \([^ ]*\) .*/\1/p' "$run_folder/task-4.txt" | sort) <(printf 'node%s\n' 1 2)

# ---- once more: the missing frames, and nothing else while that job is active
rm "$gate"/*
touch "$gate/hold-9-11"
expect_exit 0 "${farm[@]}"
wait_for_held 9 11
expect_exit 2 "${farm[@]}"
expect_stderr_contains 'is still at work on these frames'
cat "$gate/pipe-9-11" >"$work/statistics" &
reader=$!
wait_for_empty_queue
wait "$reader"
expect_report 0 'frames   15 of 15 there' \
    'task 3 +frames 9-11: 3 of 3, done on node[12] in [0-9]+ s' \
    'film     the film\.mp4: done on node[12] in [0-9]+ s'
expect_exit 0 "$report" "$(head -n 1 "the out/hedron-farm/2/jobs")"

for frame in {0..14}; do
    expect_same "$(frame_path "$frame")" "alone/$(basename "$(frame_path "$frame")")"
done
expect_same "the film.mp4" alone.mp4
stop_cluster || fail "processes of the cluster were left"
finish
