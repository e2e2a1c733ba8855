#!/bin/sh
# The Pico, booted from its UF2 file in rp2040js: the display shows what the host predicts, frames have the host's CRCs, and what goes
# wrong is told. Without node and npm, or where npm cannot install rp2040js, only the images are built, and the reason is printed.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh

pico() { make -s --no-print-directory BOARD=pico "$@" >"$tmp/log" 2>&1; }
# hardly optimised: compiling it takes longer than running it
host() { make -s --no-print-directory BOARD=host "$@" FW_OPT=-O0 >"$tmp/host.log" 2>&1; }
finish() {
    echo "$passed passed, $failed failed"
    [ "$failed" = 0 ]
    exit
}

cube="APP=play SCENE=host/scenes/cube.gltf PRESET=balanced FW_OPT=-O1"
small="--size 96x64 --frames 9-10 --set output=rgb565"
pico firmware APP=clock && pass || fail "the clock does not build: $(grep -m 1 -E 'error|region' "$tmp/log")"
pico firmware $cube IMAGE=test-cube SCENE_FLAGS="$small" && pass || fail "the cube does not build: $(grep -m 1 -E 'error|region' "$tmp/log")"
pico firmware APP=show SCENE=host/scenes/cube.gltf FW_OPT=-O1 && [ -s build/firmware/pico/show-cube.uf2 ] && pass || fail "any scene on the display does not build: $(grep -m 1 -E 'error|region' "$tmp/log")"
if ! make -s build/node_modules/rp2040js/package.json BOARD=pico >"$tmp/log" 2>&1; then
    echo "not run: $(head -n 1 "$tmp/log")"
    finish
fi

# The clock begins at 06:00, and sends what changed from frame to frame.
make -s build/ppm >/dev/null && host firmware APP=predict SCREEN_OF=pico && pass || fail "no prediction: $(tail -n 1 "$tmp/host.log")"
pico screen APP=clock ARGS=2 SCREEN_OUT="$tmp/pico.ppm" && pass || fail "the clock: $(tail -n 1 "$tmp/log")"
[ "$(grep -c '^frame [01]: .* instructions, .* cycles' "$tmp/log")" = 2 ] && pass || fail "no counts of the clock's frames: $(cat "$tmp/log")"
predicted() { build/firmware/host/predict-pico.elf "$1" "$tmp/host.ppm" && build/ppm compare "$tmp/pico.ppm" "$tmp/host.ppm" >"$tmp/differ" 2>&1; }
predicted 06:05 && pass || fail "the display is not what the host predicts: $(cat "$tmp/differ")"
predicted 06:00 && fail "the display shows the frame before, too" || pass

# A textured cube, and a scene that the app makes itself, to the last line and the exit status.
for app in "$cube IMAGE=test-cube" "APP=crc IMAGE=test-crc"; do # test_boards.sh builds crc at the same time
    pico emulate $app SCENE_FLAGS="$small" && host emulate $app SCENE_FLAGS="$small" && pass || fail "$app: $(tail -n 1 "$tmp/log")"
    grep -E '^[0-9a-f]{8} frame|^frame [0-9] crc' "$tmp/log" >"$tmp/crcs"
    grep -E '^[0-9a-f]{8} frame|^frame [0-9] crc' "$tmp/host.log" | cmp -s - "$tmp/crcs" && [ -s "$tmp/crcs" ] && pass || fail "$app: other pictures: $(cat "$tmp/crcs")"
done

# From a model of one's own to its spinning picture: one command.
printf 'v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0.5 2 0\nf 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1\n' >"$tmp/roof.obj"
for n in 1 2; do
    pico screen APP=show SCENE="$tmp/roof.obj" FW_OPT=-O1 TURN=8 ARGS=$n SCREEN_OUT="$tmp/show$n.ppm" && pass || fail "a model of one's own: $(tail -n 1 "$tmp/log")"
done
build/gnomon render "$tmp/roof.obj" -o "$tmp/roof.png" --set output=rgb565 --set atlas_size=256 >"$tmp/log" 2>&1
cmp -s "$tmp/show1.png" "$tmp/roof.png" && pass || fail "a model of one's own: the display shows another picture than the tool"
[ -s "$tmp/show2.png" ] && ! cmp -s "$tmp/show2.png" "$tmp/show1.png" && pass || fail "a model of one's own does not turn"
# options are added to those of the display; what does not fit says how to give them
pico build/firmware/pico/test-options.obj/scene/scene.c APP=show SCENE="$tmp/roof.obj" IMAGE=test-options SCENE_FLAGS="--set atlas_size=64" && head -n 1 build/firmware/pico/test-options.obj/scene/scene.h | grep -q -e '--set atlas_size=256 --set texture_size=256 --set atlas_size=64' &&
    grep -q 'SCENE_WIDTH *320' build/firmware/pico/test-options.obj/scene/scene.h && pass || fail "options for show: $(tail -n 1 "$tmp/log")"
pico firmware APP=show SCENE="$tmp/roof.obj" IMAGE=test-options SCENE_FLAGS="--set atlas_size=1024" && fail "1024x1024 texels fit the Pico" || pass
grep -q 'does not fit pico: .* nearest that does: --set ' "$tmp/log" && grep -q 'make ... SCENE_FLAGS=' "$tmp/log" && pass || fail "what does not fit: $(tail -n 1 "$tmp/log")"

# The core's own counter says what the emulator counts, but for the set-up before the picture.
pico emulate APP=bench SCENE=docs/scenes/near.gltf IMAGE=test-bench FW_OPT=-Os SCENE_FLAGS="--size 64x64 --set preset=tiny --set output=rgb565" && pass || fail "bench: $(tail -n 1 "$tmp/log")"
awk '/^cycles / { own = $2 / 1e6 } /^frame 0: / { all = $6 } END { exit !(own > 1 && own <= all + 0.05 && own > 0.95 * all) }' "$tmp/log" && pass || fail "bench: $(tr '\n' ';' <"$tmp/log")"

# What cannot run says so.
run() { NODE_PATH=build/node_modules node boards/tools/pico.js "$@" >"$tmp/log" 2>&1; }
image=build/firmware/pico/test-crc
refused() { # refused TEXT ARGUMENT...
    text=$1
    shift
    run "$@" && fail "$text: it ran" || { grep -q "^pico: .*$text" "$tmp/log" && pass || fail "$text: $(head -n 1 "$tmp/log")"; }
}
refused usage $image.uf2 $image.symbols
refused 'not a UF2 file' $image.elf $image.symbols 1
refused 'no such file' $image.uf2 "$tmp/none" 1
head -c 512 $image.uf2 >"$tmp/boot.uf2" # the boot stage alone: it jumps to where nothing is
refused '.' "$tmp/boot.uf2" $image.symbols 1

finish
