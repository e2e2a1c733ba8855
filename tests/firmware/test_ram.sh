#!/bin/sh
# Memory: the tool predicts sizeof(gn_renderer) on a 32-bit target to the byte, and the promised size holds.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh

variable() { make -s --no-print-directory WERROR=-Werror --eval="print: ; @echo \$($1)" print; }
warn=$(variable WARN)
host_knobs=$(variable HOST_KNOBS)

# ---- Memory ----------------------------------------------------------------------------------------------------------------

cat >"$tmp/ram.c" <<'EOF_C'
/* ram PRESET KEY=VALUE...: what the tool predicts for the library's default capacities. */
#include <stdio.h>
#include <string.h>
#include "host/tool/settings/settings.h"
int main(int argc, char **argv)
{
    settings set;
    scene none;
    char error[200];
    memset(&none, 0, sizeof none);
    settings_init(&set);
    for (int i = 0; i < SETTINGS_PRESETS; i++)
        if (strcmp(argv[1], settings_preset_name[i]) == 0) settings_preset(&set, i);
    if (settings_apply_all(&set, &none, (const char *const *)(argv + 2), argc - 2, error, sizeof error)) {
        printf("%s\n", error);
        return 1;
    }
    printf("%ld\n", settings_ram(&set).total);
    return 0;
}
EOF_C
if gcc -std=c11 -D_POSIX_C_SOURCE=200809L -O1 $warn -Ilib -I. $host_knobs -o "$tmp/ram" "$tmp/ram.c" host/tool/settings/*.c host/record/uses.c host/tool/fixed/output.c host/scene/core/*.c host/scene/image/*.c host/base/*.c -lm >"$tmp/ram.log" 2>&1; then
    pass
else
    fail "settings_ram: $(grep -m 1 -E 'error|undefined' "$tmp/ram.log")"
fi

# size_of FLAGS...: sizeof(gn_renderer) on a 32-bit target (64-bit integers aligned as on Arm and RISC-V), else on this one
target=
echo 'typedef char a[sizeof(void *) == 4 ? 1 : -1];' >"$tmp/probe.c"
gcc -m32 -malign-double -ffreestanding -fsyntax-only "$tmp/probe.c" 2>/dev/null && target='-m32 -malign-double'
printf '#include "gnomon.h"\ntypedef char size_is[sizeof(gn_renderer) RELATION ? 1 : -1];\n' >"$tmp/size.c"
size_is() { # size_is RELATION FLAGS...
    relation=$1
    shift
    gcc -std=c99 $target -ffreestanding -Ilib "$@" "-DRELATION=$relation" -S -o "$tmp/size.s" "$tmp/size.c" 2>"$tmp/message"
}
size_of() { # by bisection: for messages
    low=0 high=16777216
    while [ $((high - low)) -gt 1 ]; do
        middle=$(((low + high) / 2))
        if size_is "<= $middle" "$@"; then high=$middle; else low=$middle; fi
    done
    echo $high
}

# the library's default capacities
sets=
for key in max_width max_height max_triangles max_tile_refs max_lights surface_lights max_objects max_shadow_tiles max_other_tiles; do
    macro=GN_$(echo $key | tr a-z A-Z)
    sets="$sets $key=$(printf '#include "gn_config.h"\nGN_%s\n' "${macro#GN_}" | gcc -E -P -Ilib - | tail -n 1 | sed 's/^(0 ? [0-9]* : \([0-9]*\))$/\1/')"
done
# predicted PRESET KEY=VALUE...: the tool and the compiler agree
predicted() {
    preset=$1
    shift
    flags="-DGN_PRESET=GN_PRESET_$(echo "$preset" | tr a-z A-Z)"
    for set in "$@"; do flags="$flags -DGN_$(echo "${set%%=*}" | tr a-z A-Z)=${set#*=}"; done
    ram=$("$tmp/ram" "$preset" $sets "$@")
    if size_is "== $ram" $flags; then pass; else fail "RAM with $flags: predicted $ram, is $(size_of $flags)"; fi
}

if [ -n "$target" ]; then
    for preset in tiny fast balanced accurate; do
        predicted $preset
        predicted $preset other_lights=1 incremental=0 max_objects=1
        predicted $preset shadows=0 other_lights=2 max_lights=3
        predicted $preset srgb=0 texture_formats=0 materials=2 shadows=1
        predicted $preset shadows=0
        predicted $preset pictures=15
        predicted $preset shadows=5
        predicted $preset incremental=0
        predicted $preset vertex_joints=0 texture_formats=1023 biases=2
        predicted $preset incremental=2
        predicted $preset incremental=2 shadows=0 other_lights=0
        predicted $preset incremental=3
        predicted $preset incremental=3 shadows=5
        predicted $preset other_lights=2
        predicted $preset other_lights=1
        predicted $preset other_lights=0
        predicted $preset other_lights=0 shadows=0 max_objects=3 max_lights=1
        predicted $preset depth_bits=8 other_depth_bits=32 atlas_size=16 other_atlas_size=512
        predicted $preset depth_bits=32 other_depth_bits=8 atlas_size=32 other_atlas_size=16 incremental=3
        predicted $preset max_width=333 max_height=17 max_triangles=7 max_tile_refs=9 max_lights=3 max_shadow_tiles=16
        predicted $preset max_objects=777 max_other_tiles=13 surface_lights=3 max_shadow_tiles=1 max_lights=5
        predicted $preset max_tile_refs=70001 atlas_size=64 tile_width=72 tile_height=5 max_lights=8
        predicted $preset max_tile_refs=70001 atlas_size=16 tile_width=24 tile_height=1 shadows=0
        predicted $preset surface_lights=1 materials=7 other_lights=2 many_cascades=1 # casting is larger than shading
        predicted $preset surface_lights=1 materials=7 other_lights=2 many_cascades=1 biases=1
        predicted $preset surface_lights=1 materials=3 other_lights=2 many_cascades=1 texture_formats=0
        predicted $preset surface_lights=1 materials=3 other_lights=2 many_cascades=1 texture_formats=0 biases=1
        predicted $preset surface_lights=1 max_lights=1 shadows=0 other_lights=2 texture_formats=0 materials=6 vertex_values=0
        predicted $preset surface_lights=1 texture_formats=0 materials=6 other_lights=0 shadows=0 persp_step=1
        predicted $preset triangle_groups=100 max_triangles=333
        predicted $preset triangle_groups=1 max_triangles=8 tile_width=72 tile_height=5 shadows=0 pictures=3
        predicted $preset transparent_layers=2 tile_width=72 tile_height=5
        predicted $preset transparent_layers=1 triangle_groups=8 shadows=0
        predicted $preset atlas_texels=8192 other_atlas_texels=64 incremental=3
    done
    compact="compact=1 max_width=256 max_lights=1 max_shadow_tiles=1"
    predicted tiny $compact
    predicted tiny $compact max_triangles=7 atlas_size=16 tile_width=24 tile_height=5
    predicted accurate $compact max_objects=1 validation=0 biases=0
fi
# the promise of lib/gnomon.h: directional lights alone, which need no other atlas
if size_is '<= 74752' -DGN_PRESET=GN_PRESET_BALANCED -DGN_MAX_WIDTH=320 -DGN_MAX_HEIGHT=240 -DGN_ATLAS_SIZE=128 -DGN_MAX_TRIANGLES=500 \
    -DGN_OTHER_LIGHTS=0; then pass
else fail "preset balanced, 320x240, 500 triangles, directional lights: more than 73 KiB of RAM"; fi
# what it says of the default configuration, in KB rounded up
said=$(sed -n 's/.*about \([0-9]*\) KB as configured by default.*/\1/p' lib/gnomon.h)
if size_is "<= ${said:-0} * 1024 && sizeof(gn_renderer) > (${said:-0} - 1) * 1024"; then pass
else fail "lib/gnomon.h says $said KB by default, it is $(size_of) bytes"; fi

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
