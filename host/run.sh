#!/bin/sh
# Renders scenes with the library (presets accurate and balanced) and the reference, compares them, and prints a table.
# usage: run.sh TOOL WxH OUT SCENE...      leaves OUT/<scene>/<preset>/{fixed,reference,error}.png
tool=$1 size=$2 out=$3
shift 3
number() { # number NAME JSON: the first value of that name
    printf '%s' "$2" | sed -n "s/.*\"$1\": *\([-0-9.e+null]*\).*/\1/p"
}
first() { # the value of a top-level name that also occurs deeper
    printf '%s' "$2" | sed "s/\"lights\".*//" | sed -n "s/.*\"$1\": *\([-0-9.e+null]*\).*/\1/p"
}
mkdir -p "$out" || exit 1
status=0
printf '%s, the library against double precision\n\n' "$size"
printf '%-14s %-9s %11s %11s %9s %6s %10s %9s %9s\n' scene preset 'identical %' 'within 1 %' 'PSNR dB' 'worst' 'atten RMS' 'shadow %' 'RAM bytes'
for scene in "$@"; do
    name=$(basename "$scene")
    for preset in accurate balanced; do
        mkdir -p "$out/$name" || exit 1
        if json=$("$tool" compare "$scene" --json --size "$size" --set preset=$preset -o "$out/$name/$preset"); then
            printf '%s %s %s %s %s %s %s %s %s\n' "$name" "$preset" "$(number identical "$json")" "$(number within1 "$json")" \
                "$(number psnr_db "$json")" "$(number max_error "$json")" "$(first atten_rms "$json")" \
                "$(first shadow_mismatch "$json")" "$(number ram_bytes "$json")" |
                awk '{ printf "%-14s %-9s %11.4f %11.4f %9s %6d %10.6f %9.4f %9d\n", $1, $2, 100*$3, 100*$4, $5 == "null" ? "equal" : sprintf("%.2f", $5), $6, $7, 100*$8, $9 }'
        else
            status=1
        fi
    done
done
printf '\nidentical: equal RGB565; within 1: every channel within one RGB565 step; worst: largest 8-bit channel error;\n'
printf 'shadow: attenuation off by more than 1/16. Pictures: %s/<scene>/<preset>/{fixed,reference,error}.png\n' "$out"
exit $status
