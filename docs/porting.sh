#!/bin/sh
# Regenerates the table of docs/FIRMWARE.md, by running all golden frames with and without the ports. usage: porting.sh [OUT_DIR]
cd "$(dirname "$0")/.." || exit 1
out=${1:-docs}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

count() { # count BOARD PORTS
    make -s --no-print-directory emulate BOARD="$1" APP=golden IMAGE=golden-count "BOARD_PORT=$2" COUNT=1 2>&1 | sed -n 's/^instructions //p'
}

{
    echo "| core | port | without | with | gain |"
    echo "|---|---|---|---|---|"
    for file in boards/*/board.mk; do
        board=$(basename "$(dirname "$file")")
        ports=$(sed -n 's/^BOARD_PORT := //p' "$file")
        [ -n "$ports" ] && [ "$ports" != portable ] && grep -q '^BOARD_RUNS := qemu' "$file" &&
            grep -q 'RAM_BYTES : [0-9]*M' "boards/$board/link.ld" || continue
        echo "$(sed -n 's/^BOARD_CORE := //p' "$file")|$ports|$(count "$board" "")|$(count "$board" "$ports")"
    done | sort | awk -F'|' '{ printf "| %s | %s | %.1f million | %.1f million | %.1f %% |\n", $1, $2, $3 / 1e6, $4 / 1e6, 100 * (1 - $4 / $3) }'
} >"$work/table"
awk -v file="$work/table" '
    $0 == "<!-- generated: ports -->" { print; while ((getline line < file) > 0) print line; skip = 1; next }
    $0 == "<!-- end -->" { skip = 0 }
    !skip { print }' "$out/FIRMWARE.md" >"$work/next"
cp "$work/next" "$out/FIRMWARE.md"
