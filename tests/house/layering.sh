#!/bin/sh
# layering.sh ROOT: who may include whom. geometry <- sim, geometry <- render, all <- app, and each outside library in
# one place only. Prints every breach; the status is 1 if there is one.
set -u
cd "$1" || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
: >"$work/breaches"

# "path:line header", one line for each #include
grep -rnE --include='*.[ch]' --include='*.[ch]pp' '^ *# *include' geometry sim render app cases tests 2>/dev/null |
    sed -E 's/^([^:]*:[0-9]+): *# *include *[<"]([^>"]*).*/\1 \2/' | sort >"$work/includes"

breach() { # WHY: marks the lines of stdin
    while read -r line; do echo "$line  <- $1"; done >>"$work/breaches"
}
never() { # FOLDER HEADERS WHY
    grep -E "^$1/[^ ]* ($2)" "$work/includes" | breach "$3"
}
only() { # HEADERS PLACES: the headers belong in these paths alone
    grep -E " ($1)" "$work/includes" | grep -vE "^($2)" | breach "belongs in $2 only"
}

never geometry '(sim|render|app|cases|tests)/' 'geometry needs none of the others'
never sim '(render|app|cases|tests)/' 'sim needs geometry only'
never render '(sim|app|cases|tests)/' 'render needs geometry only'
never app 'tests/' 'app does not need tests'
never cases '(sim|render|app|tests)/' 'the makers of cases need geometry only'
only 'geometry/src/' 'geometry/|tests/'
only 'sim/src/' 'sim/|tests/'
only 'render/src/' 'render/|tests/'
only 'geometry/cgal/' 'geometry/cgal/'
only '(CGAL|Eigen|boost)/' 'geometry/cgal/'
only 'jansson\.h' 'geometry/json_file\.h'
only 'assimp/' 'geometry/src/files/read_scene\.c'
only 'teem/' 'geometry/src/files/read_nrrd\.c'
only 'nifti' 'geometry/src/files/read_nifti\.c'
only 'omp\.h' 'geometry/src/parallel\.c'
only '(suitesparse/)?(cholmod|amd|metis)' 'sim/'
only '(GL|EGL)/' 'render/src/'
only 'png\.h' 'render/src/'
only '(cairo|ft2build|freetype)' 'render/src/'
only 'nettle/' 'app/(planner/store/content_hash|report/packed)\.c'
only 'zlib\.h' 'app/report/packed\.c'
only 'plplot/' 'app/study/plot\.c'
only 'cmocka\.h' 'tests/check\.h'

for library in '(suitesparse/)?cholmod' 'GL/osmesa' 'png\.h' 'cairo'; do
    files=$(grep -E "^(sim|render|app)/[^ ]* $library" "$work/includes" | cut -d: -f1 | sort -u)
    [ "$(printf '%s' "$files" | grep -c .)" -gt 1 ] && echo "$files" | breach "$library is to be included by one file"
done

if [ -s "$work/breaches" ]; then
    cat "$work/breaches"
    exit 1
fi
echo "$(grep -c . "$work/includes") includes, layers hold"
