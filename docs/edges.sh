#!/bin/sh
# Draws docs/pictures/edge-*.png, with large texels (a stable fit): the same shadow's edge through every filter, and under every bias. usage: edges.sh TOOL [OUT_DIR]
set -e
tool=$1 out=${2:-docs}
mkdir -p "$out/pictures"
draw() { # draw NAME SCENE ARGUMENTS...
    name=$1 scene=$2
    shift 2
    "$tool" render docs/scenes/"$scene".gltf -o "$out/pictures/edge-$name.png" --size 160x120 --set fit=stable "$@" >/dev/null
}
for filter in hard 2x2 3x3 5x5 7x7; do draw $filter edge --set filter=$filter; done
draw disk edge --set filter=disk --set penumbra=6 --set disk_samples=32
draw none slopes --set auto_bias=off --set bias_normal=0
draw constant slopes --set auto_bias=off --set bias_normal=0 --set bias_constant=12
draw offset slopes --set auto_bias=off --set bias_normal=1
draw normal slopes --set auto_bias=normal
draw depth slopes --set auto_bias=depth
