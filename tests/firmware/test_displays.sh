#!/bin/sh
# Displays end to end: the clock's picture on the emulator's screen, driven over its bus by the board's own code, is the one that the
# library draws on the host, pixel for pixel. The clock runs for half an hour before each picture and sends what changed. Boards that
# QEMU does not run are built in full. THOROUGH=1: four pictures of each, not two.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh

export FW_OPT=-Og # the picture is the same, and the compiler takes longer than the emulator
hours="10:00 17:30 ${THOROUGH:+07:00 13:00}"
from() { case $1 in 07:00) echo 06:30 ;; 10:00) echo 09:30 ;; 13:00) echo 12:30 ;; *) echo 17:00 ;; esac; }

# same A B WHAT
same() {
    if text=$(build/ppm compare "$1" "$2" 2>&1); then pass; else fail "$3: $text"; fi
}

build() { # build WHAT MAKE-ARGUMENT...: once, quietly
    what=$1
    shift
    if make -s -j2 "$@" >"$tmp/make" 2>&1; then pass; else fail "$what does not build: $(grep -m 1 -E 'error|Error|region' "$tmp/make")"; fi
}

# display BOARD ERROR: ERROR is what the emulated controller prints of commands that it does not know
display() {
    build "the clock of $1" firmware BOARD="$1" APP=clock
    build "the prediction for $1" firmware BOARD=host APP=predict SCREEN_OF="$1" FW_OPT=-O0
    for hour in $hours; do
        if ! make -s screen BOARD="$1" ARGS="$(from "$hour") $hour" SCREEN_OUT="$tmp/$1-$hour.ppm" >"$tmp/log" 2>&1; then
            fail "$1 at $hour: $(tail -n 2 "$tmp/log" | tr '\n' ' ')"
            continue
        fi
        if grep -q -e "$2" -e 'canary' -e 'fault' "$tmp/log"; then fail "$1 at $hour: $(cat "$tmp/log")"; else pass; fi
        # "7 frames, 35 of 56 tiles sent"
        awk '/ tiles sent/ { exit !($1 == 7 && $3 > 0 && $3 < $5) }' "$tmp/log" && pass || fail "$1 at $hour: $(grep tiles "$tmp/log")"
        build/firmware/host/predict-"$1".elf "$hour" "$tmp/host.ppm" || fail "no prediction for $1 at $hour"
        same "$tmp/$1-$hour.ppm" "$tmp/host.ppm" "$1 at $hour: the screen is not what the host predicts"
        cmp -s "$tmp/$1-$hour.png" "docs/pictures/display-$1-$(echo "$hour" | tr -d :).png" && pass ||
            fail "docs/FIRMWARE.md does not show $1 at $hour as it is: make docs"
        cat "$tmp/$1-$hour.ppm" | cksum >>"$tmp/$1.sums"
    done
    row=$(sed -n "s/^RAM \([0-9]*\) bytes, with a stack of \([0-9]*\),.*/| the clock on $1, all in all | | \1, of which \2 for the stack/p" "$tmp/log")
    [ -n "$row" ] && grep -q -F -e "$row" docs/FIRMWARE.md && pass || fail "docs/FIRMWARE.md has not: $row: make docs"
    [ "$(sort -u "$tmp/$1.sums" | wc -l)" = "$(echo $hours | wc -w)" ] && pass || fail "$1 shows the same at different hours"
    if build/ppm compare "$tmp/$1-10:00.ppm" "$tmp/host.ppm" >/dev/null 2>&1; then fail "ppm compare sees no difference"; else pass; fi
}

build "the tools" build/capture build/ppm
display lm3s6965evb 'ssd0323: error'
display rv32-virt 'invalid'

# Any scene on a board's display: what the tool draws of it. Not optimised, which takes longer than a few frames.
settings=$(sed -n 's/^SCREEN_SETTINGS := //p' boards/rv32-virt/board.mk)
if make -s screen BOARD=rv32-virt APP=show SCENE=host/scenes/cube.gltf ARGS=1 FW_OPT=-O0 SCREEN_OUT="$tmp/show.ppm" >"$tmp/log" 2>&1 &&
    build/gnomon render host/scenes/cube.gltf -o "$tmp/tool.png" --size 320x240 --set output=rgb565 $settings >"$tmp/log" 2>&1 && cmp -s "$tmp/show.png" "$tmp/tool.png"; then pass
else fail "APP=show does not show the cube as the tool draws it: $(tail -n 1 "$tmp/log")"; fi
# A model that turns: after one turn it is where it was.
turned() { make -s screen BOARD=rv32-virt APP=show TURN=4 SCENE=docs/scenes/slopes.gltf ARGS="$1" FW_OPT=-O0 SCREEN_OUT="$tmp/turn$1.ppm" >"$tmp/log" 2>&1; }
build/gnomon render docs/scenes/slopes.gltf -o "$tmp/tool.png" --size 320x240 --set output=rgb565 $settings >"$tmp/log" 2>&1
if turned 2 && turned 5 && cmp -s "$tmp/turn5.png" "$tmp/tool.png"; then pass; else fail "APP=show TURN=4 is not back after one turn: $(tail -n 1 "$tmp/log")"; fi
cmp -s "$tmp/turn2.png" "$tmp/turn5.png" && fail "APP=show TURN=4 turns nothing" || pass

# The drivers are integer code without state: nothing of theirs is writable, and of others they need memcpy and integer helpers alone.
objects=build/firmware/lm3s6965evb/clock.obj/boards/displays
arm-none-eabi-nm -A --defined-only "$objects"/*.o | awk '$(NF - 1) ~ /^[dDbBcCsS]$/' >"$tmp/found"
[ -s "$tmp/found" ] && fail "writable data in boards/displays/: $(head -n 3 "$tmp/found")" || pass
arm-none-eabi-nm -A --defined-only "$objects"/*.o | awk '{ print $NF }' | sort -u >"$tmp/defined"
arm-none-eabi-nm -A -u "$objects"/*.o | awk '{ print $NF }' | sort -u | comm -23 - "$tmp/defined" |
    grep -v -x -E 'mem(cpy|set)|__aeabi_u?i(div|divmod)' >"$tmp/found"
[ -s "$tmp/found" ] && fail "boards/displays/ needs $(tr '\n' ' ' <"$tmp/found")" || pass
[ "$(wc -l <"$tmp/defined")" -gt 30 ] && pass || fail "boards/displays/ defines $(wc -l <"$tmp/defined") names"

# What the capture reports when there is nothing to capture.
build/capture 1 'READY never' "$tmp/none.ppm" qemu-system-arm -M lm3s6965evb -kernel build/firmware/lm3s6965evb/clock.elf \
    -semihosting-config enable=on,target=native,arg=clock,arg=06:00,arg=06:00 >/dev/null 2>"$tmp/log" && fail "a capture of nothing" || pass
grep -q 'the firmware did not say it' "$tmp/log" && pass || fail "$(cat "$tmp/log")"
build/capture 5 READY "$tmp/none.ppm" build/no-such-emulator >/dev/null 2>"$tmp/log" && fail "a capture without an emulator" || pass

# Boards with a display that QEMU does not run; test_pico.sh builds the Pico's.
for file in boards/*/board.mk; do
    grep -q '^SCREEN_SIZE' "$file" && grep -q '^BOARD_RUNS := no$' "$file" || continue
    board=$(basename "$(dirname "$file")")
    build "the clock of $board" firmware BOARD=$board APP=clock FW_OPT=-O0
done

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
