#!/bin/sh
# Makes host/tool/cost/cost_table.h anew: what the library's counted events (lib/base/gn_count.h) cost in instructions, by callgrind.
#   sh tests/bench/calibrate.sh           minutes; the counts come from gnomon sweep, the instructions from a build without counters
# The build that is measured is the host's, so that one program draws every configuration; without its static layer, which firmware rarely has.
# Environment: CC, BUILD.
set -eu
cd "$(dirname "$0")/../.."

CC=${CC:-gcc}
TOOL=${BUILD:-build}/gnomon
DIR=${BUILD:-build}/calibrate
SCENES="host/scenes/sundial.gltf host/scenes/avenue.gltf host/scenes/desk.gltf host/scenes/room.gltf host/scenes/fence.gltf host/scenes/mixed.gltf \
  docs/scenes/lamps.gltf docs/scenes/materials.gltf docs/scenes/suns.gltf docs/scenes/slopes.gltf"
SIZE=160x120
EVERY=4 # of the sweep's configurations

command -v valgrind >/dev/null || { echo "calibrate: valgrind is not installed" >&2; exit 1; }
mkdir -p "$DIR"
variable() { make -s --no-print-directory WERROR=-Werror --eval="print: ; @echo \$($1)" print; }
knobs=$(variable HOST_KNOBS | sed 's/-DGN_COUNTERS=1/-DGN_COUNTERS=0/; s/-DGN_INCREMENTAL=2/-DGN_INCREMENTAL=1/; s/-DGN_MANY_CASCADES=3/-DGN_MANY_CASCADES=2/')
make -s CC="$CC" "$TOOL"
"$TOOL" bake host/scenes/room.gltf -o "$DIR/baked.gltf" --size $SIZE >/dev/null # nothing else has a mask image
SCENES="$SCENES $DIR/baked.gltf"
make -s CC="$CC" BUILD="$DIR/build" HOST_KNOBS="$knobs" LIB_SRC="$(variable LIB_SRC | sed s,lib/shadow/gn_static_layer.c,,)" "$DIR/build/gnomon" >/dev/null
$CC -std=c11 -O2 -Ilib -o "$DIR/gen_costs" host/generate/gen_costs.c -lm

# instructions SCENE SETTING...: of shadow tiles, setup and binning, rasterising, shading (glibc's memset: see bench.sh)
instructions() {
    scene=$1
    shift
    n=$#
    while [ "$n" -gt 0 ]; do
        set -- "$@" --set "$1"
        shift
        n=$((n - 1))
    done
    GLIBC_TUNABLES=glibc.cpu.x86_rep_stosb_threshold=1000000000 valgrind -q --tool=callgrind --compress-strings=no --compress-pos=no \
        --toggle-collect=gn_render --callgrind-out-file="$DIR/callgrind.out" "$DIR/build/gnomon" render "$scene" --size $SIZE -o "$DIR/x.png" "$@"
    awk '
        /^cfn=/ { callee = substr($0, 5) }
        /^calls=/ { getline; cost[callee] += $NF }
        END {
            if (!cost["gn_shade_tile"] || !cost["gn_views_setup"]) exit 1
            printf "%d %d %d %d\n", cost["gn_atlas_render_tile"],
                cost["gn_scene_validate"] + cost["gn_views_setup"] + cost["gn_setup_triangles"] + cost["gn_bin_triangles"],
                cost["gn_raster_tile"], cost["gn_shade_tile"]
        }' "$DIR/callgrind.out"
}

# "SETTINGS|counts" of every configuration that is measured
rows() {
    awk -v every=$EVERY '
        NR == 1 { n = split($0, head, ","); for (first = 1; head[first] !~ /^n_/; first++); next }
        NR % every == 0 {
            split($0, part, "\"")
            m = split(part[3], value, ",") # begins with a comma: value[1] is empty
            line = part[2] == "the scene'"'"'s own" ? "" : part[2]
            line = line "|"
            for (i = first; i <= n; i++) line = line " " value[i]
            print line
        }' "$1"
}

: >"$DIR/samples.txt"
for scene in $SCENES; do
    "$TOOL" sweep "$scene" --size $SIZE --csv "$DIR/sweep.csv" >/dev/null
    rows "$DIR/sweep.csv" >"$DIR/rows.txt"
    while IFS='|' read -r settings counts; do
        # shellcheck disable=SC2086
        echo "$(basename "$scene" .gltf) $(instructions "$scene" $settings </dev/null) $counts"
    done <"$DIR/rows.txt" >>"$DIR/samples.txt"
done
"$DIR/gen_costs" "$($CC --version | sed 1q)" <"$DIR/samples.txt" >"$DIR/cost_table.h"
cp "$DIR/cost_table.h" host/tool/cost/cost_table.h
sed -n '1,/^ \*\//p' host/tool/cost/cost_table.h
