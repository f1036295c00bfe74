#!/bin/sh
# evidence.sh [--large] GNATHOS WORK [CASE...]: measures what gnathos claims and writes tests/EVIDENCE.md, with its plots in
# tests/evidence/: the stress suite, the physics tests, CalculiX on the same meshes, and study and ratios of each case.
# GNATHOS is the program in its build folder (build/app/gnathos): tests and CalculiX need the folder. WORK keeps what is
# done, so that the same command goes on where it was stopped; a new WORK starts anew. Without cases: the synthetic class
# III head, made there, and the phantom head where its data lie beside the project. --large: CalculiX at 34 thousand nodes
# too (minutes, and 2 GB).
set -eu
sizes="5 7"
[ "${1:-}" != --large ] || { sizes="5 7 10"; shift; }
[ $# -ge 2 ] || { echo "usage: evidence.sh [--large] GNATHOS WORK [CASE...]" >&2; exit 2; }
gnathos=$(realpath "$1") build=$(dirname "$(dirname "$(realpath "$1")")")
mkdir -p "$2"
work=$(realpath "$2") here=$(cd "$(dirname "$0")" && pwd)
shift 2
if [ $# -eq 0 ]; then
    if [ ! -d "$work/class3" ]; then # the folder names the case
        mkdir -p "$work/part"
        "$gnathos" new "$work/part/class3" --norm --class 3 -q
        cp "$here/../cases/class3/plan.json" "$work/part/class3"
        mv "$work/part/class3" "$work/class3"
        rmdir "$work/part"
    fi
    set -- "$work/class3"
    data=${GNATHOS_DATA:-$here/../../shared/data}/phantom_head_ct
    if [ -d "$data" ]; then
        if [ ! -d "$work/phantom" ]; then
            "$gnathos" import --skin "$data/skin.ply" --skull "$data/skull.ply" --mandible "$data/mandible.ply" \
                --landmarks "$data/landmarks.mrk.json" --name phantom -o "$work/phantom.part" -q
            cp "$here/cli/plans/mandible_advance.json" "$work/phantom.part/plan.json"
            mv "$work/phantom.part" "$work/phantom"
        fi
        set -- "$@" "$work/phantom"
    fi
fi

# ---- the runs ----
# note_time NAME COMMAND...: runs it and keeps its wall time for the page
note_time() {
    what=$1
    shift
    begin=$(date +%s)
    "$@" || return 1
    echo "$(($(date +%s) - begin))" >"$work/$what.seconds"
}
run_stress() { "$gnathos" stress -o "$work/stress" --progress=plain >/dev/null || [ -f "$work/stress/stress.md" ]; }
run_physics() {
    status=0
    (cd "$build" && ctest -L physics -V) >"$work/physics.part" 2>&1 || status=$?
    echo "status $status" >>"$work/physics.part"
    mv "$work/physics.part" "$work/physics.log"
}
run_calculix() { # cells
    mkdir -p "$work/calculix_$1"
    "$build/tests/bench/bench_calculix" "$work/calculix_$1" "$1" >"$work/calculix_$1.part" && mv "$work/calculix_$1.part" "$work/calculix_$1.csv"
}
run_seeds() {
    sh "$here/nightly/seeds.sh" 200 "$work/seeds.csv" >"$work/seeds.part" || [ -s "$work/seeds.part" ] || return 1
    mv "$work/seeds.part" "$work/seeds.txt"
}
run_study() { # case folder, study folder
    plan=$1/plan.json
    [ -f "$plan" ] || plan=$here/cli/plans/mandible_advance.json
    "$gnathos" study "$1" --plan "$plan" -o "$2" --progress=plain >/dev/null
}
run_ratios() { "$gnathos" study "$1" --ratios -o "$2" --progress=plain >/dev/null; }

[ -f "$work/stress/stress.md" ] || note_time stress run_stress
if [ -d "$work/class3" ] && [ ! -f "$work/planted.md" ]; then
    /usr/bin/python3 -B "$here/planted/run.py" "$gnathos" "$work/class3" "${data:-}" >"$work/planted.part"
    mv "$work/planted.part" "$work/planted.md"
fi
if [ -f "$build/CMakeCache.txt" ]; then
    [ -f "$work/physics.log" ] || run_physics
    [ -f "$work/seeds.txt" ] || run_seeds
    if command -v ccx >/dev/null; then
        cmake --build "$build" --target bench_calculix >/dev/null
        for cells in $sizes; do
            [ -f "$work/calculix_$cells.csv" ] || run_calculix "$cells"
        done
    fi
fi
for folder; do
    name=$(basename "$folder")
    [ -f "$work/$name.study/study.md" ] || note_time "$name.study" run_study "$folder" "$work/$name.study"
    [ -f "$work/$name.study/ratios.md" ] || note_time "$name.ratios" run_ratios "$folder" "$work/$name.study"
done

# ---- the page ----
took() { [ ! -f "$work/$1.seconds" ] || awk '{ printf " It took %.1f minutes.", $1 / 60 }' "$work/$1.seconds"; }
body() { sed '1d;s/^#/##/' "$1"; } # without the title, headings one level down
outside() { # ratios.md: what lies outside, one a line
    awk -F'|' '/OUTSIDE/ { for (k = 2; k <= 8; k++) gsub(/^ +| +$/, "", $k)
        sub(/^OUTSIDE,? ?/, "", $8)
        sub(/^: /, "", $8)
        printf "  * %s, %s: **%s**; published %s, window %s%s\n", $2, $3, $4, $7, $6, $8 == "" ? "" : " (" $8 ")" }' "$1"
}
verification() {
    if [ ! -f "$work/physics.log" ]; then
        echo "Not run: there is no build folder around the program."
        return
    fi
    grep -q '^status 0$' "$work/physics.log" || printf '**A physics test failed in this run.**\n\n'
    echo "| what is compared with what is known | off by, or order | unit |"
    echo "|---|---|---|"
    sed -n 's/^[0-9]*: evidence: //p' "$work/physics.log" |
        awk '{ unit = $NF == "-" ? "" : $NF; value = $(NF - 1); NF -= 2; print "| " $0 " | " value " | " unit " |" }'
}
failures() {
    if grep -q '^status 0$' "$work/physics.log"; then echo "all within what the tests allow"; else echo "**a physics test failed**"; fi
}
depth_table() {
    echo "| head | plan | share | ended | deep, mm | area, mm2 | nodes through bone | least J | tets inside out | iterations / factors | CPU s |"
    echo "|---|---|---|---|---|---|---|---|---|---|---|"
    awk -F, '$1 != "case" { printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s / %s | %s |\n", $1, $2, $3, $4, $5, $6, $8, $9, $10, $11, $12, $13
        rows++; bad += $17 != "ok" } END { printf "\n%d of %d rows are as they should be.\n", rows - bad, rows }' "$1"
}
calculix_short() {
    ls "$work"/calculix_*.csv >/dev/null 2>&1 || return 0
    awk -F, '$8 == "solved" { if (!n++ || $13 < low) low = $13; if ($13 > high) high = $13; if ($14 > off) off = $14; if ($1 > most) most = $1 }
        END { if (n) printf "* **Beside CalculiX.** The same displacements to %g mm, %g to %g times faster by processor time, on meshes of up to %d nodes.\n", off, low, high, most }' "$work"/calculix_*.csv
}
calculix() {
    ls "$work"/calculix_*.csv >/dev/null 2>&1 || { echo "Not run: it needs the program ccx (Debian: calculix-ccx) and the build folder."; return; }
    echo "| nodes | Poisson | gnathos: iterations, CPU s | CalculiX: iterations, CPU s | CalculiX takes so many times the CPU | wall | largest difference of a node, mm |"
    echo "|---|---|---|---|---|---|---|"
    for cells in 5 7 10; do
        [ ! -f "$work/calculix_$cells.csv" ] || awk -F, 'NR > 1 {
            if ($8 == "solved") printf "| %s | %s | %s, %s | %s, %s | %s | %s | %s |\n", $1, $2, $5, $7, $9, $11, $13, $12, $14
            else printf "| %s | %s | %s, %s | stopped | | | |\n", $1, $2, $5, $7 }' "$work/calculix_$cells.csv"
    done
}

faults() { # what the nightly scripts printed, left in WORK as kills.txt, full_disk.txt, memory.txt and same_bits.txt
    ls "$work/kills.txt" "$work/full_disk.txt" "$work/memory.txt" "$work/same_bits.txt" 2>/dev/null | grep -q . || return 0
    cat <<'END'

## Faults and same bits

`sh tests/nightly/kills.sh` kills runs at random moments, a third of them while they write: afterwards the earlier result is
there whole, or the new one, and the next run leaves nothing else. `full_disk.sh` gives output, cache and TMPDIR together a
disk of so many kB: *done*, or *told* by a line that names the file, with the earlier result whole and nothing new left.
`memory.sh` lets every 50th allocation of a command fail in turn: *right* is status 7, a line that says so, and no half result;
some allocations are not always reached. `same_bits.sh` compares every file of new, cut, prepare and predict over 1, 2, 3 and 8
threads.
END
    for name in kills full_disk memory same_bits; do
        [ -f "$work/$name.txt" ] || continue
        printf '\n```\n'
        cat "$work/$name.txt"
        echo '```'
    done
}

mkdir -p "$here/evidence"
page=$work/EVIDENCE.md
{
    echo "# Evidence"
    echo
    echo "**What to trust.** A prediction of gnathos answers a well-posed question, how a body of elastic tissue settles when bones"
    echo "move, and that answer is exact to far below anything visible: it is checked here against closed forms, other programs"
    echo "and stiff and extreme cases. Its mesh adds a few tenths of a millimetre, measured below. Whether the question is the"
    echo "right one, whether a face behaves like that body, is **not** shown here: it is only compared with published averages,"
    echo "and where it lies outside of them is listed first. Trust the chin under a moved jaw most; lips, nose and the chin that a"
    echo "genioplasty shortens least."
    echo
    echo "Made by \`sh tests/evidence.sh build/app/gnathos WORK\` on $(date -u +%Y-%m-%d), version $("$gnathos" --version | cut -d' ' -f2), on $(nproc) cores"
    echo "($(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1)). Counts and errors do not depend on the machine; times do, and other work on"
    echo "it makes them upper bounds. Words: *tets* are the tetrahedra that the tissue is divided into; *soft : hard* is how far a"
    echo "point of the skin goes for each mm of the bone or tooth behind it. Heads: *class3* is a synthetic one of skeletal class III,"
    echo "made from published norms; *phantom* the CT of an anthropomorphic phantom (CTHeadDeformation, Image-X Institute), an adult"
    echo "head with closed lips, coarse teeth and an overjet."
    echo
    echo "## In short"
    echo
    for folder; do
        name=$(basename "$folder") study=$work/$(basename "$folder").study
        echo "* **$name**, error of the mesh. $(sed -n 's/^\(The case.s own mesh is .*\)/\1/p' "$study/study.md")"
        echo "* **$name**, beside published moves. Of $(sed -n 's/^\(.*\) measures known, \(.*\) outside their window\./\1 measures, \2 lie outside the published window:/p' "$study/ratios.md")"
        outside "$study/ratios.md"
    done
    if [ -f "$work/physics.log" ]; then
        echo "* **Verification.** $(grep -c '^[0-9]*: evidence: ' "$work/physics.log") comparisons with what is known exactly or by other programs; $(failures)."
    fi
    calculix_short
    echo "* **Stiff and extreme cases.** $(grep ' cases, .* not as expected' "$work/stress/stress.md")."
    cat <<'END'

Not known:

* How far a prediction is from the face of a patient after surgery: no pair of scans before and after is at hand. Published
  ranges are of averages over patients; a head outside of one may still be right, and one inside may be wrong.
* Soft tissue is reported to follow a Le Fort I setback about twice as far once it goes beyond 4 mm; this is not tried here.
* The material is one for skin, fat and muscle. Since bones drive the tissue, only ratios of stiffness count; how much layers
  would change is not known.
* Scan, segmentation and landmarks have errors of their own; a study starts from the surfaces.
* The reference of a study is a mesh too. Its own error is estimated by Richardson's extrapolation, which holds where the
  observed order is steady; near edges of attachment and along cuts it need not be.
* Contact is compared with sliding constraints and with plain bodies, not with an exact answer on a head.

## Verification

Against what is known exactly, or what other programs give. Each line is printed by a test in `tests/physics`, which fails where
it is off by more than it allows.

END
    verification
    cat <<'END'

## Beside CalculiX

A curved slab like a face (`tests/bench/calculix.c`): the same mesh, energy and boundary for both, from nothing, on one thread. The
displacements are compared node by node; gnathos is driven to 1e-10 of the first force for this, so that the difference is
CalculiX's tolerance and the six digits that it prints.

END
    calculix
    if [ -f "$work/contact_table.md" ]; then # of bench/contact_table.sh
        cat <<'END'

## What contact costs

`sh tests/bench/contact_table.sh -o BENCH_HEAD`, with `GNATHOS_DATA` naming the folder of the scans: ratios of processor time on
one thread, each from one run, beside their goals. *L* is one linear solve of the same tissue, the least of three.

END
        cat "$work/contact_table.md"
    fi
    if [ -f "$work/contact_depth.csv" ]; then # of nightly/contact_depth.sh
        cat <<'END'

## Tissue in bone

`sh tests/nightly/contact_depth.sh`: fourteen plans on three heads, with contact. *Share*: how much of a harder plan no limit stops.
*Deep*: farther in bone or tooth than at rest, by exact distances at the nodes of the tissue's surface; at most 0.1 mm counts
as none.

END
        depth_table "$work/contact_depth.csv"
    fi
    for folder; do
        name=$(basename "$folder")
        study=$work/$name.study
        echo
        sed -n '1s/^#/##/p' "$study/study.md"
        echo
        for plot in time size; do
            cp "$study/error_$plot.png" "$here/evidence/${name}_$plot.png"
            echo "![Error over $plot, $name](evidence/${name}_$plot.png)"
        done
        body "$study/study.md"
        echo
        echo "\`gnathos study\`.$(took "$name.study")"
        echo
        sed -n '1s/^#/##/p' "$study/ratios.md"
        body "$study/ratios.md"
        echo
        echo "\`gnathos study --ratios\`.$(took "$name.ratios")"
    done
    if [ -f "$work/seeds.txt" ]; then
        cat <<'END'

## Synthetic heads of many seeds

`sh tests/nightly/seeds.sh`: teeth and mandible as `gnathos new` makes them, and the sagittal split. *Laid anew*: splits that came
out of the lateral plate and were moved inwards. *Distal pierced*: handles that the split made there. *Bite fits*: overjet and
overbite within two standard deviations of the class, a contact behind the canine on either side, no tooth 0.1 mm in another.
*Cant*: of the line through the first molars; at most 0.5 degrees.

END
        echo '```'
        cat "$work/seeds.txt"
        echo '```'
    fi
    if [ -f "$work/fuzz.txt" ]; then # the last table of nightly/fuzz.sh, which takes a night
        cat <<'END'

## Any bytes at all

`sh tests/nightly/fuzz.sh` feeds every reader, in turns, what libFuzzer makes of its corpus, under the address and
undefined-behaviour sanitizers, until ten million inputs have been tried. HDF5 is asked in a process of its own for each input;
STL and OBJ are assimp's, which is slow.

END
        echo '```'
        cat "$work/fuzz.txt"
        echo '```'
    fi
    faults
    cat <<END

## Stiff and extreme cases

\`gnathos stress\`.$(took stress) Each case has its right kind of outcome: solved, refused with a reason, or given up with one.
What is called solved is checked from the returned positions alone: forces, volumes, places. *Newton step* is how far the
farthest node would still go in one more step, the error that is left (not taken with contact and averaged volumes). *Inverted*
tets are turned inside out: the material allows it, a body does not, so they are counted. *Not a minimum* means that forces
balance but the tissue would rather buckle. *Known limit* is what the solver does not do yet, with its reason below the table.
Many iterations are no error: a plate 1e8 times stiffer than what it lies in (layers/1e8) turns by small steps only. Times are
processor time.

END
    cat "$work/stress/stress.md"
    if [ -f "$work/planted.md" ]; then
        cat <<'END'

## Planted mistakes

`tests/planted/run.py`: each mistake is made in a copy of the class III head, or of the phantom where its name says so, and the
program is run on it. *Caught*: it says so in one line that names the place, with the exit status that it should have.
*Harmless*: nothing has to be said, for the reason given. What the checks resolve: landmarks that lie on their surface
to 0.3 mm tell a surface that was moved by 1.5 mm, scaled by 1 % or turned by 1.5 degrees against them. Where the landmarks
went along, only norms are left: bones scaled by 5 % or moved by 4 mm below an unchanged skin show in the depth of soft
tissue; 2 % or 2 mm are within what people differ by, and are not told. A landmark that slid along its surface is told from
14 mm on the cranium, 20 mm on the mandible and 26 mm on the skin.
END
        cat "$work/planted.md"
    fi
} >"$page"
mv "$page" "$here/EVIDENCE.md"
echo "tests/EVIDENCE.md written"
