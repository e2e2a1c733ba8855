#!/bin/sh
# Pixels are pure (spec 4): scenes that came out in other bytes with other screen tiles.
# usage: test_pure.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh

draw() { # draw FILE SCENE SIZE TILE PRESET
    "$tool" render "tests/data/$2" -o "$tmp/$1.png" --size "$3" --set output=rgb888 --set preset="$5" --set tile_width="${4%x*}" --set tile_height="${4#*x}" >"$tmp/log" 2>&1 ||
        fail "$2, $5, tiles of $4: $(cat "$tmp/log")"
}
pure() { # pure SCENE SIZE TILE...: the same bytes as in one tile, in each preset
    scene=$1 size=$2
    shift 2
    for preset in fast balanced; do
        draw whole "$scene" "$size" 320x192 $preset
        for tile; do
            draw tiles "$scene" "$size" "$tile" $preset
            cmp -s "$tmp/whole.png" "$tmp/tiles.png" && pass || fail "$scene, $preset: other pixels with tiles of $tile than with one of 320x192"
        done
    done
}

pure pure-piece.gltf 200x63 8x1 64x16  # a row is bent, and the window of its part says that all is dark
pure pure-beyond.gltf 160x100 8x1      # a piece of a row lies beyond the shadow tile
pure pure-points.gltf 160x100 32x16 8x1 # two faces of a point light ask for windows in one cell
pure pure-range.gltf 200x48 8x23 8x1   # the plane leaves the range of depths within a row
pure pure-cell.gltf 200x100 8x16 8x1   # a cell lies beyond the shadow tile
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
