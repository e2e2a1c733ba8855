#!/bin/sh
# Compact arithmetic: the reference's pictures, the same bits on every machine, and nothing but a refusal out of its range. --table: what docs/ACCURACY.md shows.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh

variable() { make -s --no-print-directory WERROR=-Werror --eval="print: ; @echo \$($1)" print; }
warn=$(variable WARN)
flags="-DGN_COMPACT=1 -DGN_VALIDATION=0 -DGN_PRESET=GN_PRESET_TINY -DGN_SRGB=0"
# program STATUS_OF WHAT...: its counts are added
counted() {
    "$@" >"$tmp/out" 2>&1
    line=$(tail -n 1 "$tmp/out" | grep -E '^[0-9]+ passed, [0-9]+ failed$')
    passed=$((passed + ${line%% *} + 0))
    failed=$((failed + $(echo "${line:-0 passed, 1 failed}" | cut -d' ' -f3)))
    [ -n "$line" ] && grep -v '^[0-9]* passed' "$tmp/out" | head -n 10
    [ -n "$line" ] || tail -n 5 "$tmp/out"
}

# ---- Accuracy ----------------------------------------------------------------------------------------------------------------------

gcc -std=c11 -D_POSIX_C_SOURCE=200809L $warn -O2 -Ilib -Itests -Itests/support $(variable HOST_KNOBS) -c tests/oracle/compact_compare.c -o "$tmp/compare.o" &&
    gcc -o "$tmp/compare" "$tmp/compare.o" $(variable HOST_OBJ) $(variable LIB_OBJ) -lm || fail "the comparison does not build"
if [ "${1:-}" = --table ]; then
    "$tmp/compare" --table | grep '^|'
    exit
fi
counted "$tmp/compare"
counted "$tmp/compare" --srgb

for stages in compact_exact compact_bounds; do
    gcc -std=c11 -w -O1 -fsanitize=address,undefined -fno-sanitize-recover=all $flags -DGN_ATLAS_SIZE=128 -Ilib -I. -Itests -Itests/support "-DLIBRARY=\"lib/gnomon.c\"" \
        -o "$tmp/$stages" tests/oracle/$stages.c -lm || fail "$stages does not build"
    counted "$tmp/$stages"
done

# ---- Range: the compilers of the test suite, with sanitizers -----------------------------------------------------------------------

for how in "gcc -O1 -DGN_BIASES=0" "clang -O0 -DGN_VALIDATION=2"; do
    if $how -std=c11 -w -fsanitize=address,undefined -fno-sanitize-recover=all $flags -DGN_MAX_TRIANGLES=64 -DGN_MAX_HEIGHT=64 -Ilib -Itests/support \
        -o "$tmp/range" tests/oracle/compact_range.c lib/gnomon.c -lm 2>"$tmp/log"; then counted "$tmp/range" 5000
    else fail "$how: $(grep -m 1 error "$tmp/log")"; fi
done
for knobs in -O2 "-fsyntax-only -DGN_PRESET=GN_PRESET_ACCURATE -DGN_VALIDATION=0" "-fsyntax-only -DGN_BIASES=0" "-fsyntax-only -DGN_VALIDATION=2"; do
    gcc -std=c99 -pedantic $warn -Ilib -DGN_COMPACT=1 $knobs -c -o "$tmp/warnings.o" lib/gnomon.c 2>"$tmp/log" && pass || fail "$knobs: $(grep -m 1 -E 'error|warning' "$tmp/log")"
done
for contradiction in TEXTURE_FORMATS=1 MANY_CASCADES=1 SHADOWS=2 OTHER_LIGHTS=1 PICTURES=1 INCREMENTAL=1; do
    gcc -std=c99 -w -Ilib -DGN_COMPACT=1 -DGN_$contradiction -fsyntax-only lib/frame/gn_frame.c 2>"$tmp/log" && fail "compact builds with $contradiction"
    grep -q 'error.*compact_' "$tmp/log" && pass || fail "$contradiction: the message does not name compact: $(grep -m 1 error "$tmp/log")"
done
# The tool refuses by name what it has not, in a scene, in what is set afterwards, and in the picture.
refused() { # refused MESSAGE SCENE OPTIONS...
    message=$1 scene=$2
    shift 2
    build/gnomon render "host/scenes/$scene.gltf" -o "$tmp/no.png" --size 64x48 --set compact=1 "$@" >"$tmp/log" 2>&1 && fail "the tool renders $scene with compact=1 $*"
    grep -q "$message" "$tmp/log" && pass || fail "$scene, compact=1 $*: $(cat "$tmp/log")"
}
refused "'texture_formats': 0, and the texture of object 'cube'" cube
refused "'other_lights': 0, and spot light 'lamp'" desk
refused 'lights: 5, and compact arithmetic has one' mixed
refused 'atlas_size 512, and .* up to 256' fence
refused 'picture has 320x240, .* up to 256x256' sundial --size 320x240
refused "'shadows': 1, and filter 3x3" sundial --set filter=3x3
refused "'many_cascades': 0, and cascades 2" sundial --set cascades=2
refused 'output is grey8, .* rgb565' sundial --set output=grey8
refused 'texture_formats 1, ' sundial --set texture_formats=1
refused 'depth_bits 8, .* 16' sundial --set depth_bits=8
refused 'triangle_groups 64' sundial --set triangle_groups=64
refused 'distance_mode is radius, .* depth' sundial --set distance_mode=radius
refused "light '.*': bias_caster\|'biases': 1" sundial --set bias_caster=1
refused "'compact': '2' is not a whole number from 0 to 1" sundial --set compact=2
build/gnomon sweep host/scenes/sundial.gltf --size 64x48 --set compact=1 >"$tmp/log" 2>&1 && fail "it is swept, and nothing counts" || pass
# and is the general arithmetic again
for sets in "" "--set compact=1 --set compact=0 --set output=rgb888 --set preset=balanced --set filter=3x3 --set cascades=4 --set auto_bias=depth"; do
    build/gnomon render host/scenes/sundial.gltf -o "$tmp/again${sets:+2}.png" --size 64x48 --set filter=3x3 --set cascades=4 $sets >"$tmp/log" 2>&1
done
cmp -s "$tmp/again.png" "$tmp/again2.png" && pass || fail "compact=0 leaves something of compact=1"

# ---- The same bits ------------------------------------------------------------------------------------------------------------------

same() { # same WHAT FILE
    if grep '^frame' "$2" | cmp -s - tests/oracle/compact_golden.txt; then pass
    else fail "$1: $(grep '^frame' "$2" | diff - tests/oracle/compact_golden.txt | sed -n 2,3p | tr '\n' ';') $(grep -m 1 -i error "$2")"; fi
}
for how in "gcc -O0 -m64" "gcc -Os -m32" "clang -O2 -m32" ${THOROUGH:+"gcc -O3 -m64" "clang -Os -m64"}; do # the last two: make soak
    case $how in *-m32) on=$(sh tests/support/words32.sh) ;; *) on= ;; esac
    $how -std=c99 -w -Ilib -Iboards/common -Iboards/apps '-DGN_USER_CONFIG="compact_config.h"' -o "$tmp/golden" lib/gnomon.c boards/apps/compact.c \
        boards/host/startup.c boards/common/print.c >"$tmp/log" 2>&1 && $on "$tmp/golden" >"$tmp/log" 2>&1
    same "$how" "$tmp/log"
done
for board in microbit mps3-an547 rv32-virt ${THOROUGH:+mps2-an385}; do
    make -s --no-print-directory emulate BOARD=$board APP=compact >"$tmp/log" 2>&1
    same $board "$tmp/log"
done

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
