#!/bin/sh
# run_good.sh GNATHOS FOLDER: what is right is accepted, with results on stdout and nothing else there.
set -u
gnathos=$(realpath "$1") here=$(cd "$2" && pwd) failed=0
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cp -R "$here/base" "$work/case"
cd "$work/case" || exit 1
says() { # WHAT ARGUMENT...: status 0, and WHAT is on stdout
    want=$1
    shift
    "$gnathos" "$@" >"$work/stdout" 2>"$work/stderr" </dev/null
    status=$?
    if [ $status -ne 0 ] || ! grep -qF -- "$want" "$work/stdout"; then
        echo "gnathos $*: status $status, wanted on stdout: $want"
        cat "$work/stdout" "$work/stderr"
        failed=1
    fi
}
says 'gnathos 0.' --version
says 'Usage: gnathos VERB' --help
says 'Usage: gnathos VERB' help
says 'Usage: gnathos check' check --help
says 'Usage: gnathos check' help check
says 'tissue.element_mm' help case
says 'limits.maxilla_advance_mm.stop' help case
says 'maxilla_impaction_mm' help plan
says 'porion' help landmarks
says 'solve.contact.depth_mm' help outcome
says 'plan.segments.<segment>.matrix' help outcome
says 'remedy.changes' help --record plan_audit
says '"additionalProperties": false' help --schema check
says 'no errors, 1 warnings' check .
says 'no errors, 1 warnings' check case.json --plan plan.json
says '"kind": "check"' check . --json
says '"ok": true' check . --plan plan.json --json -q

printf '{ "gnathos": 1, "maxilla_advance_mm": 12, "override": "cleft" }\n' >far.json
says 'no errors, 2 warnings' check . --plan far.json
grep -q 'warning: is 12, outside -5 to 8.*Accepted because: cleft' "$work/stderr" || { echo "no warning of the override"; failed=1; }

sed 's/"surfaces"/"frame": "RAS", "surfaces"/' case.json >ras.json
for mesh in skin skull mandible; do
    awk 'NF == 3 && NR > 2 { print -$1, -$2, $3; next } { print }' $mesh.off >t && mv t $mesh.off
done
says 'no errors, 1 warnings' check ras.json

"$gnathos" check -q . --json >"$work/stdout" 2>/dev/null # the meshes are turned now, the case is not
[ $? -ne 0 ] && grep -q '"ok": false' "$work/stdout" || { echo "a wrong case must say so in JSON too"; failed=1; }
"$gnathos" stress --only poisson/0.45 -o "$work/stress" --json >"$work/stress.json"
cmp "$work/stress.json" "$work/stress/stress.json" || { echo "stress prints another record than it writes"; failed=1; }
"$gnathos" ceph "$work/case" --json >"$work/ceph.json"
/usr/bin/python3 "$here/check_record.py" "$gnathos" "$work/stdout" "$work/stress.json" "$work/ceph.json" || failed=1
# every kind has its fields and its schema
for kind in $("$gnathos" help records | sed -n 's/^  \([a-z_]*\) .*/\1/p'); do
    says '"$schema"' help --schema "$kind"
    says 'the text "'"$kind"'"' help --record "$kind"
done
[ $failed -eq 0 ] && echo "all accepted as expected"
exit $failed
