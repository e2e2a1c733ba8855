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
# THOROUGH=1, as make soak runs it: also combinations whose parts are tested each.
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
}"
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
sanitizers="-g1 -fsanitize=address,undefined -fno-sanitize-recover=all" # -g1: line numbers alone, less to write and to link

# Pictures by the hundred, against floors: they take five times as long under sanitizers, where make soak runs them, too.
# The random scenes of test_golden_random are others there: the compiler chooses the order of some random numbers.
pictures="test_accuracy test_rows test_seams test_views test_golden_random"
build all $(for name in $pictures test_fit test_extremes test_extremes_light test_extremes_many test_oiio make_report gen_tables; do echo "build/$name"; done)
for name in $pictures; do job $name build/$name; done
job test_fit build/test_fit # and a quarter of its scenes under sanitizers

# Scripts that take long go first, so that none of them is left alone in the end; before those that fill two cores, those that fill one.
scripts="tests/firmware/test_absent.sh tests/tool/test_sweep.sh tests/tool/test_compile.sh tests/tool/test_tool.sh tests/firmware/test_boards.sh
    tests/property/test_config.sh tests/oracle/test_compact.sh tests/firmware/test_size.sh tests/firmware/test_pico.sh"
for script in $scripts $(ls tests/*/test_*.sh); do
    name=$(basename "$script" .sh).sh
    grep -q "^$name " build/tmp/jobs || job "$name" "sh $script build/gnomon"
done
job test_oiio build/test_oiio
job bench 'sh tests/bench/bench.sh >build/tmp/bench.log 2>&1 && echo "1 passed, 0 failed" || { cat build/tmp/bench.log; exit 1; }'
job run 'make -s run >build/tmp/run.log 2>&1 && echo "1 passed, 0 failed" || { cat build/tmp/run.log; exit 1; }'

# Every program with GCC; those that need the library alone with Clang, which sees other faults, too, hardly optimised: its checks are
# made before it optimises.
build test-programs BUILD=build/test/gcc CC=gcc HOST_OPT=-O1 SAN="$sanitizers"
for name in $(names unit oracle reference property tool firmware); do
    case " $pictures " in *" $name "*) continue ;; esac
    few=
    [ "$name$THOROUGH" != test_fit ] || few="SCENES=60 "
    job "gcc-O2/$name" "${few}build/test/gcc/$name"
done
build alone-programs BUILD=build/test/clang CC=clang OPT=-O1 SAN="$sanitizers"
for program in build/test/clang/test_*; do job "clang-O1/$(basename "$program")" "$program"; done

# Firmware has constants for knobs; not optimised, as Clang takes ten times as long to optimise what it sanitizes as to run it. Of one preset the atlases differ: a view of one must not point into the other.
# constants NAME FLAGS: warnings of a configuration are for test_config.sh, which compiles the one file that users do
constants() {
    build constant-programs WERROR= BUILD=build/test/"$1" CC=clang OPT=-O0 SAN="$sanitizers" CONSTANTS="$2"
    for program in build/test/"$1"/test_*; do job "$1/$(basename "$program")" "SCENES=1000 $program"; done # test_shipped.sh has more of them
}
constants balanced "-DGN_PRESET=GN_PRESET_BALANCED -DGN_ATLAS_SIZE=64 -DGN_OTHER_ATLAS_SIZE=256"
[ -z "$THOROUGH" ] || constants tiny "-DGN_PRESET=GN_PRESET_TINY -DGN_ATLAS_SIZE=64 -DGN_OTHER_ATLAS_SIZE=64"
[ -z "$THOROUGH" ] || constants fast "-DGN_PRESET=GN_PRESET_FAST -DGN_ATLAS_SIZE=64 -DGN_OTHER_ATLAS_SIZE=64"
[ -z "$THOROUGH" ] || constants accurate "-DGN_PRESET=GN_PRESET_ACCURATE -DGN_ATLAS_SIZE=128 -DGN_OTHER_ATLAS_SIZE=128"

build build/test/threads/test_cores BUILD=build/test/threads OPT=-O1 SAN=-fsanitize=thread
job threads/test_cores build/test/threads/test_cores
build build/test/memory/test_random BUILD=build/test/memory CC=clang OPT=-O1 SAN=-fsanitize=memory
job memory/test_random "SCENES=4000 build/test/memory/test_random"

# ---- What is run -----------------------------------------------------------------------------------------------------------

cut -d' ' -f1 build/tmp/jobs | sed "s|^|$run/|" | xargs -n 1 dirname | sort -u | xargs mkdir -p
sed 's/ /\n/' build/tmp/jobs | tr '\n' '\0' | xargs -0 -P 2 -n 2 sh tests/run.sh --job
while read -r key _; do cat "$run/$key.out"; done <build/tmp/jobs >>build/test.log
counts=$(while read -r key _; do cat "$run/$key.count" || echo "0 1"; done <build/tmp/jobs | awk -v f=$failed '{ p += $1; f += $2 } END { print p + 0, f + 0 }')
echo "${counts% *} passed, ${counts#* } failed"
[ "${counts#* }" = 0 ]
