#!/bin/sh
# Makes host/tool/cost/cost_table.h anew: what the library's counted events (lib/base/gn_count.h) cost in instructions of a Cortex-M3, -O2, in the
# emulator. Every picture is of its own build, as gnomon compile configures it: forty minutes on one core.
#   sh tests/bench/calibrate.sh          measures and fits
#   sh tests/bench/calibrate.sh --fit    fits to what was measured last; events are counted anew
# Environment: BUILD; MODELS: more scene files to fit to, with ground, sun and shadow, textures of 128 texels.
set -eu
cd "$(dirname "$0")/../.."

BUILD=${BUILD:-build}
TOOL=$BUILD/gnomon
DIR=$BUILD/calibrate
BOARD=mps2-an385
CHARACTERS="docs/scenes/snake.gltf tests/bench/scenes/hound.gltf tests/bench/scenes/walker.gltf tests/bench/scenes/crowd.gltf host/scenes/cube.gltf"
SWEPT="host/scenes/sundial.gltf host/scenes/avenue.gltf host/scenes/desk.gltf host/scenes/room.gltf host/scenes/fence.gltf host/scenes/mixed.gltf \
  docs/scenes/lamps.gltf docs/scenes/materials.gltf docs/scenes/suns.gltf docs/scenes/slopes.gltf"
EVERY=12 # of the sweep's configurations

# options SETTING...: for the tool
options() { for setting in "$@" output=rgb565; do printf ' --set %s' "$setting"; done; }

# sample SCENE SIZE SETTING...: "SCENE SIZE SETTING... | N N N | N N N": instructions until the screen tiles, of rasterising and of shading, of the first
# frame and of the next
sample() {
    JOBS=1 sh boards/tools/count.sh $BOARD calibrate "0,0 1" FW_OPT=-O2 FW_FLAGS=-g0 SCENE="$1" \
        "SCENE_FLAGS=--size $2 --frames 0-1 --simplify safe$(shift 2 && options "$@")" >"$DIR/counted" 2>"$DIR/log" </dev/null || { echo "calibrate: left out: $*" >&2; return 0; }
    awk -v what="$*" '
        $1 == "args:" { run++ }
        $1 == "stage" { part = $2 == "gn_raster_tile" ? 2 : $2 == "gn_shade_tile" ? 3 : $2 == "bench_flush" ? 0 : 1; n[run, part] += $3 }
        END { print what, "|", n[1, 1], n[1, 2], n[1, 3], "|", n[2, 1] - n[1, 1], n[2, 2] - n[1, 2], n[2, 3] - n[1, 3] }' "$DIR/counted" >>"$DIR/measured.txt"
}

measure() {
    sh boards/tools/count.sh --ready $BOARD
    : >"$DIR/measured.txt"
    for model in $CHARACTERS ${MODELS:-}; do
        for preset in tiny fast balanced accurate; do sample "$model" 240x320 "preset=$preset" filter=3x3 texture_size=128; done
        sample "$model" 160x120 preset=fast filter=2x2 texture_size=128
    done
    for scene in $SWEPT "$DIR/baked.gltf"; do
        sample "$scene" 320x240 preset=fast
        "$TOOL" sweep "$scene" --size 160x120 --csv "$DIR/sweep.csv" >/dev/null
        awk -F '"' -v every=$EVERY 'NR > 1 && NR % every == 0 { print $2 == "the scene'"'"'s own" ? "" : $2 }' "$DIR/sweep.csv" >"$DIR/rows.txt"
        while read -r settings; do
            # shellcheck disable=SC2086
            sample "$scene" 160x120 $settings
        done <"$DIR/rows.txt"
    done
}

# counts FRAME: of the tool's JSON in $DIR/info, until the screen tiles and in them
counts() { sed -n "s/.*\"$1\": {\"instructions\": [0-9]*, \"sent\": [^,]*, \(\"prepare\": {[^}]*}, \"tiles\": {[^}]*}\)}.*/\1/p" "$DIR/info" | sed 's/"[a-z0-9_]*": //g; s/[^0-9]\{1,\}/ /g'; }

# What gen_costs reads: the scene, instructions, counts
count_events() {
    while IFS='|' read -r what first next; do
        # shellcheck disable=SC2086
        set -- $what
        scene=$1 size=$2
        shift 2
        # shellcheck disable=SC2046
        "$TOOL" info "$scene" --size "$size" $(options "$@") --json >"$DIR/info" 2>/dev/null </dev/null
        name=$(basename "${scene%.*}")
        echo "$name $first $(counts first)"
        echo "$name $next $(counts animated)"
    done <"$DIR/measured.txt"
}

mkdir -p "$DIR"
make -s "$TOOL"
"$TOOL" bake host/scenes/room.gltf -o "$DIR/baked.gltf" --size 160x120 >/dev/null # nothing else has a mask image
[ "${1:-}" = --fit ] || measure
count_events >"$DIR/samples.txt"
cc -std=c11 -O2 -Ilib -o "$DIR/gen_costs" host/generate/gen_costs.c -lm
"$DIR/gen_costs" "$(arm-none-eabi-gcc --version | sed 1q)" <"$DIR/samples.txt" >"$DIR/cost_table.h"
cp "$DIR/cost_table.h" host/tool/cost/cost_table.h
sed -n '1,/^ \*\//p' host/tool/cost/cost_table.h
