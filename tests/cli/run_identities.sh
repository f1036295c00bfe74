#!/bin/sh
# run_identities.sh GNATHOS BENT_HEADS: a model of bent templates is shown, heads are made of it and checked, its file is
# torn and refused.
set -eu
gnathos=$1 bent=$2 here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir fits
"$bent" bent.model fits
"$gnathos" identities show bent.model --json >show.json
"$gnathos" identities make bent.model --p 1,-1.5 -o head --json >head.json
"$gnathos" identities make bent.model --random --seed 4 -o random --json >random.json
"$gnathos" identities make bent.model --random --seed 4 -o again -q >/dev/null
"$gnathos" identities learn fits/* -o learnt.model --json >learnt.json
[ ! -e learnt.model.journal ] || { echo "the journal of finished work stays"; exit 1; }
"$gnathos" identities project bent.model fits/wide --json >wide.json
/usr/bin/python3 "$here/check_record.py" "$gnathos" show.json head.json random.json learnt.json wide.json
/usr/bin/python3 - <<'PY'
import json
show, learnt, wide = (json.load(open(n + ".json")) for n in ("show", "learnt", "wide"))
assert learnt["heads"] == learnt["fitted"] == 7 and learnt["refused"] == 0
for a, b in zip(show["modes"], learnt["modes"]): assert abs(a["sd_mm"] - b["sd_mm"]) < 1e-9, (a, b)
assert all(part["max_mm"] < 1e-6 for part in wide["error"].values()), wide["error"]
assert max(abs(p) for p in wide["p"]) > 0.5 and wide["guessed"] == 0
PY
for file in skin.ply skull.ply mandible.ply upper_teeth.ply lower_teeth.ply landmarks.mrk.json; do
    cmp random/$file again/$file || { echo "the same seed gives another $file"; exit 1; }
done
cmp -s head/skin.ply random/skin.ply && { echo "other coefficients give the same skin"; exit 1; }
"$gnathos" check head >/dev/null

refused() { # STATUS WORDS COMMAND...: in this way
    status=$1 words=$2
    shift 2
    got=0
    "$gnathos" identities "$@" >stdout 2>stderr || got=$?
    [ "$got" = "$status" ] && grep -qF "$words" stderr || { echo "$*: $got: $(cat stderr), not $status: $words"; exit 1; }
}
refused 3 'is not an empty folder' make bent.model --p 1 -o head
refused 2 'fits/wide is named twice' learn fits/wide fits/long fits/wide -o two.model
refused 2 'p[0] is 4: -3 to 3 standard deviations are heads' make bent.model --p 4 -o new
refused 3 'none.model: cannot be read: No such file or directory' show none.model
export XDG_CACHE_HOME="$work/cache"
refused 3 'identities-2.model: cannot be read: No such file or directory; gnathos identities learn --norm 120 makes it' show
"$gnathos" identities learn fits/* -q >/dev/null
refused 3 'identities-2.model: is there already; --force replaces it' learn fits/*
"$gnathos" identities project fits/wide --json >own.json
"$gnathos" identities show --json >own_show.json
cmp cache/gnathos/identities-2.model learnt.model || { echo "the user's own model is another"; exit 1; }
"$gnathos" identities make --random --seed 4 -o own -q >/dev/null
"$gnathos" identities make learnt.model --random --seed 4 -o named -q >/dev/null
cmp own/skin.ply named/skin.ply || { echo "the user's own model makes another head"; exit 1; }
mkdir face
echo '{"gnathos": 1, "name": "face", "surfaces": {"skin": "../head/skin.ply"}}' >face/case.json
"$gnathos" fit face --complete --no-pictures -o whole --json >whole.json 2>told.txt
grep -q 'the likeliest head of .*cache/gnathos/identities-2.model' told.txt || { cat told.txt; exit 1; }
/usr/bin/python3 "$here/check_record.py" "$gnathos" whole.json
/usr/bin/python3 - <<'PY'
import json, meshio, numpy
done = json.load(open("whole.json"))["completion"]
assert done["p"] and done["noise_mm"] > 0, done
made, true = (meshio.read(f + "/mandible.ply").points for f in ("whole", "head"))
off = numpy.linalg.norm(made - true, axis=1)
print(f"a mandible guessed from the skin alone: {off.mean():.2f} mm off in the mean, {off.max():.2f} at most")
assert off.mean() < 2
PY
GNATHOS_IDENTITIES=none.model refused 3 'none.model: cannot be read' show
head -c 100000 bent.model >torn.model
refused 3 'torn.model: is not a whole model of identities' show torn.model
refused 3 'head/case.json: is not a whole model of identities' make head/case.json --random -o new
[ ! -e new ] && [ ! -e two.model ] || { echo "what was refused left a folder"; exit 1; }
