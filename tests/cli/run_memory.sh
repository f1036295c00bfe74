#!/bin/sh
# run_memory.sh GNATHOS INJECTOR CLI STEP MOST [OUTCOME]: check, import (of meshes and of labels) and, with an OUTCOME,
# render, each again and again, with every STEP-th of its allocations failing in turn, or with MOST of them, evenly, where
# that would be more. Right is: exit status 7, a last line that says "out of memory" and at which step, and on the disk
# nothing but what was whole by then. Prints a table of how they ended.
set -u
gnathos=$(realpath "$1") injector=$(realpath "$2") base=$(realpath "$3")/base step=$4 most=$5 outcome=${6:+$(realpath "$6")} failed=0
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
cp -R "$base" base

run() { # PLACE ARGUMENT...
    place=$1
    shift
    rm -rf made
    timeout -s KILL 120 env LD_PRELOAD="$injector" GNATHOS_FAIL_AT="$place" GNATHOS_COUNT_TO=count \
        "$gnathos" "$@" >stdout 2>stderr </dev/null
}
how() { # what became of the last run, in two words
    if [ "$1" -eq 0 ] && [ "$(cat count)" -lt "$place" ]; then echo "not reached" # the number varies by a few
    elif [ "$1" -eq 137 ]; then echo "hangs"
    elif [ "$1" -gt 128 ]; then echo "crashes"
    elif [ "$1" -ne 7 ]; then echo "status $1"
    elif ! tail -1 stderr | grep -q '^gnathos: [^:]*: out of memory ([0-9]* bytes'; then echo "says otherwise: $(tail -1 stderr)"
    elif find . -name '*.part' | grep -q .; then echo "leaves a hidden file or folder"
    elif [ -d made ] && diff -r made whole | grep -v '^Only in whole'; then echo "leaves half a result"
    elif [ -s stdout ]; then echo "prints half a result"
    else echo "right"; fi
}
series() { # NAME ARGUMENT...
    name=$1
    shift
    run 0 "$@" || { echo "FAIL: $name ends with $? undisturbed"; cat stderr; failed=1; return; }
    rm -rf whole
    [ ! -d made ] || mv made whole
    all=$(cat count) by=$step
    [ $((all / by)) -le "$most" ] || by=$((all / most))
    place=1
    while [ "$place" -le "$all" ]; do
        run "$place" "$@"
        how $? >>ends
        place=$((place + by))
    done
    echo "$name: $all allocations, each $by-th failed once, $(wc -l <ends) runs:"
    sort ends | uniq -c
    grep -qvxE "right|not reached" ends && failed=1
    rm ends
}

series check check base
series import import --skin base/skin.off --skull base/skull.off --mandible base/mandible.off \
    --landmarks base/landmarks.mrk.json -o made
if [ -n "$outcome" ]; then
    /usr/bin/python3 - <<'PY'
n, mm, balls = 25, 5, ((0, 0, 0, 48, 9), (0, 0, 15, 20, 1), (0, -5, -23, 13, 2))
def label(x, y, z):
    return max(((i, l) for i, (a, b, c, r, l) in enumerate(balls) if (x - a)**2 + (y - b)**2 + (z - c)**2 < r * r), default=(0, 0))[1]
at = [mm * (i - (n - 1) / 2) for i in range(n)]
with open("head.nrrd", "wb") as f:
    f.write(f"NRRD0004\ntype: uchar\ndimension: 3\nsizes: {n} {n} {n}\nencoding: raw\nspace: left-posterior-superior\n"
            f"space directions: ({mm},0,0) (0,{mm},0) (0,0,{mm})\nspace origin: ({at[0]},{at[0]},{at[0]})\n\n".encode())
    f.write(bytes(label(x, y, z) for z in at for y in at for x in at))
PY
    series "import of labels" import --labels head.nrrd --skull 1 --mandible 2 --skin 9 --edge 8 -o made
    series render render "$outcome" --show bones --show contour --show tracing --size 320x200 -o made
fi
[ $failed -eq 0 ] && echo "all end as they should"
exit $failed
