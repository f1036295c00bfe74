#!/bin/sh
# plastimatch reads a landmark list of 3D Slicer that says that it is LPS as RAS: the face is turned by half a turn.
#
# A .fcsv has a header line "CoordinateSystem", which Slicer documents as LPS or RAS, in earlier versions 1 or 0; newer
# ones write LPS. plastimatch 1.9.4 (1.9.4+dfsg.2-0+deb12u1 of Debian 12), which reads these lists, does not look at
# that line and takes every list as RAS, silently.
# Four landmarks were given to `plastimatch lm-warp` (thin plate splines) as fixed and moving points:
#   the same points, RAS and LPS                       the image is moved by 60 mm on average in x and y, where it should rest
#   the same numbers, labelled RAS and LPS (or 1)      the image rests, where it should be turned by half a turn
# Its help does not speak of it. Lists in LPS must be turned to RAS before (x and y with the other sign).
# Fails if the lists are told apart. Needs Debian 12's packages (apt-get).
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir -p debs/partial root
apt-get install -y -q -d --reinstall --no-install-recommends -o Debug::NoLocking=1 -o Dir::Cache::archives="$work/debs" \
    plastimatch=1.9.4+dfsg.2-0+deb12u1 >apt.log 2>&1 || { cat apt.log; echo "the packages cannot be had"; exit 1; }
for deb in debs/*.deb; do dpkg -x "$deb" root; done
plastimatch() { LD_LIBRARY_PATH=$work/root/usr/lib/x86_64-linux-gnu:$work/root/usr/lib root/usr/bin/plastimatch "$@"; }
list() { # coordinate system, sign of x and y: four points, those of sign -1 in RAS are those of sign 1 in LPS
    echo "# Markups fiducial file version = 5.0"
    echo "# CoordinateSystem = $1"
    echo "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID"
    n=0
    for p in "10 20 30" "-10 20 30" "10 -20 30" "10 20 -30"; do
        n=$((n + 1))
        echo "$p" | awk -v n=$n -v s="$2" '{ printf "%d,%g,%g,%g,0,0,0,1,1,1,0,P%d,,,2,0\n", n, s * $1, s * $2, $3, n }'
    done
}
list RAS -1 >ras.fcsv
list RAS 1 >ras_same_numbers.fcsv
list LPS 1 >lps.fcsv
list 1 1 >one.fcsv
plastimatch synth --pattern rect --dim "40 40 40" --origin "-60 -60 -60" --spacing "3 3 3" --output head.nii >synth.log
moved() {
    plastimatch lm-warp -f "$1.fcsv" -m "$2.fcsv" -F head.nii -I head.nii -a tps -V field.nrrd -O warped.nii -L out.fcsv >warp.log 2>&1 ||
        { cat warp.log; exit 1; }
    plastimatch stats field.nrrd | awk '/^Mean abs:/ { printf "%.1f %.1f %.1f\n", $3, $4, $5 }'
}
wrong=0
for case in "ras ras 0.0 0.0 0.0" "ras lps 60.0 60.0 0.0" "ras one 60.0 60.0 0.0" "ras_same_numbers lps 0.0 0.0 0.0" "ras_same_numbers one 0.0 0.0 0.0" \
    "ras ras_same_numbers 60.0 60.0 0.0"; do
    set -- $case
    found=$(moved "$1" "$2")
    echo "$1 to $2: moved by $found mm on average in x, y, z"
    [ "$found" = "$3 $4 $5" ] || wrong=1
done
[ $wrong = 0 ] || { echo "not as found"; exit 1; }
echo "as found: plastimatch takes LPS for RAS"
