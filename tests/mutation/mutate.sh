#!/bin/sh
# Mutation testing: single-point mutants of lib/ (tests/mutation/mutants.c: operators, constants, bounds, conditions, statements), each
# built and run against the tests until one fails. Prints the survivors and the score. make mutate
#   [SEED=n]      which mutants; the same seed chooses the same ones of the same sources. By default the date
#   [N=500]       how many. With MINUTES=m none begins after m minutes
#   [FILES="lib/scene/gn_scene.c ..."]    of these; else of lib/ without the generated tables, and lib/compact, which has tests of its own
#   [TESTS="test_golden test_frame"]      run what survives the quick programs against these, before the slower ones of the file's folder
#   [AGAIN=1]     the survivors of this seed again, after a change of the tests
#   [ONLY="FILE LINE COLUMN LENGTH TEXT"] this one
# A campaign that was stopped goes on where it was: build/mutate/SEED-SOURCES/{first,again}, a line for each mutant.
#
# The library is a shared object, so that a mutant is one compilation and one link; programs end at the first check that fails. Two
# passes: quick programs first, then, of the survivors, the slower ones that test what the folder does.
# A mutant whose object code is the same is no mutant; nor is one that does not compile. A test that takes four times as long as before,
# and a second, kills.
cd "$(dirname "$0")/../.." || exit 1
root=$PWD/build/mutate tree=$PWD/build/mutate/tree
: "${SEED:=$(date +%Y%m%d)}" "${N:=500}" "${MINUTES:=10000}"
: "${FILES:=$(find lib -mindepth 2 -name 'gn_*.[ch]' | grep -v -e gn_tables -e lib/compact/ | sort | tr '\n' ' ')}"
: "${TESTS:=test_golden_random test_golden test_kept test_frame}"

# The tree is copied: the sources stay as they are. Objects of before are kept where the sources are the same.
mkdir -p "$tree"
for folder in lib host boards port tests docs; do
    mkdir -p "$tree/$folder"
    (cd $folder && find . -type f) | while read -r file; do
        case $file in ./support/check.h | *.png) [ -f "$tree/$folder/$file" ] && continue ;; esac
        cmp -s "$folder/$file" "$tree/$folder/$file" || { mkdir -p "$(dirname "$tree/$folder/$file")" && cp "$folder/$file" "$tree/$folder/$file"; }
    done
done
cp Makefile "$tree/"
cd "$tree" || exit 1
check=tests/support/check.h
grep -q _Exit $check || sed -i 's/#include <math.h>/&\n#include <stdlib.h>/; s/check_n_failed++;/& _Exit(1);/' $check
sources=$(cat $FILES | cksum | cut -d ' ' -f 1)
found=$root/$SEED-$sources
mkdir -p "$found"

# Tests of a file: those of its name and folder, the quick ones and the slower ones.
quick() {
    stem=$(basename "$1" | sed 's/^gn_//; s/\..*//')
    [ ! -f tests/unit/test_"$stem".c ] || echo "test_$stem"
    case $1 in
    lib/base/*) echo test_math test_affine test_pixel ;;
    lib/geometry/*) echo test_affine test_xform test_clip test_walk test_texture test_skin ;;
    lib/scene/* | lib/frame/*) echo test_refused test_limits test_defaults test_reentry ;;
    lib/light/*) echo test_object test_receiver_bias test_lists test_punctual ;;
    lib/shadow/*) echo test_persp test_tiles test_window test_filter ;;
    lib/visible/*) echo test_runs test_walk test_background test_pick ;;
    lib/shade/*) echo test_pixel test_corner test_record test_arrival test_alpha test_background ;;
    esac
}
slow() {
    echo test_limits test_lists test_extremes test_extremes_light
    case $1 in
    lib/base/* | lib/geometry/*) echo test_math test_pixel test_radiance test_texture test_vertex_cache test_corner_cases test_stages ;;
    lib/scene/* | lib/frame/*) echo test_cores test_crawl test_flicker test_culling test_groups ;;
    lib/light/*) echo test_bias test_casters test_culling ;;
    lib/shadow/*) echo test_fit test_casters test_bias test_culling test_stages test_census ;;
    lib/visible/*) echo test_groups test_exactly test_screen test_corner_cases test_stages ;;
    lib/shade/*) echo test_patches test_exactly test_radiance test_punctual test_corner_cases test_screen test_contact test_stages test_census ;;
    esac
}
tests_of() { # tests_of PASS FILE: each once, if there is such a test
    case $1-$2 in *-lib/compact/*) return ;; esac
    case $1 in
    first) echo test_golden_random test_changes $(quick "$2") test_refused test_random ;;
    again) echo $TESTS $(quick "$2") $(slow "$2") ;;
    esac | tr ' ' '\n' | awk '!seen[$1]++' | while read -r name; do [ -z "$(find tests -name "$name.c")" ] || echo "$name"; done
}
all_tests_of() { for file in $FILES; do tests_of "$1" "$file"; done | sort -u; }

# Without line numbers, which a mutant changes. An interposed symbol would keep the compiler from what it does to an object.
flags="-g0 -fPIC -fno-semantic-interposition"
objects=$(for file in lib/*/*.c; do case $file in lib/compact/*) ;; *) echo "b/obj/${file%.c}.o" ;; esac; done)
mk() { make -s BUILD=b OPT="-O2 -Wl,--no-as-needed" HOST_OPT=-O1 SAN="$flags" WERROR= "$@" >"$root/make" 2>&1; }
library() { mk $objects && gcc -shared -o b/libgnomon.so $objects; }
programs() { mk LIB_OBJ=b/libgnomon.so -o b/libgnomon.so $(printf "b/%s " "$@"); } # they load the library when they run
signature() { cat $objects 2>/dev/null | cksum; }
run() { # run NAME SECONDS, of CPU time
    (ulimit -t "$2" && SCENES=3000 "b/$1" >"$root/out" 2>&1)
}

gcc -std=c11 -O1 -o "$root/mutants" tests/mutation/mutants.c || exit 1

# The original, and how long its tests take.
prepare() { # prepare NAME...
    [ $# -gt 0 ] || return 0
    library && programs "$@" || { tail -n 5 "$root/make"; exit 1; }
    for name in "$@"; do
        [ "b/$name.seconds" -nt "b/$name" ] && continue
        (run "$name" 1000 && times) | awk -F '[ms ]+' 'NR == 2 { printf "%.0f\n", 4 * (60 * $1 + $2) + 1.5 }' >"b/$name.seconds"
        [ -s "b/$name.seconds" ] || { echo "$name fails without a mutant: $(tail -n 1 "$root/out")"; exit 1; }
    done
}

# Sources, objects and programs as they are without a mutant, with their times: so nothing is compiled twice.
save() {
    rm -rf "$root/saved" && mkdir "$root/saved" && cp -a b lib "$root/saved/" && touch "$root/stamp" && original=$(signature)
}
restore() {
    find b lib -type f -newer "$root/stamp" | while read -r changed; do cp -p "$root/saved/$changed" "$changed"; done
}

# compact NAME: what test_compact.sh runs, of the host alone, and the verdict
compact() {
    one="gcc -w -O1 -g0 -Ilib -I. -Iboards/common -Iboards/apps -Itests -Itests/support" seconds=$(if [ "$1" = mutant ]; then echo 5; else echo 1000; fi)
    small="-std=c11 -DGN_COMPACT=1 -DGN_VALIDATION=0 -DGN_PRESET=GN_PRESET_TINY -DGN_SRGB=0"
    $one -std=c99 '-DGN_USER_CONFIG="compact_config.h"' -c -o "compact/$1.o" lib/gnomon.c 2>/dev/null || { echo "not built" && return; }
    $one $small -O2 -c -o "compact/$1.small.o" lib/gnomon.c 2>/dev/null || { echo "not built" && return; }
    if [ "$1" = mutant ] && cmp -s compact/mutant.o compact/original.o && cmp -s compact/mutant.small.o compact/original.small.o; then echo "same code" && return; fi
    $one -std=c99 '-DGN_USER_CONFIG="compact_config.h"' -o "compact/golden" "compact/$1.o" boards/apps/compact.c boards/host/startup.c boards/common/print.c
    (ulimit -t "$seconds" && compact/golden 2>&1) | grep '^frame' | cmp -s - tests/oracle/compact_golden.txt || { echo "killed by compact_golden" && return; }
    for stages in compact_exact compact_bounds; do
        $one $small -DGN_ATLAS_SIZE=128 '-DLIBRARY="lib/gnomon.c"' -o compact/$stages tests/oracle/$stages.c -lm
        (ulimit -t "$seconds" && compact/$stages >/dev/null 2>&1) || { echo "killed by $stages" && return; }
    done
    $one $small -DGN_MAX_TRIANGLES=64 -DGN_MAX_HEIGHT=64 -fsanitize=undefined -fno-sanitize-recover=all -o compact/range tests/oracle/compact_range.c lib/gnomon.c -lm
    (ulimit -t "$seconds" && compact/range 5000 >/dev/null 2>&1) || { echo "killed by compact_range" && return; }
    echo SURVIVED
}

# judge PASS: reads mutants, and writes what became of each.
judge() {
    while IFS= read -r mutant; do
        [ $(($(date +%s) - begin)) -lt $((60 * MINUTES)) ] || break
        file=$(echo "$mutant" | cut -d ' ' -f 1) line=$(echo "$mutant" | cut -d ' ' -f 2) column=$(echo "$mutant" | cut -d ' ' -f 3)
        length=$(echo "$mutant" | cut -d ' ' -f 4) text=$(echo "$mutant" | cut -d ' ' -f 5-)
        TEXT="$text" awk -v l="$line" -v c="$column" -v n="$length" \
            'NR == l { $0 = substr($0, 1, c - 1) ENVIRON["TEXT"] substr($0, c + n) } { print }' "$root/saved/$file" >"$file"
        by=SURVIVED
        if [ "${file#lib/compact/}" != "$file" ]; then by=$([ "$1" = again ] && echo SURVIVED || compact mutant)
        elif ! library; then by="not built"
        elif [ "$(signature)" = "$original" ]; then by="same code"
        else
            for name in $(tests_of "$1" "$file"); do
                case $file in *.h) programs "$name" || { by="not built" && break; } ;; esac
                run "$name" "$(cat "$root/saved/b/$name.seconds")" || { by="killed by $name" && break; }
            done
        fi
        case $by-$file in SURVIVED-*.c) touch "$file" && mk WERROR=-Werror "b/obj/${file%.c}.o" || by="killed by a warning" ;; esac
        restore
        echo "$by: $mutant"
    done
}
# new RESULTS: of the mutants that are read those that are not in it; headers, which half of the library includes, last
new() { sed 's/^[^:]*: //' "$1" >"$root/known" && grep -v -x -F -f "$root/known" | awk '$1 ~ /h$/ { later[++n] = $0; next } { print } END { for (i = 1; i <= n; i++) print later[i] }'; }

begin=$(date +%s)
if [ -n "$ONLY" ]; then echo "$ONLY"; else "$root/mutants" "$SEED" "$N" $FILES; fi >"$root/chosen"
[ -z "$ONLY$AGAIN" ] || rm -f "$found/again"
[ -z "$ONLY" ] || rm -f "$found/first"
touch "$found/first" "$found/again"

mkdir -p b compact
case "$FILES" in *lib/compact/*) [ "$(compact original)" = SURVIVED ] || { echo "compact fails without a mutant: $(compact original)"; exit 1; } ;; esac
prepare $(all_tests_of first)
save
new "$found/first" <"$root/chosen" >"$root/left" && judge first <"$root/left" >>"$found/first"

sed -n 's/^SURVIVED: //p' "$found/first" >"$root/survivors"
prepare $(all_tests_of again)
save
new "$found/again" <"$root/survivors" >"$root/left" && judge again <"$root/left" >>"$found/again"

grep '^SURVIVED' "$found/again"
for folder in $(sed 's|^[^:]*: lib/||; s|/.*||' "$found/first" | sort -u) all; do
    pattern=": lib/$folder/"
    [ "$folder" = all ] && pattern=": lib/"
    count() { cat "$found/$1" | grep "^$2" | grep -c "$pattern"; }
    survived=$(($(count first SURVIVED) - $(count again killed))) killed=$(($(count first killed) + $(count again killed)))
    printf '%-10s %4d killed %4d survived %4d same code %4d not built  score %s %%\n' "$folder" $killed $survived "$(count first same)" "$(count first not)" \
        "$(awk -v k=$killed -v s=$survived 'BEGIN { printf "%.1f", k + s ? 100 * k / (k + s) : 0 }')"
done
