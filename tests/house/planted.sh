#!/bin/sh
# planted.sh LAYERING: the layering test catches each of these breaches.
set -u
layering=$1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
missed=0
plant() { # FILE INCLUDE
    rm -rf "$work/tree"
    mkdir -p "$work/tree/$(dirname "$1")"
    mkdir -p "$work/tree/app"
    printf '#include %s\n' "$2" >"$work/tree/$1"
    if sh "$layering" "$work/tree" >/dev/null; then
        echo "missed: $1 with #include $2"
        missed=1
    fi
}
plant geometry/a.c '"sim/equilibrium.h"'
plant geometry/src/a.c '"render/camera.h"'
plant sim/a.h '"render/camera.h"'
plant render/src/a.c '"sim/equilibrium.h"'
plant render/a.c '"app/planner/store/fields.h"'
plant app/a.c '"geometry/src/files/fcsv.h"'
plant geometry/src/a.c '<CGAL/Surface_mesh.h>'
plant app/a.c '"geometry/cgal/guard.hpp"'
plant geometry/a.h '<jansson.h>'
plant app/a.c '<jansson.h>'
plant app/a.c '<suitesparse/cholmod.h>'
plant sim/src/a.c '<omp.h>'
plant app/a.c '<png.h>'
plant geometry/src/a.c '<assimp/scene.h>'
plant cases/norm_head/a.c '"app/planner/store/fields.h"'
mkdir -p "$work/good/app" && echo '#include "geometry/json_file.h"' >"$work/good/app/a.c"
sh "$layering" "$work/good" >/dev/null || { echo "refused a good tree"; missed=1; }
exit $missed
