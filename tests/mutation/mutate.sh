#!/bin/sh
# Mutation testing: single-point mutants of lib/ (tests/mutation/mutants.c: operators, constants, conditions, statements), each built
# and run against the tests until one fails. Prints the survivors, the score, and what was run; also in build/mutate/log. make mutate
#   [SEED=n]      which mutants; the same seed chooses the same ones of the same sources. By default the date
#   [N=150]       how many. With MINUTES=m none begins after m minutes
#   [FILES="lib/scene/gn_scene.c ..."]    of these; else of lib/ without the generated tables, and lib/compact, which test_compact.sh tests
#   [TESTS="test_golden test_frame"]     run against these, after those of the file's folder
#   [ONLY="FILE LINE COLUMN LENGTH TEXT"] this one
# A mutant whose object code is the same is no mutant; nor is one that does not compile. A test that does not end kills.
cd "$(dirname "$0")/../.." || exit 1
root=$PWD/build/mutate tree=$PWD/build/mutate/tree
: "${SEED:=$(date +%Y%m%d)}" "${N:=150}" "${MINUTES:=10000}"
: "${FILES:=$(find lib -mindepth 2 -name 'gn_*.[ch]' | grep -v -e gn_tables -e lib/compact/ | sort | tr '\n' ' ')}"

# The tree is copied: the sources stay as they are. Objects of before are kept where the sources are the same.
mkdir -p "$tree"
for folder in lib host boards port tests; do
    mkdir -p "$tree/$folder"
    (cd $folder && find . -type f) | while read -r file; do
        cmp -s "$folder/$file" "$tree/$folder/$file" || { mkdir -p "$(dirname "$tree/$folder/$file")" && cp "$folder/$file" "$tree/$folder/$file"; }
    done
done
cp Makefile "$tree/"
cd "$tree" || exit 1

# Tests of a file: those of its name and folder first, then whatever compares all pixels, then the others, cheap ones first.
first() {
    stem=$(basename "$1" | sed 's/^gn_//; s/\..*//')
    [ ! -f tests/unit/test_"$stem".c ] || echo "test_$stem"
    case $1 in
    lib/base/*) echo test_math test_affine test_pixel ;;
    lib/geometry/*) echo test_affine test_clip test_walk ;;
    lib/scene/* | lib/frame/*) echo test_refused test_limits test_defaults test_reentry test_frame ;;
    lib/light/*) echo test_object test_receiver_bias test_lists test_punctual test_limits ;;
    lib/shadow/*) echo test_persp test_casters test_filter test_window test_tiles test_kept ;;
    lib/visible/*) echo test_runs test_walk test_frame ;;
    lib/shade/*) echo test_pixel test_radiance test_corner test_arrival ;;
    esac
}
: "${TESTS:=test_golden test_frame test_refused test_limits test_changes test_kept test_lists test_walk test_runs test_tiles test_window test_defaults
    test_vertex_cache test_affine test_math test_pixel test_arrival test_corner test_alpha test_texture test_clip test_reentry test_persp test_receiver_bias test_object test_filter
    test_punctual test_radiance test_casters test_random test_stages test_culling test_extremes test_extremes_light test_corner_cases test_bias
    test_screen test_contact}"
tests_of() { # in that order, each once, if there is such a test
    for name in $(first "$1") $TESTS; do [ -z "$(find tests -name "$name.c")" ] || echo "$name"; done | awk '!seen[$1]++'
}

# Built hardly optimised, without line numbers, which a mutant changes, and with what sees undefined behaviour.
build() { make -s -j2 BUILD=b OPT=-O1 SAN="-g0 -fsanitize=undefined -fno-sanitize-recover=all" WERROR= "$@" >"$root/make" 2>&1; }
library=$(for file in lib/*/*.c; do case $file in lib/compact/*) ;; *) echo "b/obj/${file%.c}.o" ;; esac; done)
signature() { cat $library | cksum; }
run() { (ulimit -t 60 && SCENES=3000 "b/$1" >"$root/out" 2>&1); } # seconds of CPU time

gcc -std=c11 -O1 -o "$root/mutants" tests/mutation/mutants.c || exit 1
build $library || { tail -n 5 "$root/make"; exit 1; }
original=$(signature)
for name in $TESTS; do
    [ -z "$(find tests -name "$name.c")" ] && continue
    build "b/$name" && run "$name" || { echo "$name fails without a mutant: $(tail -n 1 "$root/make" "$root/out")"; exit 1; }
done

if [ -n "$ONLY" ]; then echo "$ONLY"; else "$root/mutants" "$SEED" "$N" $FILES; fi >"$root/chosen"
begin=$(date +%s)
killed=0 survived=0 same=0 not_built=0
trap 'exit 1' HUP INT TERM
while IFS= read -r mutant; do
    [ $(($(date +%s) - begin)) -lt $((60 * MINUTES)) ] || break
    file=$(echo "$mutant" | cut -d ' ' -f 1) line=$(echo "$mutant" | cut -d ' ' -f 2) column=$(echo "$mutant" | cut -d ' ' -f 3)
    length=$(echo "$mutant" | cut -d ' ' -f 4) text=$(echo "$mutant" | cut -d ' ' -f 5-)
    cp "$file" "$root/source"
    TEXT="$text" awk -v l="$line" -v c="$column" -v n="$length" \
        'NR == l { $0 = substr($0, 1, c - 1) ENVIRON["TEXT"] substr($0, c + n) } { print }' "$root/source" >"$file"
    by=
    if ! build $library; then by="does not build" not_built=$((not_built + 1))
    elif [ "$(signature)" = "$original" ]; then by="the same code" same=$((same + 1))
    else
        for names in "$(tests_of "$file" | head -n 3)" "$(tests_of "$file" | tail -n +4)"; do # the first alone: most mutants die there
            build $(echo "$names" | sed 's|^|b/|')
            for name in $names; do
                run "$name" && continue
                by="killed by $name" killed=$((killed + 1))
                break 2
            done
        done
    fi
    [ -n "$by" ] || survived=$((survived + 1))
    cp "$root/source" "$file"
    echo "${by:-SURVIVED}: $file:$line: $(sed -n "${line}p" "$file" | sed 's/^ *//') [$(sed -n "${line}p" "$file" | cut -c "$column-$((column + length - 1))") -> $text]"
done <"$root/chosen" >"$root/results"
build $library
grep '^SURVIVED' "$root/results"
# Mutants of the same code, or that do not build, are not counted.
score=$((killed + survived > 0 ? 1000 * killed / (killed + survived) : 0))
line="seed $SEED: $killed killed, $survived survived, $same of the same code, $not_built not built: score $((score / 10)).$((score % 10)) % in $(($(date +%s) - begin)) s"
echo "$(date -u +%Y-%m-%d) $line" | tee -a "$root/log"
