#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The farm's scripts without a cluster: what hedron-submit refuses and submits, a task's actions after each exit code, and
# hedron-report. Slurm's commands log their arguments.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

submit=$project/farm/slurm/hedron-submit
task=$project/farm/slurm/hedron-task
report=$project/farm/slurm/hedron-report

# ---- commands of Slurm: their arguments, each in brackets, a line for each call
mkdir "$work/tools"
calls=$work/calls
cat >"$work/tools/slurm" <<'SCRIPT'
#!/usr/bin/env bash
name=$(basename "$0")
{ printf '%s' "$name" && printf '[%s]' "$@" && echo; } >>"$FAKE_CALLS"
case "$name $1" in
sbatch*)
    [[ ! -e $FAKE_CALLS.refuses ]] || { echo 'sbatch: error: invalid partition' >&2; exit 1; }
    grep -c '^sbatch' "$FAKE_CALLS"
    ;;
'scontrol show')
    case $2 in
    config) cat "$FAKE_CALLS.config" ;;
    hostnames) tr ',' '\n' <<<"$3" ;;
    job) printf '   WorkDir=%s\n' "$(<"$FAKE_CALLS.folder")" ;;
    esac
    ;;
squeue*) cat "$FAKE_CALLS.queue" 2>/dev/null ;;
sinfo*) printf '%s\n' node1 node2 ;;
esac
SCRIPT
chmod +x "$work/tools/slurm"
for tool in sbatch squeue scontrol scancel sinfo; do
    ln -s slurm "$work/tools/$tool"
done
echo 'MaxArraySize            = 1001' >"$calls.config"
export FAKE_CALLS=$calls PATH="$work/tools:$PATH"

# ---- a renderer that notes its arguments, stores its frames and ends with the code in a file
cat >"$work/renderer" <<'SCRIPT'
#!/usr/bin/env bash
printf '[%s]' "$@" >"$FAKE_CALLS.renderer"
[[ ! -e $FAKE_CALLS.code ]] || exit "$(<"$FAKE_CALLS.code")"
SCRIPT
chmod +x "$work/renderer"

cp "$project/scenes/default.json" "a scene.json"
options=("a scene.json" --backend c "${small[@]}")
pattern='out/f %04d.png'

expect_call() {
    grep -q -x -F -e "$1" "$calls" || fail "nothing was called as $1: $(<"$calls")"
}

expect_no_call() {
    ! grep -q -E -e "$1" "$calls" || fail "something was called as $1: $(<"$calls")"
}

# ---- refused before anything is submitted
# expect_refused TEXT ARGUMENT...
expect_refused() {
    local text=$1
    shift
    : >"$calls"
    expect_exit 2 env HEDRON="$hedron" "$submit" "$@"
    expect_stderr_contains "$text"
    expect_no_call '^sbatch'
    expect_files . "a scene.json"
}

expect_refused '--frames is missing' "${options[@]}" -o "$pattern"
for frames in 3-1 -1 1- '1-2; true'; do
    expect_refused '--frames' "${options[@]}" -o "$pattern" --frames "$frames"
done
# shellcheck disable=SC2016 # that it is not expanded is the point
for chunk in 0 x '' '$(true)'; do
    expect_refused '--chunk' "${options[@]}" -o "$pattern" --frames 0-3 --chunk "$chunk"
done
expect_refused '--retries' "${options[@]}" -o "$pattern" --frames 0-3 --retries -1
for name in a.png a%d.mp4 a%d%d.png 'a%5d.png' 'a%d/b.png' a%%d.png a%0d.pn; do
    expect_refused "-o is '$name'" "${options[@]}" -o "$name" --frames 0-3
done
expect_refused '-o was given twice' "${options[@]}" -o "$pattern" --output="$pattern" --frames 0-3
expect_refused '--stats' "${options[@]}" -o "$pattern" --frames 0-3 --stats x
expect_refused 'standard input' - -o "$pattern" --frames 0-3
expect_refused "did you mean '--size'" "${options[@]}" --siz 1x1 -o "$pattern" --frames 0-3
expect_refused 'outside the sequence' "${options[@]}" -o "$pattern" --frames 0-9999999
expect_refused '.webm, .mkv or .gif' "${options[@]}" -o "$pattern" --frames 0-3 --film a.avi
echo 'MaxArraySize            = 3' >"$calls.config"
expect_refused 'expected a larger chunk' "${options[@]}" -o "$pattern" --frames 0-3 --chunk 1
echo 'MaxArraySize            = 1001' >"$calls.config"
expect_exit 3 env HEDRON="$work/nothing" "$submit" "${options[@]}" -o "$pattern" --frames 0-3

# ---- submissions; no name is read by a shell, nor by Slurm
export HEDRON=$work/renderer
odd="\$(touch bad) '\"; %x \\n"
mkdir "$odd"
cp "a scene.json" "$odd/s.json"
: >"$calls"
expect_exit 0 "$submit" "$odd/s.json" --set "a=\$b c" -o "${odd//%/%%}/f%%%03d.png" --frames=7-20 --chunk=5 \
    --film "$odd/a film.mp4" --retries 1 --slurm=--partition=gpu --slurm '--comment=two words'
folder=$PWD/$odd/hedron-farm/1
common="[--parsable][--job-name=hedron][--partition=gpu][--comment=two words][--requeue][--output=/dev/null]"
common+="[--error=/dev/null][--chdir=$folder][--signal=B:USR1@60]"
expect_call "sbatch${common}[--array=0-2][$task][$folder]"
expect_call "sbatch${common}[--dependency=afterok:1][--kill-on-invalid-dep=yes][$task][$folder][film]"
expect_same "$folder/jobs" <(printf '1\n2\n')

# expect_task NUMBER CODE [NODE]: the task on a node whose renderer ends with the code ends with the same code.
expect_task() {
    : >"$calls"
    echo "$2" >"$calls.code"
    expect_exit "$2" env SLURM_ARRAY_JOB_ID=1 SLURM_ARRAY_TASK_ID="$1" SLURM_JOB_ID=77 SLURMD_NODENAME="${3:-node1}" \
        SLURM_JOB_PARTITION=gpu "$task" "$folder"
}

expect_rendered() {
    [[ $(<"$calls.renderer") == "$1" ]] || fail "the renderer got $(<"$calls.renderer"), expected $1"
}

# ---- chunks, the last of which is smaller
expect_task 0 0
expect_task 2 0
expect_no_call requeue
expect_rendered "[render][--frame-lines][--frames][17-20][-o][${odd//%/%%}/f%%%03d.png][$odd/s.json][--set][a=\$b c]"
rm "$calls.code"
expect_exit 0 env SLURM_JOB_ID=2 SLURMD_NODENAME=node1 "$task" "$folder" film
expect_rendered "[render][--frame-lines][--frames][7-20][-o][${odd//%/%%}/f%%%03d.png][-o][$odd/a film.mp4][$odd/s.json][--set][a=\$b c]"

# ---- exit codes: bad input never again, others once more, a missing device elsewhere
expect_task 1 2
expect_no_call requeue
rm "$folder"/task-1.*
for failure in 1 143; do
    expect_task 1 "$failure"
    expect_call 'scontrol[requeue][1_1]'
    expect_no_call ExcNodeList
    expect_task 1 "$failure"
    expect_no_call requeue
    rm "$folder"/task-1.*
done
echo '(null)' >"$calls.queue"
expect_task 1 3
expect_call 'scontrol[requeue][1_1]'
expect_call 'scontrol[update][JobId=1_1][ExcNodeList=node1]'
rm "$folder"/task-1.*
echo node1 >"$calls.queue"
expect_task 1 3 node2
expect_no_call requeue
grep -q 'the device is missing on every node of the partition gpu' "$folder/task-1.log" || fail "the log is $(<"$folder/task-1.log")"
rm "$calls.queue"

# ---- the report: frames, states, and no state of a finished task
expect_exit 1 "$report" "$odd"
expect_stdout_contains 'frames   0 of 14 there, missing 7-20'
expect_stdout_contains 'task 1   frames 12-16: 0 of 5, failed on node2 after'
expect_stdout_contains 'exit code 3'
for frame in 007 008 010 {011..020}; do
    echo picture >"$odd/f%$frame.png"
done
echo "start node1 100" >"$folder/task-1.txt"
expect_exit 1 "$report" "$odd"
expect_stdout_contains 'frames   13 of 14 there, missing 9'
expect_stdout_contains 'task 1   frames 12-16: 5 of 5, killed on node1'
echo "end node1 107 failed 1
start node2 110
end node2 119 done 0" >>"$folder/task-1.txt"
echo picture >"$odd/f%009.png"
printf '%s' "$folder" >"$calls.folder"
expect_exit 0 "$report" 1
expect_stdout_contains 'frames   14 of 14 there'
expect_stdout_contains 'task 1   frames 12-16: 5 of 5, done on node2 in 9 s, try 2'
echo '1|PENDING|Resources' >"$calls.queue"
expect_exit 1 "$report" "$folder"
expect_stdout_contains 'task 1   frames 12-16: 5 of 5, waiting (Resources), try 2'

# ---- nothing more is submitted while a job is at work
expect_exit 2 "$submit" "$odd/s.json" -o "${odd//%/%%}/f%%%03d.png" --frames 7-20
expect_stderr_contains 'job 1 is still at work on these frames'
rm "$calls.queue"
expect_exit 0 "$submit" "$odd/s.json" -o "${odd//%/%%}/f%%%03d.png" --frames 7-20
expect_stdout_contains "$PWD/$odd/hedron-farm/2"
touch "$calls.refuses"
expect_exit 1 "$submit" "$odd/s.json" -o "${odd//%/%%}/f%%%03d.png" --frames 7-20
expect_stderr_contains 'invalid partition'
rm "$calls.refuses"
expect_exit 2 "$report" nothing
[[ ! -e bad ]] || fail "a name was run by a shell"

# ---- interrupted: a cancelled task stays, one near its time limit continues if it has stored frames
expect_exit 0 "$submit" "a scene.json" -o "$pattern" --frames 0-3 --retries 0
folder=$PWD/out/hedron-farm/1
cat >"$work/renderer" <<'SCRIPT'
#!/usr/bin/env bash
trap 'kill "$sleeper"; exit 143' TERM
sleep 1000 &
sleeper=$!
echo $$ >"$FAKE_CALLS.pid"
while :; do wait; done
SCRIPT

# stop_task SIGNAL [FRAME]: a task that gets the signal while its renderer works, after storing a frame.
stop_task() {
    : >"$calls"
    rm -f "$calls.pid" "$folder"/task-0.*
    start env SLURM_ARRAY_JOB_ID=1 SLURM_ARRAY_TASK_ID=0 SLURM_JOB_ID=1 SLURMD_NODENAME=node1 "$task" "$folder"
    wait_until 60 test -s "$calls.pid" || fail "the renderer does not start"
    if [[ $# -gt 1 ]]; then
        touch -d 'now + 1 minute' "$2"
    fi
    kill "-$1" "$pid"
    expect_end 143
}

# expect_record STATE: of the interrupted task.
expect_record() {
    grep -q "^end node1 [0-9]* $1 143\$" "$folder/task-0.txt" || fail "the record is $(<"$folder/task-0.txt")"
}

stop_task TERM
expect_no_call requeue
expect_record stopped
stop_task USR1 'out/f 0002.png'
expect_call 'scontrol[requeue][1_0]'
expect_record stopped
rm 'out/f 0002.png'
stop_task USR1
expect_no_call requeue
expect_record failed
finish
