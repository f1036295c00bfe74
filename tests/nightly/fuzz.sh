#!/bin/sh
# fuzz.sh [INPUTS [SECONDS [READER...]]]: libFuzzer on every reader (or those named), in turns of SECONDS (30), until INPUTS
# (10000000) have been tried in all. After each round it prints a table: inputs, inputs a second, edges covered, inputs that
# ended the reader (kept in ./crashes). Each round goes on from the inputs that the last ones found.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${GNATHOS_BUILD:-$root/build}-sanitized
most=${1:-10000000} seconds=${2:-30}
[ $# -lt 1 ] || shift
[ $# -lt 1 ] || shift
[ $# -gt 0 ] || set -- $(ls "$root/tests/fuzz/corpus")
sh "$root/tests/net/sanitized.sh" "$root" "$build" fuzz_readers
work=$(mktemp -d -p /dev/shm 2>/dev/null || mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
export FUZZ_KEEP="$work/found" FUZZ_SEED=1 FUZZ_TIMEOUT=60
: >"$work/turns" # reader inputs seconds edges ended
ended=0
while [ "$(awk '{n += $2} END {print n + 0}' "$work/turns")" -lt "$most" ]; do
    for reader; do
        begin=$(date +%s.%N) wrong=0
        sh "$root/tests/net/fuzz.sh" "$build/tests/fuzz/fuzz_readers" "$root/tests/fuzz/corpus" "$seconds" -1 "$reader" \
            >"$work/log" || wrong=1
        [ $wrong -eq 0 ] || { cat "$work/log"; ended=1; }
        awk -v r="$reader" -v wrong=$wrong -v begin="$begin" -v end="$(date +%s.%N)" \
            '$1 == r {print r, $2 + 0, end - begin, $3 + 0, wrong}' "$work/log" >>"$work/turns"
    done
    echo "round $FUZZ_SEED"
    awk 'BEGIN {printf "%-10s %10s %10s %8s %8s\n", "reader", "inputs", "a second", "edges", "ended"}
        !($1 in n) {order[++count] = $1}
        {n[$1] += $2; s[$1] += $3; if ($4 > edges[$1]) edges[$1] = $4; bad[$1] += $5; all += $2; time += $3; ends += $5}
        END {for (i = 1; i <= count; i++) {r = order[i]; printf "%-10s %10d %10d %8d %8d\n", r, n[r], n[r] / s[r], edges[r], bad[r]}
            printf "%-10s %10d %10d %8s %8d\n", "all", all, all / time, "", ends}' "$work/turns"
    FUZZ_SEED=$((FUZZ_SEED + 1))
done
exit $ended
