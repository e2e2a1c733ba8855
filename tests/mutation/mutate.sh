#!/bin/sh
# Mutation testing: single-point mutants of lib/ (tests/mutation/mutants.c: operators, constants, bounds, conditions, statements), each
# built and run against the tests until one fails. Prints the survivors and the score. make mutate
#   [SEED=n]      which mutants; the same seed chooses the same ones of the same sources. By default the date
#   [N=500]       how many. With MINUTES=m none begins after m minutes
#   [FILES="lib/scene/gn_scene.c ..."]    of these; else of lib/ without the generated tables, and lib/compact, which test_compact.sh tests
#   [TESTS="test_golden test_frame"]      run against these, after those of the file's folder
#   [AGAIN=1]     the survivors of this seed again, after a change of the tests
#   [ONLY="FILE LINE COLUMN LENGTH TEXT"] this one
# A campaign that was stopped goes on where it was: build/mutate/SEED-SOURCES/{first,again}, a line for each mutant.
#
# Two passes. In the first, the library is a shared object, so that a mutant is one compilation and one link; programs end at the first
# check that fails; few programs run. In the second, the survivors meet all programs, with sanitizers, as in make test.
# A mutant whose object code is the same is no mutant; nor is one that does not compile. A test that takes four times as long as before,
# and a second, kills.
cd "$(dirname "$0")/../.." || exit 1
root=$PWD/build/mutate tree=$PWD/build/mutate/tree
: "${SEED:=$(date +%Y%m%d)}" "${N:=500}" "${MINUTES:=10000}"
: "${FILES:=$(find lib -mindepth 2 -name 'gn_*.[ch]' | grep -v -e gn_tables -e lib/compact/ | sort | tr '\n' ' ')}"
: "${TESTS:=test_changes test_golden test_refused test_frame test_tiles test_lists test_window test_runs test_walk test_kept test_random}"

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

# Tests of a file: those of its name and folder.
first() {
    stem=$(basename "$1" | sed 's/^gn_//; s/\..*//')
    [ ! -f tests/unit/test_"$stem".c ] || echo "test_$stem"
    case $1 in
    lib/base/*) echo test_math test_affine test_pixel ;;
    lib/geometry/*) echo test_affine test_xform test_clip test_walk test_texture test_skin ;;
    lib/scene/* | lib/frame/*) echo test_refused test_limits test_defaults test_reentry ;;
    lib/light/*) echo test_object test_receiver_bias test_lists test_punctual ;;
    lib/shadow/*) echo test_persp test_filter test_window test_tiles test_kept ;;
    lib/visible/*) echo test_runs test_walk test_background test_pick ;;
    lib/shade/*) echo test_pixel test_corner test_arrival test_alpha test_background ;;
    esac
}
names=$(for folder in unit property oracle; do for program in tests/$folder/test_*.c; do basename "$program" .c; done; done |
    grep -v -e test_extremes_many -e test_rows -e test_accuracy -e test_seams -e test_cores)
tests_of() { # tests_of PASS FILE: each once, if there is such a test
    case $1 in
    first) echo test_changes $(first "$2") $TESTS ;;
    again) echo $(first "$2") test_refused test_limits test_random $names ;;
    esac | tr ' ' '\n' | awk '!seen[$1]++' | while read -r name; do [ -z "$(find tests -name "$name.c")" ] || echo "$name"; done
}

# Without line numbers, which a mutant changes. An interposed symbol would keep the compiler from what it does to an object.
flags="-g0 -fPIC -fno-semantic-interposition"
objects=$(for file in lib/*/*.c; do case $file in lib/compact/*) ;; *) echo "obj/${file%.c}.o" ;; esac; done)
library() { # library PASS: builds it
    case $1 in first) san=$flags ;; again) san="$flags -fsanitize=address,undefined -fno-sanitize-recover=all" ;; esac
    make -s BUILD="$1" OPT="-O2 -Wl,--no-as-needed" HOST_OPT=-O1 SAN="$san" WERROR= $(echo "$objects" | sed "s|^|$1/|") >"$root/make" 2>&1 &&
        gcc $san -shared -o "$1/libgnomon.so" $(echo "$objects" | sed "s|^|$1/|")
}
programs() { # programs PASS NAME...: builds them; they stay linked to the library as it is then
    pass=$1
    shift
    case $pass in first) san=$flags ;; again) san="$flags -fsanitize=address,undefined -fno-sanitize-recover=all" ;; esac
    make -s BUILD="$pass" OPT="-O2 -Wl,--no-as-needed" HOST_OPT=-O1 SAN="$san" WERROR= LIB_OBJ="$pass/libgnomon.so" -o "$pass/libgnomon.so" \
        $(printf "$pass/%s " "$@") >"$root/make" 2>&1
}
signature() { (cd first && cat $objects) | cksum; }
run() { # run PASS NAME SECONDS, of CPU time
    (ulimit -t "$3" && SCENES=3000 "$1/$2" >"$root/out" 2>&1)
}

gcc -std=c11 -O1 -o "$root/mutants" tests/mutation/mutants.c || exit 1

# The original, and how long its tests take.
prepare() { # prepare PASS NAME...
    pass=$1
    shift
    library "$pass" && programs "$pass" "$@" || { tail -n 5 "$root/make"; exit 1; }
    for name in "$@"; do
        [ "$pass/$name.seconds" -nt "$pass/$name" ] && continue
        run "$pass" "$name" 1000 || { echo "$name fails without a mutant: $(tail -n 1 "$root/out")"; exit 1; }
        (run "$pass" "$name" 1000; times) | awk -F '[ms ]+' 'NR == 2 { printf "%.0f\n", 4 * (60 * $1 + $2) + 1.5 }' >"$pass/$name.seconds"
    done
}

# judge PASS: reads mutants, and writes what became of each.
judge() {
    pass=$1
    while IFS= read -r mutant; do
        [ $(($(date +%s) - begin)) -lt $((60 * MINUTES)) ] || break
        file=$(echo "$mutant" | cut -d ' ' -f 1) line=$(echo "$mutant" | cut -d ' ' -f 2) column=$(echo "$mutant" | cut -d ' ' -f 3)
        length=$(echo "$mutant" | cut -d ' ' -f 4) text=$(echo "$mutant" | cut -d ' ' -f 5-)
        cp "$file" "$root/source"
        TEXT="$text" awk -v l="$line" -v c="$column" -v n="$length" \
            'NR == l { $0 = substr($0, 1, c - 1) ENVIRON["TEXT"] substr($0, c + n) } { print }' "$root/source" >"$file"
        by=SURVIVED built=
        if ! library "$pass"; then by="not built"
        elif [ "$pass" = first ] && [ "$(signature)" = "$original" ]; then by="same code"
        else
            for name in $(tests_of "$pass" "$file"); do
                case $file in *.h) built="$built $name" && { programs "$pass" "$name" || { by="not built" && break; }; } ;; esac
                run "$pass" "$name" "$(cat "$pass/$name.seconds")" || { by="killed by $name" && break; }
            done
        fi
        cp "$root/source" "$file"
        [ -z "$built" ] || { library "$pass" && programs "$pass" $built; } # as they were
        echo "$by: $mutant"
    done
}

begin=$(date +%s)
trap '[ -f "$root/source" ] && cp "$root/source" "$file"; exit 1' HUP INT TERM
if [ -n "$ONLY" ]; then echo "$ONLY"; else "$root/mutants" "$SEED" "$N" $FILES; fi >"$root/chosen"
[ -z "$ONLY$AGAIN" ] || rm -f "$found/again"
[ -z "$ONLY" ] || rm -f "$found/first"
touch "$found/first" "$found/again"

# What of the files is in the tree of the last mutant, if that was stopped, is the original by now: copied above.
prepare first $(for file in $FILES; do tests_of first "$file"; done | sort -u)
original=$(signature)
tail -n +$(($(wc -l <"$found/first") + 1)) "$root/chosen" | judge first >>"$found/first"

grep '^SURVIVED' "$found/first" | sed 's/^SURVIVED: //' >"$root/survivors"
prepare again $names
tail -n +$(($(wc -l <"$found/again") + 1)) "$root/survivors" | judge again >>"$found/again"

grep '^SURVIVED' "$found/again"
for folder in $(sed 's|^[^:]*: lib/||; s|/.*||' "$found/first" | sort -u) all; do
    pattern=": lib/$folder/"
    [ "$folder" = all ] && pattern=": lib/"
    count() { cat "$found/$1" | grep "^$2" | grep -c "$pattern"; }
    survived=$(($(count first SURVIVED) - $(count again killed))) killed=$(($(count first killed) + $(count again killed)))
    printf '%-10s %4d killed %4d survived %4d same code %4d not built  score %s %%\n' "$folder" $killed $survived "$(count first same)" "$(count first not)" \
        "$(awk -v k=$killed -v s=$survived 'BEGIN { printf "%.1f", k + s ? 100 * k / (k + s) : 0 }')"
done
