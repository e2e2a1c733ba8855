#!/bin/sh
# Prints the lines and branches of lib/ that the C tests run, by file and in all: gcc --coverage, not optimised. Minutes.
#   sh tests/coverage.sh [--missing] [TEST...]      what is not run, too; of these programs only, as in test_filter
# Of the host's build, which has its knobs at run time, and of configurations as they ship under random scenes (test_shipped.sh). A line
# is run if one of the builds runs it. A branch of one build is that of another where their lines have the same number of branches.
cd "$(dirname "$0")/.." || exit 1
build=build/coverage
mkdir -p $build/shipped
missing=0
[ "$1" != --missing ] || { missing=1 && shift; }
for program in tests/*/test_*.c; do basename "$program" .c; done >build/coverage.names
[ $# = 0 ] || printf '%s\n' "$@" >build/coverage.names
make -s -j2 WERROR=-Werror $(sed "s|^|$build/|" build/coverage.names) BUILD=$build OPT=-O0 HOST_OPT=-O1 SAN="--coverage -Dalways_inline=unused" >build/coverage.log 2>&1 || { tail -n 5 build/coverage.log; exit 1; }
find $build -name '*.gcda' -delete
xargs -P 2 -I '{}' sh -c "[ {} != test_random ] || export SCENES=\${SCENES:-20000}; $build/{} >/dev/null || echo '{} failed'" <build/coverage.names

# shipped NAME SOURCE FLAGS...
shipped() {
    name=$1 source=$2
    shift 2
    gcc -std=c11 -w -O0 --coverage -Dalways_inline=unused -D_POSIX_C_SOURCE=200809L -Ilib -I. -Itests -Itests/support "$@" -c -o "$build/shipped/$name.o" lib/gnomon.c &&
        gcc -std=c11 -w -O1 -D_POSIX_C_SOURCE=200809L -Ilib -I. -Itests -Itests/support "$@" -o "$build/shipped/$name" "$source" "$build/shipped/$name.o" --coverage -lm &&
        SCENES=25000 "$build/shipped/$name" 20000 >/dev/null || echo "$name failed"
}
shipped tiny tests/property/test_random.c -DGN_PRESET=GN_PRESET_TINY
shipped accurate tests/property/test_random.c -DGN_PRESET=GN_PRESET_ACCURATE -DGN_ATLAS_SIZE=128 -DGN_OTHER_ATLAS_SIZE=64 -DGN_INCREMENTAL=3 -DGN_MANY_CASCADES=3
shipped accurate-defaults tests/unit/test_defaults.c -DGN_PRESET=GN_PRESET_ACCURATE -DGN_ATLAS_SIZE=128 -DGN_OTHER_ATLAS_SIZE=128
shipped fast tests/property/test_random.c -DGN_CORE_DIVIDES=1 -DGN_PRESET=GN_PRESET_FAST -DGN_ATLAS_SIZE=32 -DGN_OTHER_ATLAS_SIZE=128
shipped least tests/property/test_random.c -DGN_PRESET=GN_PRESET_TINY -DGN_OTHER_LIGHTS=2 -DGN_MATERIALS=3 -DGN_BIASES=1 \
    -DGN_SHADOWS=1 -DGN_TEXTURE_FORMATS=1 -DGN_INCREMENTAL=0 -DGN_PICTURES=2
shipped size-first tests/property/test_random.c -DGN_SIZE_FIRST=1 -DGN_PRESET=GN_PRESET_TINY -DGN_SHORT_VERTICES=3
shipped capacities tests/property/test_random.c -DGN_PRESET=GN_PRESET_FAST -DGN_MAX_TRIANGLES=12 -DGN_MAX_TILE_REFS=24 -DGN_MAX_OBJECTS=3 -DGN_MAX_LIGHTS=3 \
    -DGN_SURFACE_LIGHTS=2 -DGN_MAX_SHADOW_TILES=2 -DGN_MAX_OTHER_TILES=3 -DGN_ATLAS_SIZE=32 -DGN_OTHER_ATLAS_SIZE=32
shipped compact tests/property/test_random.c -DGN_COMPACT=1
shipped compact-range tests/oracle/compact_range.c -DGN_COMPACT=1 -DGN_VALIDATION=0 -DGN_PRESET=GN_PRESET_TINY -DGN_SRGB=0 -DGN_MAX_TRIANGLES=64 -DGN_MAX_HEIGHT=64

find $build/obj/lib $build/shipped -name '*.gcda' | sort | while read -r data; do gcov -t -b -c -o "${data%.gcda}.o" "$data"; done 2>/dev/null | awk -v missing="$missing" '
    / +-: +0:Source:/ { file = $0; sub(/.*Source:/, "", file); ours = file ~ /^lib\//; line = 0; next }
    !ours { next }
    /^branch / {
        if ($0 !~ /never executed|taken 0/) now[file, line, n_now[file, line] + 0] = 1
        n_now[file, line]++ # their numbers count calls, too
        next
    }
    /^ *[^:]*: *[0-9]+:/ {
        close_line()
        split($0, cell, ":")
        count = cell[1]; line = cell[2] + 0
        gsub(/[ *]/, "", count)
        if (count == "-") next
        lines[file, line] = 1
        if (count !~ /^[#=]/) run[file, line] = 1
    }
    # Branches of the line before, of this build, are merged with what is known of it
    function close_line(  k, i) {
        for (k in n_now) {
            if (!(k in n_branches) || (n_branches[k] == n_now[k])) {
                n_branches[k] = n_now[k]
                for (i = 0; i < n_now[k]; i++) if ((k, i) in now) taken[k, i] = 1
            }
            for (i = 0; i < n_now[k]; i++) delete now[k, i]
            delete n_now[k]
        }
    }
    function rate(got, n) { return n ? sprintf("%6.2f %%", 100 * got / n) : "       -" }
    END {
        close_line()
        for (k in lines) { split(k, p, SUBSEP); files[p[1]] = 1; n_lines[p[1]]++; if (k in run) n_run[p[1]]++; else if (missing) print "line " p[1] ":" p[2] | "sort" }
        for (k in n_branches) {
            split(k, p, SUBSEP)
            for (i = 0; i < n_branches[k]; i++) {
                all_of[p[1]]++
                if ((k, i) in taken) got[p[1]]++
                else if (missing && k in run) print "branch " p[1] ":" p[2] " " i " of " n_branches[k] | "sort"
            }
        }
        close("sort")
        printf "%-36s %10s %12s\n", "", "lines", "branches"
        for (f in files) {
            printf "%-36s %10s %12s\n", f, rate(n_run[f], n_lines[f]), rate(got[f], all_of[f]) | "sort"
            a += n_run[f]; b += n_lines[f]; c += got[f]; d += all_of[f]
        }
        close("sort")
        printf "%-36s %10s %12s  %d of %d lines, %d of %d branches\n", "all", rate(a, b), rate(c, d), a, b, c, d
    }'
