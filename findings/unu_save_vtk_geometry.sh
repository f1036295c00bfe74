#!/bin/sh
# teem's unu writes a .vtk whose voxels are 1 mm cubes at the origin, whatever the NRRD says in space directions.
#
# An NRRD can say how large its voxels are in two ways: "spacings" of the axes, or "space directions" with "space origin",
# as all medical ones do (3D Slicer, ITK). `unu save -f vtk` of teem 1.12.0 (1.12.0~20160122-5 of Debian 12) knows the first
# way only. A volume of 0.5 x 0.4 x 2 mm at (-10, 20, 30) becomes
#   ORIGIN 0 0 0
#   SPACING 1 1 1
# without a word, so that ParaView shows a head of the wrong shape. The same volume with "spacings" keeps them. Its other
# verbs do follow space directions: `unu crop`, `pad`, `resample` and `flip` write the right ones. Its help says nothing of it.
# Fails if the spacing is kept, or if "spacings" is not. Needs Debian 12's packages (apt-get) and python3.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir -p debs/partial root
apt-get install -y -q -d --reinstall --no-install-recommends -o Debug::NoLocking=1 -o Dir::Cache::archives="$work/debs" \
    teem-apps=1.12.0~20160122-5 libteem2=1.12.0~20160122-5 >apt.log 2>&1 || { cat apt.log; echo "the packages cannot be had"; exit 1; }
for deb in debs/*.deb; do dpkg -x "$deb" root; done
lib=$work/root/usr/lib/x86_64-linux-gnu
unu() { LD_LIBRARY_PATH=$lib:$lib/teem root/usr/bin/teem-unu "$@"; }
cat >volume.py <<'PY'
import sys
where = {"directions": "space: left-posterior-superior\nspace directions: (0.5,0,0) (0,0.4,0) (0,0,2)\nspace origin: (-10,20,30)\n",
         "spacings": "spacings: 0.5 0.4 2\n"}[sys.argv[1]]
head = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 5 6\nencoding: raw\n"
open(sys.argv[1] + ".nrrd", "wb").write((head + where + "\n").encode() + bytes(range(120)))
PY
for kind in directions spacings; do
    python3 volume.py $kind
    unu save -f vtk -i $kind.nrrd -o $kind.vtk 2>$kind.err
    [ ! -s $kind.err ] || { cat $kind.err; echo "it says something"; exit 1; }
    echo "$kind: $(grep -a -E '^(ORIGIN|SPACING)' $kind.vtk | tr '\n' ' ')"
done
unu flip -a 0 -i directions.nrrd -o flipped.nrrd
echo "flipped: $(grep -a -E '^space (directions|origin)' flipped.nrrd | tr '\n' ' ')"
grep -a -q '^space directions: (-0.5,-0,-0)' flipped.nrrd && grep -a -q '^space origin: (-8.5,20,30)' flipped.nrrd ||
    { echo "flip does not follow the directions"; exit 1; }
grep -a -q '^SPACING 0.5 0.4' spacings.vtk || { echo "spacings are lost too"; exit 1; }
grep -a -q '^SPACING 1 1 1$' directions.vtk && grep -a -q '^ORIGIN 0 0 0$' directions.vtk || { echo "the spacing is kept now"; exit 1; }
echo "as found: size and place of the voxels are lost"
