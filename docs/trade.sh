#!/bin/sh
# Makes the generated parts of docs/data/TRADE.md and docs/pictures/trade-*.svg, and docs/trade.txt, what is counted on a Cortex-M3: five minutes on
# two cores. usage: trade.sh TOOL [OUT_DIR [SCENE...]]
# With OUT_DIR they are written there instead of in place, with SCENE only of these, and nothing is counted: figures are those of
# docs/trade.txt. The test compares one scene.
set -e
tool=$1 out=${2:-docs}
target=mps2-an385
[ $# -lt 2 ] || target=
[ $# -lt 2 ] && shift || shift 2
scenes=${*:-sundial avenue desk room fence mixed}
mkdir -p build/tmp
work=$(mktemp -d build/tmp/trade.XXXXXX)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out/pictures" "$out/data"
[ "$out" = docs ] || cp docs/data/TRADE.md "$out/data/"

# counted SCENE CSV: lines "SCENE|CONFIGURATION|FIRST|LATER" of what was counted
counted() {
    awk -F '"' -v scene="$1" 'NR > 1 { split($3, v, ","); if (v[22] != "") printf "%s|%s|%.1f|%.1f\n", scene, $2, v[22], v[23] }' "$2"
}

# front SCENE CSV: the rows of the front, from the smallest. Of a scene that moves, "a (b)" is the mean of what is played, and the worst.
front() {
    awk -F '"' -v scene="$1" '
        NR == FNR { split($0, f, "|"); if (f[1] == scene) counted[f[2]] = f[3] "|" f[4]; next }
        FNR == 1 { next }
        { split($3, v, ",") }
        FNR == 2 {
            moves = v[15] > 1
            if (moves) print "Frame 0, and the later frames 1 to 8: their mean, and in brackets the worst of them.\n"
            first = moves ? "first frame" : "tiles drawn"; later = moves ? "later frames" : "tiles kept"
            print "| RAM, bytes | M3: instructions per pixel, " first " | M3, " later " | model, " first " | model, " later " | PSNR against exact shadows, dB | shadow mismatch" (moves ? ", first frame" : "") " | PSNR against the reference, dB | configuration |"
            print "|---|---|---|---|---|---|---|---|---|"
        }
        v[2] != 1 { next }
        {
            later = sprintf("%.0f", v[16]); truth = sprintf("%.2f", v[18]); reference = sprintf("%.2f", v[20])
            if (moves) { later = later sprintf(" (%.0f)", v[17]); truth = truth sprintf(" (%.2f)", v[19]); reference = reference sprintf(" (%.2f)", v[21]) }
            m3 = "· | ·"
            if ($2 in counted) { split(counted[$2], c, "|"); m3 = sprintf("%.0f | %.0f", c[1], c[2]) }
            printf "| %d | %s | %.0f | %s | %s | %.2f %% | %s | `%s` |\n", v[3], m3, v[4], later, truth, 100 * v[9], reference, $2
        }' docs/trade.txt "$2"
}

# fits SCENE CSV: rows of the table of fits, two atlases. A scene with nothing to fit has one configuration of each.
fits() {
    awk -F '"' -v scene="$1" '
        function cells(key) { return figures[(key in figures) ? key : after] }
        NR > 1 && $2 ~ /^preset=balanced filter=hard( (other_)?atlas_size=[0-9]+)*( fit=stable)?( tiles=equal)?$/ {
            split($3, v, ",")
            side = $2 ~ /atlas_size=64/ ? 64 : $2 ~ /atlas_size=(32|128|256|512)/ ? 0 : 128
            figures[side ($2 ~ /fit=|tiles=/ ? "before" : "after")] = sprintf("%d | %.2f %% | %.2f", v[3], 100 * v[9], v[7])
        }
        END {
            for (side = 128; side >= 64; side /= 2) {
                after = side "after"
                printf "| %s | %d² | %s | %s |\n", scene, side, cells(side "before"), cells(after)
            }
        }' "$2"
}

# all_fits: the table. Rows of scenes that are not made anew stay.
all_fits() {
    echo
    echo "## The same atlas, before and after"
    echo
    echo "Preset balanced, filter hard, first frame. Before: \`fit=stable tiles=equal\`. After: \`fit=tight tiles=worth\`, as the preset has it. Both are against exact shadows. The atlases are as large as each other; equal tiles may leave a part unused, which then takes no RAM."
    echo
    echo "| scene | atlas | before: RAM, bytes | shadow mismatch | PSNR, dB | after: RAM, bytes | shadow mismatch | PSNR, dB |"
    echo "|---|---|---|---|---|---|---|---|"
    for name in sundial avenue desk room fence mixed; do
        if [ -f "$work/$name.csv" ]; then fits "$name" "$work/$name.csv"; else grep "^| $name |" "$out/data/TRADE.md" || true; fi
    done
    echo
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
        !skip { print }' "$out/data/TRADE.md" >"$work/next"
    cp "$work/next" "$out/data/TRADE.md"
}

# two scenes at a time
# shellcheck disable=SC2016
printf '%s\n' $scenes | xargs -P 2 -I '{}' sh -ec '
    "$2" sweep "host/scenes/$1.gltf" --csv "$3/$1.csv" --svg "$4/pictures/trade-$1.svg" ${5:+--target} ${5:+"$5"} >"$3/$1.txt" || { echo "trade: $1" >&2; exit 1; }' \
    sweep '{}' "$tool" "$work" "$out" "$target"
if [ -n "$target" ]; then
    echo "# Written by docs/trade.sh: scene, configuration, instructions per pixel on $target of the first frame and of later ones; $(arm-none-eabi-gcc --version | sed 1q), -O2." >"$work/trade.txt"
    for scene in $scenes; do counted "$scene" "$work/$scene.csv"; done >>"$work/trade.txt"
    cp "$work/trade.txt" docs/trade.txt
fi
for scene in $scenes; do
    {
        echo
        echo "![$scene: RAM and cost against error](../pictures/trade-$scene.svg)"
        echo
        front "$scene" "$work/$scene.csv"
        schedules "$work/$scene.txt"
        echo
    } >"$work/$scene.md"
    replace "$scene" "$work/$scene.md"
done

all_fits >"$work/fits.md"
replace fits "$work/fits.md"

{
    echo
    sed '/clang-format/d; /^ \*\//q' host/tool/cost/cost_table.h | sed 's|^/\* ||; s|^ \*/||; s|^ \*   |- |; s|^ \* ||; s|:$|:\n|'
    echo "| event | instructions | one of them is |"
    echo "|---|---|---|"
    sed -n 's|^COST(\([a-z0-9_]*\), \([0-9.e+]*\)) /\* \(.*\) \*/$|\| `\1` \| \2 \| \3 \||p' host/tool/cost/cost_table.h
    echo
} >"$work/weights.md"
replace weights "$work/weights.md"
