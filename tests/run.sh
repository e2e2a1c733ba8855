#!/bin/sh
# Runs every test and ends with "N passed, N failed". Installs what is missing first.
cd "$(dirname "$0")/.." || exit 1
passed=0 failed=0
log=build/test.log
mkdir -p build/tmp
: >"$log"

# ---- What the tests need: command or file, and the Debian package that has it ----------------------------------------------

missing_packages() {
    while read -r probe package; do
        case $probe in
        /*) ls $probe >/dev/null 2>&1 || echo "$package" ;;
        *) command -v "$probe" >/dev/null 2>&1 || echo "$package" ;;
        esac
    done <<'NEEDS'
gcc gcc
g++ g++
make make
clang clang
/usr/lib/llvm-*/lib/clang/*/lib/linux/libclang_rt.asan-x86_64.a libclang-rt-dev
valgrind valgrind
arm-none-eabi-gcc gcc-arm-none-eabi
qemu-system-arm qemu-system-arm
qemu-system-riscv32 qemu-system-misc
riscv64-unknown-elf-gcc gcc-riscv64-unknown-elf
pkg-config pkg-config
/usr/include/OpenImageIO/imageio.h libopenimageio-dev
/usr/include/stdio.h libc6-dev
/usr/lib/gcc/x86_64-linux-gnu/*/32/libgcc.a gcc-multilib
NEEDS
}

install_missing() {
    packages=$(missing_packages | sort -u | tr '\n' ' ')
    [ -n "$packages" ] || return 0
    echo "installing what the tests need: $packages"
    root=
    if [ "$(id -u)" != 0 ]; then
        if command -v sudo >/dev/null 2>&1; then root=sudo; else
            echo "not root and no sudo: please install: $packages"
            echo "0 passed, 1 failed"
            exit 1
        fi
    fi
    { $root apt-get -o DPkg::Lock::Timeout=500 update &&
        $root env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=500 install -y --no-install-recommends $packages; } >>"$log" 2>&1
    packages=$(missing_packages | sort -u | tr '\n' ' ')
    if [ -n "$packages" ]; then
        tail -n 5 "$log"
        echo "could not install: $packages"
        echo "0 passed, 1 failed"
        exit 1
    fi
}

# ---- Running -----------------------------------------------------------------------------------------------------------

# Adds up what one test left in build/tmp/run: NAME.out, NAME.status, NAME.seconds. A program that ends without its closing line, or
# with an exit status that contradicts it, failed.
report() { # report KEY NAME
    out=build/tmp/run/$1.out
    status=$(cat "build/tmp/run/$1.status" 2>/dev/null || echo 1)
    cat "$out" >>"$log"
    line=$(tail -n 1 "$out" | grep -E '^[0-9]+ passed, [0-9]+ failed$')
    p=$(echo "${line:-0}" | cut -d' ' -f1) f=$(echo "${line:-0 passed, 1 failed}" | cut -d' ' -f3)
    [ "$status" = 0 ] || [ "$f" -gt 0 ] || f=1
    passed=$((passed + p)) failed=$((failed + f))
    printf '%-44s %8d passed %4d failed %4ds\n' "$2" "$p" "$f" "$(cat "build/tmp/run/$1.seconds" 2>/dev/null || echo 0)"
    [ "$f" = 0 ] || grep -v '^[0-9]* passed' "$out" | head -n 20
}

# together LABEL: the tests in build/tmp/jobs, a line "KEY COMMAND" each, two at a time.
together() {
    rm -rf build/tmp/run
    mkdir -p build/tmp/run
    xargs -P 2 -I '{}' sh -c '
        key=${1%% *} command=${1#* } start=$(date +%s)
        sh -c "$command" >"build/tmp/run/$key.out" 2>&1
        echo $? >"build/tmp/run/$key.status"
        echo $(($(date +%s) - start)) >"build/tmp/run/$key.seconds"' run '{}' <build/tmp/jobs
    while read -r key _; do report "$key" "$key${1:+, $1}"; done <build/tmp/jobs
}

# build TARGET...: a build that fails is a failed test
build() {
    if ! make -s -j2 "$@" >build/tmp/make 2>&1; then
        grep -v '^  [A-Z]* ' build/tmp/make | head -n 20
        echo "make $* failed"
        failed=$((failed + 1))
    fi
    cat build/tmp/make >>"$log"
}

# What takes minutes at -O0 runs once. That every compiler draws the same bytes at every optimisation is for test_boards.sh to say.
once="test_rows test_seams test_accuracy"

variant() { # variant COMPILER OPTIMISATION [1: with the tests that run once]
    dir=build/test/$1$2 host=$2
    [ "$2" = -O0 ] && host=-O1 # the oracles and the tests; the library itself stays without optimisation
    build test-programs BUILD="$dir" CC="$1" OPT="$2" HOST_OPT="$host" SAN="-fsanitize=address,undefined -fno-sanitize-recover=all"
    for program in tests/*/test_*.c; do
        name=$(basename "$program" .c)
        case " $once " in *" $name "*) [ "${3:-0}" = 1 ] || continue ;; esac
        echo "$name $dir/$name"
    done >build/tmp/jobs
    together "$1 $2"
}

install_missing
build all
build build/test_oiio build/make_report build/test_stages build/test_casters build/test_radiance build/test_punctual build/test_accuracy build/test_bias build/test_contact build/test_census build/test_rows build/test_seams build/test_crawl \
    build/test_kept build/test_culling build/test_lists build/test_changes build/test_extremes build/test_extremes_light build/test_extremes_many build/gen_tables
variant gcc -O2 1
variant clang -O0
build build/test/threads/test_cores BUILD=build/test/threads SAN=-fsanitize=thread
build build/test/memory/test_random BUILD=build/test/memory CC=clang SAN=-fsanitize=memory
{
    for script in tests/*/test_*.sh; do echo "$(basename "$script" .sh) sh $script build/gnomon"; done
    echo "test_oiio build/test_oiio"
    echo "threads build/test/threads/test_cores"
    echo "memory build/test/memory/test_random"
    echo 'bench sh tests/bench/bench.sh >build/tmp/bench.log 2>&1 && echo "1 passed, 0 failed" || { cat build/tmp/bench.log; exit 1; }'
    echo 'run make -s run >build/tmp/run.log 2>&1 && echo "1 passed, 0 failed" || { cat build/tmp/run.log; exit 1; }'
} >build/tmp/jobs
together
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
