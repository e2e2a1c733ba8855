#!/bin/sh
# gnomon compile: what it writes builds without a warning and draws the very bytes of gnomon render. usage: test_compile.sh [TOOL]
# THOROUGH=1: every scene with every preset, flash of more scenes, and -Os without a warning apart from boards.
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh

variable() { make -s --no-print-directory WERROR=-Werror --eval="print: ; @echo \$($1)" print; }
warn=$(variable WARN)
strict="-std=c99 -pedantic-errors $warn -Ilib"
if gcc -std=c11 -D_POSIX_C_SOURCE=200809L -O2 $warn -Itests -o "$tmp/same" tests/tool/same_pictures.c host/scene/image/*.c host/base/arena.c -lm \
    >"$tmp/log" 2>&1; then pass; else fail "same_pictures: $(grep -m 1 -E 'error|undefined' "$tmp/log")"; fi

# build NAME: the firmware of build/tmp/.../NAME as a program; what was written, without a warning. Clang compiles it in a third of
# gcc's time; gcc, which keeps functions that nobody calls, two whole scenes, THOROUGH=1: all of them.
build() {
    case $THOROUGH$1 in mixed-tiny | avenue-accurate | 1*-tiny | 1*-fast | 1*-balanced | 1*-accurate) compiler=gcc ;; *) compiler=clang ;; esac
    gcc $strict -fsyntax-only -I"$tmp/$1" '-DGN_USER_CONFIG="gn_scene_config.h"' "$tmp/$1/scene.c" 2>"$tmp/$1/log" &&
        $compiler -std=c99 -w -O0 -Ilib -I"$tmp/$1" '-DGN_USER_CONFIG="gn_scene_config.h"' -o "$tmp/$1/run" lib/gnomon.c "$tmp/$1/scene.c" \
            tests/tool/compiled_picture.c 2>"$tmp/$1/log"
}

# same NAME SCENE "FRAMES" "COMPILE-OPTIONS" OPTIONS...: what the compiled scene shows at frames of its own is what the tool renders
same() {
    name=$1 scene=$2 frames=$3 options=$4
    shift 4
    mkdir -p "$tmp/$name"
    if ! "$tool" compile "$scene" -o "$tmp/$name" $options "$@" >"$tmp/$name/log" 2>&1; then fail "$name: $(head -n 1 "$tmp/$name/log")"; return; fi
    if ! build "$name"; then fail "$name does not build: $(grep -m 1 -E 'error|undefined' "$tmp/$name/log")"; return; fi
    pictures=
    for frame in $frames; do
        "$tool" render "$scene" -o "$tmp/$name/$frame.png" --frame "$frame" "$@" >"$tmp/$name/log" 2>&1
        pictures="$pictures $tmp/$name/$frame.png"
    done
    if "$tmp/$name/run" $frames 2>"$tmp/$name/log" | "$tmp/same" $pictures >"$tmp/$name/differ"; then pass
    else fail "$name: $(head -n 1 "$tmp/$name/log" "$tmp/$name/differ" | tr '\n' ' ')"; fi
}

# every scene and every preset, nothing left out, all frames
whole() { # whole SCENE PRESET "FRAMES" SIZE
    for preset in $([ "$THOROUGH" ] && echo tiny fast balanced accurate || echo "$2"); do
        same "$1-$preset" "host/scenes/$1.gltf" "$3" "--simplify none" --size "$4" --set preset=$preset
    done
}
whole sundial balanced "0 1 77 144 9" 96x64
whole avenue accurate 0 200x100
whole desk tiny "0 1 2 30 48" 96x64
whole room accurate 0 160x120
whole fence balanced 0 200x100
whole mixed tiny "24 0 25 48" 160x120
# what none of these frames shows left out
same sundial host/scenes/sundial.gltf "0 2 4 1" "--frames 0-4" --size 160x120
same avenue host/scenes/avenue.gltf 0 ""
same desk host/scenes/desk.gltf "0 2 3" "--frames 0-3" --size 96x64
same room host/scenes/room.gltf 0 "" --size 160x120
same fence host/scenes/fence.gltf 0 "--set output=grey4" --size 160x120
same cube host/scenes/cube.gltf "9 0 48" "" --size 96x64 --set transparent_layers=1 # where nothing has alpha
# mirrors, scales of 0, and vertices that are there twice: with them once, no pixel is another
for preset in tiny ${THOROUGH:+fast balanced}; do same "scales-$preset" tests/data/scales.gltf "24 0 48" "--frames 0-48" --size 160x120 --set preset=$preset; done
"$tool" compile tests/data/scales.gltf -o "$tmp/scales-tiny" --size 160x120 >"$tmp/log" 2>&1
! grep -q "frames would change" "$tmp/log" && grep -q "vertices that were there twice" "$tmp/scales-tiny/gn_scene_config.h" &&
    pass || fail "scales: $(cat "$tmp/log")"
same snake docs/scenes/snake.gltf "1 5 0" "--frames 0-5" --size 96x64 # [R12]
same mixed host/scenes/mixed.gltf "1 0" "--frames 0-1" --size 96x64 --set preset=tiny
same compact host/scenes/sundial.gltf "1 0 4" "--frames 0-4" --size 160x120 --set compact=1
same unshadowed host/scenes/sundial.gltf 0 "" --size 96x64 --frames 0-0 --set preset=accurate --set shadows=0
same compact-avenue host/scenes/avenue.gltf 0 "--simplify none" --size 96x64 --set compact=1 --set srgb=0 --set atlas_size=64
# [D12] boxes for the whole animation; what is open has none
same cube-fits host/scenes/cube.gltf "9 0 48" "" --size 96x64 --set fit=compiled
same mixed-fits host/scenes/mixed.gltf "24 0" "--simplify none" --size 96x64 --set preset=tiny --set fit=compiled
# [A7] tiles by worth share fewer texels than the squares have
same mixed-texels host/scenes/mixed.gltf "1 0" "--frames 0-1 --simplify none" --size 96x64 --set preset=tiny --set atlas_texels=2048 --set other_atlas_texels=1472
grep -q '^#define GN_OTHER_ATLAS_TEXELS *1472 ' "$tmp/mixed-texels/gn_scene_config.h" && pass || fail "mixed-texels: $(grep TEXELS "$tmp/mixed-texels/gn_scene_config.h")"
"$tool" compile host/scenes/cube.gltf --open -o "$tmp/open-fits" --size 96x64 --set fit=compiled >/dev/null 2>&1
for name in cube:1 mixed:2; do
    grep -q "gn_fixed_fit fixed_fits\[${name#*:}\]" "$tmp/${name%:*}-fits/scene.c" && pass || fail "${name%:*}: there are not ${name#*:} boxes"
done
grep -q gn_fixed_fit "$tmp/open-fits/scene.c" && fail "an open scene has boxes" || pass
grep -q '^#define GN_COMPACT  *1 ' "$tmp/compact/gn_scene_config.h" && ! grep -q GN_COMPACT "$tmp/sundial/gn_scene_config.h" && pass || fail "GN_COMPACT is not where it was set"

# vertices in half the bytes: the tool quantises alike
same short host/scenes/sundial.gltf "0 2" "--frames 0-2" --size 96x64 --set short_vertices=3
same short-room host/scenes/room.gltf 0 "--simplify none" --size 96x64 --set short_vertices=1
# chosen where no bit of the picture changes, else measured
mesh() { # mesh NAME X: a pyramid on a grid but for a coordinate X of four bytes, as glTF
    zero='\000\000\000\000' one='\000\000\200\077' minus='\000\000\200\277' words='\000\000\001\000\002\000\000\000\002\000\003\000\000\000\004\000\001\000\003\000\004\000\000\000'
    bytes=$(printf "$zero$zero$zero$one$zero$zero$2$one$zero$zero$one$zero$zero$zero$minus$words" | base64 -w 0)
    cat >"$tmp/$1.gltf" <<E_GLTF
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "translation": [0.3, 0.1, 0.7]}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3"}, {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
 "bufferViews": [{"buffer": 0, "byteLength": 60}, {"buffer": 0, "byteOffset": 60, "byteLength": 24}],
 "buffers": [{"byteLength": 84, "uri": "data:application/octet-stream;base64,$bytes"}]}
E_GLTF
}
mesh grid '\000\000\200\077'
mesh off '\315\314\214\077' # 1.1
same grid "$tmp/grid.gltf" 0 "--simplify safe" --size 96x64 --set ground=0
same off "$tmp/off.gltf" 0 "--simplify safe" --size 96x64 --set ground=0
same wide "$tmp/grid.gltf" 0 "" --size 96x64 --set ground=0 --set short_vertices=0
for name in grid:1 off:0 wide:0; do
    grep -q "^#define GN_SHORT_VERTICES *${name#*:} " "$tmp/${name%:*}/gn_scene_config.h" && pass || fail "${name%:*}: short_vertices is not ${name#*:}"
done
grep -q 'positions that 16 bits hold exactly' "$tmp/grid/gn_scene_config.h" && grep -q 'short_vertices=1 [0-9]* less: ' "$tmp/off/gn_scene_config.h" &&
    pass || fail "it is not said what 16 bits change"
grep -q 'static const gn_position ' "$tmp/short/scene.c" && grep -q '^#define GN_SHORT_VERTICES *3 ' "$tmp/short/gn_scene_config.h" && pass || fail "short: no short positions"

# ---- What it says it takes -------------------------------------------------------------------------------------------------------

# takes NAME COMPILER FLAGS...: sizeof of what the build declares, "renderer state"
printf '#include "scene.h"\nchar renderer_bytes[sizeof(gn_renderer)], state_bytes[sizeof(scene_state)];\n' >"$tmp/takes.c"
takes() {
    name=$1
    shift
    "$@" -std=c99 -ffreestanding -Ilib -I"$tmp/$name" '-DGN_USER_CONFIG="gn_scene_config.h"' -fno-common -c -o "$tmp/takes.o" "$tmp/takes.c" 2>"$tmp/log" &&
        nm -S -t d "$tmp/takes.o" | awk '{ size[$4] = $2 + 0 } END { print size["renderer_bytes"], size["state_bytes"] }'
}
# to the byte, on targets whose enumerations are words, and on Arm
for name in sundial desk room mixed-tiny fence avenue-accurate compact cube-fits; do
    said=$(sed -n 's/^ \* RAM, bytes: gn_renderer \([0-9]*\), scene_state \([0-9]*\); on Arm, .*, \([0-9]*\) and \([0-9]*\)\..*/\1 \2 \3 \4/p' "$tmp/$name/gn_scene_config.h")
    is="$(takes "$name" gcc -m32 -malign-double) $(takes "$name" arm-none-eabi-gcc -mcpu=cortex-m0 -mthumb)"
    if [ -n "$said" ] && [ "$said" = "$is" ]; then pass; else fail "$name: RAM is said to be $said, is $is"; fi
done

# flash: the scene's data to its alignment, the library's code within a fifth
for name in mixed-tiny compact ${THOROUGH:+sundial room short unshadowed compact-avenue mixed-fits}; do
    arm="arm-none-eabi-gcc -mcpu=cortex-m0 -mthumb -std=c99 -Os -ffreestanding -isystem boards/common/include -Ilib -I$tmp/$name"
    $arm '-DGN_USER_CONFIG="gn_scene_config.h"' -c -o "$tmp/data.o" "$tmp/$name/scene.c" 2>"$tmp/log"
    data=$(arm-none-eabi-size -A "$tmp/data.o" | awk '$1 ~ /^\.rodata/ { n += $2 } END { print n + 0 }')
    said=$(sed -n 's/^ \* Flash, bytes: scene\.c \([0-9]*\); .* about \([0-9]*\) on Cortex-M0.*/\1 \2/p' "$tmp/$name/gn_scene_config.h")
    if [ $((${said% *} - data)) -ge 0 ] && [ $((${said% *} - data)) -le 64 ]; then pass; else fail "$name: data is said to be ${said% *} bytes, is $data"; fi
    code=$(sh host/generate/gen_flash.sh -- cortex-m0 -I"$tmp/$name" '-DGN_USER_CONFIG="gn_scene_config.h"')
    if [ $((5 * ${said#* })) -ge $((4 * code)) ] && [ $((5 * ${said#* })) -le $((6 * code)) ]; then pass
    else fail "$name: code is said to be ${said#* } bytes, is $code: sh host/generate/gen_flash.sh > host/tool/cost/flash_table.h"; fi
done
# with -O2, as boards are built; without a board info and compile estimate that build
for name in sundial ${THOROUGH:+compact}; do
    said=$(sed -n 's/^ \* Flash, bytes: .*; with -O2, as boards build it, \([0-9]*\) and [0-9]*\.$/\1/p' "$tmp/$name/gn_scene_config.h")
    code=$(sh host/generate/gen_flash.sh -- cortex-m0 -O2 -I"$tmp/$name" '-DGN_USER_CONFIG="gn_scene_config.h"')
    if [ $((5 * ${said:-0})) -ge $((4 * code)) ] && [ $((5 * ${said:-0})) -le $((6 * code)) ]; then pass; else fail "$name: code with -O2 is said to be ${said:-nothing} bytes, is $code"; fi
done
flash_said() { "$tool" info host/scenes/cube.gltf --size 64x48 --frame 0 --flash 1000000 "$@" | sed -n 's/^  fits that: .* about \([0-9]*\) of flash.*/\1/p'; }
[ "$(flash_said)" = "$(flash_said --optimise -O2)" ] && [ $((10 * $(flash_said))) -gt $((12 * $(flash_said --optimise -Os))) ] && pass ||
    fail "flash without a board: $(flash_said), with -O2 $(flash_said --optimise -O2), with -Os $(flash_said --optimise -Os)"

if [ "$THOROUGH" ]; then # the library for it, where size comes first: no warning; boards are built so, too
    root=$PWD
    mkdir -p "$tmp/objects"
    (cd "$tmp/objects" && arm-none-eabi-gcc -mcpu=cortex-m0 -mthumb -std=c99 -Os $warn -ffreestanding -isystem "$root/boards/common/include" -I"$root/lib" -I"$root/$tmp/mixed" \
        '-DGN_USER_CONFIG="gn_scene_config.h"' -c "$root"/lib/*.c) >"$tmp/log" 2>&1 && pass || fail "mixed: the library at -Os: $(grep -m 1 -E 'error|warning' "$tmp/log")"
fi

# ---- Boards ------------------------------------------------------------------------------------------------------------------------

"$tool" compile docs/scenes/near.gltf -o "$tmp/near" --board microbit --size 128x64 --set preset=tiny --set tiles=equal >"$tmp/out" 2>&1 && pass || fail "near.gltf does not fit a micro:bit: $(cat "$tmp/out")"
"$tool" info docs/scenes/near.gltf --board microbit --size 128x64 --set preset=tiny --set tiles=equal >"$tmp/out" 2>&1
grep -q '^  fits microbit: ' "$tmp/out" && pass || fail "info does not say that near.gltf fits: $(tail -n 1 "$tmp/out")"
# refused, with a configuration that then fits: fewer bits of depth, a coarser map, smaller tiles, a smaller picture; less flash
nearest() { # nearest NAME SCENE OPTIONS...
    name=$1 scene=$2
    shift 2
    "$tool" compile "$scene" -o "$tmp/$name" "$@" >"$tmp/out" 2>"$tmp/err"
    [ $? = 1 ] && [ ! -e "$tmp/$name" ] && [ "$(wc -l <"$tmp/err")" = 1 ] && pass || fail "$name is not refused: $(tail -n 1 "$tmp/out" "$tmp/err" | tr '\n' ' ')"
    near=$(sed -n 's/.*nearest that does:\(.*\): [0-9]* bytes of RAM.* off by .*/\1/p' "$tmp/err")
    [ -n "$near" ] && "$tool" compile "$scene" -o "$tmp/$name" "$@" $near >"$tmp/out" 2>&1 && pass || fail "$name, nearest configuration '$near': $(tail -n 1 "$tmp/out" "$tmp/err" | tr '\n' ' ')"
}
nearest slopes docs/scenes/slopes.gltf --board microbit --size 128x64 --set preset=tiny
nearest suns-accurate docs/scenes/suns.gltf --board microbit --size 128x64 --set preset=accurate
nearest sundial-small host/scenes/sundial.gltf --board microbit --size 64x48 --frames 72-72 --set preset=tiny
# in the picture's own size, as groups take the place of records of triangles
nearest sundial-groups host/scenes/sundial.gltf --board microbit --size 160x120 --frames 72-73
echo "$near" | grep -q -e '--set triangle_groups=256' && ! echo "$near" | grep -q -e '--size' && pass || fail "16 KB for the sundial: '$near'"
nearest sundial-compact host/scenes/sundial.gltf --flash 22000 --optimise -Os --size 160x120 --frames 72-74
echo "$near" | grep -q -e '--set compact=1$' && pass || fail "22000 bytes of flash for the sundial: '$near'"
# compact arithmetic where general arithmetic does not fit and it draws the same filter and surfaces; not where it was set otherwise, nor for a
# program that moves the scene
flat="--size 96x64 --set filter=hard --set cascades=1"
same compact-flat "$tmp/grid.gltf" 0 "" $flat --set compact=1
"$tool" compile "$tmp/grid.gltf" -o "$tmp/chosen" --flash 20000 --optimise -Os $flat --json >"$tmp/out" 2>"$tmp/err" && grep -q '"compact": 1}' "$tmp/out" && pass || fail "compact arithmetic is not chosen: $(cat "$tmp/err")"
[ "$(grep -c '^gnomon: compact arithmetic is chosen: [0-9]* bytes of RAM and [0-9]* of flash; general arithmetic takes .*--set compact=0 keeps it general$' "$tmp/err")" = 1 ] && pass || fail "compact arithmetic: $(cat "$tmp/err")"
cmp -s "$tmp/chosen/scene.c" "$tmp/compact-flat/scene.c" && grep -q '^#define GN_COMPACT  *1 /\* chosen' "$tmp/chosen/gn_scene_config.h" &&
    [ "$(diff "$tmp/chosen/gn_scene_config.h" "$tmp/compact-flat/gn_scene_config.h" | grep -c '^<')" = 1 ] && pass || fail "compact arithmetic: the chosen scene is not the requested one"
"$tool" info "$tmp/grid.gltf" --flash 20000 --optimise -Os $flat | grep -q '^  fits that: .*; compact arithmetic is chosen: ' && pass || fail "info does not choose compact arithmetic"
for general in "--flash 200000 --optimise -Os" "--flash 20000 --optimise -Os --set compact=0" "--flash 20000 --optimise -Os --set filter=3x3" "--flash 20000 --optimise -Os --simplify safe" "--flash 20000 --optimise -Os --set output=rgb888"; do
    "$tool" compile "$tmp/grid.gltf" -o "$tmp/general" $flat $general >"$tmp/out" 2>&1
    grep -q 'is chosen' "$tmp/out" && fail "compact arithmetic is chosen with $general" || pass
done
"$tool" compile docs/scenes/slopes.gltf -o "$tmp/no" --flash 20000 --optimise -Os $flat >"$tmp/out" 2>&1 && fail "normals are lost unasked" || pass
nearest cube-textures host/scenes/cube.gltf --flash 46000 --optimise -Os --size 64x64 --frames 0-0 --set persp_step=1 --set fit=stable --set tiles=equal
echo "$near" | grep -q -e '--set texture_size=32$' && pass || fail "46000 bytes of flash for the cube: '$near'"
# where nothing fits, what smaller textures would leave
printf 'newmtl m\nmap_Kd %s\n' "$PWD/docs/pictures/playground.png" >"$tmp/poster.mtl"
printf 'mtllib poster.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n' >"$tmp/poster.obj"
"$tool" info "$tmp/poster.obj" --outside --size 64x48 --ram 1000 --flash 20000 --optimise -Os | grep -q "no settings do .* [0-9]\{6,\} of flash, or [0-9]\{5\} with --set texture_size=64$" && pass || fail "a texture that fills the flash is not named"
nearest edge-flash docs/scenes/edge.gltf --flash 30000 --optimise -Os --size 64x48
"$tool" compile docs/scenes/slopes.gltf -o "$tmp/no" --flash 20000 --optimise -Os 2>"$tmp/err" && fail "20000 bytes of flash are enough" || pass
grep -q 'bytes of flash (scene [0-9]*, code about [0-9]*) of 20000' "$tmp/err" && pass || fail "too much flash: $(cat "$tmp/err")"
for board in nowhere "" ../../etc; do
    "$tool" compile docs/scenes/near.gltf -o "$tmp/no" --board "$board" >"$tmp/out" 2>"$tmp/err" && fail "board '$board' is known" || pass
    [ "$(grep -c '^gnomon: ' "$tmp/err")" = 1 ] && pass || fail "board '$board': $(cat "$tmp/err")"
done
for folder in boards/*/link.ld; do
    board=$(basename "$(dirname "$folder")")
    "$tool" info docs/scenes/edge.gltf --size 16x12 --board "$board" >"$tmp/out" 2>&1 && grep -q "fits\? $board" "$tmp/out" && pass || fail "$folder is not understood: $(tail -n 1 "$tmp/out")"
done

# the image that is linked: its RAM to the byte, its flash within the estimate's tolerance, at either optimisation
linked() { # linked BOARD END OPTIMISATION OPTIONS...
    board=$1 end=$2 optimise=$3
    shift 3
    make -s firmware BOARD=$board APP=play SCENE=docs/scenes/near.gltf IMAGE=test-fit$optimise FW_OPT=$optimise FW_SCENE_BOARD= SCENE_FLAGS="$*" >"$tmp/log" 2>&1
    image=$(arm-none-eabi-nm -t d "build/firmware/$board/test-fit$optimise.elf" | awk -v end="$end" '{ at[$3] = $1 + 0 } END { print at[end] - at["board_stack_bottom"] }')
    code=$(arm-none-eabi-size -A -d "build/firmware/$board/test-fit$optimise.elf" | awk '$1 ~ /^\.(boot|vectors|text|hot|data|ARM\.exidx)$/ { n += $2 } END { print n + 0 }')
    "$tool" compile docs/scenes/near.gltf -o "$tmp/no" --board $board --optimise $optimise --ram "$((image - 1))" --flash 100 "$@" 2>"$tmp/err"
    said=$(sed -n 's/.*it takes \([0-9]*\) bytes of RAM.* and \([0-9]*\) bytes of flash.*/\1 \2/p' "$tmp/err")
    said=${said:-0 0}
    if [ "${said% *}" = "$image" ]; then pass; else fail "$board: RAM is said to be ${said% *}, is $image: $(tail -n 1 "$tmp/log")"; fi
    if [ $((10 * ${said#* })) -ge $((9 * code)) ] && [ $((8 * ${said#* })) -le $((9 * code)) ]; then pass; else fail "$board $optimise: flash is said to be ${said#* }, is $code"; fi
    "$tool" compile docs/scenes/near.gltf -o "$tmp/edge" --board $board --ram "$image" "$@" >"$tmp/out" 2>&1 && pass || fail "$board: $image bytes of RAM do not do: $(tail -n 1 "$tmp/out")"
}
linked microbit board_fast_bss_end -Os --size 64x48 --set preset=tiny --set fit=stable --set tiles=equal
linked stm32f429-discovery board_bss_end -O2 --size 64x48 --set preset=balanced
# less than the tolerance is left: said; refused where the board's own optimisation needs more
"$tool" compile docs/scenes/near.gltf -o "$tmp/edge" --board microbit --size 64x48 --set preset=tiny --set fit=stable --set tiles=equal --flash 83500 --optimise -Os 2>&1 | grep -q 'may not fit' && pass || fail "flash that is nearly full is not warned of"
"$tool" compile docs/scenes/near.gltf -o "$tmp/no" --board microbit --size 64x48 --set preset=tiny --set fit=stable --set tiles=equal --flash 60000 --optimise -O2 >"$tmp/out" 2>&1 && fail "-O2 takes no more flash" || pass

# a texture, a buffer or a material that changes makes the scene anew, wherever it lies
mkdir -p "$tmp/beside" "$tmp/far off" && : >"$tmp/far off/a\$b:.mtl"
printf 'mtllib ../far off/a$b:.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$tmp/beside/one.obj"
touch -d '1 minute ago' "$tmp/beside/"* "$tmp/far off/"*
again() { make -s "$@" "build/firmware/microbit/test-beside.obj/scene/scene.c" BOARD=microbit IMAGE=test-beside SCENE="$tmp/beside/one.obj" SCENE_FLAGS="--size 32x24 --outside --set preset=tiny --set tile_height=4 --set atlas_size=32" 2>&1 | grep -c 'bytes of RAM'; }
rm -rf build/firmware/microbit/test-beside.obj
first="$(again)$(again)"
touch "$tmp/far off/"*
first=$first$(again)
first=$first$(again -W boards/microbit/link.ld)$(again -W boards/microbit/board.mk)$(again) # as if these were new
[ "$first" = 101110 ] && pass || fail "a changed material, linker script or board.mk: the scene is made $first, not 101110"

# ---- What is left out --------------------------------------------------------------------------------------------------------------

# leaves NAME WHAT: the configuration says so
leaves() {
    grep -q "^ \* - [0-9]* $2" "$tmp/$1/gn_scene_config.h" && pass || fail "$1: nothing was left out of: $2"
}
leaves avenue "casters whose shadow no frame shows: .*[1-9][0-9.]* % of instructions"
leaves avenue "receivers that no shadow reaches"
leaves room "objects that no frame shows"
leaves desk "triangles that no frame shows"
leaves desk "vertex normals and colours that change nothing"
leaves mixed "vertices that were there twice"
grep -q '^ \* - ' "$tmp/sundial-balanced/gn_scene_config.h" && fail "--simplify none leaves something out" || pass
# casters: boxes where they spare one; the code for far ones where there are any, or where the scene may be moved
has() { grep -q "^#define GN_$2 *$3 " "$tmp/$1/gn_scene_config.h" && pass || fail "$1: GN_$2 is not $3"; }
has sundial OBJECT_BOXES 0
has avenue OBJECT_BOXES 1
has sundial CLIPPING 1
has sundial-balanced CLIPPING 2
same cascades docs/scenes/slopes.gltf 0 "" --size 96x64 --set cascades=4 --set cascade_blend=soft --set tiles=equal
leaves cascades "cascades that no pixel looks into: 0 1: .*, [1-9][0-9]* of RAM"
same far docs/scenes/near.gltf 0 "" --size 64x64 --set max_distance=1.75 --set cascades=1 --set atlas_size=1024
has far CLIPPING 2
# a lamp that reaches nothing, a sun whose shadow is nowhere: neither its kind nor its atlas is in the image
same lamp docs/scenes/near.gltf 0 "" --size 96x64 --set add_light=point --set range@1=0.01
leaves lamp "lights that reach nothing: '"
grep -q '^#define GN_OTHER_LIGHTS *0 ' "$tmp/lamp/gn_scene_config.h" && pass || fail "lamp: punctual lights are built"
same suns docs/scenes/near.gltf 0 "" --size 96x64 --set max_distance=0.5
leaves suns "shadows of lights that no frame shows"
grep -q '^#define GN_SHADOWS *0 ' "$tmp/suns/gn_scene_config.h" && pass || fail "suns: shadows are built"
same baked docs/scenes/baked.gltf 0 "" --size 96x64

# ---- Errors ------------------------------------------------------------------------------------------------------------------------

refused() { # refused STATUS WORDS OPTIONS...
    expected=$1 words=$2
    shift 2
    "$tool" compile "$@" >"$tmp/out" 2>"$tmp/err"
    status=$?
    if [ $status = "$expected" ] && grep -q -e "$words" "$tmp/err"; then pass; else fail "compile $*: status $status, $(head -n 1 "$tmp/err")"; fi
}
refused 2 "-o DIR is missing" docs/scenes/near.gltf
refused 2 "bad value" docs/scenes/near.gltf -o "$tmp/no" --frames 5-2
refused 2 "bad value" docs/scenes/near.gltf -o "$tmp/no" --frames 5
refused 2 "bad value" docs/scenes/near.gltf -o "$tmp/no" --margin -1
refused 2 "bad value" docs/scenes/near.gltf -o "$tmp/no" --simplify much
refused 2 "does not use --frame" docs/scenes/near.gltf -o "$tmp/no" --frame 3
refused 1 "are more than 20000" host/scenes/sundial.gltf -o "$tmp/no" --frames 0-99999999
refused 1 "cannot create the folder" docs/scenes/near.gltf -o "$tmp/none/such" --size 16x12
refused 1 "cannot be opened" "$tmp/none.gltf" -o "$tmp/no"
refused 1 "max_triangles" docs/scenes/near.gltf -o "$tmp/no" --size 64x64 --set max_triangles=3
refused 1 "clipping" docs/scenes/near.gltf -o "$tmp/no" --size 64x64 --set max_distance=1.75 --set cascades=1 --set atlas_size=1024 --set clipping=1
[ ! -e "$tmp/no" ] && pass || fail "a refused scene leaves a folder"
# a folder keeps what it had if not all of it can be written
mkdir "$tmp/half" "$tmp/half/scene.c"
refused 1 "scene.c: Is a directory" docs/scenes/near.gltf -o "$tmp/half" --size 16x12
[ -z "$(find "$tmp/half" -name '*.new')" ] && pass || fail "a failed write leaves $(ls "$tmp/half" | tr '\n' ' ')"
# what make says of a board, an app or a scene that is not there
for wrong in "BOARD=nowhere" "BOARD=mps2-an385 SCENE=$tmp/none.gltf" "BOARD=mps2-an385 APP=none" "BOARD=mps2-an385 APP=stream" "BOARD=mps2-an385 APP=clock" "BOARD=pico APP=show TURN=round"; do
    make -s firmware $wrong >"$tmp/out" 2>"$tmp/err" && fail "make firmware $wrong succeeds" || pass
    grep -q "There is no board 'nowhere'\|there is no such file\|no app 'none': .* gauge .* stack stream\|APP=stream needs SCENE=FILE\|mps2-an385 has no display\|TURN='round' is no number" "$tmp/err" && pass || fail "make firmware $wrong: $(head -n 1 "$tmp/err")"
done
# the same again, byte for byte
"$tool" compile host/scenes/desk.gltf -o "$tmp/again" --frames 0-3 --size 96x64 >"$tmp/log" 2>&1
diff -r "$tmp/again/scene.c" "$tmp/desk/scene.c" >"$tmp/log" && diff "$tmp/again/gn_scene_config.h" "$tmp/desk/gn_scene_config.h" >"$tmp/log" && pass || fail "compiling again writes something else"
# nothing to be seen
sed 's/"rotation": \[-0.104465, [^]]*\]/"rotation": [0.7071, 0, 0, 0.7071]/' docs/scenes/near.gltf >"$tmp/sky.gltf"
same sky "$tmp/sky.gltf" 0 "" --size 64x48
# all of it removed: no array is of zero elements
sed 's/"nodes": \[0\]/"nodes": [0, 1]/; s/"nodes": \[{"mesh": 0, /"cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}], "nodes": [{"mesh": 0, /; s/0.7\]}\],$/0.7]}, {"camera": 0, "translation": [0, 0, -5]}],/' "$tmp/grid.gltf" >"$tmp/away.gltf"
same away "$tmp/away.gltf" 0 "" --size 64x48
grep -q 'gn_mesh meshes' "$tmp/away/scene.c" && fail "away: something of the mesh is left" || pass
# names of the file in comments
printf 'o a*/b?\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nf 1 2 3\nf 4 2 3\n' >"$tmp/odd.obj"
same odd "$tmp/odd.obj" 0 "" --size 64x48

# bytes that are not ASCII, marks of direction among them, stay out of the code
sed 's/{"mesh": 0, /{"mesh": 0, "name": "\\u202eab\\u00e9c", /' "$tmp/grid.gltf" >"$tmp/bidi.gltf"
same bidi "$tmp/bidi.gltf" 0 "--simplify none" --size 64x48
grep -q '/\* \.\.\.ab\.\.c \*/' "$tmp/bidi/scene.c" && ! LC_ALL=C grep -q '[^ -~]' "$tmp/bidi/scene.c" && pass || fail "bidi: $(grep -m 1 'ab' "$tmp/bidi/scene.c")"
# what changes nothing is named
same idle docs/scenes/near.gltf 0 "" --size 96x64 --set max_distance=0.5 --set filter=3x3
leaves idle "settings and materials that change nothing: .*'filter'"

# frames that the animation does not have
"$tool" compile host/scenes/desk.gltf -o "$tmp/beyond" --frames 47-60 --size 32x24 2>&1 | grep -q 'the animation ends with frame 48$' && pass || fail "frames beyond the animation are not told of"
"$tool" info host/scenes/desk.gltf --board mps2-an385 --size 32x24 | grep -q '^  fits mps2-an385: .*(frame 0 alone; --frames 0-48 for all)$' && pass || fail "info does not say that it is frame 0"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
