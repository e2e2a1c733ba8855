#!/bin/sh
# Every configuration builds without a warning with two compilers and draws what the host build draws of the same scene; what is
# not built in is refused; wrong configurations do not build, and say why; capacities that are too small say how many they lack.
# THOROUGH=1: each feature also alone, all but each, and more combinations.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh

variable() { make -s --no-print-directory WERROR=-Werror --eval="print: ; @echo \$($1)" print; }
warn=$(variable WARN)
host_knobs=$(variable HOST_KNOBS)
strict="-std=c99 -pedantic $warn -Ilib"

features=$(sed -n '/GN_FEATURE_KNOBS/,$s/^    X([a-z_0-9]*, \([A-Z_0-9]*\), .*/\1/p' lib/gn_knobs.h | grep -v -e VALIDATION -e "^CLIPPING")
# flags WORD...: "none" and "all" of the features, "tiny"..., NAME=VALUE of a knob, or a flag as it is; of a name the last value counts
flags() {
    for word in "$@"; do
        case $word in
        none) echo "$none" ;;
        all) echo "$all" ;;
        tiny | fast | balanced | accurate) echo "-DGN_PRESET=GN_PRESET_$(echo "$word" | tr a-z A-Z)" ;;
        -*) echo "$word" ;;
        *) echo "-DGN_$word" ;;
        esac
    done | awk -F= '!($1 in at) { at[$1] = ++n } { flag[at[$1]] = $0 } END { for (i = 1; i <= n; i++) print flag[i] }'
}
most() {
    case $1 in
    SHADOWS) echo 6 ;;
    VERTEX_JOINTS) echo 4 ;;
    MANY_CASCADES | BIASES | OTHER_LIGHTS | VERTEX_VALUES) echo 3 ;;
    INCREMENTAL) echo 3 ;;
    TILE_SIZES | CLIPPING) echo 2 ;;
    TEXTURE_FORMATS) echo 2047 ;;
    PICTURES | MATERIALS) echo 15 ;;
    *) echo 1 ;;
    esac
}
none=$(for feature in $features; do echo "-DGN_$feature=0"; done) all=$(for feature in $features; do echo "-DGN_$feature=$(most "$feature")"; done)

# ---- What must build, and draw the same ------------------------------------------------------------------------------------

more() { [ -z "$THOROUGH" ] || echo "$@"; } # of parts that other configurations have, each

# Eight configurations under shadows that together have of any two features one, the other, both; "none" has neither. Each feature is in
# five of them, no two in the same five: 56 features at most.
others=$(echo "$features" | grep -v -x SHADOWS)
pairs() {
    for feature in $others; do echo "$feature=$(most "$feature")"; done | awk '{ feature[NR] = $1 }
        END {
            for (a = 1; a < 9; a++) for (b = 1; b < a; b++) for (c = 1; c < b; c++) {
                k++
                for (i = 1; i < 9; i++) if (i != a && i != b && i != c) of[i] = of[i] " " feature[k]
            }
            for (i = 1; i < 9; i++) { gsub(/ +/, " ", of[i]); print "none SHADOWS=1" of[i] }
        }'
}
{
    echo
    echo "none"
    echo "all"
    pairs
    idle= # alone they have nothing to do: over shadows, or lights
    for feature in $features; do
        value=$(most "$feature")
        case $feature in
        *CASC* | *BIAS* | INCREM* | TILE_S* | OBJECT_B*)
            idle="$idle $feature=$value"
            more "none SHADOWS=1 $feature=$value" ;;
        *) more "none $feature=$value" ;;
        esac
        more "all $feature=0" # tests/firmware/test_absent.sh builds these: nothing undefined is left
    done
    more "none $idle"
    echo "all VALIDATION=0"
    more "none SHADOWS=1 VALIDATION=0 tiny SRGB=0"
    for part in 4 8; do
        more "none SHADOWS=1 TEXTURE_FORMATS=1023 MATERIALS=$part"
        more "all TEXTURE_FORMATS=0 MATERIALS=$((3 + part))"
    done
    for level in TEXTURE_FORMATS=1023 MANY_CASCADES=1 MANY_CASCADES=2 TILE_SIZES=1 INCREMENTAL=1 INCREMENTAL=2 SHADOWS=5; do more "all $level"; done
    echo "all TEXTURE_FORMATS=1023 MANY_CASCADES=1 TILE_SIZES=1 INCREMENTAL=1"
    echo "all MANY_CASCADES=2 INCREMENTAL=2 SHADOWS=5"
    for parts in "OTHER_LIGHTS=1 VERTEX_VALUES=2 BIASES=1 MATERIALS=10 PICTURES=1" "OTHER_LIGHTS=2 VERTEX_VALUES=1 BIASES=2 MATERIALS=5 PICTURES=6"; do
        echo "all $parts"
        more "none SHADOWS=1 $parts"
    done
    echo "none SHADOWS=1"
    more "none SHADOWS=1 OTHER_LIGHTS=1"
    more "none SHADOWS=1 OTHER_LIGHTS=3 BIASES=2"
    more "all OTHER_LIGHTS=2 MANY_CASCADES=1"
    echo "all OTHER_LIGHTS=0"
    more "none SHADOWS=1 INCREMENTAL=3"
    for level in 1 2 3 4; do # with what builds upon kernels
        $([ $level = 2 ] && echo echo || echo more) "all SHADOWS=$level BIASES=$((level % 2 ? 1 : 3))"
    done
    for bits in "8 32" "16 8" "32 16"; do
        echo "DEPTH_BITS=${bits% *} OTHER_DEPTH_BITS=${bits#* } SHADOWS=$((5 + ${bits% *} / 16 % 2))"
    done
    more "OTHER_LIGHTS=0 DEPTH_BITS=8"
    more "EDGE=4"
    more "tiny all EDGE=8 DEPTH_BITS=32"
    echo "fast EDGE=1 OTHER_LIGHTS=2 BIASES=1"
    more "accurate EDGE=3 SHADOWS=1"
    more "OTHER_LIGHTS=0 DEPTH_BITS=32 INCREMENTAL=3"
    echo "OTHER_ATLAS_SIZE=32 ATLAS_SIZE=64 TILE_WIDTH=32 TILE_HEIGHT=5"
    echo "TRIANGLE_GROUPS=64 MAX_TRIANGLES=400 MAX_TILE_REFS=1"
    echo "TRANSPARENT_LAYERS=1 TEXTURE_FORMATS=0 SIZE_FIRST=1"
    echo "fast TRANSPARENT_LAYERS=3 TRIANGLE_GROUPS=64 MAX_TRIANGLES=400"
    more "accurate all TRANSPARENT_LAYERS=2 PICTURES=2"
    more "none TRIANGLE_GROUPS=3 TILE_WIDTH=24 SIZE_FIRST=1 VALIDATION=2"
    more "tiny all TRIANGLE_GROUPS=4096"
    more "-m32 accurate TRIANGLE_GROUPS=17"
    for preset in tiny fast accurate; do # balanced is the default
        echo "$preset"
        more "$preset none"
        more "-m32 $preset"
    done
    more "tiny all SRGB=0 VALIDATION=2"
    more "accurate all SRGB=0"
    more "-m32"
    more "-m32 none"
    echo "-m32 all"
    more "-m32 all SHADOWS=0"
    more "-m32 all OTHER_LIGHTS=2 DEPTH_BITS=32"
    echo "RUNTIME_KNOBS=1"
    more "RUNTIME_KNOBS=1 SHADOWS=0"
    more "RUNTIME_KNOBS=1 SHADOWS=1"
    echo "SUBPIXEL_BITS=8 MAX_TILE_REFS=65535"
    echo "MAX_TILE_REFS=65536 MAX_LIGHTS=4 SURFACE_LIGHTS=4 MAX_OBJECTS=3"
    echo "MAX_WIDTH=56 MAX_HEIGHT=44 TILE_WIDTH=8 TILE_HEIGHT=1 MAX_TILE_REFS=2000"
} >"$tmp/wanted"

words32=$(sh tests/support/words32.sh)

# draws N COMPILER CHECKER FLAGS...: built by the one without a warning, and looked through by the other; the same lines as the host
draws() {
    n=$1 compiler=$2 checker=$3
    shift 3
    words=$*
    set -- $(flags "$@")
    if ! $compiler $strict -O0 "$@" -Itests/support -o "$tmp/run$n" lib/gnomon.c tests/property/config_picture.c 2>"$tmp/log$n" ||
        ! $checker $strict "$@" -fsyntax-only lib/gnomon.c 2>"$tmp/log$n"; then
        echo "$compiler, $checker: does not build: $words"
        grep -m 3 -E 'error|warning|undefined' "$tmp/log$n"
        return
    fi
    case $words in -m32*) on=$words32 ;; *) on= ;; esac
    $on "$tmp/run$n" >"$tmp/target$n" 2>&1
    "$tmp/host_picture" -DGN_PRESET=GN_PRESET_BALANCED "$@" >"$tmp/host$n" 2>&1
    if cmp -s "$tmp/target$n" "$tmp/host$n" && grep -q '^format' "$tmp/host$n" && ! grep -q -v '^format' "$tmp/host$n"; then echo ok
    else
        echo "$compiler: draws something else than the host: $words"
        diff "$tmp/target$n" "$tmp/host$n" | sed -n 2p
    fi
    rm -f "$tmp/run$n" "$tmp/target$n" "$tmp/host$n"
}

# every second line, from line $1 on; the compilers take turns, the faster one more often. Only gcc keeps functions that nobody calls, and so
# finds what they call and is not built.
some_draw() {
    line=0
    while read -r words; do
        line=$((line + 1))
        [ $((line % 2)) = "$1" ] || continue
        case $words in
        "all "*=0) compiler=gcc ;;
        *) [ $((line / 2 % 12)) = 0 ] && compiler=gcc || compiler=clang ;;
        esac
        if [ $compiler = gcc ]; then draws "$1" gcc clang $words; else draws "$1" clang gcc $words; fi
    done <"$tmp/wanted"
}

# the library of the tool, as tests/run.sh built it; what else it counts is in one object
host_lib="$(variable LIB_OBJ) build/obj/host/tool/cost/count.o"
if make -s -j2 SAN=-g0 $host_lib >"$tmp/log" 2>&1 && gcc $strict -O1 $host_knobs -Itests/support -o "$tmp/host_picture" tests/property/config_picture.c $host_lib 2>"$tmp/log"; then
    (
        trap - EXIT # it is not this subshell that cleans up
        some_draw 0 >"$tmp/drawn0"
    ) &
    some_draw 1 >"$tmp/drawn1"
    wait
    passed=$((passed + $(cat "$tmp"/drawn? | grep -c '^ok$')))
    failed=$((failed + $(wc -l <"$tmp/wanted") - passed))
    grep -hv '^ok$' "$tmp"/drawn?
else fail "the host build: $(grep -m 1 -E 'error|undefined' "$tmp/log")"; fi

[ "$(echo "$others" | wc -l)" -le 56 ] && pass || fail "more than 56 features: pairs() leaves some out"

# file by file, as users build it: what each needs, it includes itself
for flags in "" "$none" "$all" "$(flags MAX_WIDTH=1 MAX_HEIGHT=1 MAX_TRIANGLES=1 MAX_TILE_REFS=1 TILE_WIDTH=8 TILE_HEIGHT=1 ATLAS_SIZE=16 OTHER_ATLAS_SIZE=16 \
    MAX_LIGHTS=1 SURFACE_LIGHTS=1 MAX_OBJECTS=1 MAX_SHADOW_TILES=1 MAX_OTHER_TILES=1)"; do
    for compiler in gcc clang; do
        if $compiler $strict $flags -O1 -ffreestanding -fsyntax-only lib/*.c >"$tmp/log" 2>&1; then pass
        else fail "$compiler $flags: $(grep -m 1 -E 'error|warning' "$tmp/log")"; fi
    done
done

# ---- What must not ---------------------------------------------------------------------------------------------------------

# refused NAME FLAG: the build stops and its message names the knob
refused() {
    if gcc -std=c99 -Ilib $2 -fsyntax-only "$tmp/check.c" >"$tmp/message" 2>&1; then fail "builds with $2"
    elif grep -q "error.*$1" "$tmp/message"; then pass
    else fail "$2: the message does not name $1: $(grep -m 1 error "$tmp/message")"
    fi
}

grep -q '"frame/gn_check.h"' lib/frame/gn_frame.c && pass || fail "lib/frame/gn_frame.c does not include the checks"
echo '#include "frame/gn_check.h"' >"$tmp/check.c"
if gcc -std=c99 -Ilib -fsyntax-only "$tmp/check.c"; then pass; else fail "lib/frame/gn_check.h does not stand alone"; fi
sed -n 's/^ *X(\([a-z_]*\), \([A-Z_]*\), \([0-9]*\), \([0-9]*\),.*/\1 \2 \3 \4/p' lib/gn_knobs.h >"$tmp/knobs"
[ "$(wc -l <"$tmp/knobs")" = "$(grep -c '^ *X(' lib/gn_knobs.h)" ] && pass || fail "the list of knobs in lib/gn_knobs.h is not understood"
while read -r name macro low high; do
    refused "${name}_out_of_range" "-DGN_$macro=$((low - 1))"
    refused "${name}_out_of_range" "-DGN_$macro=$((high + 1))"
done <"$tmp/knobs"
refused preset_unknown -DGN_PRESET=4
refused preset_unknown -DGN_PRESET=-1
refused persp_step -DGN_PERSP_STEP=2
refused atlas_size -DGN_ATLAS_SIZE=96
refused other_atlas_size -DGN_OTHER_ATLAS_SIZE=96
refused depth_bits -DGN_DEPTH_BITS=24
refused other_depth_bits -DGN_OTHER_DEPTH_BITS=12
refused tile_width -DGN_TILE_WIDTH=68
refused triangle_groups_have_tiles "-DGN_TRIANGLE_GROUPS=1 -DGN_TILE_WIDTH=8 -DGN_TILE_HEIGHT=1 -DGN_MAX_HEIGHT=100"
refused triangle_groups_have_up_to_128 "-DGN_TRIANGLE_GROUPS=1 -DGN_TILE_HEIGHT=1"
for gone in TILE_LIGHTS LINEAR_KERNELS DEPTH_BLOCKS ATTEN_BITS NEWTON_STEPS SHADOW_DEPTH_FRAC SHADOW_SUBPIXEL_BITS WEIGHT_BITS VERTEX_CACHE; do refused "knob that is gone" "-DGN_$gone=0"; done
for part in CASTER_ALPHA VISIBLE_ALPHA EMISSIVE_TEXTURES MASKS BAKED_LIGHT RECEIVER_BIAS CASTER_BIAS RECEIVER_PLANE BLENDED_CASCADES CASTER_CULLING DISK_FILTER \
    TEXTURE_LEVELS STATIC_LAYER TILE_IMPORTANCE TIGHT_FIT CASTER_CLIPPING CLIPS PICKING RAW_VIEWS ERROR_FIELDS FILTER_MAX TEXTURES AUTO_BIAS OTHER_BIASES SPECULAR EMISSIVE POSITION_BITS NORMAL_BITS TILE_DRAWING \
    OTHER_FORMATS ORTHOGRAPHIC PUNCTUAL_LIGHTS MAIN_LIGHT VERTEX_NORMALS VERTEX_COLOURS ALPHA BAKED; do
    refused "part of another one" "-DGN_$part=0"
done
refused transparent_layers_need_alpha "-DGN_TRANSPARENT_LAYERS=1 -DGN_MATERIALS=0"

# ---- The user's own header; C++ --------------------------------------------------------------------------------------------

cat >"$tmp/my_config.h" <<'EOF_C'
#define GN_PRESET GN_PRESET_TINY
#define GN_MAX_TRIANGLES 77
#define GN_SHADOWS 0
EOF_C
cat >"$tmp/user.c" <<'EOF_C'
#include "gnomon.h"
typedef char tiny_tile[GN_TILE_HEIGHT == 16 && GN_DEPTH_BITS == 8 ? 1 : -1];
typedef char own_capacity[GN_MAX_TRIANGLES == 77 && sizeof(((gn_frame *)0)->records.tri) == 77 * sizeof(gn_tri) ? 1 : -1];
typedef char no_shadows[GN_SHADOWS == 0 ? 1 : -1];
EOF_C
if gcc $strict -I"$tmp" '-DGN_USER_CONFIG="my_config.h"' -fsyntax-only "$tmp/user.c" 2>"$tmp/message"; then pass
else fail "GN_USER_CONFIG: $(grep -m 1 error "$tmp/message")"; fi
if gcc $strict -I"$tmp" '-DGN_USER_CONFIG="my_config.h"' -O1 -ffreestanding -c -o "$tmp/user.o" lib/gnomon.c 2>"$tmp/user.log"; then pass
else fail "GN_USER_CONFIG: $(grep -m 1 error "$tmp/user.log")"; fi

cat >"$tmp/user.cpp" <<'EOF_C'
#include "gnomon.h"
static gn_renderer renderer;
static const int32_t pos[9] = {GN_Q16(-1), 0, 0, GN_Q16(1.5), 0, 0, 0, GN_Q16(1), 0};
static const uint16_t idx[3] = {0, 1, 2};
static void flush(void *, int, int, int, int, const void *) {}
gn_status draw()
{
    gn_mesh mesh = {pos, nullptr, nullptr, nullptr, nullptr, idx, 3, 1, 16, 0};
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
    return gn_get_detail(&renderer)->needed ? GN_ERR_NO_BEGIN : gn_status_text(status)[0] ? status : GN_OK;
}
EOF_C
for words in "" none all "SHADOWS=0 PICTURES=15" RUNTIME_KNOBS=1 accurate; do
    if g++ -std=c++11 -Wall -Wextra -pedantic -Werror -Ilib $(flags $words) -fsyntax-only "$tmp/user.cpp" 2>"$tmp/message"; then pass
    else fail "C++ $words: $(grep -m 1 error "$tmp/message")"; fi
done

# what a user need not set, where positions are short, too
for words in "" SHORT_VERTICES=3; do
    if clang $strict -Itests/support -O0 $(flags $words) -o "$tmp/defaults" lib/gnomon.c tests/unit/test_defaults.c 2>"$tmp/log" && "$tmp/defaults" >"$tmp/log"; then pass
    else fail "tests/unit/test_defaults.c with '$words': $(grep -m 1 -E 'error|failed' "$tmp/log")"; fi
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
    int preset = argc > 6 ? atoi(argv[6]) : GN_PRESET_BALANCED;
#define PRESET_(name, MACRO, lo, hi, meaning, cost) { static const int32_t v[] = {GN_PRESETS_##MACRO}; renderer.frame.knobs.name = v[preset]; }
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

# program NAME LIBRARY FLAGS...: $tmp/NAME.run
program() {
    program_name=$1 library=$2
    shift 2
    clang $strict -Itests/support -O0 "$@" -o "$tmp/$program_name.run" "$tmp/picture.c" $library >"$tmp/$program_name.log" 2>&1 || {
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
    program host "$host_lib" $host_knobs
    program wide lib/gnomon.c -DGN_MAX_WIDTH=2048 -DGN_PRESET=GN_PRESET_TINY
) &
for preset in tiny fast balanced accurate; do program $preset lib/gnomon.c -DGN_PRESET=GN_PRESET_$(echo $preset | tr a-z A-Z); done
wait
for name in host wide tiny fast balanced accurate; do
    if [ -x "$tmp/$name.run" ]; then pass; else fail "no program '$name': $(grep -m 1 error "$tmp/$name.log")"; fi
done
preset=0
for name in tiny fast balanced accurate; do
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


# ---- Capacities ------------------------------------------------------------------------------------------------------------

# status name -> number, from the order of the list
number() { sed -n 's/^ *X(\(GN_[A-Z_]*\),.*/\1/p' lib/gnomon.h | awk -v name="$1" '$1 == name { print NR - 1 }'; }

small() { # small FLAGS...: the last line of what the scene of tests/property/config_picture.c prints
    clang $strict -Itests/support -O0 $(flags "$@") -o "$tmp/small" lib/gnomon.c tests/property/config_picture.c 2>"$tmp/log" || { head -n 1 "$tmp/log"; return; }
    "$tmp/small" | tail -n 1
}

# full STATUS MACRO TOO-FEW STEP FLAGS...: too few; as many as are said to be needed, of those without flags below all at once; a step less
enough=
full() {
    status=$(number "$1") macro=$2 few=$3 step=$4
    shift 4
    message=$(small "-D$macro=$few" "$@")
    needed=$(echo "$message" | cut -d ' ' -f 4)
    if [ "$message" = "status $status needed ${needed:-0} available $few" ]; then pass
    else fail "$macro=$few: $message, not status $status"; return; fi
    if [ $# = 0 ]; then enough="$enough -D$macro=$needed"
    else
        message=$(small "-D$macro=$needed" "$@")
        if [ "$message" = "$(small "$@")" ]; then pass; else fail "$macro=$needed, as needed: $message"; fi
    fi
    message=$(small "-D$macro=$((needed - step))" "$@")
    if [ "$message" = "status $status needed $needed available $((needed - step))" ]; then pass; else fail "$macro=$((needed - step)): $message"; fi
}

plain=$(small)
full GN_ERR_TRIANGLES_FULL GN_MAX_TRIANGLES 3 1
full GN_ERR_TRIANGLES_FULL GN_MAX_TRIANGLES 1 1 TRIANGLE_GROUPS=8
full GN_ERR_TILE_REFS_FULL GN_MAX_TILE_REFS 3 1
full GN_ERR_TOO_MANY_OBJECTS GN_MAX_OBJECTS 1 1
full GN_ERR_TOO_MANY_LIGHTS GN_MAX_LIGHTS 1 1 OTHER_LIGHTS=2
full GN_ERR_SURFACE_LIGHTS GN_SURFACE_LIGHTS 1 1
for macro in GN_ATLAS_TEXELS GN_OTHER_ATLAS_TEXELS; do full GN_ERR_ATLAS_FULL $macro 64 64; done # they come in blocks of 64
[ "$(echo $enough | wc -w)" = 6 ] && message=$(small $enough) && [ "$message" = "$plain" ] && pass || fail "$enough, as needed: $message"
# shadow tiles are no capacity that a frame fails for: lights go without, and are counted (A3)
message=$(small MAX_SHADOW_TILES=1)
if [ "$message" = "without room: 1" ]; then pass; else fail "GN_MAX_SHADOW_TILES=1: $message"; fi
message=$(small MAX_OTHER_TILES=1)
if [ "$message" = "without room: 2" ]; then pass; else fail "GN_MAX_OTHER_TILES=1: $message"; fi

# A core whose int has 16 bits is refused in words, first of all, in a program and in the library.
printf '#include "gnomon.h"\n' >"$tmp/avr.c"
for core in avr msp430; do
    for file in "$tmp/avr.c" lib/gnomon.c; do
        clang --target=$core -w -ffreestanding -fsyntax-only -Ilib "$file" 2>&1 | grep -m 1 'error' | grep -q 'Gnomon needs a core of 32 bits' && pass || fail "$core, $file: no word on its int of 16 bits"
    done
done

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
