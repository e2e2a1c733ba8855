#!/bin/sh
# The same bits on machines of other kinds, under emulation: big-endian s390x (64 bits) and PowerPC (32 bits) by qemu-user, and wasm32 by
# node. The golden frames go the whole way, loaders and all; panel drivers see both orders of bytes. make machines; some minutes.
# [MACHINES="s390x powerpc wasm32"]: those without a compiler or emulator are named and left out (Debian: gcc-s390x-linux-gnu
# libc6-dev-s390x-cross gcc-powerpc-linux-gnu libc6-dev-powerpc-cross qemu-user; wasi-libc lld libclang-rt-14-dev-wasm32 nodejs).
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh

# built NAME FLAGS...: the program of that name in $build
built() {
    program=$1
    shift
    make -s -j2 WERROR= BUILD="$build" OPT=-O2 HOST_OPT=-O1 "$@" "$build/$program" >"$tmp/log" 2>&1 && return
    fail "$machine: $program does not build: $(grep -m 1 -E 'error|undefined' "$tmp/log")"
    return 1
}
# ran COMMAND...: it ends well, and its last line counts what passed
ran() {
    if "$@" >"$tmp/out" 2>&1; then
        pass
        echo "$machine: $program: $(tail -n 1 "$tmp/out")"
    else fail "$machine: $program: $(grep -m 3 -v '^  ' "$tmp/out" | tr '\n' ';')"; fi
}
has() {
    for tool in "$@"; do
        command -v "$tool" >/dev/null 2>&1 && continue
        echo "$machine: left out, no $tool"
        return 1
    done
}

# big_endian EMULATOR PROGRAM...: linked statically. s390x computes floats as doubles where a standard is asked for: not so here
big_endian() {
    emulator=$1
    shift
    has "$machine-linux-gnu-gcc" "$emulator" || return
    for name in "$@"; do
        built "$name" CC="$machine-linux-gnu-gcc" SAN="-static -fexcess-precision=fast -D_FILE_OFFSET_BITS=64" && ran "$emulator" "$build/$name"
    done
}

# node runs a program by WASI; what starts processes is left out, as for the playground. The last line decides: some
# versions of node crash while they end.
cat >"$tmp/run.mjs" <<'JS'
import { WASI } from 'node:wasi';
import { readFileSync } from 'node:fs';
const wasi = new WASI({ version: 'preview1', args: [process.argv[2]], env: process.env, preopens: { '.': '.' }, returnOnExit: true });
const imports = wasi.getImportObject ? wasi.getImportObject() : { wasi_snapshot_preview1: wasi.wasiImport };
const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), imports);
process.exit(wasi.start(instance));
JS
web() {
    has clang wasm-ld node || return
    sources=$(make -s --no-print-directory --eval='print: ; @echo $(filter-out %/sweep_target.c,$(HOST_SRC)) host/web/no_target.c' print)
    for name in "$@"; do
        built "$name" CC="clang --target=wasm32-wasi" HOST_SRC="$sources" \
            SAN="-isystem /usr/include/wasm32-wasi -L/usr/lib/wasm32-wasi -Wl,-z,stack-size=8388608 -Wno-unused-command-line-argument" &&
            ran sh -c "node --no-warnings $tmp/run.mjs $build/$name >$tmp/node 2>&1; grep '^[0-9]* passed, 0 failed\$' $tmp/node"
    done
}

for machine in ${MACHINES:-s390x powerpc wasm32}; do
    build=build/machines/$machine
    case $machine in
    s390x) big_endian qemu-s390x test_panels test_panel_fuzz test_golden ;;
    powerpc) big_endian qemu-ppc test_panels ;; # QEMU 7.2 lacks an instruction of its C library, and cannot list folders for it
    wasm32) web test_golden ;;
    *) fail "no such machine: $machine" ;;
    esac
done
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
