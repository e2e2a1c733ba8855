#!/bin/sh
# gnomon asset: what it writes builds as C99 and C++11 without a warning, draws the very bytes of gnomon render, and its clips
# stand where the tool's frames have them. compile --open. A program that moves things by name. usage: test_asset.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh

strict="-Wall -Wextra -Werror -Ilib -I$tmp"
size="-DWIDTH=96 -DHEIGHT=64"
roomy="-DGN_MAX_OBJECTS=100 -DGN_MAX_TRIANGLES=20000 -DGN_MAX_TILE_REFS=60000 -DGN_MAX_SHADOW_TILES=16 -DGN_MAX_OTHER_TILES=16"
ok() { if "$@" >"$tmp/log" 2>&1; then pass; else fail "$*: $(head -n 1 "$tmp/log")"; fi; }
ok gcc -std=c11 -D_POSIX_C_SOURCE=200809L -O1 -w -Itests -o "$tmp/same" tests/tool/same_pictures.c host/scene/image/*.c host/base/arena.c -lm

# asset NAME SCENE OPTIONS...: written, and a program of it, as C and as C++
asset() {
    name=$1 scene=$2
    shift 2
    rm -f "$tmp/$name"*
    if ! "$tool" asset "$scene" -o "$tmp/$name" --size 96x64 "$@" >"$tmp/$name.log" 2>&1; then fail "$name: $(head -n 1 "$tmp/$name.log")"; return; fi
    knobs=$(sed -n '/knobs than the library/s/.*own://p' "$tmp/$name.h")
    fps=$(sed -n 's/.*"fps": *\([0-9]*\).*/\1/p' "$scene")
    clips=$(grep -q "^void ${name}_pose" "$tmp/$name.h" && echo -DCLIPS)
    set -- $roomy $knobs $clips $size "-DFPS=${fps:-24}" "-DHEADER=\"$name.h\"" "-DMODEL(x)=${name}_##x"
    ok gcc -std=c99 -pedantic-errors $strict "$@" -fsyntax-only "$tmp/$name.c" tests/tool/asset_picture.c
    ok g++ -std=c++11 -x c++ $strict "$@" -fsyntax-only "$tmp/$name.c" tests/tool/asset_picture.c
    ok clang -std=c99 -w -O0 -Ilib -I"$tmp" "$@" -o "$tmp/$name.run" lib/gnomon.c "$tmp/$name.c" tests/tool/asset_picture.c
}
# shows NAME SCENE "OPTIONS of render" FRAMES...: bytes that differ, of each frame
shows() {
    name=$1 scene=$2 options=$3
    shift 3
    pictures=
    for frame in ${*:-0}; do
        "$tool" render "$scene" -o "$tmp/$frame.png" --frame "$frame" --size 96x64 $options >"$tmp/log" 2>&1
        pictures="$pictures $tmp/$frame.png"
    done
    "$tmp/$name.run" "$@" 2>"$tmp/log" | "$tmp/same" $pictures
}
same() { # same NAME SCENE OPTIONS...
    name=$1 scene=$2
    shift 2
    asset "$name" "$scene" "$@"
    differ=$(shows "$name" "$scene" "$*")
    [ -z "$differ" ] && pass || fail "$name: $differ"
}
# A clip is rounded to keys of 16 bits: edges cross a few pixels' centres. 18432 bytes.
poses() { # poses NAME SCENE MOST FRAMES...
    name=$1 scene=$2 most=$3
    shift 3
    shows "$name" "$scene" "$how" "$@" >"$tmp/differ"
    worst=$(sed 's/.*: \([0-9]*\) of .*/\1/; s/.*no picture.*/99999/' "$tmp/differ" | sort -n | tail -n 1)
    [ "${worst:-0}" -le "$most" ] && pass || fail "$name: $worst bytes differ in a frame of $*"
}

# [R8] the file as it is, byte for byte
for scene in cube sundial avenue desk mixed; do same $scene host/scenes/$scene.gltf; done
same robot tests/data/robot.gltf
grep '^clip "Wave!"' "$tmp/robot.log" | awk '{ for (i = 1; i < NF; i++) if ($i == "most") exit !($(i + 1) < 7e-5) }' && pass || fail "splines: $(cat "$tmp/robot.log")"
same materials docs/scenes/materials.gltf --set preset=tiny
same lamps docs/scenes/lamps.gltf --set lights=directional --set short_vertices=1
# --triangles: the same meshes in every command, as many as said, and the error is said
same fewer host/scenes/fence.gltf --triangles 200
grep -q "meshes have 199 of 672 triangles, off by at most [0-9.]*, [0-9.]* % of the size of '" "$tmp/fewer.log" && pass || fail "--triangles 200: $(cat "$tmp/fewer.log")"
grep -q " meshes of 199 triangles, " "$tmp/fewer.log" && pass || fail "asset --triangles 200 has others: $(cat "$tmp/fewer.log")"
"$tool" render host/scenes/cube.gltf -o "$tmp/n.png" --triangles 0 2>"$tmp/log" && fail "--triangles 0 is taken"
grep -q "bad value '0', not a number of triangles from 1" "$tmp/log" && pass || fail "--triangles 0: $(cat "$tmp/log")"
# [R12] skins: joints as they are in the file, and by a clip
same snake docs/scenes/snake.gltf
# mirrors, scales that begin and end at 0, and that change their sign
same scales tests/data/scales.gltf
# [R8] clips: rotation, of a light, and of a hierarchy with splines, steps, scales, a fixed matrix, a lamp and a camera
poses cube host/scenes/cube.gltf 300 0 1 30 60 96
poses sundial host/scenes/sundial.gltf 300 1 77 144
poses desk host/scenes/desk.gltf 300 7 30
poses robot tests/data/robot.gltf 300 0 10 20 30 47 72
poses snake docs/scenes/snake.gltf 300 0 11 30 66 96
poses scales tests/data/scales.gltf 300 0 1 11 13 24 35 37 48
# up=z: clips of a file that is turned
how="--set up=z"
same turned tests/data/robot.gltf $how
poses turned tests/data/robot.gltf 300 0 20 47 72
same coiled docs/scenes/snake.gltf $how
poses coiled docs/scenes/snake.gltf 300 11 66
how=

# a lamp of the program's own is as bright as the file's: the robot's torch is of 40 candela. NAME_now sets the camera alone
cat >"$tmp/lamp.c" <<'E_C'
#include <math.h>
#include <string.h>
#include "robot.h"
static robot_state robot;
int main(void)
{
    robot_init(&robot);
    const gn_light *file = &robot.lights[ROBOT_LIGHT_TORCH];
    gn_light own = gn_light_point(file->position_q16);
    own.colour_uq16[0] = ROBOT_INTENSITY(CANDELA / 3.14159265358979);
    own.colour_exp = ROBOT_INTENSITY_EXP;
    robot.scene.lights = &own, robot.scene.n_lights = 1; /* lights and objects of its own stay */
    robot.scene.objects = robot.objects + 1, robot.scene.n_objects--;
    robot.camera = ROBOT_CAMERA_ABOVE;
    const gn_scene *now = robot_now(&robot);
    if (now->lights != &own || now->n_lights != 1 || now->objects != robot.objects + 1) return 2;
    if (memcmp(&now->camera, &robot.cameras[ROBOT_CAMERA_ABOVE], sizeof now->camera)) return 3;
    robot_init(&robot);
    if (now->lights != robot.lights || now->objects != robot.objects || now->n_lights != ROBOT_LIGHTS) return 4;
    return !(fabs(ldexp(own.colour_uq16[0], own.colour_exp) / ldexp(file->colour_uq16[0], file->colour_exp) - 1) < 1e-3);
}
E_C
ok gcc -std=c99 -w -Ilib -I"$tmp" $roomy -DCANDELA=40.0 -o "$tmp/lamp" lib/gnomon.c "$tmp/robot.c" "$tmp/lamp.c" -lm
ok "$tmp/lamp"
# what the file lacks and the tool adds is said
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$tmp/bare.obj"
"$tool" asset "$tmp/bare.obj" -o "$tmp/bare" >"$tmp/log" 2>&1
grep -q ' bytes of flash; added: ground, camera, light$' "$tmp/log" && pass || fail "asset does not name what it adds: $(cat "$tmp/log")"

# names: of the file, in letters of C, each once; all cameras
for word in ROBOT_OBJECT_ROBOT_BASE ROBOT_LIGHT_TORCH ROBOT_CAMERA_ABOVE ROBOT_MESH_RED_BOX ROBOT_CLIP_WAVE ROBOT_CLIP_WALK; do
    grep -q "^    $word, " "$tmp/robot.h" && pass || fail "robot.h has no $word"
done
grep -q DESK_OBJECT_MUG_2 "$tmp/desk.h" && pass || fail "the second mug has no name of its own"

# objects of an OBJ: by o, or else by g; one name may come twice; a byte order mark is no statement
three() { # three FILE NAMES...
    file=$1
    shift
    "$tool" asset "$tmp/$file.obj" -o "$tmp/$file" --set ground=0 >"$tmp/log" 2>&1
    for name in "$@"; do grep -q "^    $name, " "$tmp/$file.h" && pass || fail "$file.obj: no $name: $(head -n 1 "$tmp/log")"; done
    grep -q "_OBJECTS = $#" "$tmp/$file.h" && pass || fail "$file.obj: $(grep '_OBJECTS = ' "$tmp/$file.h")"
    gcc -std=c99 -w -Ilib -I"$tmp" -fsyntax-only "$tmp/$file.c" 2>"$tmp/log" && pass || fail "$file.c: $(head -n 1 "$tmp/log")"
}
corners='v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\n'
printf '\357\273\277v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\no Left door\nf 1 2 4\nusemtl red\nf 4 3 2\no Hull\nf 1 3 4\no Left door\nf 4 2 1\n' >"$tmp/car.obj"
three car CAR_OBJECT_DEFAULT CAR_OBJECT_LEFT_DOOR CAR_OBJECT_LEFT_DOOR_2 CAR_OBJECT_HULL
printf "${corners}g A\nf 1 2 3\ng B\nf 1 2 4\n" >"$tmp/parts.obj"
three parts PARTS_OBJECT_A PARTS_OBJECT_B

# what a configuration lacks is said when it is compiled
gcc -std=c99 -w -Ilib -I"$tmp" -DGN_MATERIALS=0 -fsyntax-only "$tmp/desk.c" 2>"$tmp/log"
grep -q "DGN_MATERIALS=1: specular of object" "$tmp/log" && pass || fail "without materials: $(head -n 1 "$tmp/log")"

# mistakes
refused() { # refused STATUS WORD ARGUMENTS...
    status=$1 word=$2
    shift 2
    "$tool" "$@" >"$tmp/log" 2>&1
    [ $? = "$status" ] && grep -q "$word" "$tmp/log" && pass || fail "$*: $(head -n 1 "$tmp/log")"
}
refused 2 "lower-case letters" asset host/scenes/cube.gltf -o "$tmp/9x"
refused 2 "not the library's" asset host/scenes/cube.gltf -o "$tmp/gn"
refused 2 "not the library's" asset host/scenes/cube.gltf -o "$tmp/gn_cube"
refused 2 "missing" asset host/scenes/cube.gltf
refused 1 "No such file" asset host/scenes/cube.gltf -o "$tmp/none/cube"
refused 2 "does not use" asset host/scenes/cube.gltf -o "$tmp/cube" --board microbit

# A firmware program that moves three named objects, two lights and the camera: one source as C and as C++, at most 60 lines.
program=tests/tool/asset_program.c
[ "$(wc -l <$program)" -le 60 ] && pass || fail "$program has more than 60 lines"
asset toys host/scenes/mixed.gltf
for language in c c++; do
    standard=$([ $language = c ] && echo c99 || echo c++11)
    ok gcc -x $language -std=$standard $strict $roomy -O1 -c "$tmp/toys.c" -o "$tmp/toys-$language.o"
    ok gcc -x $language -std=$standard $strict $roomy -O1 -c $program -o "$tmp/program-$language.o"
    ok clang -std=c99 -w $roomy -Ilib -O0 -o "$tmp/program-$language" lib/gnomon.c "$tmp/toys-$language.o" "$tmp/program-$language.o"
    "$tmp/program-$language" >"$tmp/$language.txt" 2>&1 && pass || fail "the program in $language: $(head -n 1 "$tmp/$language.txt")"
done
cmp -s "$tmp/c.txt" "$tmp/c++.txt" && [ "$(sort -u "$tmp/c.txt" | wc -l)" = 8 ] && pass || fail "8 pictures: $(tr '\n' ' ' <"$tmp/c.txt")"
if command -v arm-none-eabi-gcc >/dev/null 2>&1; then
    ok arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb -std=c99 $strict $roomy -O1 -c "$tmp/toys.c" -o "$tmp/toys-arm.o"
fi

# compile --open: the frames of the file, and what a program moves stays moved
mkdir -p "$tmp/open"
ok "$tool" compile host/scenes/sundial.gltf -o "$tmp/open" --open --frames 0-3 --size 96x64
open="-DGN_USER_CONFIG=\"gn_scene_config.h\" -I$tmp/open $strict -Itests/tool"
ok gcc -std=c99 $open -fsyntax-only "$tmp/open/scene.c" tests/tool/open_picture.c
ok g++ -std=c++11 -x c++ $open -fsyntax-only "$tmp/open/scene.c"
ok clang -std=c99 -w $open -O0 -o "$tmp/open/run" lib/gnomon.c "$tmp/open/scene.c" tests/tool/open_picture.c
"$tool" render host/scenes/sundial.gltf -o "$tmp/2.png" --frame 2 --size 96x64 >"$tmp/log" 2>&1
"$tmp/open/run" 2>"$tmp/log" | "$tmp/same" "$tmp/2.png" "$tmp/2.png" >"$tmp/differ"
grep -q "bytes differ" "$tmp/differ" && [ "$(wc -l <"$tmp/differ")" = 1 ] && pass || fail "compile --open: $(cat "$tmp/differ" "$tmp/log")"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
