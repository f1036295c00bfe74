#!/bin/sh
# layering.sh ROOT: who may include whom. geometry <- sim, geometry <- render, all <- app; in app the planner below the
# others and the command line above them, in the planner one room on the next; no circles, and each outside library in
# one place only. The planner prints nothing and ends no process. Prints every breach; the status is 1 if there is one.
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
silent() { # FOLDER PATTERN WHY [FILE]: no line of code there matches but in FILE
    grep -rnE --include='*.[ch]' "$2" "$1" 2>/dev/null | grep -vE "^[^:]*:[0-9]+: *(/\\*|\\* )|^(${4:-none}):" | breach "$3"
}
only() { # HEADERS PLACES: the headers belong in these paths alone
    grep -E " ($1)" "$work/includes" | grep -vE "^($2)" | breach "belongs in $2 only"
}

never geometry '(sim|render|app|cases|tests)/' 'geometry needs none of the others'
never sim '(render|app|cases|tests)/' 'sim needs geometry only'
never render '(sim|app|cases|tests)/' 'render needs geometry only'
never app 'tests/' 'app does not need tests'
never cases '(sim|render|app|tests)/' 'the makers of cases need geometry only'
never app/planner '(app/(cli|identities|pictures|report|study|stress)/|render/)' 'the planner is below the rest of app and draws nothing'
never app/pictures 'app/(report|study|stress)/' 'pictures need the planner only'
never app/report 'app/(study|stress)/' 'the page needs pictures and the planner only'
never app/identities 'app/(pictures|report|study|stress)/' 'identities need the planner only'
never app/study 'app/(pictures|report|stress)/' 'study needs the planner only'
never app/stress 'app/(pictures|report|study)/' 'stress needs the planner only'
above= # one room of the planner on the next, from the top
for room in bounds predict judge plan identity patient store; do
    [ -n "$above" ] && never "app/planner/$room" "app/planner/($above)/" "$room is below $above"
    above=${above:+$above|}$room
done
only 'app/cli/' 'app/cli/'
only 'argp\.h' 'app/cli/'
silent app/planner '(^|[^a-zA-Z0-9_])(printf|vprintf|puts|putchar|perror)\(|(^|[^a-zA-Z0-9_])(stdout|stderr)([^a-zA-Z0-9_]|$)' \
    'the planner prints nothing'
# child.c leaves a process that it forked itself
silent app/planner '(^|[^a-zA-Z0-9_])(exit|_exit|_Exit|quick_exit|abort)\(' 'the planner ends no process' \
    'app/planner/store/child\.c'
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
only 'zlib\.h' '(app/report/packed|geometry/src/files/inflate)\.c'
only 'hdf5\.h' 'geometry/src/files/transform_h5\.c'
only 'plplot/' 'app/(study|identities)/plot\.c'
only 'cmocka\.h' 'tests/check\.h'

for library in '(suitesparse/)?cholmod' 'GL/osmesa' 'png\.h' 'cairo'; do
    files=$(grep -E "^(sim|render|app)/[^ ]* $library" "$work/includes" | cut -d: -f1 | sort -u)
    [ "$(printf '%s' "$files" | grep -c .)" -gt 1 ] && echo "$files" | breach "$library is to be included by one file"
done

# "file header" with both as paths from the root; tsort names the circles
sed -E 's/:[0-9]+ / /' "$work/includes" | while read -r file header; do
    [ -f "$header" ] || header=$(dirname "$file")/$header
    [ -f "$header" ] && echo "$file $header"
done >"$work/edges"
tsort "$work/edges" 2>&1 >/dev/null | sed -E 's/^tsort: //' | grep -v 'input contains a loop' | breach 'includes in a circle'

if [ -s "$work/breaches" ]; then
    cat "$work/breaches"
    exit 1
fi
echo "$(grep -c . "$work/includes") includes, layers hold"
