#!/bin/sh
# Regenerates the generated parts of docs/FIRMWARE.md (boards), docs/data/GOLDEN.md (golden, pocket) and docs/pictures/pocket.png. usage: boards.sh [OUT_DIR], or --boards: prints the table of the boards
cd "$(dirname "$0")/.." || exit 1

setting() { sed -n "s/^$2 := *//p" "boards/$1/board.mk"; }

table_of_boards() {
    echo "| board | core | memory for code + data | what it is |"
    echo "|---|---|---|---|"
    for file in boards/*/board.mk; do
        board=$(basename "$(dirname "$file")")
        [ "$board" = host ] && continue
        memory=$(sed -n 's/^ *[a-z0-9]* (\(r[wx]*\)) : ORIGIN = [^,]*, LENGTH = \(.*\)$/\1 \2/p' "boards/$board/link.ld" |
            awk '{ sub(/^rw?x? DEFINED\(RAM_BYTES\) \? RAM_BYTES : /, "rw "); sub(/ - (256|4K)$/, ""); if ($2 != "256") print $2 }' | paste -s -d+ | sed 's/+/ + /g; s/\([KM]\)/ \1B/g')
        echo "| $board | $(setting "$board" BOARD_CORE) | $memory | $(sed -n '1s/^# //p' "$file") |"
    done
}

# Lines "CRC SCENE frame N PRESET PICTURE", as the app prints them.
table_of_golden_frames() {
    echo "| scene | frame | preset | picture | CRC-32 |"
    echo "|---|---|---|---|---|"
    make -s --no-print-directory emulate BOARD=host APP=golden 2>&1 |
        sed -n 's/^\([0-9a-f]\{8\}\) \([a-z]*\) frame \([0-9]*\) \([a-z]*\) \(.*\)$/| \2 | \3 | \4 | \5 | `\1` |/p'
}

pocket() { # pocket PICTURE.png
    make -s --no-print-directory emulate BOARD=host APP=pocket ARGS="$work/strips" 2>&1 | sed -n 's/^hour \([0-9]\) crc \(.*\)$/| \1 | `\2` |/p' >"$work/hours"
    make -s --no-print-directory build/rgb565_png >/dev/null
    build/rgb565_png 128 128 "$1" <"$work/strips"
    printf '| hour | CRC-32 |\n|---|---|\n'
    cat "$work/hours"
}

replace() { # replace DOCUMENT NAME: by the lines of standard input
    cat >"$work/lines"
    awk -v name="$2" -v file="$work/lines" '
        $0 == "<!-- generated: " name " -->" { print; while ((getline line < file) > 0) print line; skip = 1; next }
        $0 == "<!-- end -->" { skip = 0 }
        !skip { print }' "$out/$1" >"$work/next"
    cp "$work/next" "$out/$1"
}

if [ "${1:-}" = --boards ]; then table_of_boards; exit; fi # for a test to compare
out=${1:-docs}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out/pictures"
table_of_boards | replace FIRMWARE.md boards
table_of_golden_frames | replace data/GOLDEN.md golden
pocket "$out/pictures/pocket.png" | replace data/GOLDEN.md pocket
