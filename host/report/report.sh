#!/bin/sh
# Compares scenes with the reference and the ray tracer, and makes one page of it. usage: report.sh TOOL WxH OUT SCENE[@FRAME]...
# Leaves OUT/index.html, and under OUT/SCENE/ what it is made of.
set -e
tool=$1 size=$2 out=$3
shift 3
mkdir -p "$out"
names=
for wanted in "$@"; do
    scene=${wanted%@*} frame=0
    case $wanted in *@*) frame=${wanted##*@} ;; esac
    name=$(basename "$scene" | sed 's/\.[^.]*$//')
    mkdir -p "$out/$name"
    for preset in fast balanced accurate; do
        "$tool" compare "$scene" --with truth --json --size "$size" --frame "$frame" --set preset=$preset -o "$out/$name/$preset" >"$out/$name/$preset.json"
    done
    # the same atlas with the fits and tiles before, and after; hard edges show where texels are
    for fits in 'before stable equal' 'after tight worth'; do
        # shellcheck disable=SC2086
        set -- $fits
        "$tool" compare "$scene" --with truth --json --size "$size" --frame "$frame" --set preset=balanced --set filter=hard --set fit="$2" --set tiles="$3" \
            -o "$out/$name/$1" >"$out/$name/$1.json"
    done
    names="$names $name"
done
# shellcheck disable=SC2086
"$(dirname "$tool")/make_report" "$out/index.html" "$out" docs/pictures host/report $names
