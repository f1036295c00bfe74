#!/bin/sh
# run_full.sh GNATHOS CLI: what cannot be written (files may have no bytes here, as on a full disk) is told with its path,
# the earlier result stays whole, and nothing half done is left.
set -u
gnathos=$(realpath "$1") base=$(realpath "$2")/base failed=0
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
wrong() { echo "FAIL: $*"; failed=1; }
full() { # PATH ARGUMENT...: the program cannot write PATH
    path=$1
    shift
    (trap '' XFSZ && ulimit -f 0 && exec "$gnathos" "$@" 2>&1 >/dev/null </dev/null) | cat >said
    grep -qx "gnathos: $path: cannot be written: File too large" said || wrong "gnathos $* says: $(cat said)"
    [ -z "$(find . -name '*.part')" ] || wrong "gnathos $* leaves $(find . -name '*.part')"
}
status() { # the last one, without a pipe to hide it
    (trap '' XFSZ && ulimit -f 0 && exec "$gnathos" "$@" >/dev/null 2>&1)
    code=$?
    [ $code -eq 7 ] || wrong "gnathos $* ends with $code"
}
"$gnathos" stress --only poisson/0.45 -o old -q >/dev/null || exit 1
cp -R old kept
for command in "old/stress.md stress --only poisson/0.47 -o old --force" \
    "new/skin.ply import --skin $base/skin.off --skull $base/skull.off --mandible $base/mandible.off --landmarks $base/landmarks.mrk.json -o new"; do
    # shellcheck disable=SC2086
    full $command
    # shellcheck disable=SC2086
    status ${command#* }
done
diff -r old kept || wrong "the earlier result is another"
[ ! -e new ] || wrong "half a case is left"
[ $failed -eq 0 ] && echo "a full disk is told"
exit $failed
