#!/bin/sh
# run_default.sh [CASE]: installs the packages, builds gnathos, makes the head of the case (class3) and predicts its face
# after the case's plan. Results: out/CASE. GNATHOS_BUILD: the build folder (build/).
set -eu
cd "$(dirname "$0")/.."
name=${1:-class3}
build=${GNATHOS_BUILD:-build}
sh .ci/setup
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$build" --target gnathos
gnathos=$build/app/gnathos
[ -f "cases/$name/case.json" ] || "$gnathos" new "cases/$name"
"$gnathos" check -q "cases/$name" --plan "cases/$name/plan.json"
mkdir -p out
"$gnathos" predict "cases/$name" --plan "cases/$name/plan.json" -o "out/$name" --force
