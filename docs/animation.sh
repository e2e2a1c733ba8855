#!/bin/sh
# The table of docs/ACCURACY.md over the frames of the scenes' animations: the range of each figure of gnomon compare, in every preset.
# usage: animation.sh TOOL [OUT_DIR] [SCENE...]: the scenes by name, by default the six of the project; a minute for all
set -e
tool=$1 out=${2:-docs}
[ $# -gt 2 ] && shift 2 || set -- sundial avenue desk room fence mixed
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
[ -f "$out/ACCURACY.md" ] || { mkdir -p "$out" && cp docs/ACCURACY.md "$out/"; }

field() { sed -n "s/.*\"$1\": \([-+.0-9a-z]*\),.*/\1/p" "$work/json"; } # of the first object: the whole picture's
{
    echo
    echo "| scene | frames | preset | identical: least, median, most | within1, least | PSNR dB: least, median, most | shadow mismatch: median, most | least PSNR at frame |"
    echo "|---|---|---|---|---|---|---|---|"
    for name; do
        scene=host/scenes/$name.gltf
        last=$("$tool" info "$scene" | sed -n 's/.*--frames 0-\([0-9]*\) plays them all.*/\1/p')
        # about a dozen frames, the first and the last among them; the sundial's day in steps of 40 minutes
        step=$(((${last:-0} + 17) / 18))
        [ "$step" -gt 0 ] || step=1
        for preset in accurate balanced fast tiny; do
            frame=0
            while [ "$frame" -le "${last:-0}" ]; do
                "$tool" compare "$scene" --frame "$frame" --set preset=$preset --json | sed 's/"lights": .*//' >"$work/json"
                echo "$frame $(field identical) $(field within1) $(field psnr_db) $(field shadow_mismatch)"
                frame=$((frame + step))
            done >"$work/rows"
            awk -v scene="$name" -v preset=$preset '
                function sorted(column,   i, k, t) {
                    for (i = 1; i <= NR; i++) s[i] = value[i, column]
                    for (i = 2; i <= NR; i++) for (k = i; k > 1 && s[k] < s[k - 1]; k--) { t = s[k]; s[k] = s[k - 1]; s[k - 1] = t }
                }
                function median() { return (s[int((NR + 1) / 2)] + s[int((NR + 2) / 2)]) / 2 }
                NF != 5 { print "animation.sh: no figures in: " $0 >"/dev/stderr"; failed = 1; exit }
                { for (i = 2; i <= 5; i++) value[NR, i] = $i == "null" ? 999 : $i + 0; frame[NR] = $1 }
                END {
                    if (failed || !NR) exit 1
                    for (i = 1; i <= NR; i++) if (!worst || value[i, 4] < value[worst, 4]) worst = i
                    sorted(2); printf "| %s | %d | %s | %.4f, %.4f, %.4f |", scene, NR, preset, s[1], median(), s[NR]
                    sorted(3); printf " %.4f |", s[1]
                    sorted(4); printf " %.1f, %.1f, %.1f |", s[1], median(), s[NR]
                    sorted(5); printf " %.4f, %.4f | %d |\n", median(), s[NR], frame[worst]
                }' "$work/rows"
        done
    done
} >"$work/table"
awk -v file="$work/table" '
    $0 == "<!-- generated: animation -->" { print; while ((getline line < file) > 0) print line; skip = 1; next }
    $0 == "<!-- end -->" { skip = 0 }
    !skip { print }' "$out/ACCURACY.md" >"$work/next"
cp "$work/next" "$out/ACCURACY.md"
