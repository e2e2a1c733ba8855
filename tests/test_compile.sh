#!/bin/sh
# gnomon compile: what it writes builds without a warning and draws the very bytes of gnomon render. usage: test_compile.sh [TOOL]
cd "$(dirname "$0")/.." || exit 1
tool=${1:-build/gnomon}
. tests/check.sh

variable() { make -s --no-print-directory --eval="print: ; @echo \$($1)" print; }
warn=$(variable WARN)
strict="-std=c99 -pedantic $warn -Ilib"
TMPDIR=$tmp sh tests/one_file.sh lib >"$tmp/lib.c"
if gcc -std=c11 -D_POSIX_C_SOURCE=200809L -O2 $warn -o "$tmp/same" tests/same_pictures.c host/scene/*.c -lm \
    >"$tmp/log" 2>&1; then pass; else fail "same_pictures: $(grep -m 1 -E 'error|undefined' "$tmp/log")"; fi

# build NAME: the firmware of build/tmp/.../NAME as a program
build() {
    gcc $strict -O1 -I"$tmp/$1" '-DGN_USER_CONFIG="gn_scene_config.h"' -o "$tmp/$1/run" "$tmp/lib.c" "$tmp/$1/scene.c" tests/compiled_picture.c 2>"$tmp/$1/log"
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

# every preset, nothing left out, all frames
for preset in tiny balanced accurate; do
    same sundial-$preset host/scenes/sundial.gltf "0 1 77 144 9" "--simplify none" --size 160x120 --set preset=$preset
    same avenue-$preset host/scenes/avenue.gltf 0 "--simplify none" --size 200x100 --set preset=$preset
    same desk-$preset host/scenes/desk.gltf "0 1 2 30 48" "--simplify none" --size 96x64 --set preset=$preset
    same room-$preset host/scenes/room.gltf 0 "--simplify none" --size 160x120 --set preset=$preset
    same fence-$preset host/scenes/fence.gltf 0 "--simplify none" --size 200x100 --set preset=$preset
    same mixed-$preset host/scenes/mixed.gltf "24 0 25 48" "--simplify none" --size 160x120 --set preset=$preset
done
# what none of these frames shows left out
same sundial host/scenes/sundial.gltf "0 2 4 1" "--frames 0-4" --size 160x120
same avenue host/scenes/avenue.gltf 0 ""
same desk host/scenes/desk.gltf "0 2 3" "--frames 0-3" --size 96x64
same room host/scenes/room.gltf 0 "" --size 160x120
same fence host/scenes/fence.gltf 0 "--set output=grey4" --size 160x120
same mixed host/scenes/mixed.gltf "1 0" "--frames 0-1" --size 96x64 --set preset=tiny

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
