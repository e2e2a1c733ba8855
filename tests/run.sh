#!/bin/sh
# Runs every test, two at a time, and ends with "N passed, N failed". A test prints a line when it is done, and what failed;
# all that it printed is in build/test.log. The tools: tests/deps.sh.
#
#   unit/       a part of the library each, found by its stem
#   oracle/     the library against the reference, the ray tracer, or the specification's extremes
#   reference/  the reference and the ray tracer against closed forms
#   property/   what must hold of any scene: nothing kept, culled or drawn elsewhere changes a pixel; what is refused
#   tool/       the command line, scene files, baking, compiled scenes
#   firmware/   boards, ports, displays, and what they take of flash, RAM and stack
#   documents/  rules of the source, and documents that say what is so
#   prove/      what Frama-C proves of lib/: make prove, not here: it is no tool of the tests
#   bench/      instructions against baselines
#   web/        the playground as WebAssembly in node; the page in a browser: make test-playground, which takes minutes
#
# THOROUGH=1, as make soak runs it: also combinations whose parts are tested each, and every program under the sanitizers of both compilers.
cd "$(dirname "$0")/.." || exit 1
run=build/tmp/run
export WERROR=-Werror # of every make

# ---- run.sh --job KEY COMMAND: one test. Without its closing line, or with an exit status that contradicts it, it failed. -----

if [ "$1" = --job ]; then
    key=$2 start=$(date +%s)
    sh -c "$3" >"$run/$key.out" 2>&1
    status=$?
    times >"$run/$key.times" # of the command and what it ran, on both cores
    cpu=$(awk -F '[ms ]+' 'NR == 2 { printf "%.0f", 60 * ($1 + $3) + $2 + $4 }' "$run/$key.times")
    line=$(tail -n 1 "$run/$key.out" | grep -E '^[0-9]+ passed, [0-9]+ failed$')
    p=$(echo "${line:-0}" | cut -d' ' -f1) f=$(echo "${line:-0 passed, 1 failed}" | cut -d' ' -f3)
    [ "$status" = 0 ] || [ "$f" -gt 0 ] || f=1
    echo "$p $f" >"$run/$key.count"
    said=$([ "$f" = 0 ] || grep -v '^[0-9]* passed' "$run/$key.out" | head -n 20)
    printf '%-32s %8d passed %4d failed %4d CPU-s %4ds\n%s' "$key" "$p" "$f" "$cpu" "$(($(date +%s) - start))" "${said:+$said
}" >"$run/$key.said"
    cat "$run/$key.said"
    exit 0
fi

# ---- What is built ---------------------------------------------------------------------------------------------------------

failed=0
rm -rf $run
mkdir -p $run
: >build/tmp/jobs
: >build/test.log

job() { # job KEY COMMAND
    echo "$1 $2" >>build/tmp/jobs
}
# build TARGET...: a build that fails is a failed test
build() {
    if ! make -s -j2 "$@" >build/tmp/make 2>&1; then
        grep -v '^  [A-Z]* ' build/tmp/make | head -n 20
        echo "make $* failed"
        failed=$((failed + 1))
    fi
    cat build/tmp/make >>build/test.log
}
names() { # names FOLDER...: the programs of these folders of tests/
    for folder in "$@"; do
        for program in tests/"$folder"/test_*.c; do basename "$program" .c; done
    done
}
. tests/support/sanitized.sh

# Every program with GCC, optimised as users do. What takes long goes first, so that none of it is left alone in the end; of scripts, before
# those that fill two cores, those that fill one.
build all test-programs build/test_oiio build/make_report build/gen_tables SAN=-g0 # a quarter of the time to compile is for debuggers
pictures="test_accuracy test_rows test_seams test_views"
for name in $pictures test_fit test_valley; do job $name build/$name; done
scripts="tests/firmware/test_absent.sh tests/tool/test_sweep.sh tests/tool/test_compile.sh tests/tool/test_tool.sh tests/firmware/test_boards.sh
    tests/property/test_config.sh tests/oracle/test_compact.sh tests/firmware/test_size.sh tests/firmware/test_pico.sh"
for script in $scripts $(ls tests/*/test_*.sh); do
    name=$(basename "$script" .sh).sh
    grep -q "^$name " build/tmp/jobs || job "$name" "sh $script build/gnomon"
done
for name in $(names unit oracle reference property tool firmware); do
    grep -q "^$name " build/tmp/jobs || job "$name" "build/$name"
done
job test_oiio build/test_oiio
job bench 'sh tests/bench/bench.sh >build/tmp/bench.log 2>&1 && echo "1 passed, 0 failed" || { cat build/tmp/bench.log; exit 1; }'
job run 'make -s run >build/tmp/run.log 2>&1 && echo "1 passed, 0 failed" || { cat build/tmp/run.log; exit 1; }'

# Once under sanitizers, with Clang, the library not optimised, as it takes ten times as long to optimise what it sanitizes as to run it: what needs the
# library alone has constants for knobs, as firmware has, the others are the tool's, the boards' and those that choose their knobs. The oracles,
# which draw pictures by the hundred, and programs with floors for the random scenes of GCC (the compiler chooses the order of random numbers)
# or bytes of its sines (test_scenes) are left to make soak.
programs=$(for name in $(names tool firmware | grep -v -x test_scenes) arrival casters corner radiance refused runs tiles; do echo "build/test/clang/test_${name#test_}"; done)
build $programs $sanitized_clang SAN="$sanitizers"
for program in $programs; do job "clang-O0/${program##*/}" "$program"; done
if [ "$THOROUGH" ]; then # all of it optimised, too, and every program with GCC, but for pictures, which have campaigns of their own
    build alone-programs BUILD=build/test/clang-O1 CC=clang OPT=-O1 SAN="$sanitizers"
    for program in build/test/clang-O1/test_*; do job "clang-O1/${program##*/}" "$program"; done
    build test-programs $sanitized_gcc SAN="$sanitizers"
    job gcc-O2/test_tool_sanitized.sh "SANITIZED_BY=gcc sh tests/tool/test_tool_sanitized.sh"
    for name in $(names unit oracle reference property tool firmware); do
        case " $pictures test_golden_random " in *" $name "*) ;; *) job "gcc-O2/$name" "build/test/gcc/$name" ;; esac
    done
fi

# Of one preset the atlases differ: a view of one must not point into the other.
# constants NAME FLAGS: warnings of a configuration are for test_config.sh, which compiles the one file that users do
constants() {
    build constant-programs WERROR= BUILD=build/test/"$1" CC=clang OPT=-O0 ONE_FILE=1 SAN="$sanitizers" CONSTANTS="$2"
    for program in build/test/"$1"/test_*; do job "$1/$(basename "$program")" "SCENES=500 $program"; done # as many as test_shipped.sh has
}
constants balanced "-DGN_PRESET=GN_PRESET_BALANCED -DGN_ATLAS_SIZE=64 -DGN_OTHER_ATLAS_SIZE=256"
[ -z "$THOROUGH" ] || constants tiny "-DGN_PRESET=GN_PRESET_TINY -DGN_ATLAS_SIZE=64 -DGN_OTHER_ATLAS_SIZE=64"
[ -z "$THOROUGH" ] || constants fast "-DGN_PRESET=GN_PRESET_FAST -DGN_ATLAS_SIZE=64 -DGN_OTHER_ATLAS_SIZE=64"
[ -z "$THOROUGH" ] || constants accurate "-DGN_PRESET=GN_PRESET_ACCURATE -DGN_ATLAS_SIZE=128 -DGN_OTHER_ATLAS_SIZE=128"

build build/test/threads/test_cores BUILD=build/test/threads CC=clang OPT=-O0 ONE_FILE=1 SAN=-fsanitize=thread
job threads/test_cores build/test/threads/test_cores

# ---- What is run -----------------------------------------------------------------------------------------------------------

cut -d' ' -f1 build/tmp/jobs | sed "s|^|$run/|" | xargs -n 1 dirname | sort -u | xargs mkdir -p
sed 's/ /\n/' build/tmp/jobs | tr '\n' '\0' | xargs -0 -P 2 -n 2 sh tests/run.sh --job
while read -r key _; do cat "$run/$key.out"; done <build/tmp/jobs >>build/test.log
counts=$(while read -r key _; do cat "$run/$key.count" || echo "0 1"; done <build/tmp/jobs | awk -v f=$failed '{ p += $1; f += $2 } END { print p + 0, f + 0 }')
# once more, in the end, what failed: of a long log, its end is what people read
while read -r key _; do
    [ -f "$run/$key.count" ] || { echo "$key did not end"; continue; }
    grep -q " 0$" "$run/$key.count" || cat "$run/$key.said"
done <build/tmp/jobs
[ $failed = 0 ] || echo "builds failed: $failed; see above, and build/test.log"
echo "${counts% *} passed, ${counts#* } failed"
[ "${counts#* }" = 0 ]
