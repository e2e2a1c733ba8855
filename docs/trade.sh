#!/bin/sh
# Makes the generated parts of docs/TRADE.md and docs/pictures/trade-*.svg: about a minute. usage: trade.sh TOOL [OUT_DIR [SCENE...]]
# With OUT_DIR they are written there instead of in place, with SCENE only of these: the test compares one of them.
set -e
tool=$1 out=${2:-docs}
[ $# -lt 2 ] && shift || shift 2
scenes=${*:-sundial avenue desk room fence mixed}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out/pictures"
[ "$out" = docs ] || cp docs/TRADE.md "$out/"

# front CSV: the rows of the front, from the smallest
front() {
    echo "| RAM, bytes | instructions per pixel | PSNR against exact shadows, dB | shadow mismatch | PSNR against the reference, dB | configuration |"
    echo "|---|---|---|---|---|---|"
    awk -F '"' 'NR > 1 {
        split($3, v, ",")
        if (v[2] != 1) next
        printf "| %d | %.0f | %.2f | %.2f %% | %.2f | `%s` |\n", v[3], v[4], v[7], 100 * v[9], v[12], $2
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
    "$tool" sweep "host/scenes/$scene.gltf" --csv "$work/$scene.csv" --svg "$out/pictures/trade-$scene.svg" >/dev/null
    {
        echo
        echo "![$scene: RAM and cost against error](pictures/trade-$scene.svg)"
        echo
        front "$work/$scene.csv"
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
