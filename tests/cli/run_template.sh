#!/bin/sh
# run_template.sh GNATHOS KEEP: the template of heads is made once and kept in KEEP, where other tests find it, and found
# again; what cannot be it is refused.
set -eu
gnathos=$1 keep=$2 here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAIL: $*" >&2; exit 1; }
refused() { # STATUS WORDS: of the command before, in $status and stderr
    [ $status -eq "$1" ] || fail "status $status, wanted $1: $(cat "$work/stderr")"
    [ "$(wc -l <"$work/stderr")" -eq "$3" ] && grep -qF -- "$2" "$work/stderr" || fail "wanted '$2': $(cat "$work/stderr")"
}
rm -f "$keep"
export GNATHOS_TEMPLATE="$keep"
"$gnathos" template --json >"$work/made.json" 2>"$work/told.txt"
grep -q 'not there yet; it is made, once' "$work/told.txt" || fail "nothing tells that it is made: $(cat "$work/told.txt")"
[ "$(find "$(dirname "$keep")" -name "$(basename "$keep")*" | wc -l)" -eq 1 ] || fail "files are left beside it"
# found in the cache, by a path with a space that is a folder deeper than what is there
mkdir -p "$work/my cache/gnathos"
cp "$keep" "$work/my cache/gnathos/template-1.pack"
env -u GNATHOS_TEMPLATE XDG_CACHE_HOME="$work/my cache" "$gnathos" template -o "$work/out" --json >"$work/found.json"
cmp "$work/found.json" "$work/out/template.json" || fail "template prints another record than it writes"
/usr/bin/python3 "$here/check_record.py" "$gnathos" "$work/made.json" "$work/found.json"
/usr/bin/python3 - "$work" <<'PY'
import json, os, sys
work = sys.argv[1]
made, found = (json.load(open(f"{work}/{n}.json")) for n in ("made", "found"))
assert made["place"] == "named" and made["seconds"]["make"] > 1 and found["place"] == "cached"
assert found["seconds"]["make"] is None and found["path"].endswith("my cache/gnathos/template-1.pack")
for key in ("numbering", "hash", "parts", "tissue", "landmarks"): assert made[key] == found[key], key
assert 5000 <= made["tissue"]["nodes"] <= 8000, made["tissue"]
assert len(set(made["landmarks"]["labels"])) == made["landmarks"]["count"] > 70
points = json.load(open(work + "/out/landmarks.mrk.json"))["markups"][0]["controlPoints"]
assert [p["label"] for p in points] == made["landmarks"]["labels"]
for part, size in made["parts"].items():
    head = open(f"{work}/out/{part}.ply", "rb").read(400).decode("latin1")
    assert f"element vertex {size['vertices']}\n" in head and f"element face {size['triangles']}\n" in head, part
import meshio
tissue = meshio.read(work + "/out/tissue.vtu")
assert len(tissue.points) == made["tissue"]["nodes"] and len(tissue.cells[0].data) == made["tissue"]["tets"]
facing = tissue.point_data["facing"].ravel()
assert (facing >= 0).sum() == 2 * made["tissue"]["lip_pairs"]
assert set(tissue.point_data["attachment"].ravel()) == {0, 1, 2}
PY
status=0
printf 'a text\n' >"$work/text.pack"
GNATHOS_TEMPLATE="$work/text.pack" "$gnathos" template >"$work/stdout" 2>"$work/stderr" || status=$?
refused 3 'text.pack: is no whole template of heads' 1
status=0
GNATHOS_TEMPLATE="$work/text.pack/t.pack" "$gnathos" template >"$work/stdout" 2>"$work/stderr" || status=$?
refused 7 'text.pack: cannot be made as a folder' 2
status=0
env -u GNATHOS_TEMPLATE -u HOME -u XDG_CACHE_HOME "$gnathos" template >"$work/stdout" 2>"$work/stderr" || status=$?
refused 7 'no place to keep the template of heads' 1
echo "the template is made, found and refused"
