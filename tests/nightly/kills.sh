#!/bin/sh
# kills.sh [KILLS [SEED [CASE]]]: kill -9 at KILLS (60) random moments of predict --force, audit --force, prepare and study
# of a case, or of the synthetic class III head in a coarse mesh; every third while files are written.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
gnathos=${GNATHOS_BUILD:-$root/build}/app/gnathos case=${3:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ -z "$case" ]; then
    case=$work/head
    "$gnathos" new "$case" --norm --class 3 -q >/dev/null
    sed -i 's/"osteotomies"/"tissue": { "element_mm": 8 }, "osteotomies"/' "$case/case.json"
fi
"$gnathos" prepare "$case" -q >/dev/null
/usr/bin/python3 "$root/tests/cli/run_kills.py" "$gnathos" "$case" "${1:-60}" "${2:-1}"
