#!/bin/sh
# full_disk.sh CASE OUTCOME: a disk of 0, 64, 512 and 2048 kB for output, cache and TMPDIR (a tmpfs; needs root, or user
# namespaces). Right is: done, or status 7 and a line that names the file and says that no space is left; the earlier
# result whole, and no new one, no hidden file and no empty folder. CASE is prepared already; OUTCOME is one of predict.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
gnathos=${GNATHOS_BUILD:-$root/build}/app/gnathos
if [ -z "${GNATHOS_MOUNTS:-}" ]; then
    [ "$(id -u)" -eq 0 ] || map=-r
    GNATHOS_MOUNTS=own exec unshare ${map:-} -m --propagation private sh "$0" "$(realpath "$1")" "$(realpath "$2")"
fi
case=$1 outcome=$2 failed=0
work=$(mktemp -d)
trap 'umount "$work/disk" 2>/dev/null || true; rm -rf "$work"' EXIT
mkdir "$work/disk"
cd "$work"
printf '{ "gnathos": 1, "maxilla_advance_mm": 2 }\n' >plan.json
[ -f "$outcome/outcome.json" ] || { echo "$outcome is no outcome"; exit 2; }
wrong() { echo "FAIL: $*"; failed=1; }
on_disk() { # KB ARGUMENT...: NEW in them is a name on the disk
    mount -t tmpfs -o "size=${1}k" none disk
    if [ "$1" -eq 0 ]; then umount disk; mount -t tmpfs -o nr_blocks=1 none disk; fi
    kb=$1
    shift
    mkdir disk/earlier
    echo earlier >disk/earlier/one || true
    [ "$kb" -ne 0 ] || head -c 65536 /dev/zero >disk/fill 2>/dev/null || true
    before=$(cd disk && find . | sort)
    status=0
    # shellcheck disable=SC2046
    TMPDIR=$work/disk "$gnathos" $(echo "$*" | sed "s#NEW#$work/disk/new#g") >/dev/null 2>said </dev/null || status=$?
    after=$(cd disk && find . | sort)
    case $status in
    0) end="done" ;;
    7) end="told"
        tail -1 said | grep -q "^gnathos: $work/disk/new.*: cannot be written: No space left" || wrong "$1 in $kb kB says: $(tail -1 said)"
        [ "$before" = "$after" ] || wrong "$1 in $kb kB leaves: $after" ;;
    *) end="status $status"; wrong "$1 in $kb kB ends with $status: $(tail -1 said)" ;;
    esac
    printf '%-34s %5s kB: %s\n' "$(echo "$*" | cut -d ' ' -f 1,4- | cut -c 1-34)" "$kb" "$end"
    umount disk
}
for kb in 0 64 512 2048; do
    on_disk $kb predict "$case" --plan plan.json --no-pictures --contact off -o NEW
    on_disk $kb audit "$case" --line maxilla_advance_mm --geometry-only --no-pictures -o NEW
    on_disk $kb cut "$case" -o NEW
    on_disk $kb render "$outcome" --show skin --size 640x400 -o NEW
    on_disk $kb export "$outcome" --format stl -o NEW
    on_disk $kb report "$outcome" -o NEW.html
done
for kb in 0 2048; do on_disk $kb prepare "$case" --cache NEW; done
[ $failed -eq 0 ] && echo "a full disk is told"
exit $failed
