#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Random scenes, rendered by a ray tracer written from docs/model.md alone, have the same pixels.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

need_python
run python3 -B "$project/tests/reference/compare_scenes.py" "$hedron" 45 20
cat "$logs/stdout"
((code == 0)) || fail "the tracer has other pixels: $(<"$logs/stderr")"
finish
