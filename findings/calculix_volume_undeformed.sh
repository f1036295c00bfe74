#!/bin/sh
# CalculiX prints the volume of an element as it was before, also where NLGEOM deforms it: a test of it cannot fail.
#
# Whoever solves nearly incompressible tissue checks its volume. `*EL PRINT` with EVOL is "the volume" in CalculiX' manual; in
# Abaqus, whose input it shares, EVOL is the current one. CalculiX 2.20 (2.20-1 of Debian 12) prints the reference volume
# after a finite deformation: a neo-Hookean cube of 1 that is pulled to 1.5 its length and lost a part of its width has
#   displacements of the top   -0.1116344 -0.1116344 0.5       so 0.8883656^2 1.5 = 1.184 in volume
#   EVOL                       1.000000
#   COORD of integration points, as EVOL: 0.2113249 and 0.7886751, those of the cube at rest
# while S is the true (Cauchy) stress of the deformed one. The volume must be made from the displacements.
# Fails if EVOL or COORD follows the deformation. Needs Debian 12's packages (apt-get).
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir -p debs/partial root
apt-get install -y -q -d --reinstall --no-install-recommends -o Debug::NoLocking=1 -o Dir::Cache::archives="$work/debs" \
    calculix-ccx=2.20-1 >apt.log 2>&1 || { cat apt.log; echo "the packages cannot be had"; exit 1; }
for deb in debs/*.deb; do dpkg -x "$deb" root; done
cat >cube.inp <<'INP'
*NODE, NSET=ALL
1,0,0,0
2,1,0,0
3,1,1,0
4,0,1,0
5,0,0,1
6,1,0,1
7,1,1,1
8,0,1,1
*ELEMENT, TYPE=C3D8, ELSET=CUBE
1,1,2,3,4,5,6,7,8
*MATERIAL, NAME=TISSUE
*HYPERELASTIC, NEO HOOKE
1.,0.5
*SOLID SECTION, ELSET=CUBE, MATERIAL=TISSUE
*STEP, NLGEOM
*STATIC
1.,1.
*BOUNDARY
1,1,3
2,2,3
3,3
4,1
4,3
5,1,2
6,2
8,1
5,3,3,0.5
6,3,3,0.5
7,3,3,0.5
8,3,3,0.5
*NODE PRINT, NSET=ALL
U
*EL PRINT, ELSET=CUBE
EVOL,COORD,S
*END STEP
INP
LD_LIBRARY_PATH=$work/root/usr/lib/x86_64-linux-gnu root/usr/bin/ccx cube >cube.log 2>&1 || { cat cube.log; exit 1; }
awk '
/displacements/ { part = "u" } /stresses/ { part = "s" } /volume/ { part = "v" } /global coordinates/ { part = "x" }
part == "u" && $1 == 7 && NF == 4 { ux = $2; uy = $3; uz = $4 }
part == "v" && NF == 2 { volume = $2 }
part == "x" && $1 == 1 && $2 == 8 { x = $3; z = $5 }
part == "s" && $1 == 1 && $2 == 8 { s = $5 }
END {
    true_volume = (1 + ux) * (1 + uy) * (1 + uz)
    printf "the cube is %.4f x %.4f x %.4f, %.4f in volume; EVOL %.4f; last integration point %.4f %.4f; stress %.4f\n", 1 + ux, 1 + uy, 1 + uz, true_volume, volume, x, z, s
    if (true_volume < 1.18 || true_volume > 1.19) { print "another deformation"; exit 1 }
    if (volume != 1 || x < 0.788 || x > 0.789 || z < 0.788 || z > 0.789) { print "EVOL or COORD follows the deformation now"; exit 1 }
}' cube.dat
echo "as found: CalculiX prints the volume before the deformation"
