#!/bin/sh
# gnomon bake: a scene that stands still draws no shadows any more, and is as near to the truth as with shadow maps, or nearer; the
# file is read, compared and compiled as any other. usage: test_bake.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh

run() { timeout 120 "$tool" "$@" >"$tmp/out" 2>"$tmp/err" </dev/null; }
good() { # good ARGUMENTS...: exit 0 and nothing on stderr
    run "$@"
    status=$?
    if [ $status != 0 ] || [ -s "$tmp/err" ]; then fail "'$*' exits with $status: $(head -n 1 "$tmp/err")"; else pass; fi
}
bad() { # bad STATUS WORD ARGUMENTS...
    expected=$1 word=$2
    shift 2
    run "$@"
    status=$?
    [ $status = "$expected" ] && head -n 1 "$tmp/err" | grep -q -e "^gnomon: .*$word" && [ ! -s "$tmp/out" ] && pass ||
        fail "'$*' exits with $status, not $expected naming '$word': $(head -n 1 "$tmp/err")"
}
# field OBJECT NAME: a number of maps or masks
field() { sed -n "s/.*\"$1\": {[^}]*\"$2\": \([-+.0-9a-z]*\).*/\1/p" "$tmp/out"; }
holds() { # holds WHAT CONDITION: of two numbers in awk
    awk "BEGIN { exit !($2) }" && pass || fail "$1: $2 does not hold"
}

# ---- A static scene ------------------------------------------------------------------------------------------------------------

for name in room sundial mixed ${THOROUGH:+desk}; do
    case $name in room | sundial) texels=512 ;; *) texels=256 ;; esac
    good bake host/scenes/$name.gltf -o "$tmp/$name.gltf" --still --size 160x120 --texels $texels --json
    [ "$(field masks shadow_texels)" = 0 ] && pass || fail "$name draws $(field masks shadow_texels) texels of shadow maps"
    holds "$name, shadow maps" "$(field maps shadow_texels) > 0"
    holds "$name, PSNR" "$(field masks psnr_db) >= $(field maps psnr_db)"
    holds "$name, attenuation" "$(field masks atten_rms) <= $(field maps atten_rms)"
    holds "$name, mismatch" "$(field masks shadow_mismatch) <= 1.05 * $(field maps shadow_mismatch)"
    holds "$name, RAM" "$(field masks ram_bytes) < $(field maps ram_bytes) / 2"
    # A mask is looked up at every pixel; a shadow map, where its bounds decide, is not. Neither is where the lamp does not reach, which is most of the desk:
    # there is less to save, and less than there was since maps are looked up between corners, too.
    case $name in desk) share=1 ;; *) share=0.85 ;; esac
    [ $name = sundial ] || holds "$name, instructions" "$(field masks instructions_per_pixel) < $share * $(field maps instructions_per_pixel)"
    good compare "$tmp/$name.gltf" --size 160x120 --json
    holds "$name, cells against reference" "$(sed -n 's/.*"within1": \([0-9.]*\),.*/\1/p' "$tmp/out") > 0.994"
    good compare "$tmp/$name.gltf" --size 160x120 --json --set persp_step=1
    holds "$name, pixels against reference" "$(sed -n 's/.*"identical": \([0-9.]*\), "within1.*/\1/p' "$tmp/out") > 0.98"
done
run bake host/scenes/sundial.gltf -o "$tmp/soft.gltf" --still --size 160x120 --texels 256
[ $? = 0 ] && [ "$(grep -c -v ' is not kept: ' "$tmp/err")" = 1 ] && grep -q 'edges of shadows are softer than with shadow maps, .* but less wrong on the average: more --texels make them sharper$' "$tmp/err" && pass ||
    fail "softer edges of the sundial are not said, alone: $(cat "$tmp/err")"
# The tool finds by itself that the room needs 512 texels, and writes the same.
cp "$tmp/room.gltf" "$tmp/first.gltf"
good bake host/scenes/room.gltf -o "$tmp/room.gltf" --still --size 160x120
cmp -s "$tmp/room.gltf" "$tmp/first.gltf" && pass || fail "the same bake writes another file"
grep -q "^  light 0 'lamp': channel 0$" "$tmp/out" && grep -q '^  flash: [0-9]* bytes of masks' "$tmp/out" && pass || fail "bake does not say what it did"
good info "$tmp/room.gltf"
grep -q 'with a shadow mask' "$tmp/out" && grep -q "'lamp': point, mixed, no shadow: within its range nothing casts" "$tmp/out" && pass || fail "info does not see masks, or sees tiles"

# what 256 texels leave farther from the truth than the maps is baked with more, up to 1024: the fence's own maps, fitted to what is seen, have
# sharper edges than that, but more wrong in all
good bake host/scenes/fence.gltf -o "$tmp/fence.gltf" --still --size 80x60 --json
holds "fence, texels chosen" "$(sed -n 's/.*"texels": \([0-9]*\),.*/\1/p' "$tmp/out") > 256"
holds "fence, attenuation" "$(field masks atten_rms) <= $(field maps atten_rms)"

# compiled: without shadow rendering, and the picture is the tool's
mkdir "$tmp/compiled"
good compile "$tmp/room.gltf" -o "$tmp/compiled" --size 160x120
grep -q '^#define GN_SHADOWS  *0 ' "$tmp/compiled/gn_scene_config.h" && pass || fail "the compiled scene still has shadow rendering"
good render "$tmp/room.gltf" -o "$tmp/room.png" --size 160x120
if gcc -std=c11 -D_POSIX_C_SOURCE=200809L -O1 -Itests -o "$tmp/same" tests/tool/same_pictures.c host/scene/image/*.c host/base/arena.c -lm 2>"$tmp/err" &&
    clang -std=c99 -w -Ilib -O0 -I"$tmp/compiled" '-DGN_USER_CONFIG="gn_scene_config.h"' -o "$tmp/program" lib/gnomon.c "$tmp/compiled/scene.c" tests/tool/compiled_picture.c 2>"$tmp/err" &&
    "$tmp/program" 0 2>"$tmp/err" | "$tmp/same" "$tmp/room.png" 2>>"$tmp/err"; then pass
else fail "the compiled room: $(grep -m 1 . "$tmp/err")"; fi

# ---- What moves, vertices, other files --------------------------------------------------------------------------------------------

good bake host/scenes/desk.gltf -o "$tmp/moving.gltf" --size 80x60 --json
grep -q '"moving": 4, "casters_kept": true' "$tmp/out" && pass || fail "the desk's moving objects are not seen"
"$tool" bake host/scenes/sundial.gltf -o "$tmp/still.gltf" --size 32x24 --texels 64 2>&1 >/dev/null | grep -q 'the animation, .*camera, is not kept: all is as at frame 0$' && pass || fail "it is not said that the animation goes"
holds "desk with moving objects" "$(field masks shadow_texels) > 0"
good bake host/scenes/room.gltf -o "$tmp/vertices.glb" --texels 0 --size 80x60 --json
[ "$(field masks shadow_texels)" = 0 ] && grep -q '"charts": 0' "$tmp/out" && grep -q -a '_GNOMON_MASK' "$tmp/vertices.glb" && pass || fail "no masks per vertex"
sed 's/"lamp"/"\\u001b[31m"/' host/scenes/room.gltf >"$tmp/control.gltf"
run bake "$tmp/control.gltf" -o "$tmp/vertices.glb" --texels 0 --size 16x12
grep -q "^  light 0 '?\[31m': channel 0$" "$tmp/out" && pass || fail "a light's name: $(grep ' light 0' "$tmp/out" | cat -v)"
good bake host/scenes/room.gltf -o "$tmp/set.gltf" --size 80x60 --set preset=tiny --set persp_step=4 --set strength=0.5
grep -q '"preset": "tiny", "persp_step": "4"' "$tmp/set.gltf" && grep -q '"strength": 0.5' "$tmp/set.gltf" && pass || fail "settings are not in the file"
printf 'v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1 0\nf 4 3 5\nf 3 2 5\nf 2 1 5\nf 1 4 5\n' >"$tmp/pyramid.obj"
good bake "$tmp/pyramid.obj" -o "$tmp/pyramid.gltf" --size 80x60 --json
[ "$(field masks shadow_texels)" = 0 ] && pass || fail "the pyramid still draws shadows"
# larger than any max_distance that a file may set
awk '$1 == "v" { print "v", $2 * 1e6, $3 * 1e6, $4 * 1e6; next } 1' "$tmp/pyramid.obj" >"$tmp/large.obj"
good bake "$tmp/large.obj" -o "$tmp/large.gltf" --size 80x60 --json

# ---- Channels ------------------------------------------------------------------------------------------------------------------

# five suns: four channels, and the fifth is in the vertices, by name
five=directional,directional,directional,directional,directional
"$tool" bake host/scenes/sundial.gltf -o "$tmp/five.gltf" --size 80x60 --set lights=$five --texels 128 >"$tmp/out" 2>"$tmp/err"
grep -q 'farther from exact shadows than the shadow maps' "$tmp/err" && pass || fail "masks of few texels are not warned of: $(cat "$tmp/err")"
[ "$(grep -c ': channel [0-3]$' "$tmp/out")" = 4 ] && [ "$(grep -c "^  light 4 '.*': baked whole" "$tmp/out")" = 1 ] && pass || fail "five suns: $(grep light "$tmp/out" | tr '\n' ';')"
grep -q '_GNOMON_BAKED' "$tmp/five.gltf" && grep -q '"mode": "baked"' "$tmp/five.gltf" && pass || fail "the fifth sun is not in the vertices"
# what more texels do not help stops where it is; soft maps and the normal form of bias, whose colours are nearer to the truth at this size than the masks
"$tool" bake docs/scenes/near.gltf -o "$tmp/six.gltf" --size 80x60 --set lights=directional,point,point,point,point,point --set other_filter=5x5 --set auto_bias=normal >"$tmp/out" 2>"$tmp/err"
grep -q 'more texels do not help, as lights are baked whole' "$tmp/err" && grep -q ' 256x256 texels' "$tmp/out" && pass || fail "lights baked whole: $(head -n 1 "$tmp/err" "$tmp/out")"
# sixteen lamps whose ranges meet only their neighbours' share four
good bake docs/scenes/lamps.gltf -o "$tmp/lamps.gltf" --size 80x60 --set shadow=1 --texels 128 --json
[ "$(grep -o '"fate": "masked"' "$tmp/out" | wc -l)" -ge 8 ] && grep -q '"channels": 4' "$tmp/out" && pass || fail "lamps do not share channels"
good info "$tmp/lamps.gltf" --set shadow=1
grep -q 'share mask channel' "$tmp/out" && fail "lamps share a channel, and their ranges overlap" || pass

# ---- Errors --------------------------------------------------------------------------------------------------------------------

scene=host/scenes/room.gltf
bad 2 '-o' bake $scene
bad 2 'texels' bake $scene -o "$tmp/x.gltf" --texels 100
bad 2 'texels' bake $scene -o "$tmp/x.gltf" --texels 8192
bad 2 'engine' bake $scene -o "$tmp/x.gltf" --engine fixed
bad 2 'still' render $scene -o "$tmp/x.png" --still
bad 1 'do not fit' bake $scene -o "$tmp/x.gltf" --texels 16 --size 80x60
bad 1 'cannot be written' bake "$tmp/pyramid.obj" -o "$tmp/no/x.gltf" --size 80x60
bad 1 'nothing in it casts' bake "$tmp/room.gltf" -o "$tmp/x.gltf" # its masks would be lost
bad 1 'missing' bake "$tmp/missing.gltf" -o "$tmp/x.gltf"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
