#!/bin/sh
# Random scenes (test_random.c) on configurations as they ship, constants for knobs, under the address, undefined-behaviour and
# memory sanitizers: presets, compact, size first, short positions and normals, atlases of unequal sizes, capacities that are often too small.
# A good frame after a refused one is a fresh renderer's. The accurate one has poisoned gaps between the arrays of the state;
# tests/run.sh has the balanced one.
# SOAK=1: 100000 scenes of each; SEED=n others.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh
scenes=500
[ -z "$SOAK" ] || scenes=100000
: "${SCENES:=$scenes}"
export SCENES

# random NAME LIB FLAGS...: not optimised, which takes the compiler a tenth of the time
sanitizer=address,undefined
random() {
    name=$1 lib=$2
    shift 2
    if ! clang -std=c11 -w -g1 -O0 -fsanitize=$sanitizer -fno-sanitize-recover=all -D_POSIX_C_SOURCE=200809L "-I$lib" -Itests/support "$@" -o "$tmp/$name" \
        "$lib/gnomon.c" tests/property/test_random.c -lm 2>"$tmp/log"; then fail "$name does not build: $(grep -m 1 -E 'error|undefined' "$tmp/log")"
    elif "$tmp/$name" >"$tmp/out" 2>&1; then
        pass
        [ -z "$SOAK" ] || echo "$name: $(grep '^seed' "$tmp/out")"
    else fail "$name: $(grep -m 3 -E 'failed|ERROR|error|other pixels' "$tmp/out" | tr '\n' ';')"; fi
    for fault in $faults; do # SEED:FIRST
        SEED=${fault%:*} FIRST=${fault#*:} SCENES=256 "$tmp/$name" >"$tmp/out" 2>&1 && pass || fail "$name, scenes that had a fault, $fault: $(grep -m 1 -E 'failed|error' "$tmp/out")"
    done
    rm -f "$tmp/$name"
}

# In these an int overflowed once, where coordinates of textures go round thousands of times in a cell.
faults="20261123:59136 20261124:26880"
random tiny lib -DGN_PRESET=GN_PRESET_TINY
faults=
[ -z "$SOAK" ] || random balanced lib -DGN_PRESET=GN_PRESET_BALANCED # tests/run.sh has it
[ -z "$SOAK" ] || random fast lib -DGN_PRESET=GN_PRESET_FAST -DGN_ATLAS_SIZE=32 -DGN_OTHER_ATLAS_SIZE=128 # that of capacities is of this preset, too
random size-first lib -DGN_SIZE_FIRST=1 -DGN_PRESET=GN_PRESET_TINY -DGN_SHORT_VERTICES=3 -DGN_OTHER_ATLAS_SIZE=32
once=$SCENES SCENES=$((2 * SCENES)) # of which few are drawn
random capacities lib -DGN_PRESET=GN_PRESET_FAST -DGN_MAX_TRIANGLES=12 -DGN_MAX_TILE_REFS=24 -DGN_MAX_OBJECTS=3 -DGN_MAX_LIGHTS=3 -DGN_SURFACE_LIGHTS=2 \
    -DGN_MAX_SHADOW_TILES=2 -DGN_MAX_OTHER_TILES=3 -DGN_ATLAS_SIZE=32 -DGN_OTHER_ATLAS_SIZE=32
SCENES=$once
random least lib -DGN_PRESET=GN_PRESET_TINY -DGN_OTHER_LIGHTS=2 -DGN_MATERIALS=3 -DGN_BIASES=1 -DGN_SHADOWS=1 -DGN_TEXTURE_FORMATS=1 \
    -DGN_INCREMENTAL=0 -DGN_PICTURES=2
random compact lib -DGN_COMPACT=1
[ -z "$SOAK" ] || random compact-short lib -DGN_COMPACT=1 -DGN_SIZE_FIRST=1 -DGN_SHORT_VERTICES=1
sanitizer=memory
random memory lib -DGN_PRESET=GN_PRESET_BALANCED
sanitizer=address,undefined

# That the target of fuzzing by coverage compiles; make soak lets it run.
clang -std=c11 -w -fsyntax-only -DLIBFUZZER -D_POSIX_C_SOURCE=200809L -Ilib -Itests/support tests/property/test_random.c 2>"$tmp/log" && pass || fail "fuzz does not compile: $(grep -m 1 error "$tmp/log")"

# An overrun from one array of the state into the next is one into a gap.
cp -r lib "$tmp/lib"
awk '/^typedef struct gn_(frame|scratch) \{/ { of = $3; sub(/^gn_/, "", of) }
    /^\} gn_/ { of = "" }
    of != "" && /^    [a-z]/ && (/^    [^;]*\];/ || /^    (gn_work|gn_tile_pixels|gn_[a-z]*_texels) /) { printf "uint64_t gap_%d[8];\n", ++n; print of ".gap_" n >list }
    { print }' list="$tmp/gaps" lib/frame/gn_state.h >"$tmp/lib/frame/gn_state.h"
accurate="-DGN_PRESET=GN_PRESET_ACCURATE -DGN_ATLAS_SIZE=128 -DGN_OTHER_ATLAS_SIZE=64 -DGN_INCREMENTAL=3 -DGN_MANY_CASCADES=3"
# of arrays that this build does not have there is no gap either
echo '#include "gnomon.h"' >"$tmp/gaps.c"
clang -E -P $accurate "-I$tmp/lib" "$tmp/gaps.c" | grep -o '^ *uint64_t gap_[0-9]*' | sed 's/.* //' >"$tmp/built"
gaps=$(grep -w -F -f "$tmp/built" "$tmp/gaps" | sed 's/.*/X(&)/' | tr '\n' ' ')
[ "$(wc -l <"$tmp/built")" -ge 14 ] && pass || fail "only $(wc -l <"$tmp/built") gaps"
random accurate "$tmp/lib" $accurate "-DGAPS(X)=$gaps"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
