#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Models made by hedron_model, and the supplied scene with one of them.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
model=$(realpath "$2")/hedron_model

# One sentence of the program's own, nothing on standard output: expect_model_refusal CODE WHAT ARGUMENT...
expect_model_refusal() {
    expect_exit "$1" timeout "$time_limit" "$model" "${@:3}"
    expect_stdout_lines 0
    expect_stderr_contains "$2"
    if (($(grep -c -E '^hedron_model: .{10,}$' "$logs/stderr") != 1 || $(wc -l <"$logs/stderr") != 1)); then
        fail "standard error is not one sentence"
    fi
}

# Prints the number of directed edges that do not occur exactly once in each direction, and whether the volume that the
# triangles enclose is positive.
measure() {
    awk '$1 == "v" { n++; for (i = 0; i < 3; i++) p[n, i] = $(2 + i) }
        $1 == "f" {
            for (i = 0; i < 3; i++) edges[$(2 + i), $(2 + (i + 1) % 3)]++
            a = $2; b = $3; c = $4
            volume += p[a, 0] * (p[b, 1] * p[c, 2] - p[b, 2] * p[c, 1])
            volume += p[a, 1] * (p[b, 2] * p[c, 0] - p[b, 0] * p[c, 2])
            volume += p[a, 2] * (p[b, 0] * p[c, 1] - p[b, 1] * p[c, 0])
        }
        END {
            for (edge in edges) {
                split(edge, ends, SUBSEP)
                bad += edges[edge] != 1 || edges[ends[2], ends[1]] != 1
            }
            print bad + 0, (volume > 0 ? "positive" : "not positive")
        }'
}

# expect_model KIND WANTED VERTICES TRIANGLES: the message and the file agree, and hedron reads all of it.
expect_model() {
    local file=$1.obj found
    expect_exit 0 "$model" "$1" "$2" -o "$file"
    expect_silent_stderr
    expect_stdout_lines 0
    found=$(grep -c '^v ' "$file"; grep -c '^f ' "$file"; grep -c -v -E \
        '^(v( -?[0-9]+\.[0-9]{6}){3}|f( [1-9][0-9]*){3}|# .*)$' "$file" || true)
    if [[ ${found//$'\n'/ } != "$3 $4 0" ]]; then
        fail "$1 $2 has ${found//$'\n'/ } vertices, triangles and other lines, expected $3 $4 0"
    fi
    if ! head -n 1 "$file" | grep -q -F ": $4 triangles; hedron_model $1 $2"; then
        fail "the first line of $1 $2 is $(head -n 1 "$file")"
    fi
    expect_exit 0 "$hedron" render --backend c --verbose --set "meshes[0].file=$file" "${small[@]}" any.json -o any.data
    expect_stderr_contains "meshes    1 with $4 triangles, and 0 without an area left out"
}
cat >any.json <<'JSON'
{
  "hedron": 1,
  "camera": {"eye": [2, -3, 2]},
  "materials": {"clay": {"diffuse": 0.9}},
  "meshes": [{"file": "any.obj", "normals": "smooth", "material": "clay"}],
  "lights": [{"position": [3, -4, 8]}]
}
JSON

# ---- every kind, from the fewest triangles on
expect_model sphere 12 8 12
expect_model sphere 20000 10088 20172
expect_model knot 12 9 18
expect_model soup 12 36 12
expect_model soup 20000 60000 20000

# ---- closed, and seen from outside counterclockwise
for kind in sphere knot; do
    expect_same <("$model" "$kind" 3000 | measure) <(echo '0 positive')
done

rm ./*.obj

# ---- wrong usage
expect_model_refusal 2 'expected KIND and TRIANGLES' knot
expect_model_refusal 2 '"teapot" is an unknown kind' teapot 100
for triangles in 11 10000001 1e3 '' 4294967396; do
    expect_model_refusal 2 "TRIANGLES is \"$triangles\"" knot "$triangles"
done
expect_model_refusal 2 '-5 is an unknown option' knot -5
expect_model_refusal 2 '"100" is too much' knot 100 100
expect_model_refusal 2 'after -o' knot 100 -o a.obj -o b.obj
expect_model_refusal 2 'is not a regular file' knot 100 -o .

# ---- a failed write is reported, and leaves the old file
if [[ -c /dev/full ]]; then
    expect_exit 1 bash -c "'$model' knot 12 >/dev/full"
    expect_stderr_contains 'hedron_model: cannot write to standard output: No space left'
fi
echo old >old.obj
expect_exit 1 bash -c "ulimit -f 100; '$model' knot 20000 -o old.obj"
expect_stderr_contains 'hedron_model: cannot write old.obj: File too large'
expect_same old.obj <(echo old)
start "$model" soup 10000000 -o late.obj
wait_until "$time_limit" compgen -G 'late.obj.tmp-*' >/dev/null || fail "there is no temporary file"
kill -INT "$pid"
expect_end 130
expect_stderr_contains 'hedron_model: interrupted'
expect_files . any.data any.json old.obj

# ---- the supplied scene has the model that the program makes, and passes the check
expect_exit 0 "$model" knot 8000 -o knot.obj
expect_same knot.obj "$project/scenes/knot.obj"
expect_exit 0 "$hedron" check "$project/scenes/knot.json"
expect_silent_stderr
expect_stdout_lines 2 '.*/knot\.json: (fine, 1 solid, 1 mesh of 8000 triangles in 1 place, .*|meshes\[0\], .*)'

# ---- a model of clear air is invisible; all its images together need a depth beyond 60
render_far() {
    expect_exit 0 "$hedron" render --quiet --backend c "$project/scenes/knot.json" --frames 20 --size 160x90 \
        --samples 1 --depth 600 "$@"
    expect_silent_stderr
}
render_far -o none.data --set 'meshes=[]'
render_far -o clear.data --set 'materials."apricot glass"={"transmission": 1}'
expect_same clear.data none.data
finish
