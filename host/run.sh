#!/bin/sh
# Renders scenes with the library (presets fast, balanced and accurate) and the reference, compares them, and prints a table.
# usage: run.sh TOOL WxH OUT SCENE...      leaves OUT/<scene>/<preset>.json and OUT/<scene>/<preset>/{fixed,reference,error}.png
tool=$1 size=$2 out=$3
shift 3
number() { # number NAME JSON: the first value of that name
    printf '%s' "$2" | sed -n "s/.*\"$1\": *\([-0-9.e+null]*\).*/\1/p"
}
first() { # the value of a top-level name that also occurs deeper
    printf '%s' "$2" | sed "s/\"lights\".*//" | sed -n "s/.*\"$1\": *\([-0-9.e+null]*\).*/\1/p"
}
row() { # row NAME PRESET JSON
    printf '%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n' "$1" "$2" "$(number identical "$3")" "$(number within1 "$3")" \
        "$(number psnr_db "$3")" "$(number max_error "$3")" "$(first atten_rms "$3")" \
        "$(first shadow_mismatch "$3")" "$(number ram_bytes "$3")" |
        awk -F '\t' '{ printf "%-14s %-9s %11.4f %11.4f %9s %6d %10.6f %9.4f %9d\n", $1, $2, 100*$3, 100*$4, $5 == "null" ? "equal" : sprintf("%.2f", $5), $6, $7, 100*$8, $9 }'
}
# A folder's name for a scene that no earlier scene of this run has: the file's, with -2 and so on if need be.
taken='
'
distinct() {
    name=$(printf '%s' "$(basename -- "$1")" | tr '\t\n' '  ')
    wanted=$name n=1
    while case $taken in *"
$name
"*) true ;; *) false ;; esac do
        n=$((n + 1))
        name=$wanted-$n
    done
    taken="$taken$name
"
}

mkdir -p -- "$out" || exit 1
status=0
printf '%s, the library against double precision\n\n' "$size"
printf '%-14s %-9s %11s %11s %9s %6s %10s %9s %9s\n' scene preset 'identical %' 'within 1 %' 'PSNR dB' 'worst' 'atten RMS' 'shadow %' 'RAM bytes'
for scene in "$@"; do
    case $scene in -*) scene=./$scene ;; esac # not an option
    distinct "$scene"
    folder=$out/$name said=
    mkdir -p -- "$folder" || exit 1
    for preset in fast balanced accurate; do
        if error=$("$tool" compare "$scene" --json --size "$size" --set preset=$preset -o "$folder/$preset" 2>&1 >"$folder/$preset.json"); then
            row "$name" "$preset" "$(cat "$folder/$preset.json")"
        else
            status=1
            rm -f "$folder/$preset.json"
            [ "$error" = "$said" ] || printf '%s\n' "$error" >&2 # once if the presets fail alike
            said=$error
        fi
    done
done
printf '\nidentical: equal RGB565; within 1: every channel within one RGB565 step; worst: largest 8-bit channel error;\n'
printf 'shadow: attenuation off by more than 1/16. Pictures: %s/<scene>/<preset>/{fixed,reference,error}.png\n' "$out"
exit $status
