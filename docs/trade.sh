#!/bin/sh
# Makes the generated parts of docs/TRADE.md and docs/pictures/trade-*.svg: minutes. usage: trade.sh TOOL [OUT_DIR [SCENE...]]
# With OUT_DIR they are written there instead of in place, with SCENE only of these: the test compares one of them.
set -e
tool=$1 out=${2:-docs}
[ $# -lt 2 ] && shift || shift 2
scenes=${*:-sundial avenue desk room fence mixed}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out/pictures"
[ "$out" = docs ] || cp docs/TRADE.md "$out/"

# front CSV: the rows of the front, from the smallest. Of a scene that moves, "a (b)" is all frames that are played, and the worst of them.
front() {
    awk -F '"' '
        NR == 1 { next }
        { split($3, v, ",") }
        NR == 2 {
            moves = v[15] > 1
            if (moves) {
                print "Frame 0, and the later frames 1 to 8: their mean, and in brackets the worst of them.\n"
                print "| RAM, bytes | instructions per pixel: first frame | later frames | PSNR against exact shadows, dB | shadow mismatch, first frame | PSNR against the reference, dB | configuration |"
            } else print "| RAM, bytes | instructions per pixel: tiles drawn | tiles kept | PSNR against exact shadows, dB | shadow mismatch | PSNR against the reference, dB | configuration |"
            print "|---|---|---|---|---|---|---|"
        }
        v[2] != 1 { next }
        {
            later = sprintf("%.0f", v[16]); truth = sprintf("%.2f", v[18]); reference = sprintf("%.2f", v[20])
            if (moves) { later = later sprintf(" (%.0f)", v[17]); truth = truth sprintf(" (%.2f)", v[19]); reference = reference sprintf(" (%.2f)", v[21]) }
            printf "| %d | %.0f | %s | %s | %.2f %% | %s | `%s` |\n", v[3], v[4], later, truth, 100 * v[9], reference, $2
        }' "$1"
}

# schedules TEXT: what the sweep says of cascades on a schedule
schedules() {
    awk '
        /^Cascades on a schedule/ {
            print "\nCascades on a schedule, in the later frames; with what they change:\n"
            print "| instructions per pixel | PSNR against exact shadows, dB | PSNR against the reference, always drawn anew, dB | its worst frame | configuration |\n|---|---|---|---|---|"
            on = 1; next
        }
        on && / dB  / {
            name = $0; sub(/.* dB  /, "", name)
            printf "| %.1f (%s %%) | %s (%s) | %s (%s) | %s | `%s` |\n", $1, $2, $4, $5, $7, $8, $10, name
        }' "$1"
}

replace() { # replace NAME FILE
    awk -v name="$1" -v file="$2" '
        $0 == "<!-- generated: " name " -->" { print; while ((getline line < file) > 0) print line; skip = 1; next }
        $0 == "<!-- end -->" { skip = 0 }
        !skip { print }' "$out/TRADE.md" >"$work/next"
    cp "$work/next" "$out/TRADE.md"
}

for scene in $scenes; do
    "$tool" sweep "host/scenes/$scene.gltf" --csv "$work/$scene.csv" --svg "$out/pictures/trade-$scene.svg" >"$work/$scene.txt"
    {
        echo
        echo "![$scene: RAM and cost against error](pictures/trade-$scene.svg)"
        echo
        front "$work/$scene.csv"
        schedules "$work/$scene.txt"
        echo
    } >"$work/$scene.md"
    replace "$scene" "$work/$scene.md"
done

{
    echo
    sed -n '/^\/\*/,/\*\//p' host/tool/cost_table.h | sed -n '1,/^ \*\//p' | sed 's|^/\* ||; s|^ \*/||; s|^ \*   |- |; s|^ \* ||; s|:$|:\n|'
    echo "| event | instructions | one of them is |"
    echo "|---|---|---|"
    sed -n 's|^COST(\([a-z0-9_]*\), \([0-9.e+]*\)) /\* \(.*\) \*/$|\| `\1` \| \2 \| \3 \||p' host/tool/cost_table.h
    echo
} >"$work/weights.md"
replace weights "$work/weights.md"
