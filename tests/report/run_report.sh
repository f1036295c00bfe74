#!/bin/sh
# run_report.sh GNATHOS NODE OUT: makes the pages of the outcome OUT and opens them in a headless Chromium. Skipped (77)
# where there is none.
set -eu
gnathos=$1 node=$2 out=$3 here=$(cd "$(dirname "$0")" && pwd)
[ -x /usr/bin/chromium ] || { echo "skipped: the pages are not opened, because /usr/bin/chromium is not here"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -R "$out" "$work/out"
# an audit of the plan, which judges no tissue, found one limit otherwise and a remedy
"$node" -e '
const fs = require("fs"), out = process.argv[1], o = JSON.parse(fs.readFileSync(out + "/outcome.json", "utf8"));
const { gnathos, version, case: name } = o, tissue = ["solved", "smallest_j", "largest_stretch", "incisor_show_mm", "lower_face_share"];
const limits = o.limits.limits.filter(l => !tissue.includes(l.limit));
limits[0] = { ...limits[0], level: "stop", value: 8.25 };
const change = { control: "maxilla_advance_mm", unit: "mm", by: -0.25, wanted: 8.25, proposed: 8 };
fs.writeFileSync(out + "/audit.json", JSON.stringify({ gnathos, kind: "plan_audit", version, worst: "stop", override: "",
    limits, case: name, plan: o.plan.name, feasible: false, remedy: { found: true, changes: [change], contradict: [] } }));
' "$work/out"
"$gnathos" report "$work/out" -o "$work/report.html"
"$gnathos" report "$work/out" -o "$work/again.html" --no-pictures -q
"$gnathos" report "$work/out" -o "$work/again2.html" --no-pictures -q -j 1
cmp "$work/again.html" "$work/again2.html" || { echo "the same outcome gave another page"; exit 1; }
cp -R "$work/out" "$work/hostile"
rm "$work/hostile/audit.json"
"$node" -e '
const fs = require("fs"), path = process.argv[1], o = JSON.parse(fs.readFileSync(path, "utf8"));
o.case = "</script><img src=x onerror=alert(1)> Mustermann";
o.plan.name = "<!--<script> Mustermann";
o.plan.override = "<b>Mustermann";
o.landmarks.push({ ...o.landmarks[0], label: "Mustermann" });
fs.writeFileSync(path, JSON.stringify(o));' "$work/hostile/outcome.json"
"$gnathos" report "$work/hostile" -o "$work/named.html" --name --no-pictures -q
"$gnathos" report "$work/hostile" -o "$work/unnamed.html" --no-pictures -q
[ "$(ls "$work" | sort | tr '\n' ' ')" = "again.html again2.html hostile named.html out report.html unnamed.html " ] ||
    { echo "something else was left behind:"; ls -A "$work"; exit 1; }
"$node" "$here/report.mjs" "$work"
