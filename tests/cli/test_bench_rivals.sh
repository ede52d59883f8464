#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Other programs beside hedron: what they are told of a scene, that POV-Ray has the same picture where it is installed, what is
# told where nothing is, and the page.
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

need_python

# ---- solids: closed, outwards, all corners at the circumradius
cat >solids.py <<'PYTHON'
from harness.rivals import shapes
from harness.rivals.shapes import cross, dot, minus
for kind in shapes.CORNERS:
    centre = [1, -2, 3]
    faces = shapes.faces({"kind": kind, "centre": centre, "circumradius": 2, "rotation": [20, 30, 40]})
    key = lambda corner: tuple(round(x, 6) for x in corner)
    edges = [(key(a), key(b)) for face in faces for a, b in zip(face, face[1:] + face[:1])]
    outwards = all(dot(cross(minus(f[1], f[0]), minus(f[2], f[0])), minus(f[0], centre)) > 0 for f in faces)
    far = {round(dot(minus(c, centre), minus(c, centre)), 9) for f in faces for c in f}
    print(kind, len(faces), {len(face) for face in faces}, outwards, far, set(edges) == {(b, a) for a, b in edges})
PYTHON
expect_python "tetrahedron 4 {3} True {4.0} True
cube 6 {4} True {4.0} True
octahedron 8 {3} True {4.0} True
dodecahedron 12 {5} True {4.0} True
icosahedron 20 {3} True {4.0} True" "$(cat solids.py)"

# ---- what other programs have no word for
expect_python 'other programs cannot be told of rim' 'from harness.rivals import shapes' 'from harness.run.program import Problem' \
    'parts = {"camera": {}, "floor": {}, "materials": {}, "lights": [], "solids": [{"kind": "cube", "rim": {}}]}' \
    'try: shapes.checked(parts)' 'except Problem as problem: print(problem)'

# ---- pictures: means of squares; a PFM read back
expect_python "(2, 1, [2.5, 3.5, 4.5, 1.0, 1.0, 1.0]) (2, 1, array('f', [2.5, 3.5, 4.5, 1.0, 1.0, 1.0]))" \
    'from harness.rivals.povray import smaller' 'from harness.run import pfm' \
    'small = smaller((4, 2, [1, 2, 3, 2, 3, 4] + [1] * 6 + [3, 4, 5, 4, 5, 6] + [1] * 6), 2)' \
    'pfm.write("a.pfm", *small)' 'print(small, pfm.read("a.pfm"))'

# ---- POV-Ray's picture is hedron's, sample by sample
if command -v povray >"$logs/which"; then
    cat >same.py <<PYTHON
from pathlib import Path
from harness.measure.scenes import read_scene
from harness.measurements import rivals
from harness.run import pfm
from harness.run.program import Program
scene, here, size = read_scene(rivals.SCENE), Path.cwd(), (64, 36)
ours = rivals.Hedron(Program(Path("$hedron")), scene, size, here)
ours.grid(1, here / "ours.pfm")
rivals.Povray(scene, size, here).render((1, "-A"), here / "theirs.pfm", 0)
print(pfm.share_within("ours.pfm", "theirs.pfm", 1) > 0.997)
PYTHON
    expect_python True "$(cat same.py)"
fi

# ---- where nothing is installed, and what the page says
cat >page.py <<'PYTHON'
from types import SimpleNamespace as Some
from pathlib import Path
from harness.measurements import rivals
from harness.page.section import sections
from harness.rivals import mitsuba, povray
povray.shutil = Some(which=lambda name: None)
mitsuba.PLACES = ("no/python",)
rivals.Hedron = lambda *_: Some(name="hedron")
study = Some(result={}, program=None, folder=Path.cwd(), arguments=Some(quick=True))
print(rivals.measure(study)[:63])
def point(program, ms, rmse): return {"program": program, "name": "a", "cpu": [ms], "wall": [ms], "ms": ms, "rmse": rmse, "largest": 9, "own_rmse": rmse}
found = {"size": [4, 3], "threads": 2, "reasons": {"B": "B is not installed"}, "versions": {"hedron": "1", "A": "2"},
         "agreements": {"A": {"deep": "so many samples", "rmse": 0.5, "above_1": 0.25}},
         "points": [point("hedron", 10, 1), point("A", 300, 1), point("A", 900, 0.5)]}
place = {"cpu": "c", "cores": 2, "name": "m"}
drawn = sections({"rivals": rivals.PART}, [{"left_out": {}, "devices": [], "machine": place, "hedron": {"version": "1"}, "rivals": found}])
print(drawn[0].charts["study_rivals0"][1])
print(*drawn[0].notes, len(drawn[0].table), sep="\n")
PYTHON
expect_python "POV-Ray is not installed: its package is povray. Mitsuba 3 is n
Processor time for the same error, against hedron: A takes 30 times at an RMSE of 4, 30 times at an RMSE of 2, 30 times at an RMSE of 1. Each line has the settings that no other of its program beats in both; 2 threads.
The deep pictures of A 2 and of hedron are 0.50 apart (RMSE, steps of 255; so many samples), 75.00 % of the pixels within 1.
B is not installed.
4" "$(cat page.py)"
finish
