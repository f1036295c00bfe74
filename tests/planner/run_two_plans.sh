#!/bin/sh
# run_two_plans.sh GNATHOS TWO_PLANS CONTACT [CASE]: two_plans on a prepared case, or on a coarse synthetic head made here.
set -eu
gnathos=$1 two_plans=$2 contact=$3 case=${4:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ -z "$case" ]; then
    case=$work/case
    "$gnathos" new -q "$case" --norm --class 3 --coarseness 3 >"$work/new.txt"
    /usr/bin/python3 - "$case/case.json" <<'PY'
import json, sys
case = json.load(open(sys.argv[1]))
case.setdefault("tissue", {}).update({"element_mm": 6, "coarse_mm": 12})
json.dump(case, open(sys.argv[1], "w"))
PY
fi
"$gnathos" prepare -q "$case" >"$work/prepare.txt"
for control in maxilla_advance_mm mandible_advance_mm; do
    echo "$control"
    "$two_plans" "$case" "$contact" $control
done
