#!/bin/sh
# evidence.sh GNATHOS WORK [CASE...]: runs the stress suite, and study and ratios of each case, and writes tests/EVIDENCE.md
# with its plots in tests/evidence/. WORK keeps the runs: the same command goes on where it was stopped,
# and a new WORK starts anew. Without cases: the
# synthetic class III head, made there, and the phantom head where its data lie beside the project.
set -eu
[ $# -ge 2 ] || { echo "usage: evidence.sh GNATHOS WORK [CASE...]" >&2; exit 2; }
gnathos=$(realpath "$1")
mkdir -p "$2"
work=$(realpath "$2") here=$(cd "$(dirname "$0")" && pwd)
shift 2
if [ $# -eq 0 ]; then
    [ -d "$work/class3" ] || { "$gnathos" new "$work/class3.part" --norm --class 3 -q && cp "$here/../cases/class3/plan.json" "$work/class3.part" &&
        mv "$work/class3.part" "$work/class3"; }
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

[ -f "$work/stress/stress.md" ] || "$gnathos" stress -o "$work/stress" --progress=plain >/dev/null || [ -f "$work/stress/stress.md" ]
for folder; do
    name=$(basename "$folder")
    plan=
    [ -f "$folder/plan.json" ] || plan="--plan $here/cli/plans/mandible_advance.json"
    # shellcheck disable=SC2086
    [ -f "$work/$name.study/study.md" ] || "$gnathos" study "$folder" $plan -o "$work/$name.study" --progress=plain >/dev/null
    [ -f "$work/$name.study/ratios.md" ] || "$gnathos" study "$folder" --ratios -o "$work/$name.study" --progress=plain >/dev/null
done

mkdir -p "$here/evidence"
page=$work/EVIDENCE.md
section() { sed 's/^#/##/' "$1"; } # headings one level down
{
    echo "# Evidence"
    echo
    echo "Made by \`sh tests/evidence.sh GNATHOS WORK\` on $(date -u +%Y-%m-%d), version $("$gnathos" --version | cut -d' ' -f2), on $(nproc) cores"
    echo "($(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1)), which other work shared: times are upper bounds, counts and errors are not touched by that."
    echo
    echo "What is known, in short:"
    echo
    for folder; do
        study=$work/$(basename "$folder").study
        echo "* $(basename "$folder"): $(sed -n 's/^\(The case.s own mesh is .*\)/\1/p' "$study/study.md")"
        sed -n 's/^\(.*\) ratios known, \(.*\) outside their window\./  Of \1 soft : hard ratios known, \2 lie outside the published window./p' "$study/ratios.md"
        awk -F'|' '/OUTSIDE/ { gsub(/^ +| +$/, "", $2); gsub(/^ +| +$/, "", $3); gsub(/ /, "", $5); gsub(/^ +| +$/, "", $7);
            printf "  * %s, %s: %s, published window %s%s\n", $2, $3, $5, $7, /within the bar/ ? " (within the numerical bar)" : "" }' "$study/ratios.md"
    done
    echo "* Stress: $(grep ' cases, .* not as expected' "$work/stress/stress.md")"
    echo
    cat <<'END'
What is not known:

* How far a prediction is from the face of a patient after surgery: no pair of scans before and after is at hand. The windows of
  ratios are means over patients; one head outside of one may still be right, and one inside may be wrong.
* Whether the material matters in a face as it does here: bones drive the tissue, so only ratios of stiffness count; skin, fat and
  muscle are one material.
* The error of the surface between scan and mesh, of the segmentation and of the landmarks: a study starts from the surfaces.
* The reference of a study is itself a mesh. Its own error is estimated by Richardson's extrapolation, which holds where the
  observed order is steady; near the edges of attachment and along cuts it need not be.
* Contact is compared with the case's own scene, not with an exact answer.
END
    for folder; do
        name=$(basename "$folder")
        study=$work/$name.study
        echo
        section "$study/study.md"
        echo
        for plot in time size; do
            cp "$study/error_$plot.png" "$here/evidence/${name}_$plot.png"
            echo "![Error over $plot, $name](evidence/${name}_$plot.png)"
        done
        echo
        section "$study/ratios.md"
    done
    echo
    echo "## Stiff and extreme cases"
    echo
    echo "\`gnathos stress\`: each case has its right kind of outcome; what is called solved is checked from the returned positions (forces,"
    echo "volumes, places, and how far one more Newton step would go). Times are processor time."
    echo
    cat "$work/stress/stress.md"
} >"$page"
mv "$page" "$here/EVIDENCE.md"
echo "tests/EVIDENCE.md written"
