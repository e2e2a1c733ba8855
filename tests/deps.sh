#!/bin/sh
# Installs what the tests need and is not there: as root, or with sudo. Without either it names the packages and fails.
# A line below: a command, or a file where no command tells, and the Debian package that has it. What every Debian has
# (coreutils, diffutils, findutils, sed, grep, awk, tar) is not listed.
cd "$(dirname "$0")/.." || exit 1
log=build/deps.log
mkdir -p build

words32=$(sh tests/support/words32.sh) # a kernel without 32-bit programs needs an emulator for them

missing_packages() {
    while read -r probe package; do
        case $probe in
        /*) ls $probe >/dev/null 2>&1 || echo "$package" ;;
        *) command -v "$probe" >/dev/null 2>&1 || echo "$package" ;;
        esac
    done <<NEEDS | sort -u | tr '\n' ' '
gcc gcc
g++ g++
make make
objdump binutils
/usr/include/stdio.h libc6-dev
/usr/lib/gcc/*/*/32/libgcc.a gcc-multilib
clang clang
clang-format clang-format
/usr/lib/llvm-*/lib/clang/*/lib/*/libclang_rt.asan*.a libclang-rt-dev
wasm-ld lld
/usr/include/wasm32-wasi/stdio.h wasi-libc
/usr/lib/llvm-*/lib/clang/*/lib/wasi/libclang_rt.builtins-wasm32.a libclang-rt-dev-wasm32
node nodejs
valgrind valgrind
arduino-builder arduino-builder
cmake cmake
arm-none-eabi-gcc gcc-arm-none-eabi
/usr/lib/arm-none-eabi/lib/nosys.specs libnewlib-arm-none-eabi
riscv64-unknown-elf-gcc gcc-riscv64-unknown-elf
xtensa-lx106-elf-gcc gcc-xtensa-lx106
qemu-system-arm qemu-system-arm
qemu-system-xtensa qemu-system-misc
qemu-system-riscv32 qemu-system-misc
${words32:-true} qemu-user
pkg-config pkg-config
/usr/include/OpenImageIO/imageio.h libopenimageio-dev
NEEDS
}

# refuse WORDS: the last line is that of a test, for who runs only this
refuse() {
    echo "$*"
    echo "0 passed, 1 failed"
    exit 1
}

packages=$(missing_packages)
[ -n "$packages" ] || exit 0
root=
if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null 2>&1 || refuse "not root and no sudo; please install: $packages"
    root=sudo
fi
command -v apt-get >/dev/null 2>&1 || refuse "no apt-get; please install what Debian has as: $packages"
echo "installing what the tests need: $packages"
apt() { $root env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=500 "$@" >>"$log" 2>&1; }
: >"$log"
apt update && apt install -y --no-install-recommends $packages
packages=$(missing_packages)
[ -z "$packages" ] || refuse "could not install: $packages ($(tail -n 1 "$log"))"
