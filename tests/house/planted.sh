#!/bin/sh
# planted.sh LAYERING SIZES: the tests of layers and of sizes catch each of these breaches and let what is right pass.
set -u
layering=$1 sizes=$2
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
missed=0
lay() { # FILE LINE: one more file of the tree
    mkdir -p "$work/tree/$(dirname "$1")" "$work/tree/app"
    printf '%s\n' "$2" >"$work/tree/$1"
}
caught() { # WHAT
    if sh "$layering" "$work/tree" >/dev/null; then
        echo "missed: $1"
        missed=1
    fi
    rm -rf "$work/tree"
}
passes() { # WHAT
    sh "$layering" "$work/tree" || { echo "refused: $1"; missed=1; }
    rm -rf "$work/tree"
}
plant() { # FILE INCLUDE
    lay "$1" "#include $2"
    caught "$1 with #include $2"
}
says() { # FILE LINE
    lay "$1" "$2"
    caught "$1 with $2"
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
plant app/planner/plan/a.c '"app/cli/verb.h"'
plant app/planner/plan/a.c '<argp.h>'
plant app/study/a.c '<argp.h>'
plant app/planner/predict/a.h '"render/camera.h"'
plant app/planner/predict/a.c '"app/pictures/standard.h"'
plant app/planner/bounds/a.c '"app/report/page.h"'
plant app/planner/judge/a.c '"app/study/study.h"'
plant app/planner/judge/a.c '"app/stress/stress.h"'
plant app/pictures/a.c '"app/cli/command.h"'
plant app/stress/a.c '"app/study/study.h"'
plant tests/unit/a.c '"app/cli/command.h"'
plant app/planner/store/a.c '"app/planner/patient/case_file.h"'
plant app/planner/patient/a.c '"app/planner/plan/plan_file.h"'
plant app/planner/plan/a.c '"app/planner/judge/judge.h"'
plant app/planner/judge/a.h '"app/planner/predict/outcome.h"'
plant app/planner/predict/a.c '"app/planner/bounds/audit.h"'
says app/planner/plan/a.c '    printf("done");'
says app/planner/plan/a.c '    puts("done");'
says app/planner/plan/a.c '    fprintf(stderr, "done");'
says app/planner/plan/a.c '    table_write(t, stdout);'
says app/planner/plan/a.c '    if (!ok) exit(1);'
says app/planner/plan/child.c '    _exit(1);'
lay geometry/a.h '#include "geometry/b.h"'
lay geometry/b.h '#include "geometry/c.h"'
lay geometry/c.h '#include "geometry/a.h"'
caught 'a circle of three headers'
lay cases/head/a.h '#include "b.h"'
lay cases/head/b.h '#include "a.h"'
caught 'a circle of headers beside each other'
lay app/a.c '#include "geometry/json_file.h"'
lay app/planner/store/child.c '    _exit(0);'
lay app/planner/bounds/a.c '#include "app/planner/store/a.h"'
lay app/planner/store/a.h ' * a text that was on stdout'
lay app/planner/store/b.c '    fprintf(w.stream, "%d", snprintf(text, 9, "printf"));'
lay app/planner/plan/a.c '    on_exit(f); task_exit(t);'
passes 'a good tree'

lines() { # COUNT FILE: so many lines more
    awk -v n="$1" 'BEGIN { for (i = 0; i < n; i++) print "    work();" }' >>"$work/tree/$2"
}
function_of() { # LINES FILE: one more function, braces counted
    printf 'void f(void)\n{\n' >>"$work/tree/$2"
    lines $(($1 - 2)) "$2"
    echo '}' >>"$work/tree/$2"
}
sized() { # refused or passed, WHAT
    sh "$sizes" "$work/tree" >/dev/null && got=passed || got=refused
    [ $got = "$1" ] || { echo "$2: not $1"; missed=1; }
    rm -rf "$work/tree"
}
lay sim/src/a.c ''
function_of 61 sim/src/a.c
sized refused 'a function of 61 lines'
lay geometry/cgal/a.cpp ''
function_of 60 geometry/cgal/a.cpp
function_of 61 geometry/cgal/a.cpp
sized refused 'the second function of C++ has 61 lines'
lay app/cli/a.h ''
lines 320 app/cli/a.h
sized refused 'a header of 321 lines'
lay app/cli/a.h ''
lines 319 app/cli/a.h
lay sim/src/a.c ''
function_of 60 sim/src/a.c
function_of 60 sim/src/a.c
sized passed 'what is just short enough'
exit $missed
