#!/bin/sh
# The campaigns, each in a build of its own under the address and undefined-behaviour sanitizers, with progress on a terminal. What was run
# goes to build/soak.log: date, commit, campaign, seed, scenes, result. usage: [SEED=n] [SCENES=n] [MODELS="a.obj b.glb"] [MINUTES=n] [CAMPAIGNS="random census"] soak.sh
#
# random    10^6 random scenes: nothing undefined, nothing changed that was kept (tests/property/test_random.c), some minutes
# fine      10^5 random scenes of fine meshes, by other screen tiles and orders the same (tests/property/test_fine.c), twenty minutes
# unchanged 10^6 frames in which little changes, against fresh renderers (tests/property/test_unchanged.c), an hour
# shipped   10^5 random scenes of each configuration that ships, and with poisoned gaps in the state (tests/property/test_shipped.sh), half an hour
# fuzz      scenes and files by coverage, where Clang has libFuzzer (tests/property/test_random.c, tests/tool/test_fuzz.c), MINUTES=60 each
# extremes  20000 random scenes against the reference (tests/oracle/test_extremes_many.c), about an hour
# census    planes at 100 times as many angles (tests/oracle/test_census.c)
# fit       tight fits of 1000 random scenes (tests/oracle/test_fit.c), some minutes
# culling   casters left out at many more places (tests/property/test_culling.c)
# panels    10^6 damaged programs of calls to panel drivers, on failing buses (tests/firmware/test_panel_fuzz.c), an hour
# math      every operand of the reciprocal and of the root (tests/unit/test_math.c)
# files     10^6 damaged files of each of six kinds, scenes and pictures (tests/tool/test_fuzz.c), an hour; KINDS="png glb": of these
# valley    folds at every angle (tests/oracle/test_valley.c), of which make test has every second of each combination
# models    the accuracy of meshes that MODELS names (tests/oracle/test_accuracy.c), a minute each
# machines  the golden frames and the panel tests on big-endian hosts and as WebAssembly (tests/firmware/machines.sh), ten minutes
# accuracy, rows, seams, views    hundreds of pictures against floors, which make test draws without sanitizers: a quarter of an hour
# suite     make test with THOROUGH=1: also the combinations whose parts it tests each, and every program under the sanitizers of both compilers, an hour
cd "$(dirname "$0")/.." || exit 1
build=build/soak
: "${SEED:=$(date +%Y%m%d)}" "${CAMPAIGNS:=random fine unchanged shipped fuzz files panels math culling fit valley census accuracy rows seams views machines suite ${MODELS:+models }extremes}"
asked=$SCENES
passed=0 failed=0

# campaign NAME SCENES: how many, unless SCENES says otherwise; 0: it has no scenes to count
campaign() {
    program=$build/test_$1 option=
    case $1 in
    extremes) program=$build/test_extremes_many option=--random ;;
    files) program=$build/test_fuzz ;;
    panels) program=$build/test_panel_fuzz ;;
    models) program=$build/test_accuracy option=--models ;;
    esac
    SCENES=${asked:-$2}
    if ! make -s -j2 "$program" BUILD=$build SAN="-fsanitize=address,undefined -fno-sanitize-recover=all" >$build/make 2>&1; then
        tail -n 5 $build/make
        failed=$((failed + 1))
        return
    fi
    echo "$1: seed $SEED$([ "$2" = 0 ] || echo ", $SCENES scenes")"
    start=$(date +%s)
    SOAK=1 SEED=$SEED SCENES=$SCENES "$program" $option >$build/$1.out
    record $? "$1"
}

shipped() {
    echo "shipped: seed $SEED"
    start=$(date +%s)
    SCENES=${asked:-100000} SOAK=1 SEED=$SEED sh tests/property/test_shipped.sh >$build/shipped.out
    SCENES=${asked:-100000} record $? shipped
}

# by_coverage NAME TARGET: test_TARGET as a libFuzzer. What it has reached is kept in build/soak/corpus for the next time; an input that fails is named in its output
by_coverage() {
    minutes=${MINUTES:-60} corpus=$build/corpus/$1 program=$build/fuzz/test_$2
    echo "fuzz-$1: seed $SEED, $minutes minutes"
    mkdir -p "$corpus"
    if ! make -s -j2 "$program" BUILD=$build/fuzz CC=clang OPT=-O1 WERROR= \
        SAN="-fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -DLIBFUZZER" >$build/make 2>&1; then
        tail -n 5 $build/make
        failed=$((failed + 1))
        return
    fi
    seeds=
    [ "$1" != files ] || seeds=build/tmp/fuzz/seeds
    [ -z "$seeds" ] || mkdir -p $seeds
    start=$(date +%s)
    "$program" -seed="$SEED" -max_total_time=$((60 * minutes)) -max_len=16384 -len_control=0 -timeout=60 -print_final_stats=1 \
        -artifact_prefix="$build/fuzz/$1-" "$corpus" $seeds >"$build/fuzz-$1.out" 2>&1
    status=$?
    grep -a -E 'ERROR|runtime error|failed:|Test unit written' "$build/fuzz-$1.out" | head -n 5
    [ $status = 0 ] || echo "0 passed, 1 failed" >>"$build/fuzz-$1.out"
    sed -n 's/^stat::number_of_executed_units: *\([0-9]*\)$/\1 passed, 0 failed/p' "$build/fuzz-$1.out" >"$build/fuzz-$1.count"
    [ $status != 0 ] || cat "$build/fuzz-$1.count" >>"$build/fuzz-$1.out"
    SCENES=0 record $status "fuzz-$1"
}

fuzz() {
    mkdir -p $build/fuzz
    echo 'int LLVMFuzzerTestOneInput(const unsigned char *bytes, unsigned long n); int LLVMFuzzerTestOneInput(const unsigned char *bytes, unsigned long n) { return !bytes && n; }' >$build/fuzz/probe.c
    if ! clang -fsanitize=fuzzer -o $build/fuzz/probe $build/fuzz/probe.c >/dev/null 2>&1; then
        echo "$(date -u +%Y-%m-%d) fuzz left out: there is no clang with libFuzzer (Debian: clang libclang-rt-dev)" | tee -a build/soak.log
        return
    fi
    by_coverage scenes random
    by_coverage files fuzz
}

machines() {
    echo machines
    start=$(date +%s)
    sh tests/firmware/machines.sh >$build/machines.out
    SCENES=0 record $? machines
}

suite() {
    echo suite
    start=$(date +%s)
    (
        unset SEED SCENES # of programs that are campaigns of their own, and of make run
        THOROUGH=1 sh tests/run.sh >$build/suite.out
    )
    SCENES=0 record $? suite
}

record() { # record STATUS NAME: what its last line counts
    status=$1 && shift
    line=$(tail -n 1 $build/$1.out | grep -E '^[0-9]+ passed, [0-9]+ failed$')
    p=$(echo "${line:-0}" | cut -d' ' -f1) f=$(echo "${line:-0 passed, 1 failed}" | cut -d' ' -f3)
    [ "$status" = 0 ] || [ "$f" -gt 0 ] || f=1
    passed=$((passed + p)) failed=$((failed + f))
    grep -E '^seed|failed:|[1-9][0-9]* failed .*s$' $build/$1.out | head -n 20
    echo "$(date -u +%Y-%m-%d) $(git rev-parse --short HEAD 2>/dev/null) $1 seed $SEED scenes $SCENES: $p passed, $f failed in $(($(date +%s) - start)) s" | tee -a build/soak.log
}

mkdir -p $build
for name in $CAMPAIGNS; do
    case $name in
    random | unchanged) campaign $name 1000000 ;;
    files | panels) campaign $name 1000000 ;;
    fine) campaign fine 100000 ;;
    extremes) campaign extremes 20000 ;;
    fit) campaign fit 1000 ;;
    shipped) shipped ;;
    fuzz) fuzz ;;
    suite) suite ;;
    machines) machines ;;
    census | culling | math | valley | models | accuracy | rows | seams | views) campaign $name 0 ;;
    *) echo "no such campaign: $name" && failed=$((failed + 1)) ;;
    esac
done
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
