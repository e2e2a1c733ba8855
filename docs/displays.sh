#!/bin/sh
# Makes what is generated of docs/FIRMWARE.md about displays: the emulators' screens as pictures, and a table of bytes: flash at -Os on a Cortex-M3, RAM of the
# objects that the caller supplies. usage: displays.sh OUT_DIR TABLE
set -e
cd "$(dirname "$0")/.."
out=$1 table=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

mkdir -p "$out/pictures"
for board in lm3s6965evb rv32-virt; do
    for hour in 07:00 10:00 13:00 17:30; do
        make -s screen BOARD=$board ARGS="$hour $hour" SCREEN_OUT="$work/screen.ppm" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
        cp "$work/screen.png" "$out/pictures/display-$board-$(echo $hour | tr -d :).png"
    done
    sed -n "s/^RAM \([0-9]*\) bytes, with a stack of \([0-9]*\), of which used \([0-9]*\).*/| the clock on $board, all in all | | \1, of which \2 for the stack; used of that: \3 |/p" "$work/log" >>"$work/clocks"
done

make -s build/test_panels build/ppm >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
while read -r picture zoom panel; do
    build/test_panels --picture "$panel" "$zoom" >"$work/glass.ppm"
    build/ppm png "$work/glass.ppm" "$out/pictures/display-model-$picture.png"
done <<'PANELS'
ssd1306 3 ssd1306
ssd1327 2 ssd1327
st7789 1 st7789 135x240
PANELS

compile() { arm-none-eabi-gcc -mcpu=cortex-m3 -mthumb -std=c99 -Os -ffreestanding -isystem boards/common/include -Ilib -Iboards/displays -c "$@"; }
for source in boards/displays/*.c; do compile -o "$work/$(basename "$source" .c).o" "$source"; done
printf '#include "display.h"\n#include "framebuffer.h"\nchar panel_[sizeof(panel)], display_[sizeof(display)], frame_[sizeof(framebuffer)];\n' >"$work/ram.c"
compile -o "$work/ram.o" "$work/ram.c"
flash() { (cd "$work" && for part in "$@"; do echo "$part.o"; done | xargs arm-none-eabi-size | awk 'NR > 1 { n += $1 } END { print n }'); }
ram() { arm-none-eabi-nm -S "$work/ram.o" | awk -v name="$1" '$4 == name { print $2 }' | sed 's/^0*/0x/' | xargs printf '%d\n'; }
{
    echo "| part | flash | RAM |"
    echo "|---|---|---|"
    echo "| \`panel.c\`: every panel | $(flash panel) | $(ram panel_): \`panel\` |"
    echo "| ST7789 | $(flash panel_dcs panel_st7789) | |"
    echo "| ILI9341 | $(flash panel_dcs panel_ili9341) | |"
    echo "| SSD1306 | $(flash panel_ssd panel_ssd1306) | |"
    echo "| SSD1327 and SSD0323 | $(flash panel_ssd panel_ssd_grey) | |"
    echo "| frame buffer in memory | $(flash panel_linear framebuffer) | $(ram frame_): \`framebuffer\` |"
    echo "| \`display.c\`, \`display_pack.c\`: the library's tiles | $(flash display display_pack) | $(ram display_): \`display\`; two buffers of a tile |"
    cat "$work/clocks"
} >"$table"
