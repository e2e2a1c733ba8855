#!/bin/sh
# The same bits on a host build and on cores in the emulator, one for each port (THOROUGH=1: eight), as docs/data/GOLDEN.md lists them; 16 KB of RAM; guards that report;
# boards that QEMU does not run are built.
# THOROUGH=1: golden frames and guards of cores whose port another has, too, a scene with constants on every core, more optimisations on the host and without a warning, -O2 on every board.
cd "$(dirname "$0")/../.." || exit 1
if [ "${1:-}" = job ]; then tmp=$2; else . tests/support/check.sh; fi # a job is this script, called by xargs below

setting() { sed -n "s/^$2 := *//p" "boards/$1/board.mk"; }
boards=$(for file in boards/*/board.mk; do basename "$(dirname "$file")"; done)
emulated=$(for board in $boards; do if [ "$(setting "$board" BOARD_RUNS)" = qemu ]; then echo "$board"; fi; done)
flashed=$(for board in $boards; do case $(setting "$board" BOARD_RUNS) in qemu | host) ;; *) echo "$board" ;; esac; done) # an image to flash
firmware() { make -s --no-print-directory "$@"; }
variable() { make -s --no-print-directory WERROR=-Werror --eval="print: ; @echo \$($1)" print; }

# ---- Jobs: each prints "ok" or what is wrong, a line each ------------------------------------------------------------------

same_frames() { # same_frames WHAT FILE
    if cmp -s "$2" "$tmp/golden"; then echo ok
    else echo "$1: $(diff "$2" "$tmp/golden" | head -n 3 | tr '\n' ';')"; fi
}

# The whole library as one file; scenes as objects of one word size.
host_golden() { # host_golden COMPILER OPTIMISATION WORD
    out=$tmp/host$1$2$3 on=
    [ "$3" = -m64 ] || on=$(sh tests/support/words32.sh)
    if $1 $3 -std=c99 -w $2 -Ilib -Iboards/common -Iboards/apps '-DGN_USER_CONFIG="golden_config.h"' -o "$out" lib/gnomon.c \
        boards/apps/golden.c boards/host/startup.c boards/common/print.c "$tmp"/scene"$3"_*.o 2>"$out.log"; then
        $on "$out" >"$out.txt" 2>&1
        same_frames "$*" "$out.txt"
    else echo "$*: $(grep -m 1 -E 'error|undefined' "$out.log")"; fi
}

# Of cores that have the same port, one is optimised as it ships, the others less: compiling takes most of the time.
board_golden() { # board_golden BOARD
    case $1$THOROUGH in mps2-an505*) opt=-Os ;; mps2-an385 | rv32-virt) opt=-Og ;; mps2-an500 | nrf51-large | xtensa-sim) opt=-O1 ;; *) opt=-O2 ;; esac # -Os: GN_SIZE_FIRST
    if firmware firmware BOARD="$1" APP=golden FW_OPT=$opt >"$tmp/$1.log" 2>&1 && firmware emulate BOARD="$1" APP=golden FW_OPT=$opt >"$tmp/$1.txt" 2>&1; then
        same_frames "$1" "$tmp/$1.txt"
    else echo "$1: golden: $(grep -h -m 1 -i -E 'error|undefined|fault' "$tmp/$1.log" "$tmp/$1.txt")"; fi
}

# Knobs as constants, and only what the scene needs.
board_play() { # board_play BOARD SCENE FRAME PRESET
    crc=$(grep " $2 frame $3 $4 RGB565\$" "$tmp/golden" | head -n 1 | cut -d' ' -f1)
    firmware emulate BOARD="$1" APP=play SCENE="host/scenes/$2.gltf" PRESET="$4" FW_OPT=$([ "$1" = xtensa-sim ] && echo -O1 || echo -Os) \
        SCENE_FLAGS="--size 160x120 --frames $3-$3 --set output=rgb565" >"$tmp/play$1" 2>&1
    if [ -n "$crc" ] && grep -q "^$crc frame 0\$" "$tmp/play$1"; then echo ok
    else echo "$1: $*: $(grep -v '^  ' "$tmp/play$1" | head -n 2 | tr '\n' ';') instead of $crc"; fi
}

board_guards() { # board_guards BOARD
    for args in none trap stack; do
        firmware emulate BOARD="$1" APP=fault ARGS=$args >"$tmp/guard$1" 2>&1
        status=$?
        case $args in
        none) expected='^stack [0-9]* bytes$' ;;
        trap) expected='^fault: exception [0-9]* pc=0*[1-9a-f][0-9a-f]* lr=' ;;
        stack) expected='the stack ran over' ;;
        esac
        if [ $((status != 0)) = "$([ $args = none ] && echo 0 || echo 1)" ] && grep -q "$expected" "$tmp/guard$1"; then echo ok
        else echo "$1: fault $args: $(grep -v '^  ' "$tmp/guard$1" | tr '\n' ';')"; fi
    done
}

# A scene on a stack that is too small for it, where a bus drops what is written below the RAM, where other memory lies there, and where
# nothing does: a fault at once, not a run that goes wrong.
board_overrun() { # board_overrun BOARD
    firmware emulate BOARD="$1" APP=pocket FW_OPT=-O0 LINK_FLAGS=-Wl,--defsym=STACK=640 IMAGE=pocket-overrun TIMEOUT=30 >"$tmp/overrun$1" 2>&1
    if grep -q '^fault: exception' "$tmp/overrun$1" && grep -q '^fault: the stack ran over' "$tmp/overrun$1"; then echo ok
    else echo "$1: no report of an overrun: $(grep -v '^  ' "$tmp/overrun$1" | tr '\n' ';')"; fi
}

# The library without a warning: what the compiler sees differs with the optimisation.
board_warnings() { # board_warnings BOARD OPTIMISATION CONFIGURATION
    root=$PWD dir=$tmp/warnings$1$2$3
    cc="$(setting "$1" BOARD_CROSS)gcc $(setting "$1" BOARD_CPU) -std=c99 $2 $(variable WARN) -ffreestanding"
    mkdir -p "$dir"
    if (cd "$dir" && $cc -isystem "$root/boards/common/include" -I"$root/lib" -I"$root/boards/apps" "-DGN_USER_CONFIG=\"$3_config.h\"" \
        -c "$root"/lib/*.c) 2>"$dir.log"; then echo ok
    else echo "$*: $(grep -m 1 -E 'error|warning' "$dir.log")"; fi
}

built() { # built BOARD: those whose images hot() looks at as they are flashed, the others of the same core hardly optimised
    case $1$THOROUGH in nrf52840-dk | black-pill | stm32f429-discovery) opt=-O0 ;; *) opt=-O2 ;; esac
    if firmware firmware BOARD="$1" APP=crc FW_OPT=$opt >"$tmp/built$1" 2>&1 && [ -s "build/firmware/$1/crc.elf" ]; then echo ok
    else echo "$1: $(grep -m 1 -E 'error|undefined' "$tmp/built$1")"; fi
    [ -s "build/firmware/$1/crc.bin" ] && echo ok || echo "$1 has no flat image"
    case $(setting "$1" BOARD_RUNS) in no) said="Built, not run" ;; *) said="Runs in $(setting "$1" BOARD_RUNS)" ;; esac
    sed -n 1p "boards/$1/board.mk" | grep -q "$said" && echo ok || echo "$1 is not labelled: $said"
}

host_opt() { [ "$1" != host ] || echo FW_OPT=-O0; }

# The micro:bit's 16 KB: the pictures and the strips are the host's, and what does not fit is refused.
pocket() {
    for board in host microbit; do
        firmware emulate BOARD=$board APP=pocket $(host_opt $board) ARGS="$tmp/strips.$board" >"$tmp/pocket.$board" 2>&1
    done
    grep '^hour' "$tmp/pocket.host" >"$tmp/hours.host"
    grep '^hour' "$tmp/pocket.microbit" >"$tmp/hours.microbit"
    if [ "$(wc -l <"$tmp/hours.host")" = 3 ] && cmp -s "$tmp/hours.host" "$tmp/hours.microbit"; then echo ok
    else echo "pocket: $(grep -v '^  ' "$tmp/pocket.microbit" | tr '\n' ';')"; fi
    sed 's/hour \([0-9]\) crc \(.*\)/| \1 | `\2` |/' "$tmp/hours.microbit" >"$tmp/hours.rows"
    [ "$(grep -c -x -F -f "$tmp/hours.rows" docs/data/GOLDEN.md)" = 3 ] && echo ok || echo "docs/data/GOLDEN.md has other CRCs of the pocket sundial"
    if build/rgb565_png 128 128 "$tmp/pocket.png" <"$tmp/strips.microbit" && cmp -s "$tmp/pocket.png" docs/pictures/pocket.png; then echo ok
    else echo "pocket: the streamed picture is not docs/pictures/pocket.png"; fi
    bytes=$(sed -n 's/^RAM \([0-9]*\) bytes.*/\1/p' "$tmp/pocket.microbit")
    [ "${bytes:-99999}" -le 16384 ] && echo ok || echo "pocket: $bytes bytes of RAM"
    # A comma is the emulator's, what is too long is refused, and so is a file that cannot be.
    firmware emulate BOARD=microbit APP=pocket ARGS="$tmp/a,b" >/dev/null 2>&1 && cmp -s "$tmp/a,b" "$tmp/strips.microbit" && echo ok || echo "pocket: no file with a comma"
    long=$tmp/$(printf '%0110d' 0)
    for board in host microbit; do
        firmware emulate BOARD=$board APP=pocket $(host_opt $board) ARGS="$long" >"$tmp/long.$board" 2>&1 && echo "$board: ARGS of 110 characters"
        grep -q '^ARGS are too long' "$tmp/long.$board" && echo ok || echo "$board: ARGS of 110 characters: $(head -n 1 "$tmp/long.$board")"
        firmware emulate BOARD=$board APP=pocket $(host_opt $board) ARGS=/no/such/folder >"$tmp/no.$board" 2>&1 && echo "$board: a file in no folder"
        grep -q '^cannot create /no/such/folder' "$tmp/no.$board" && echo ok || echo "$board: a file in no folder: $(head -n 1 "$tmp/no.$board")"
    done
    if firmware firmware BOARD=microbit APP=pocket LINK_FLAGS=-Wl,--defsym=RAM_BYTES=12K IMAGE=pocket >"$tmp/pocket.12" 2>&1; then echo "12 KB are enough for the pocket sundial"
    elif grep -q 'overflowed by' "$tmp/pocket.12"; then echo ok
    else echo "pocket with 12 KB: $(head -n 1 "$tmp/pocket.12")"; fi
}

# A gauge over a scene: it is in the picture that GALLERY shows, and its hand turns by few tiles, as the host says.
gauge() {
    flags="$(sed -n 's/^! gauge avenue //p' docs/gallery.txt)"
    for board in host mps2-an385; do
        firmware emulate BOARD=$board APP=gauge FW_OPT=$([ $board = host ] && echo -O0 || echo -Og) SCENE=host/scenes/avenue.gltf SCENE_FLAGS="$flags" ARGS="$tmp/gauge.$board" >"$tmp/gauge.txt" 2>&1
        grep -o 'the hand turns: .* drawn.*' "$tmp/gauge.txt" >"$tmp/turns.$board"
        if build/rgb565_png 320 240 "$tmp/gauge.png" <"$tmp/gauge.$board" && cmp -s "$tmp/gauge.png" docs/pictures/gallery/r11-2.png; then echo ok
        else echo "$board: the gauge is not docs/pictures/gallery/r11-2.png"; fi
    done
    set -- $(tr -c '0-9\n' ' ' <"$tmp/turns.host")
    grep -q 'tiles drawn$' "$tmp/turns.host" && [ "${1:-0}" -gt 24 ] && [ $((10 * $1)) -lt "$2" ] && cmp -s "$tmp/turns.host" "$tmp/turns.mps2-an385" && echo ok || echo "gauge: $(cat "$tmp/turns.host")"
}

# A mesh of 70,000 triangles within 64 KB on a Cortex-M3, by groups: the picture that the host draws by records.
large() {
    awk -v across=264 -v down=133 'BEGIN {
        half = 3.14159265358979
        for (k = 0; k <= down; k++) for (i = 0; i < across; i++) {
            turn = 2 * half * i / across
            rise = half * k / down
            r = 1 + 0.2 * sin(5 * turn) * sin(4 * rise)
            printf "v %.9f %.9f %.9f\n", r * sin(rise) * cos(turn), r * cos(rise), r * sin(rise) * sin(turn)
        }
        for (n = 0; n < across * down; n++) { # in no order at all
            cell = n * 7919 % (across * down)
            i = cell % across
            above = cell - i + 1
            next_i = (i + 1) % across
            print "f", above + i, above + next_i, above + across + next_i, above + across + i
        }
    }' >"$tmp/large.obj"
    size="--size 320x240 --set output=rgb565"
    firmware emulate BOARD=host APP=play SCENE="$tmp/large.obj" PRESET=tiny IMAGE=play-large FW_OPT=-O0 SCENE_FLAGS="$size" >"$tmp/large.host" 2>&1
    firmware emulate BOARD=mps2-an385 APP=play SCENE="$tmp/large.obj" PRESET=tiny IMAGE=play-large FW_OPT=-Og LINK_FLAGS=-Wl,--defsym=RAM_BYTES=64K \
        SCENE_FLAGS="$size --set triangle_groups=1024" >"$tmp/large.m3" 2>&1
    line=$(grep ' frame 0$' "$tmp/large.host")
    if [ -n "$line" ] && grep -q -x "$line" "$tmp/large.m3"; then echo ok
    else echo "large: $(grep -v '^  ' "$tmp/large.m3" | head -n 3 | tr '\n' ';') instead of $line"; fi
}

# What is hot stands in .hot, which runs from the instruction memory where a board has one; nothing else does.
hot() {
    arm-none-eabi-objdump -t build/firmware/mps3-an547/golden.elf | awk '$3 == "F" && $4 == ".hot" && $1 < "00080000" { print $NF }' >"$tmp/hot"
    for function in gn_raster_tile gn_shade_tile; do
        grep -q -x $function "$tmp/hot" && echo ok || echo "$function is not in the instruction memory of mps3-an547"
    done
    grep -q -x gn_scene_validate "$tmp/hot" && echo "gn_scene_validate is hot" || echo ok
    # What is marked as hot (GN_HOT) is there, and nothing else of the library; a clone of a function counts as it.
    sed -n 's|^GN_HOT ([^(]*[ *])([a-z_0-9]*)\(.*|\2|p' -E lib/*/*.[ch] | sort -u >"$tmp/marked"
    [ "$(wc -l <"$tmp/marked")" -gt 100 ] && echo ok || echo "$(wc -l <"$tmp/marked") functions are marked as hot"
    for image in mps3-an547/golden pico/crc ${THOROUGH:+stm32f429-discovery/crc}; do
        for section in .hot .text; do
            arm-none-eabi-objdump -t "build/firmware/$image.elf" |
                awk -v s=$section '$3 == "F" && $4 == s && $NF !~ /_veneer$/ { sub(/\..*/, "", $NF); print $NF }' | sort -u >"$tmp/in$section"
        done
        comm -12 "$tmp/marked" "$tmp/in.text" >"$tmp/lost"
        [ -s "$tmp/lost" ] && echo "$image: marked as hot, but not in .hot: $(tr '\n' ' ' <"$tmp/lost")" || echo ok
        comm -13 "$tmp/marked" "$tmp/in.hot" | grep -v -E '^(__|mem|copy_up|gn_port_)' >"$tmp/unmarked"
        [ -s "$tmp/unmarked" ] && echo "$image: in .hot without a mark: $(tr '\n' ' ' <"$tmp/unmarked")" || echo ok
        comm -12 "$tmp/marked" "$tmp/in.hot" | wc -l | awk -v i=$image '$1 < 50 { print i ": only " $1 " hot functions" } $1 >= 50 { print "ok" }'
    done
    # What it calls elsewhere goes through a veneer: per vertex, triangle, object, tile and light is rare enough, per pixel is not.
    for image in mps3-an547/golden pico/crc; do
        arm-none-eabi-objdump -t "build/firmware/$image.elf" | sed -n 's/.* \.hot.* __\(.*\)_veneer$/\1/p' |
            grep -v -x -E 'find_(depth|face)|gn_(screen_rect|join_find|surface_[a-z_]*|setup_(vertex|tile|record)|normals_find|clip|outcode|xform_[a-z_]*|cascade_tan2_q24|scene_auto_bias)' >"$tmp/away"
        [ -s "$tmp/away" ] && echo "$image: hot code calls $(tr '\n' ' ' <"$tmp/away")outside of .hot" || echo ok
    done
}

# What is marked as fast lies in the memory that is.
fast() {
    for place in stm32f429-discovery:1000; do
        arm-none-eabi-nm "build/firmware/${place%:*}/crc.elf" | grep -q "^${place#*:}.* renderer\$" && echo ok || echo "the renderer is not in the fast memory of ${place%:*}"
    done
}

# The boot ROM of the RP2040 wants CRC-32/MPEG-2 of the first 252 bytes in the next four.
pico_boot() {
    arm-none-eabi-objcopy -O binary -j .boot build/firmware/pico/crc.elf "$tmp/boot"
    cat >"$tmp/boot.c" <<'EOF_C'
#include <stdint.h>
#include <stdio.h>
int main(void)
{
    uint32_t crc = ~0U, stored = 0;
    for (int i = 0; i < 252; i++) {
        crc ^= (uint32_t)getchar() << 24;
        for (int bit = 0; bit < 8; bit++) crc = crc << 1 ^ (crc >> 31 ? 0x04C11DB7U : 0);
    }
    for (int i = 0; i < 4; i++) stored |= (uint32_t)getchar() << 8 * i;
    if (crc != stored || getchar() != EOF) printf("pico: the boot stage's CRC is %08x, not %08x\n", (unsigned)crc, (unsigned)stored);
    else printf("ok\n");
}
EOF_C
    gcc -o "$tmp/boot_crc" "$tmp/boot.c" && "$tmp/boot_crc" <"$tmp/boot"
}

# UF2: blocks of 512 bytes with 256 of the flat image each, in order, for an RP2040.
pico_uf2() {
    bin=build/firmware/pico/crc.bin uf2=build/firmware/pico/crc.uf2
    n=$((($(wc -c <$bin) + 255) / 256))
    [ "$(wc -c <$uf2)" = $((512 * n)) ] && echo ok || echo "crc.uf2 has not $n blocks"
    last=$(od -A n -v -t x4 -j $((512 * (n - 1))) -N 32 $uf2 | tr -d ' \n')
    expected=$(printf '0a3246559e5d515700002000%08x00000100%08x%08xe48bff56' $((0x10000000 + 256 * (n - 1))) $((n - 1)) $n)
    [ "$last" = "$expected" ] && echo ok || echo "crc.uf2: $last, not $expected"
    od -A n -v -w512 -t x1 $uf2 | cut -c 97-864 | tr -d ' \n' >"$tmp/uf2"
    od -A n -v -w256 -t x1 $bin | tr -d ' \n' >"$tmp/bin"
    head -c "$(wc -c <"$tmp/bin")" "$tmp/uf2" | cmp -s - "$tmp/bin" && echo ok || echo "crc.uf2 holds other bytes than crc.bin"
}

# ---- Running, two at a time ------------------------------------------------------------------------------------------------

if [ "${1:-}" = job ]; then
    shift 2
    "$@"
    exit
fi

# Lines "CRC SCENE frame N PRESET PICTURE" from the document's table
sed -n 's/^| \([a-z]*\) | \([0-9]*\) | \([a-z]*\) | \(.*\) | `\([0-9a-f]*\)` |$/\5 \1 frame \2 \3 \4/p' docs/data/GOLDEN.md >"$tmp/golden"
[ "$(wc -l <"$tmp/golden")" -gt 40 ] && pass || fail "docs/data/GOLDEN.md has no table of golden frames"
# Groups of triangles draw what records do.
sed -n "s|, groups$||p" "$tmp/golden" >"$tmp/groups"
[ "$(grep -c -x -F -f "$tmp/groups" "$tmp/golden")" = 4 ] && pass || fail "docs/data/GOLDEN.md: groups draw other pictures than records"

sh docs/boards.sh --boards | grep -v -x -F -f docs/FIRMWARE.md >"$tmp/rows"
[ -s "$tmp/rows" ] && fail "docs/FIRMWARE.md has other boards: $(head -n 1 "$tmp/rows")" || pass

scenes=$(sed -n "s|^GOLDEN_SCENES := ||p" boards/apps/golden.mk)
scenes_ok=1
for scene in $scenes; do firmware BOARD=host APP=golden "build/firmware/scenes/$scene/scene.c" >"$tmp/log" 2>&1 || scenes_ok=0; done
for word in ${THOROUGH:+-m64} -m32; do
    for scene in $scenes; do
        gcc $word -std=c99 -w -O1 -Ilib -Iboards/apps "-Ibuild/firmware/scenes/$scene" '-DGN_USER_CONFIG="golden_config.h"' -DGOLDEN_SCENE=$scene \
            -c -o "$tmp/scene${word}_$scene.o" boards/apps/golden_scene.c || scenes_ok=0
    done
done
[ $scenes_ok = 1 ] && pass || fail "a scene does not compile: $(tail -n 1 "$tmp/log")"
make -s build/rgb565_png >"$tmp/log" 2>&1 && pass || fail "rgb565_png does not build"

{
    for board in $emulated; do
        case $board$THOROUGH in mps2-an386 | mps2-an500 | xtensa-sim) continue ;; esac # whose port another has
        grep -q "RAM_BYTES : [0-9]*M" "boards/$board/link.ld" && echo "board_golden $board"
    done
    echo "host_golden clang -O2 -m32"
    echo "board_play xtensa-sim mixed 0 balanced"
    if [ "$THOROUGH" ]; then
        echo "host_golden gcc -O1 -m64" && echo "host_golden gcc -O3 -m64" && echo "host_golden clang -O3 -m32"
        echo "board_play nrf51-large avenue 0 tiny"
        echo "board_play mps3-an547 mixed 0 balanced"
        echo "board_play rv32-virt room 0 accurate"
        echo "host_golden gcc -O2 -m32" && echo "host_golden clang -O2 -m64"
        echo "host_golden gcc -Os -m64" && echo "host_golden clang -Os -m32"
        echo "host_golden gcc -O0 -m32" && echo "host_golden clang -O0 -m64"
        echo "board_play mps2-an385 sundial 24 tiny"
        echo "board_play mps2-an386 desk 0 balanced"
        echo "board_play mps2-an505 fence 0 accurate"
        for opt in -O0 -O3 -Os; do echo "board_warnings mps2-an385 $opt crc"; done
        for board in rv32-virt mps3-an547; do echo "board_warnings $board -O3 crc"; done
        echo "board_warnings mps2-an385 -O3 golden"
    fi
    for board in $emulated; do
        case $board$THOROUGH in mps2-an386 | mps2-an500) ;; *) echo "board_guards $board" ;; esac # they start as mps2-an385 does
    done
    for board in lm3s6965evb rv32-virt microbit; do echo "board_overrun $board"; done
    for board in $flashed; do echo "built $board"; done
    echo pocket
    echo large
    echo gauge
} >"$tmp/jobs"
xargs -P 2 -I '{}' sh -c 'sh tests/firmware/test_boards.sh job "$1" $2' run "$tmp" '{}' <"$tmp/jobs" >"$tmp/results" 2>&1
{ hot; fast; pico_boot; pico_uf2; } >>"$tmp/results" 2>&1
passed=$((passed + $(grep -c '^ok$' "$tmp/results")))
failed=$((failed + $(grep -v -c '^ok$' "$tmp/results")))
grep -v '^ok$' "$tmp/results"
[ "$(echo "$emulated" | grep -c .)" -ge 9 ] && pass || fail "the emulated boards are $emulated"
[ "$(echo "$flashed" | grep -c .)" -ge 4 ] && pass || fail "the boards with an image to flash are $flashed"
[ "$(grep -c '^ok$' "$tmp/results")" -ge $((${THOROUGH:+32} + 62)) ] && pass || fail "jobs are missing"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
