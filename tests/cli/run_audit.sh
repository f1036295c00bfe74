#!/bin/sh
# run_audit.sh GNATHOS CASE: audits a prepared case on a coarse grid, once through and once killed at three random moments,
# compares all files, and reads them as a user's tools would.
set -eu
gnathos=$1 case=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAIL: $*" >&2; exit 1; }
size() { stat -c %s "$1" 2>/dev/null || echo 0; }
settings="--pair maxilla_advance_mm,mandible_advance_mm --spacing 5 --tolerance 1.3"
# shellcheck disable=SC2086
"$gnathos" audit "$case" -o "$work/whole" $settings >"$work/table.txt"
cat "$work/table.txt"
grep -q 'maxilla_advance_mm  *low' "$work/table.txt" || fail "no table of bounds"
[ ! -e "$work/whole.journal" ] || fail "the journal stays after the end"
/usr/bin/python3 "$(dirname "$0")/check_record.py" "$gnathos" "$work/whole/audit.json"
# shellcheck disable=SC2086
"$gnathos" audit "$case" -o "$work/bones" $settings --geometry-only --no-pictures --json >"$work/bones.json"
cmp "$work/bones.json" "$work/bones/audit.json" || fail "audit prints another record than it writes"
/usr/bin/python3 "$(dirname "$0")/check_record.py" "$gnathos" "$work/bones.json"

seed=$(od -An -N2 -tu2 /dev/urandom | tr -d ' ')
echo "seed $seed"
# the journal's growth, in bytes, after which each run is killed: among bones, among solves, anywhere
for grow in $(awk -v s="$seed" 'BEGIN { srand(s); print int(100 + 1500 * rand()), int(4000 + 200000 * rand()), int(1 + 400000 * rand()) }'); do
    before=$(size "$work/parts.journal")
    "$gnathos" audit "$case" -o "$work/parts" $settings >/dev/null 2>"$work/note.txt" &
    running=$!
    while kill -0 $running 2>/dev/null && [ "$(size "$work/parts.journal")" -lt $((before + grow)) ]; do sleep 0.02; done
    kill -9 $running 2>/dev/null || true
    wait $running 2>/dev/null || true
    if [ -e "$work/parts" ]; then echo "ended before it was killed"; break; fi
    if [ "$before" -gt 200 ]; then grep -q 'goes on after' "$work/note.txt" || fail "an earlier run was forgotten"; fi
done
if [ ! -e "$work/parts" ]; then
    "$gnathos" audit "$case" -o "$work/parts" $settings >"$work/again.txt" 2>"$work/note.txt"
    sed 's/whole$/parts/' "$work/table.txt" | cmp - "$work/again.txt" || fail "another table"
fi
[ "$(ls "$work/whole")" = "$(ls "$work/parts")" ] || fail "other files"
for file in "$work/whole"/*; do cmp "$file" "$work/parts/$(basename "$file")" || fail "killed and resumed, $file differs"; done

# an interruption is polite, and one thread gives the same bytes as all
"$gnathos" audit "$case" -o "$work/one" -j1 $settings >/dev/null 2>"$work/note.txt" &
running=$!
while kill -0 $running 2>/dev/null && [ "$(size "$work/one.journal")" -lt 800 ]; do sleep 0.02; done
kill -INT $running
status=0
wait $running || status=$?
[ $status -eq 130 ] || fail "exit status $status after an interruption"
grep -q 'goes on from there' "$work/note.txt" || fail "no word of the journal"
[ ! -e "$work/one" ] || fail "half a result"

/usr/bin/python3 - "$work/whole" <<'PY'
import csv, json, os, sys
import vtk
from vtk.util.numpy_support import vtk_to_numpy
out = sys.argv[1]
a = json.load(open(os.path.join(out, "audit.json")))
name = a["maps"][0]["files"]
reader = vtk.vtkXMLImageDataReader()
reader.SetFileName(os.path.join(out, name + ".vti"))
reader.Update()
grid = reader.GetOutput()
rows = list(csv.DictReader(open(os.path.join(out, name + ".csv"))))
assert grid.GetNumberOfPoints() == len(rows) == a["maps"][0]["nodes"]
level = vtk_to_numpy(grid.GetPointData().GetArray("level"))
names = {l["number"]: l["name"] for l in a["limits"]}
limit = vtk_to_numpy(grid.GetPointData().GetArray("limit"))
for i, row in enumerate(rows):
    x = grid.GetPoint(i)
    assert abs(x[0] - float(row["maxilla_advance_mm"])) < 1e-9 and abs(x[1] - float(row["mandible_advance_mm"])) < 1e-9
    assert ("fine", "caution", "stop")[int(level[i])] == row["level"] and names[int(limit[i])] == row["limit"]
assert {r["level"] for r in rows} >= {"stop"} and any(r["level"] != "stop" for r in rows)
for b in a["bounds"]:
    low, high = b["low"], b["high"]
    if b["base_feasible"]:
        assert b["box"][0] < low["feasible_to"] <= b["base"] <= high["feasible_to"] < b["box"][1], b
        assert low["stopped_beyond"]["limit"] and high["stopped_beyond"]["limit"]
assert a["tissue"]["solves"] > 0 and a["tissue"]["solves_left_out"] > 0, a["tissue"]
assert os.path.getsize(os.path.join(out, name + ".png")) > 10000
PY
echo "audited, killed and resumed to the same bytes"
