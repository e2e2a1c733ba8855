#!/bin/sh
# Every configuration builds without a warning; wrong ones do not, and say why; capacities, presets and memory are as promised.
cd "$(dirname "$0")/.." || exit 1
. tests/check.sh

variable() { make -s --no-print-directory --eval="print: ; @echo \$($1)" print; }
warn=$(variable WARN)
host_knobs=$(variable HOST_KNOBS)
strict="-std=c99 -pedantic $warn -Ilib"

# objects NAME FLAGS...: the library under these flags, as $tmp/NAME/*.o
objects() {
    mkdir -p "$tmp/$1"
    (
        dir=$1 root=$PWD
        shift
        cd "$tmp/$dir" && gcc -std=c99 -pedantic $warn -I"$root/lib" "$@" -c "$root"/lib/*.c
    ) >"$tmp/$1.log" 2>&1
}

# ---- What must build -------------------------------------------------------------------------------------------------------

builds() {
    while read -r line; do
        name=variant$(echo "$line" | tr -c 'A-Za-z0-9\n' _)
        if objects "$name" -O1 -ffreestanding $line; then echo ok; else
            echo "does not build: ${line:-(defaults)}"
            grep -m 2 -E 'error|warning' "$tmp/$name.log"
        fi
        rm -rf "${tmp:?}/$name"
    done
}

cat >"$tmp/wanted" <<'LIST'

-DGN_PRESET=GN_PRESET_TINY
-DGN_PRESET=GN_PRESET_BALANCED
-DGN_PRESET=GN_PRESET_ACCURATE
-DGN_RAW_VIEWS=1
-DGN_FILTER_MAX=0
-DGN_FILTER_MAX=1
-DGN_FILTER_MAX=2
-DGN_FILTER_MAX=3
-DGN_RAW_VIEWS=1 -DGN_SHADOWS=0
-DGN_VERTEX_NORMALS=0 -DGN_VERTEX_COLOURS=0
-DGN_SHADOWS=0 -DGN_FILTER_MAX=0 -DGN_VERTEX_NORMALS=0 -DGN_VERTEX_COLOURS=0 -DGN_DEPTH_BLOCKS=0 -DGN_SRGB=0
-DGN_SHADOWS=0 -DGN_FILTER_MAX=0 -DGN_VERTEX_NORMALS=0 -DGN_VERTEX_COLOURS=0 -DGN_DEPTH_BLOCKS=0 -DGN_RAW_VIEWS=1
-DGN_RUNTIME_KNOBS=1 -DGN_SHADOWS=0
-DGN_RUNTIME_KNOBS=1 -DGN_FILTER_MAX=0
-DGN_SUBPIXEL_BITS=8 -DGN_MAX_TILE_REFS=65535
-DGN_MAX_TILE_REFS=65536 -DGN_VERTEX_CACHE=4 -DGN_MAX_LIGHTS=1
-DGN_MAX_WIDTH=1 -DGN_MAX_HEIGHT=1 -DGN_MAX_TRIANGLES=1 -DGN_MAX_TILE_REFS=1 -DGN_TILE_WIDTH=8 -DGN_TILE_HEIGHT=1 -DGN_ATLAS_SIZE=16
LIST
# each switch off alone, and with each filter it could interact with
for macro in $(sed -n '/GN_FEATURE_KNOBS/,$s/^    X([a-z_]*, \([A-Z_]*\), 0, 1,.*/\1/p' lib/gn_knobs.h | grep -v -e RAW_VIEWS -e RUNTIME_KNOBS); do
    echo "-DGN_$macro=0"
done >>"$tmp/wanted"
echo "-DGN_DEPTH_BLOCKS=0 -DGN_FILTER_MAX=1" >>"$tmp/wanted"
(
    trap - EXIT # it is not this subshell that cleans up
    awk 'NR % 2' "$tmp/wanted" | builds >"$tmp/built1"
) &
awk 'NR % 2 == 0' "$tmp/wanted" | builds >"$tmp/built2"
wait
passed=$((passed + $(cat "$tmp"/built? | grep -c '^ok$')))
failed=$((failed + $(cat "$tmp"/built? | grep -c '^does not build')))
grep -hv '^ok$' "$tmp"/built?

# ---- What must not ---------------------------------------------------------------------------------------------------------

# refused NAME FLAG: the build stops and its message names the knob
refused() {
    if gcc -std=c99 -Ilib $2 -fsyntax-only lib/gn_frame.c >"$tmp/message" 2>&1; then fail "builds with $2"
    elif grep -q "error.*$1" "$tmp/message"; then pass
    else fail "$2: the message does not name $1: $(grep -m 1 error "$tmp/message")"
    fi
}

sed -n 's/^ *X(\([a-z_]*\), \([A-Z_]*\), \([0-9]*\), \([0-9]*\),.*/\1 \2 \3 \4/p' lib/gn_knobs.h >"$tmp/knobs"
[ "$(wc -l <"$tmp/knobs")" = "$(grep -c '^ *X(' lib/gn_knobs.h)" ] && pass || fail "the list of knobs in lib/gn_knobs.h is not understood"
while read -r name macro low high; do
    refused "${name}_out_of_range" "-DGN_$macro=$((low - 1))"
    refused "${name}_out_of_range" "-DGN_$macro=$((high + 1))"
done <"$tmp/knobs"
refused preset_unknown -DGN_PRESET=3
refused preset_unknown -DGN_PRESET=-1
refused persp_step -DGN_PERSP_STEP=2
refused atten_bits -DGN_ATTEN_BITS=12
refused atlas_size -DGN_ATLAS_SIZE=96
refused vertex_cache -DGN_VERTEX_CACHE=33
refused tile_width -DGN_TILE_WIDTH=68
refused picture_too_large "-DGN_SUBPIXEL_BITS=6 -DGN_MAX_WIDTH=1024" # beyond 16-bit screen coordinates
refused picture_too_large "-DGN_SUBPIXEL_BITS=6 -DGN_MAX_HEIGHT=1024"

# ---- The user's own header; C++ --------------------------------------------------------------------------------------------

cat >"$tmp/my_config.h" <<'EOF_C'
#define GN_PRESET GN_PRESET_TINY
#define GN_MAX_TRIANGLES 77
#define GN_SHADOWS 0
EOF_C
cat >"$tmp/user.c" <<'EOF_C'
#include "gnomon.h"
typedef char tiny_tile[GN_TILE_HEIGHT == 8 && GN_WEIGHT_BITS == 6 ? 1 : -1];
typedef char own_capacity[GN_MAX_TRIANGLES == 77 && sizeof(((gn_frame *)0)->tri) == 77 * sizeof(gn_tri) ? 1 : -1];
typedef char no_shadows[GN_SHADOWS == 0 ? 1 : -1];
EOF_C
if gcc $strict -I"$tmp" '-DGN_USER_CONFIG="my_config.h"' -fsyntax-only "$tmp/user.c" 2>"$tmp/message"; then pass
else fail "GN_USER_CONFIG: $(grep -m 1 error "$tmp/message")"; fi
if objects user -O1 -ffreestanding -I"$PWD/$tmp" '-DGN_USER_CONFIG="my_config.h"'; then pass
else fail "GN_USER_CONFIG: $(grep -m 1 error "$tmp/user.log")"; fi

cat >"$tmp/user.cpp" <<'EOF_C'
#include "gnomon.h"
static gn_renderer renderer;
static const int32_t pos[9] = {GN_Q16(-1), 0, 0, GN_Q16(1.5), 0, 0, 0, GN_Q16(1), 0};
static const uint16_t idx[3] = {0, 1, 2};
static void flush(void *, int, int, int, int, const void *) {}
gn_status draw()
{
    gn_mesh mesh = {pos, nullptr, nullptr, idx, 3, 1, 16};
    gn_object object = gn_object();
    object.mesh = &mesh;
    object.flags = GN_OBJECT_DEFAULT;
    gn_affine_rotation(&object.to_world, GN_TURN(-90), 0, 0);
    gn_affine_scale(&object.to_world, GN_Q16(2));
    gn_scene scene = gn_scene();
    scene.objects = &object;
    scene.n_objects = 1;
    scene.camera.focal_q24 = gn_focal_from_fov_q24(GN_TURN(50));
    scene.shadow.filter = GN_FILTER_2X2;
    gn_picture picture = {32, 32, GN_FORMAT_RGB565, GN_VIEW_COLOUR, 0};
    gn_status status = gn_init(&renderer, &picture);
    if (status == GN_OK) status = gn_render(&renderer, &scene, flush, nullptr);
    return gn_get_detail(&renderer)->needed ? GN_ERR_ORDER : gn_status_text(status)[0] ? status : GN_OK;
}
EOF_C
for flags in "" "-DGN_SHADOWS=0 -DGN_RAW_VIEWS=1" "-DGN_RUNTIME_KNOBS=1" "-DGN_PRESET=2"; do
    if g++ -std=c++11 -Wall -Wextra -pedantic -Werror -Ilib $flags -fsyntax-only "$tmp/user.cpp" 2>"$tmp/message"; then pass
    else fail "C++ $flags: $(grep -m 1 error "$tmp/message")"; fi
done

# ---- Pictures of the demo scene --------------------------------------------------------------------------------------------

cat >"$tmp/picture.c" <<'EOF_C'
/* picture WIDTH HEIGHT FORMAT FILTER FRAME [PRESET]: prints the CRC of the picture, or the status and what it needs. */
#include <stdio.h>
#include <stdlib.h>
#include "demo_scene.h"
static uint8_t canvas[2048 * 512 * 3];
static gn_picture picture;
static gn_renderer renderer;
static demo_scene demo;
static void flush(void *user, int x, int y, int w, int h, const void *pixels)
{
    size_t bytes = picture.format == GN_FORMAT_RGB565 ? 2 : 3;
    (void)user;
    for (int row = 0; row < h; row++)
        memcpy(canvas + ((size_t)(y + row) * picture.width + (size_t)x) * bytes,
               (const uint8_t *)pixels + (size_t)(row * w) * bytes, (size_t)w * bytes);
}
int main(int argc, char **argv)
{
    if (argc < 6) return 2;
    picture.width = (uint16_t)atoi(argv[1]);
    picture.height = (uint16_t)atoi(argv[2]);
    picture.format = (gn_format)atoi(argv[3]);
    uint32_t frame = (uint32_t)atoi(argv[5]);
    demo_scene_make(&demo, frame);
    if (argv[4][0] != '-') demo.scene.shadow.filter = (gn_filter)atoi(argv[4]);
    if (frame == 9) { /* a vertex next to the near plane at the longest focal length: coordinates round far */
        demo_scene_make(&demo, 0);
        demo.scene.camera.near_q16 = 256;
        demo.scene.camera.focal_q24 = 0xFFFFFF00U;
        demo.scene.camera.to_world.t_q16[1] = GN_Q16(0.01);
        demo.scene.camera.to_world = demo.object[2].to_world;
        demo.scene.camera.to_world.t_q16[1] = 200;
    }
    if (gn_init(&renderer, &picture)) return 1;
#if GN_RUNTIME_KNOBS
    int preset = argc > 6 ? atoi(argv[6]) : 1;
#define PRESET_(name, MACRO, lo, hi, meaning, cost) { static const int32_t v[3] = {GN_PRESETS_##MACRO}; renderer.frame.knobs.name = v[preset]; }
    GN_QUALITY_KNOBS(PRESET_)
#endif
    gn_status status = gn_render(&renderer, &demo.scene, flush, NULL);
    const gn_detail *d = gn_get_detail(&renderer);
    size_t n = (size_t)picture.width * picture.height * (picture.format == GN_FORMAT_RGB565 ? 2 : 3);
    if (status) printf("%d %u %u\n", (int)status, d->needed, d->available);
    else printf("%08x\n", demo_crc32(0, canvas, n));
    return 0;
}
EOF_C

# program NAME FLAGS...: $tmp/NAME.run
program() {
    program_name=$1
    shift
    objects "$program_name" -O1 "$@" &&
        gcc $strict -Itests -O1 "$@" -o "$tmp/$program_name.run" "$tmp/picture.c" "$tmp/$program_name"/*.o >>"$tmp/$program_name.log" 2>&1 || {
        fail "no program with $*: $(grep -m 1 error "$tmp/$program_name.log")"
        return 1
    }
}

# same NAME "ARGUMENTS" OTHER "ARGUMENTS" WHAT
same() {
    a=$("$tmp/$1.run" $2 2>&1) b=$("$tmp/$3.run" $4 2>&1)
    case $a in
    ????????) if [ "$a" = "$b" ]; then pass; else fail "$5: $a, not $b ($2)"; fi ;;
    *) fail "$5: no picture: $a ($2)" ;;
    esac
}

(
    trap - EXIT
    program host $host_knobs
    program wide -DGN_MAX_WIDTH=2048 -DGN_PRESET=0
) &
for preset in tiny balanced accurate; do program $preset -DGN_PRESET=GN_PRESET_$(echo $preset | tr a-z A-Z); done
wait
for name in host wide tiny balanced accurate; do
    if [ -x "$tmp/$name.run" ]; then pass; else fail "no program '$name': $(grep -m 1 error "$tmp/$name.log")"; fi
done
preset=0
for name in tiny balanced accurate; do
    for frame in 0 1 2 3 4; do
        same $name "160 120 0 - $frame" host "160 120 0 - $frame $preset" "preset $name at compile time against run time"
        same $name "95 71 1 $frame $frame" host "95 71 1 $frame $frame $preset" "preset $name at compile time against run time"
    done
    same $name "320 240 1 4 9" host "320 240 1 4 9 $preset" "preset $name at compile time against run time, focal length 255.99"
    preset=$((preset + 1))
done
# screen coordinates of a wide picture: the guard band reaches beyond it
for frame in 0 1 2 3 4; do same wide "2048 80 1 - $frame" host "2048 80 1 - $frame 0" "2048 pixels wide at compile time against run time"; done
if [ "$("$tmp/host.run" 160 120 0 - 0)" = "$("$tmp/host.run" 160 120 0 - 1)" ]; then fail "the demo's frames do not differ"; else pass; fi

program plain -DGN_DEPTH_BLOCKS=0 && for filter in 0 1 2 3 4; do
    same plain "160 120 1 $filter 0" balanced "160 120 1 $filter 0" "without depth blocks"
done
program hard -DGN_FILTER_MAX=0 && same hard "160 120 1 0 0" balanced "160 120 1 0 0" "hard filter alone"
program tent -DGN_FILTER_MAX=2 && same tent "160 120 1 2 0" balanced "160 120 1 2 0" "3x3 filter the largest"

# ---- Capacities ------------------------------------------------------------------------------------------------------------

# status name -> number, from the order of the list
number() { sed -n 's/^ *X(\(GN_[A-Z_]*\),.*/\1/p' lib/gnomon.h | awk -v name="$1" '$1 == name { print NR - 1 }'; }

# full NAME STATUS MACRO OTHER-FLAGS [FRAME]: too few; as many as are needed; one less
full() {
    frame=${5:-0} status=$2 macro=$3 flags=$4 name=$1
    program "$name" "-D$macro=3" $flags || return
    set -- $("$tmp/$name.run" 160 120 0 - "$frame")
    if [ "$1 $3" = "$(number "$status") 3" ] && [ "${2:-0}" -gt 3 ]; then pass; else fail "$macro=3: status ${1:-?}, needed ${2:-?}, available ${3:-?}"; return; fi
    needed=$2
    program "$name" "-D$macro=$needed" $flags || return
    same "$name" "160 120 0 - $frame" balanced "160 120 0 - $frame" "$macro=$needed, as needed"
    program "$name" "-D$macro=$((needed - 1))" $flags || return
    if [ "$("$tmp/$name.run" 160 120 0 - "$frame")" = "$(number "$status") $needed $((needed - 1))" ]; then pass; else fail "$macro=$((needed - 1)): it needs $needed"; fi
}

full triangles GN_ERR_TRIANGLES_FULL GN_MAX_TRIANGLES ""
full refs GN_ERR_TILE_REFS_FULL GN_MAX_TILE_REFS ""
full tiles GN_ERR_SHADOW_TILES_FULL GN_MAX_SHADOW_TILES "" 1

# ---- Memory ----------------------------------------------------------------------------------------------------------------

cat >"$tmp/ram.c" <<'EOF_C'
/* ram PRESET KEY=VALUE...: what the tool predicts for the library's default capacities. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "host/tool/settings.h"
int main(int argc, char **argv)
{
    settings set;
    scene none;
    char error[200];
    memset(&none, 0, sizeof none);
    settings_init(&set);
    settings_preset(&set, atoi(argv[1]));
    if (settings_apply_all(&set, &none, argv + 2, argc - 2, error, sizeof error)) {
        printf("%s\n", error);
        return 1;
    }
    printf("%ld\n", settings_ram(&set).total);
    return 0;
}
EOF_C
if gcc -std=c11 -D_POSIX_C_SOURCE=200809L -O1 $warn -Ilib -I. $host_knobs -o "$tmp/ram" "$tmp/ram.c" host/tool/settings*.c host/tool/output.c host/scene/*.c -lm >"$tmp/ram.log" 2>&1; then
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

# predicted PRESET KEY=VALUE...: the tool and the compiler agree
predicted() {
    preset=$1
    shift
    flags="-DGN_PRESET=$preset" sets=
    for key in max_width max_height max_triangles max_tile_refs max_lights surface_lights max_objects max_shadow_tiles max_other_tiles vertex_cache; do
        macro=GN_$(echo $key | tr a-z A-Z)
        sets="$sets $key=$(sed -n "s/^#define $macro \([0-9]*\)$/\1/p" lib/gn_config.h)"
    done
    for set in "$@"; do flags="$flags -DGN_$(echo "${set%%=*}" | tr a-z A-Z)=${set#*=}"; done
    ram=$("$tmp/ram" "$preset" $sets "$@")
    if size_is "== $ram" $flags; then pass; else fail "RAM with $flags: predicted $ram, is $(size_of $flags)"; fi
}

if [ -n "$target" ]; then
    for preset in 0 1 2; do
        predicted $preset
        predicted $preset shadows=0
        predicted $preset raw_views=1
        predicted $preset depth_blocks=0
        predicted $preset incremental=0
        predicted $preset static_layer=1
        predicted $preset static_layer=1 depth_blocks=0 incremental=0
        predicted $preset punctual_lights=0
        predicted $preset main_light=0
        predicted $preset punctual_lights=0 main_light=0
        predicted $preset punctual_lights=0 main_light=0 shadows=0 max_objects=3 max_lights=1
        predicted $preset depth_bits=8 other_depth_bits=32 atlas_size=16 other_atlas_size=512
        predicted $preset depth_bits=32 other_depth_bits=8 atlas_size=32 other_atlas_size=16 static_layer=1
        predicted $preset max_width=333 max_height=17 max_triangles=7 max_tile_refs=9 max_lights=3 max_shadow_tiles=16 vertex_cache=64
        predicted $preset max_objects=777 max_other_tiles=13 surface_lights=3 max_shadow_tiles=1 max_lights=5
        predicted $preset max_tile_refs=70001 atlas_size=64 tile_width=72 tile_height=5 max_lights=8
        predicted $preset max_tile_refs=70001 atlas_size=16 tile_width=24 tile_height=1 shadows=0
    done
fi
if size_is '<= 65536' -DGN_PRESET=GN_PRESET_BALANCED -DGN_MAX_WIDTH=320 -DGN_MAX_HEIGHT=240 -DGN_ATLAS_SIZE=128 -DGN_MAX_TRIANGLES=500; then pass
else fail "preset balanced, 320x240, 500 triangles: more than 64 KiB of RAM"; fi

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
