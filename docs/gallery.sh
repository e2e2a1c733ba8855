#!/bin/sh
# Makes docs/GALLERY.md and docs/pictures/gallery/*.png from docs/gallery.txt. usage: gallery.sh TOOL [OUT_DIR]
set -e
tool=$1 out=${2:-docs}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/pictures"

scene_path() { if [ -f "docs/scenes/$1.gltf" ]; then echo "docs/scenes/$1.gltf"; else echo "host/scenes/$1.gltf"; fi; }

# field NAME FILE: a number of a JSON object on one line, outside its lists
field() { sed 's/\[[^]]*\]//g' "$2" | sed -n "s/.*\"$1\": \([-+.0-9a-z]*\).*/\1/p"; }
percent() { field "$1" "$work/json" | awk '{ printf "%.2f %%", 100 * $1 }'; }

# picture NAME SCENE ARGUMENTS...: the picture; its command and its metrics in $work
picture() {
    name=$1 scene=$(scene_path "$2")
    shift 2
    case " $* " in *" --size "*) ;; *) set -- "$@" --size 240x180 ;; esac
    # shellcheck disable=SC2086
    "$tool" compare "$scene" "$@" $GALLERY_SET --json -o "$work/one" >"$work/json"
    mv "$work/one/beside.png" "$work/pictures/$name.png"
    echo "gnomon compare $scene $* -o DIR" >"$work/command"
    psnr=$(field psnr_db "$work/json")
    case $psnr in null) psnr=infinite ;; *) psnr=$(printf '%.1f dB' "$psnr") ;; esac
    echo "identical $(percent identical), PSNR $psnr, shadow mismatch $(percent shadow_mismatch)" >"$work/metrics"
}

# drawn NAME APP SCENE FLAGS...: what a program of boards/apps makes of a compiled scene
drawn() {
    name=$1 app=$2 scene=$(scene_path "$3")
    shift 3
    make -s --no-print-directory emulate BOARD=host APP="$app" SCENE="$scene" SCENE_FLAGS="$*" \
        ARGS="$work/strips" >"$work/log" 2>&1 && make -s --no-print-directory build/rgb565_png >>"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
    build/rgb565_png 320 240 "$work/pictures/$name.png" <"$work/strips"
    echo "make emulate BOARD=host APP=$app SCENE=$scene SCENE_FLAGS=\"$*\" ARGS=$app.rgb565" >"$work/command"
    echo "boards/apps/$app.c" >"$work/metrics"
}

# numbers FIELDS SCENE ARGUMENTS...: of gnomon info, which has no views
numbers() {
    fields=$1 scene=$(scene_path "$2")
    shift 2
    n=$#
    while [ "$n" -gt 0 ]; do
        case $1 in
        --view | --light) shift 2 && n=$((n - 2)) ;;
        *) set -- "$@" "$1" && shift && n=$((n - 1)) ;;
        esac
    done
    case " $* " in *" --size "*) ;; *) set -- "$@" --size 240x180 ;; esac
    "$tool" info "$scene" "$@" --json >"$work/info"
    for name in $fields; do printf ', %s %s' "$(echo "$name" | tr _ ' ')" "$(field "$name" "$work/info")"; done
}

cat >"$work/GALLERY.md" <<'TEXT'
# Gallery

What Gnomon can do, feature by feature. Each picture is drawn by the library, by the double-precision reference, and as their difference, eight times as strong. The numbers below it: pixels that are identical as RGB565, PSNR of the 8-bit colours, and how many surface points have a light's attenuation off by more than 1/16.

[data/FEATURES.md](data/FEATURES.md) names settings, code and test of each feature, [data/MATRIX.md](data/MATRIX.md) what it costs. `make docs` makes this page and its pictures from `docs/gallery.txt`.

| group | features |
| --- | --- |
TEXT
awk '
    BEGIN {
        split("D P A F B M R", order, " ")
        split("directional lights;spot and point lights;shadow atlases;filters;bias;materials, baked shadows, textures;rendering", title, ";")
    }
    /^## [A-Z][0-9]+ / {
        name = $0
        sub(/^## [A-Z0-9]+ /, "", name)
        group = substr($2, 1, 1)
        list[group] = list[group] (list[group] == "" ? "" : " · ") "[" name "](#" tolower($2) ")"
    }
    END { for (i = 1; i <= 7; i++) print "| " title[i] " | " list[order[i]] " |" }' docs/gallery.txt >>"$work/GALLERY.md"
row='' n=0 extra='' wanted=''
while IFS= read -r line; do
    text=${line#? }
    case $line in
    '## '*)
        text=${line#'## '}
        row=$(echo "${text%% *}" | tr A-Z a-z) n=0
        printf '\n<a id="%s"></a>\n\n## %s\n\n' "$row" "$text"
        ;;
    '* '*)
        n=$((n + 1)) wanted=$text extra=''
        picture "$row-$n" $wanted
        ;;
    '! '*)
        n=$((n + 1)) wanted='' extra=''
        drawn "$row-$n" $text
        ;;
    '= '*) extra=$(numbers "$text" $wanted) ;;
    '> '*)
        printf '\n%s\n\n![%s](pictures/gallery/%s.png)\n\n`%s`<br>\n%s%s\n' "$text" "$(echo "$row" | tr a-z A-Z)" "$row-$n" \
            "$(cat "$work/command")" "$(cat "$work/metrics")" "$extra"
        ;;
    *) [ -z "$row" ] || [ -z "$line" ] || echo "$line" ;;
    esac
done <docs/gallery.txt >>"$work/GALLERY.md"

mkdir -p "$out/pictures"
rm -rf "$out/pictures/gallery"
cp -R "$work/pictures" "$out/pictures/gallery"
cp "$work/GALLERY.md" "$out/GALLERY.md"
