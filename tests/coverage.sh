#!/bin/sh
# Prints the lines and branches of lib/ that the C tests run, by part and in all: gcc --coverage, not optimised. Minutes.
#   sh tests/coverage.sh [TEST...]      of these programs only, as in test_filter
cd "$(dirname "$0")/.." || exit 1
mkdir -p build
build=build/coverage
for program in tests/*/test_*.c; do basename "$program" .c; done >build/coverage.names
[ $# = 0 ] || printf '%s\n' "$@" >build/coverage.names
make -s -j2 WERROR=-Werror $(sed "s|^|$build/|" build/coverage.names) BUILD=$build OPT=-O0 HOST_OPT=-O1 SAN=--coverage >build/coverage.log 2>&1 || { tail -n 5 build/coverage.log; exit 1; }
find $build -name '*.gcda' -delete
xargs -P 2 -I '{}' sh -c "SCENES=\${SCENES:-20000} $build/{} >/dev/null || echo '{} failed'" <build/coverage.names
find $build/obj/lib -name '*.gcda' | sort | while read -r data; do gcov -n -b -o "$(dirname "$data")" "$data"; done 2>/dev/null | awk '
    /^File / { file = substr($2, 2, length($2) - 2); ours = file ~ /^lib\// }
    ours && /^(Lines executed|Taken at least once):/ {
        split($0, part, /[:% ]+/)
        n = $NF; percent = $0; sub(/.*:/, "", percent); sub(/%.*/, "", percent)
        what = /^Lines/ ? "lines" : "branches"
        if ((file, what) in of) next # a header: once
        of[file, what] = n; hit[file, what] = n * percent / 100
        all[what] += n; all_hit[what] += n * percent / 100
        if (what == "branches") names[++n_names] = file
    }
    function rate(got, n) { return n ? sprintf("%6.2f %%", 100 * got / n) : "       -" }
    END {
        printf "%-36s %10s %12s\n", "", "lines", "branches"
        for (i = 1; i <= n_names; i++) {
            f = names[i]
            printf "%-36s %10s %12s\n", f, rate(hit[f, "lines"], of[f, "lines"]), rate(hit[f, "branches"], of[f, "branches"])
        }
        printf "%-36s %10s %12s\n", "all", rate(all_hit["lines"], all["lines"]), rate(all_hit["branches"], all["branches"])
    }'
