#!/bin/sh
# run_faults.sh GNATHOS: what happens when a run is stopped, killed, doubled, or its output cannot be written.
set -u
gnathos=$(realpath "$1") failed=0
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
wrong() { echo "FAIL: $*"; failed=1; }
left() { ls -A | grep -c '^\.[^.].*\.part$'; }

"$gnathos" new head --norm --class 3 -q >new.out || exit 1
started() { # ARGUMENT...: runs in the background until its own hidden folder is there
    "$gnathos" "$@" >started.out 2>started.err &
    run=$!
    for _ in $(seq 200); do
        ls -A | grep -q "^\.[^.].*\.$run\.part\$" && return
        sleep 0.05
    done
    wrong "gnathos $* makes no hidden folder"
}

# killed: what it leaves is removed by the next run, which is then stopped
started cut head -o bones
kill -9 $run
wait $run 2>/dev/null
[ "$(left)" -eq 1 ] || wrong "kill -9 left $(left) hidden folders, 1 was expected"
started cut head -o bones
[ "$(left)" -eq 1 ] || wrong "the next run did not remove what the killed one left"

# two into one
"$gnathos" cut head -o bones >two.out 2>two.err
status=$?
[ $status -eq 7 ] || wrong "a second run into the same folder ends with $status"
grep -q "another gnathos (process $run) is writing it" two.err || wrong "it says: $(cat two.err)"

# SIGTERM, in the midst of the cuts
sleep 1
begin=$(date +%s)
kill -TERM $run
wait $run
status=$?
[ $status -eq 130 ] || wrong "SIGTERM ends with status $status"
[ $(($(date +%s) - begin)) -le 4 ] || wrong "SIGTERM was answered after $(($(date +%s) - begin)) s"
grep -q interrupted started.err || wrong "it says: $(cat started.err)"
[ "$(left)" -eq 0 ] || wrong "SIGTERM left a hidden folder"
[ ! -e bones ] || wrong "SIGTERM left half a result"

# a disk that is full
if [ -c /dev/full ]; then
    for words in --version "help landmarks" "check head --json"; do
        # shellcheck disable=SC2086
        "$gnathos" $words >/dev/full 2>full.err
        status=$?
        [ $status -eq 7 ] || wrong "gnathos $words on a full disk ends with $status"
        grep -q 'could not be written' full.err || wrong "it says: $(cat full.err)"
    done
fi
[ $failed -eq 0 ] && echo "all faults end as they should"
exit $failed
