#!/bin/sh
# Makes the generated part of docs/data/BAKE.md and its pictures. usage: bake.sh TOOL [OUT_DIR]
set -e
tool=$1 out=${2:-docs}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out/pictures" "$out/data"
[ "$out" = docs ] || cp docs/data/BAKE.md "$out/data/"

# field NAME, of maps or masks: NAME@OBJECT; of $work/json
field() {
    case $1 in
    *@*) sed -n "s/.*\"${1#*@}\": {[^}]*\"${1%@*}\": \([-+.0-9a-z]*\).*/\1/p" "$work/json" ;;
    *) sed -n "s/.*\"$1\": \([-+.0-9a-z]*\).*/\1/p" "$work/json" ;;
    esac
}
row() { # row SCENE LABEL, of maps or masks: OBJECT
    echo "$(field "psnr_db@$2") $(field "atten_rms@$2") $(field "shadow_mismatch@$2") $(field "ram_bytes@$2") $(field "instructions_per_pixel@$2") $3" |
        awk -v scene="$1" '{ printf "| %s | %s | %.2f | %.4f | %.2f %% | %d | %d | %d |\n", scene, $7 == "" ? "shadow maps" : "masks, " $7, $1, $2, 100 * $3, $6, $4, $5 }'
}
{
    echo
    echo "| scene | shadows | PSNR, dB | attenuation, RMS error | shadow mismatch | flash of masks, bytes | RAM, bytes | instructions per pixel |"
    echo "|---|---|---|---|---|---|---|---|"
    for name in sundial avenue desk room fence mixed; do
        first=1
        case $name in avenue) sizes="0 256 512 1024" ;; *) sizes="0 256 512" ;; esac
        for texels in $sizes; do
            "$tool" bake host/scenes/$name.gltf -o "$work/$name.gltf" --still --texels $texels --json >"$work/json"
            [ $first = 0 ] || row $name maps 0
            first=0
            label=$texels
            [ $texels != 0 ] || label=vertices
            row $name masks "$(field mask_bytes) $label"
        done
    done
    echo
} >"$work/table"
awk -v file="$work/table" '
    $0 == "<!-- generated: bake -->" { print; while ((getline line < file) > 0) print line; skip = 1; next }
    $0 == "<!-- end -->" { skip = 0 }
    !skip { print }' "$out/data/BAKE.md" >"$work/next"
cp "$work/next" "$out/data/BAKE.md"

"$tool" render host/scenes/room.gltf -o "$out/pictures/bake-maps.png"
"$tool" render "$work/room.gltf" -o "$out/pictures/bake-masks.png"
"$tool" render host/scenes/room.gltf --engine truth -o "$out/pictures/bake-truth.png"
