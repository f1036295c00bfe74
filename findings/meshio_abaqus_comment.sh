#!/bin/sh
# meshio stops reading tetrahedra at a comment in an Abaqus or CalculiX file, and gives the mesh without the rest.
#
# In an .inp file a line that begins with ** is a comment, anywhere, also between the lines of *NODE and *ELEMENT, where
# preprocessors and people mark parts. meshio 5.0.0 (python3-meshio 7.0.0-3 of Debian 12) takes any line that begins with *
# for the end of the list. Of two tetrahedra with a comment between them
#   meshio reads 1, without a warning,
#   CalculiX 2.20 (2.20-1) reads 2: both volumes are in its output.
# In *NODE, it ends in a KeyError if a tetrahedron needs a node that was left out. So a mandible can be solved whole and shown
# in part. Strip comments before, or compare the number of elements.
# Fails if meshio reads both or CalculiX does not. Needs Debian 12's packages (apt-get), python3-numpy.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir -p debs/partial root
apt-get install -y -q -d --reinstall --no-install-recommends -o Debug::NoLocking=1 -o Dir::Cache::archives="$work/debs" \
    python3-meshio=7.0.0-3 python3-rich calculix-ccx=2.20-1 >apt.log 2>&1 || { cat apt.log; echo "the packages cannot be had"; exit 1; }
for deb in debs/*.deb; do dpkg -x "$deb" root; done
inp() {
    cat <<INP
*NODE, NSET=ALL
1,0,0,0
2,1,0,0
3,0,1,0
4,0,0,1
5,1,1,1
*ELEMENT, TYPE=C3D4, ELSET=MANDIBLE
1,1,2,3,4
$1
2,2,3,4,5
*MATERIAL, NAME=BONE
*ELASTIC
1000,0.3
*SOLID SECTION, ELSET=MANDIBLE, MATERIAL=BONE
*STEP
*STATIC
*BOUNDARY
ALL,1,3
*EL PRINT, ELSET=MANDIBLE
EVOL
*END STEP
INP
}
inp "** condyle" >comment.inp
inp "" | sed '/^$/d' >plain.inp
cat >count.py <<'PY'
import sys
sys.path.insert(0, "root/usr/lib/python3/dist-packages")
import meshio
print(sum(len(block.data) for block in meshio.read(sys.argv[1]).cells if block.type == "tetra"))
PY
for kind in plain comment; do
    /usr/bin/python3 count.py $kind.inp >$kind.meshio 2>$kind.err || { cat $kind.err; echo "meshio does not read it"; exit 1; }
    [ ! -s $kind.err ] || { cat $kind.err; echo "meshio says something"; exit 1; }
    LD_LIBRARY_PATH=$work/root/usr/lib/x86_64-linux-gnu root/usr/bin/ccx $kind >$kind.log 2>&1 || { cat $kind.log; exit 1; }
    awk 'NF == 2 && $1 ~ /^[0-9]+$/' $kind.dat | wc -l >$kind.ccx
    echo "$kind: $(cat $kind.meshio) of 2 tetrahedra in meshio, $(cat $kind.ccx) in CalculiX"
done
[ "$(cat plain.meshio plain.ccx comment.ccx | tr -d '\n')" = 222 ] || { echo "not even the plain file is read, or not by CalculiX"; exit 1; }
[ "$(cat comment.meshio)" = 1 ] || { echo "meshio reads on after the comment now"; exit 1; }
echo "as found: meshio drops what follows a comment"
