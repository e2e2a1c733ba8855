#!/bin/sh
# Prints flash_table.h: bytes of the library's code and constants, built with -Os for Cortex-M0 and Cortex-M4 and linked with what it needs of
# libgcc and libc, and what each feature adds to a typical build. Run by hand when the library's size has changed: sh host/generate/gen_flash.sh > host/tool/cost/flash_table.h
# usage: gen_flash.sh [-- CPU FLAGS...]: the size of one build
cd "$(dirname "$0")/../.." || exit 1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/main.c" <<'E_C'
#include "gnomon.h"
static gn_renderer renderer;
const gn_picture *volatile picture;
const gn_scene *volatile now;
gn_flush_fn volatile flush;
int main(void)
{
    return gn_init(&renderer, picture) || gn_render(&renderer, now, flush, 0);
}
E_C

size() { # size CPU FLAGS...: without main
    cpu=$1
    shift
    arm-none-eabi-gcc -mcpu="$cpu" -mthumb -Os -std=c99 -Ilib -ffunction-sections -fdata-sections -nostartfiles --specs=nosys.specs -Wl,--gc-sections \
        -Wl,-e,main -Wl,-Ttext=0x8000 "$@" "$work/main.c" lib/gnomon.c -o "$work/elf" 2>"$work/log" || { cat "$work/log" >&2; exit 1; }
    arm-none-eabi-size "$work/elf" | awk 'NR == 2 { print $1 + $2 }'
}
if [ "$1" = -- ]; then
    shift
    size "$@"
    exit
fi

features=$(sed -n '/GN_FEATURE_KNOBS/,$s/^    X([a-z_0-9]*, \([A-Z_0-9]*\), .*/\1/p' lib/gn_knobs.h)
# One directional light with a filtered shadow on smooth meshes
typical="SHADOWS=3 VERTEX_VALUES"
# flags NAME...: these features
flags() {
    for feature in $features; do
        value=0
        for name in "$@"; do
            case $name in
            "$feature") value=1 ;;
            "$feature="*) value=${name#*=} ;;
            esac
        done
        echo "-DGN_$feature=$value"
    done
}
row() { # row NAME COMMENT FLAGS...: more than the typical build
    name=$1 comment=$2
    shift 2
    echo "FLASH($name, $(($(size cortex-m0 "$@") - m0)), $(($(size cortex-m4 "$@") - m4))) /* $comment */"
}
levels() { case $1 in MANY_CASCADES | INCREMENTAL) echo 3 ;; OTHER_LIGHTS | BIASES | MATERIALS | TILE_SIZES | CLIPPING) echo 2 ;; *) echo 1 ;; esac; }

m0=$(size cortex-m0 $(flags $typical)) m4=$(size cortex-m4 $(flags $typical))
echo "/* Made by host/generate/gen_flash.sh with $(arm-none-eabi-gcc -dumpversion). Bytes of flash: on Cortex-M0, on Cortex-M4. */"
echo "FLASH(typical, $m0, $m4) /* shadows 3, vertex_values 1, preset balanced */"
row no_shadows "without shadows, and what is of shadows" $(flags VERTEX_VALUES)
for level in 0 3; do row vertex_values_$level "with $level" $(flags $typical VERTEX_VALUES=$level); done
for level in 1 2 4 5 6; do row shadows_$level "other shadows" $(flags $typical SHADOWS=$level); done
row punctual_unshadowed "spot and point lights, no shadows: above no_shadows too" $(flags VERTEX_VALUES OTHER_LIGHTS)
for feature in $features; do
    case " SHADOWS $typical " in *" $feature "*) continue ;; esac
    row $(echo $feature | tr A-Z a-z) "with" $(flags $typical $feature)
    level=2
    while [ $level -le $(levels $feature) ]; do
        row $(echo $feature | tr A-Z a-z)_$level "with $level" $(flags $typical $feature=$level)
        level=$((level + 1))
    done
done
for part in 2 4; do row pictures_$part "with $part" $(flags $typical PICTURES=$part); done
for part in 4 8; do row materials_$part "with $part" $(flags $typical MATERIALS=$part); done
row texture_formats_1025 "with 1025" $(flags $typical TEXTURE_FORMATS=1025)
row edge "edge 4" $(flags $typical) -DGN_EDGE=4
row preset_accurate "quality of preset accurate" $(flags $typical) -DGN_PRESET=GN_PRESET_ACCURATE
row accurate_unshadowed "the same without shadows" $(flags VERTEX_VALUES) -DGN_PRESET=GN_PRESET_ACCURATE
row linear "srgb 0" $(flags $typical) -DGN_SRGB=0

# Compact arithmetic, and what more than that
compact() { # compact NAME COMMENT FLAGS...
    name=$1 comment=$2
    shift 2
    for cpu in m0 m4; do
        eval "$cpu"=$(size cortex-$cpu -DGN_COMPACT=1 -DGN_VALIDATION=0 -DGN_BIASES=0)
    done
    row "$name" "$comment" -DGN_COMPACT=1 "$@"
}
row compact "compact arithmetic" -DGN_COMPACT=1 -DGN_VALIDATION=0 -DGN_BIASES=0
compact compact_validation "with" -DGN_VALIDATION=1 -DGN_BIASES=0
compact compact_auto_bias "with" -DGN_VALIDATION=0 -DGN_BIASES=1
compact compact_linear "srgb 0" -DGN_VALIDATION=0 -DGN_BIASES=0 -DGN_SRGB=0
