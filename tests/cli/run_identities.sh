#!/bin/sh
# run_identities.sh GNATHOS BENT_HEADS: a model of bent templates is shown, heads are made of it and checked, its file is
# torn and refused.
set -eu
gnathos=$1 bent=$2 here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
cd "$work"
"$bent" bent.model
"$gnathos" identities show bent.model --json >show.json
"$gnathos" identities make bent.model --p 1,-1.5 -o head --json >head.json
"$gnathos" identities make bent.model --random --seed 4 -o random --json >random.json
"$gnathos" identities make bent.model --random --seed 4 -o again -q >/dev/null
/usr/bin/python3 "$here/check_record.py" "$gnathos" show.json head.json random.json
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
refused 2 'p[0] is 4: -3 to 3 standard deviations are heads' make bent.model --p 4 -o new
refused 3 'none.model: cannot be read: No such file or directory' show none.model
head -c 100000 bent.model >torn.model
refused 3 'torn.model: is not a whole model of identities' show torn.model
refused 3 'head/case.json: is not a whole model of identities' make head/case.json --random -o new
[ ! -e new ] || { echo "what was refused left a folder"; exit 1; }
