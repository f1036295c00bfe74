#!/bin/sh
# fuzz.sh FUZZ_READERS CORPUS SECONDS RUNS [READER...]: libFuzzer on each reader, at most SECONDS and RUNS inputs each,
# beginning with CORPUS/READER. Prints a line per reader: inputs tried, covered edges, end. The inputs that end a reader
# are kept in the folder `crashes` of the current folder, the inputs that reach something new in FUZZ_KEEP/READER where
# that is set. FUZZ_SEED begins the dice (1), FUZZ_TIMEOUT is the most seconds for one input (10). What outside libraries
# leak is not ours. Leaks are looked for at the end of a turn: after each input that would take most of the time.
set -u
here=$(cd "$(dirname "$0")" && pwd)
fuzz=$1 corpus=$2 seconds=$3 runs=$4
shift 4
[ $# -gt 0 ] || set -- $(ls "$corpus")
mkdir -p crashes
work=$(mktemp -d -p /dev/shm 2>/dev/null || mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
export TMPDIR="$work" ASAN_OPTIONS=detect_leaks=1:allocator_may_return_null=1:max_allocation_size_mb=1024
export LSAN_OPTIONS="suppressions=$here/leaks.txt:print_suppressions=0"
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
failed=0
printf '%-10s %10s %8s  %s\n' reader inputs edges end
for reader; do
    new=${FUZZ_KEEP:-$work/new}/$reader length=4096
    [ "$reader" != h5 ] || length=16384 # ITK writes no smaller ones
    mkdir -p "$new"
    "$fuzz" --reader="$reader" -max_total_time="$seconds" -runs="$runs" -seed="${FUZZ_SEED:-1}" -max_len="$length" -timeout="${FUZZ_TIMEOUT:-10}" \
        -rss_limit_mb=2048 -detect_leaks=0 -print_final_stats=1 -verbosity=1 -artifact_prefix="crashes/$reader-" \
        "$new" "$corpus/$reader" >"$work/log" 2>&1
    status=$?
    end=held
    [ $status -eq 0 ] || { end="status $status"; failed=1; }
    printf '%-10s %10s %8s  %s\n' "$reader" "$(sed -n 's/^stat::number_of_executed_units: *//p' "$work/log")" \
        "$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$work/log" | tail -1)" "$end"
    [ $status -eq 0 ] || grep -E 'ERROR|SUMMARY|Assertion|runtime error|^    #[0-9]+ ' "$work/log" | head -12
    rm -rf "$work/new"
done
rmdir crashes 2>/dev/null
exit $failed
