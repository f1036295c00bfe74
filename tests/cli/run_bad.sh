#!/bin/sh
# run_bad.sh GNATHOS FOLDER [NAMES [--accept]]: every folder of FOLDER/bad (whose name matches NAMES) is laid over a copy of
# FOLDER/base and `command` is run there. Each must end with the exit status in the first line of `expected`, print
# exactly the rest of it on stderr, nothing on stdout, and leave every file as it was. --accept writes what was printed
# into `expected`, to be reviewed: tests/cli/run_bad.sh build/app/gnathos tests/cli "mesh_*" --accept
set -u
gnathos=$(realpath "$1") here=$(cd "$2" && pwd) names=${3:-*} accept=${4:-}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
passed=0 failed=0
for bad in "$here"/bad/$names/; do
    name=$(basename "$bad")
    rm -rf "$work/case"
    cp -R "$here/base" "$work/case"
    cp -R "$bad/." "$work/case"
    rm -f "$work/case/command" "$work/case/expected"
    before=$(cd "$work" && find case -type f -exec cksum {} + | sort)
    line=$(cat "$bad/command") || exit 1
    (cd "$work/case" && eval "exec \"$gnathos\" $line") >"$work/stdout" 2>"$work/stderr" </dev/null
    status=$?
    { echo $status; cat "$work/stderr"; } >"$work/got"
    [ "$accept" = --accept ] && cp "$work/got" "$bad/expected"
    why=
    cmp -s "$work/got" "$bad/expected" || why="exit status or message"
    [ -s "$work/stdout" ] && why="$why; something on stdout"
    [ $status -eq 0 ] && why="$why; accepted"
    [ "$before" = "$(cd "$work" && find case -type f -exec cksum {} + | sort)" ] || why="$why; files changed"
    if [ -z "$why" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "$name: wrong: $why"
        diff "$bad/expected" "$work/got"
    fi
done
echo "$passed refusals as expected, $failed not"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
