#!/bin/sh
# Writes docs/data/MATRIX.md: what each feature costs in flash, RAM, stack and instructions, on a Cortex-M0 and a Cortex-M4; and images of the own scenes,
# made for them, beside the full library on the same scene. Takes minutes.
#   sh docs/matrix.sh TOOL            measures, and writes docs/matrix.txt and docs/data/MATRIX.md
#   sh docs/matrix.sh --tables        prints the tables of what docs/matrix.txt has; --document writes them into docs/data/MATRIX.md
#   sh docs/matrix.sh --scene TOOL SCENE CORE    measures the images of one scene
#   sh docs/matrix.sh --list          the configurations: NAME FLAGS..., features alone and all
set -eu
cd "$(dirname "$0")/.."
FIGURES=docs/matrix.txt
DOC=docs/data/MATRIX.md
CORES="Cortex-M0 Cortex-M4"
SCENES="sundial avenue desk room fence mixed near sundial@accurate"
mkdir -p build/tmp
work=$(mktemp -d build/tmp/matrix.XXXXXX)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM

# ---- Configurations -----------------------------------------------------------------------------------------------------------

features=$(sed -n '/GN_FEATURE_KNOBS/,$s/^    X([a-z_0-9]*, \([A-Z_0-9]*\), .*/\1/p' lib/gn_knobs.h)
most() {
    case $1 in
    SHADOWS) echo 6 ;;
    VERTEX_JOINTS) echo 4 ;;
    TEXTURE_FORMATS) echo 2047 ;;
    MANY_CASCADES | BIASES | OTHER_LIGHTS | VERTEX_VALUES) echo 3 ;;
    PICTURES) echo 7 ;;
    MATERIALS) echo 15 ;;
    INCREMENTAL) echo 3 ;;
    TILE_SIZES | CLIPPING) echo 2 ;;
    *) echo 1 ;;
    esac
}
# Formats of textures, in the order of gn_scene_types.h
FORMATS="RGBA8888 RGB565 RGB565A1 PALETTE8 PALETTE4 PALETTE1 GREY8 GREY4 ALPHA8 ALPHA4"
# base FEATURE: what must be built for it to have something to do
base() {
    case $1 in
    SHADOWS | OTHER_LIGHTS | TEXTURE_FORMATS | MATERIALS | VERTEX_* | VALIDATION | PICTURES | CLIPPING) echo none ;;
    *) echo shadows ;;
    esac
}
set_of() { # every feature off, but for what $work/on says
    { for feature in $features; do echo "$feature=0"; done; cat "$work/on"; } |
        awk -F= '!($1 in at) { at[$1] = ++n } { v[at[$1]] = $0 } END { for (i = 1; i <= n; i++) print "-DGN_" v[i] }' | paste -s -d" "
}
with() { printf '%s\n' "$@" >"$work/on"; set_of; }
without() { for feature in $features; do if [ "$feature" = "$1" ]; then echo "-DGN_$feature=0"; else echo "-DGN_$feature=$(most "$feature")"; fi; done | paste -s -d' '; }
configurations() {
    echo "none $(with SHADOWS=0)"
    echo "shadows $(with SHADOWS=1)"
    echo "lights $(with OTHER_LIGHTS=1)"
    echo "filters $(with SHADOWS=5)"
    echo "textures $(with TEXTURE_FORMATS=1)"
    echo "shadows+lights $(with SHADOWS=1 OTHER_LIGHTS=1)"
    echo "all $(without nothing)"
    bit=1
    for format in $FORMATS; do
        [ $bit = 1 ] || echo "textures+$format $(with TEXTURE_FORMATS=$((1 + bit)))"
        bit=$((2 * bit))
    done
    for feature in $features; do
        value=$(most "$feature")
        case $(base "$feature") in
        none) echo "none+$feature $(with "$feature=$value")" ;;
        lights) echo "lights+$feature $(with OTHER_LIGHTS=1 "$feature=$value")" ;;
        filters) echo "filters+$feature $(with SHADOWS=5 "$feature=$value")" ;;
        shadows) echo "shadows+$feature $(with SHADOWS=1 "$feature=$value")" ;;
        esac
        echo "all-$feature $(without "$feature")"
    done
}

# scene NAME[@PRESET]: its own configuration; "full": every feature, settings and capacities as the scene has them; "any": quality knobs as data too
scene() {
    preset=balanced
    case $1 in *@*) preset=${1#*@} ;; esac
    file=host/scenes/${1%@*}.gltf
    [ -e "$file" ] || file=docs/scenes/${1%@*}.gltf
    "$tool" compile "$file" -o "$work/own-$1" --size 160x120 --set output=rgb565 --set preset=$preset >"$work/log"
    "$tool" compile "$file" -o "$work/full-$1" --size 160x120 --set output=rgb565 --set preset=$preset --simplify none >"$work/log"
    for feature in $features; do
        value=$(most "$feature")
        [ $feature != INCREMENTAL ] || value=1 # 3: twice the RAM, of no use to most
        sed "s/^\(#define GN_$feature\)  *[0-9]*/\1 $value/" "$work/full-$1/gn_scene_config.h" >"$work/config.h"
        mv "$work/config.h" "$work/full-$1/gn_scene_config.h"
    done
    cp -r "$work/full-$1" "$work/any-$1"
    sed "s/^#define GN_SCENE_CONFIG_H/&\n#define GN_RUNTIME_KNOBS 1/" "$work/full-$1/gn_scene_config.h" >"$work/any-$1/gn_scene_config.h"
    for kind in own full any; do echo "$kind-$1 -I$work/$kind-$1 -DGN_USER_CONFIG=\"gn_scene_config.h\""; done
}
# data NAME: bytes of the scene in flash, and of what moves in RAM
data() {
    arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb -std=c99 -Os -ffreestanding -isystem boards/common/include -Ilib -I"$work/$1" \
        '-DGN_USER_CONFIG="gn_scene_config.h"' -c -o "$work/data.o" "$work/$1/scene.c"
    printf '#include "scene.h"\nextern scene_state s;\nscene_state s;\n' >"$work/state.c"
    arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb -std=c99 -ffreestanding -Ilib -I"$work/$1" '-DGN_USER_CONFIG="gn_scene_config.h"' -c -o "$work/state.o" "$work/state.c"
    echo "data both $1 flash $(arm-none-eabi-size "$work/data.o" | awk 'NR == 2 { print $1 }')"
    echo "data both $1 state $(arm-none-eabi-nm -S --radix=d "$work/state.o" | awk '{ print $2 + 0 }')"
}

# ---- Instructions -------------------------------------------------------------------------------------------------------------

# Lines "work Cortex-M4 CASE OVER N": instructions of a picture of boards/apps/features.c, one case of features at a time
instructions() {
    image=build/firmware/mps2-an386/features
    make -s firmware build/libstages.so BOARD=mps2-an386 APP=features >"$work/log" 2>&1
    begin=$(arm-none-eabi-nm "$image.elf" | awk '$3 == "gn_render" { print $1 }')
    make -s emulate BOARD=mps2-an386 APP=features 2>&1 | grep '^[a-z0-9_]* [a-z0-9_-]*$' >"$work/cases"
    while read -r name over; do
        make -s emulate BOARD=mps2-an386 APP=features ARGS="$name" \
            EMULATOR_FLAGS="-display none -monitor none -serial none -plugin $PWD/build/libstages.so,out=$work/stages,stage=$begin" >"$work/log" 2>&1 </dev/null
        awk -v of="work Cortex-M4 $name $over" '$2 == 1 && $3 { print of, $3; n++ } END { exit !n }' "$work/stages" || exit 1
    done <"$work/cases"
}

# ---- Documents ----------------------------------------------------------------------------------------------------------------

measure() {
    echo "# Written by sh docs/matrix.sh: bytes of the library, as tests/firmware/size.sh measures them."
    configurations >"$work/list"
    for name in $SCENES; do scene "$name"; done >>"$work/list"
    sh tests/firmware/size.sh --list "$work/list" $CORES >"$work/sizes"
    [ "$(grep -c "^flash" "$work/sizes")" = $((2 * $(wc -l <"$work/list"))) ] || exit 1
    awk '$1 == "flash" || ($1 == "ram" && $4 == "total") || ($1 == "stack" && $4 == "gn_render")' "$work/sizes"
    for name in $SCENES; do
        data "own-$name"
        data "full-$name"
    done
    instructions
}

tables() {
    awk -v features="$(echo $features)" -v scenes="$SCENES" -v formats="$FORMATS" '
        /^#/ { next }
        $1 == "work" { over[$3] = $4; work[$3] = $5; cases[++n_cases] = $3; next }
        { at[$1, $2, $3, ($1 == "data" ? $4 : "")] = $5 }
        function get(kind, core, name) { return at[kind, "Cortex-" core, name, ""] }
        function number(v) { return v == "" ? "·" : v }
        function minus(a, b) { return a == "" || b == "" ? "·" : a - b == 0 ? "0" : sprintf("%+d", a - b) }
        function row(name, title) {
            printf "| %s | %s | %s | %s | %s | %s |\n", title, number(get("flash", "M0", name)), number(get("flash", "M4", name)),
                number(get("ram", "M4", name)), number(get("stack", "M0", name)), number(get("stack", "M4", name))
        }
        function share(a, b) { return a == "" || b == "" ? "·" : sprintf("−%.1f %%", 100 * (1 - a / b)) }
        function alone(f,    b) {
            for (b = 1; b <= 4; b++) if (get("flash", "M4", base[b] "+" f) != "" || get("flash", "M0", base[b] "+" f) != "") return base[b]
            return "none"
        }
        END {
            split("none shadows lights filters", base, " ")
            head = "| configuration | flash, M0 | flash, M4 | RAM | stack, M0 | stack, M4 |\n| --- | --- | --- | --- | --- | --- |"
            print head
            row("none", "none")
            row("shadows", "`shadows` alone, hard")
            row("lights", "`other_lights` 1 alone")
            row("shadows+lights", "both")
            row("all", "all")
            n = split(scenes, scene, " ")
            for (i = 1; i <= n; i++) row("own-" scene[i], scene[i] ", its own")
            print "\n## What each feature costs\n"
            print "Bytes; *alone*: more than what it stands on (none of the features; `shadows`; `other_lights` 1; `shadows` 5); *of all*: what all of them take more than all but this.\n"
            print "| feature | alone, over | flash, M0 | flash, M4 | RAM | stack, M4 | of all: flash, M0 | flash, M4 | RAM | stack, M4 |"
            print "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
            n_features = split(features, feature, " ")
            for (i = 1; i <= n_features; i++) {
                f = feature[i]; b = alone(f)
                x = b "+" f; y = "all-" f
                printf "| `%s` | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", tolower(f), b == "lights" ? "punctual" : b,
                    minus(get("flash", "M0", x), get("flash", "M0", b)), minus(get("flash", "M4", x), get("flash", "M4", b)),
                    minus(get("ram", "M4", x), get("ram", "M4", b)), minus(get("stack", "M4", x), get("stack", "M4", b)),
                    minus(get("flash", "M0", "all"), get("flash", "M0", y)), minus(get("flash", "M4", "all"), get("flash", "M4", y)),
                    minus(get("ram", "M4", "all"), get("ram", "M4", y)), minus(get("stack", "M4", "all"), get("stack", "M4", y))
            }
            print "\n## What each format of textures costs\n"
            print "Bytes of flash more than RGBA8888 alone.\n"
            print "| format | M0 | M4 |\n| --- | --- | --- |"
            n_formats = split(formats, format, " ")
            for (i = 2; i <= n_formats; i++)
                printf "| %s | %s | %s |\n", format[i], minus(get("flash", "M0", "textures+" format[i]), get("flash", "M0", "textures")),
                    minus(get("flash", "M4", "textures+" format[i]), get("flash", "M4", "textures"))
            print "\n## What using it costs\n"
            print "Instructions of one picture of 160×120 pixels on Cortex-M4, -O2, every feature built in (`boards/apps/features.c`: a box, a ball and a ground), per picture pixel, shadow tiles included; what the case takes more than the one that it is over. *ground*: it alone fills the picture; its textures have about a texel per pixel, hardly one like the next, and are bilinear but for *nearest*.\n"
            print "| in use | over | instructions per pixel | more |"
            print "| --- | --- | --- | --- |"
            for (i = 1; i <= n_cases; i++) {
                c = cases[i]
                printf "| %s | %s | %.0f | %s |\n", c, over[c] == "-" ? "" : over[c], work[c] / 19200, over[c] == "-" ? "" : sprintf("%+.0f", (work[c] - work[over[c]]) / 19200)
            }
            print "\n## An image for one scene, and the full library\n"
            print "160×120 pixels, RGB565, preset balanced but for what says another, all frames. *Own*: `gnomon compile`. *Every feature*: the same settings and capacities, nothing left out of library or scene. *Any setting*: the quality knobs as data too (`GN_RUNTIME_KNOBS`), the library that draws every scene in every preset. Flash in bytes, library alone, and what the own image saves of each; data: `scene.c`.\n"
            print "| scene | core | own | every feature | saved | any setting | saved | data, own | data, all | RAM, own | RAM, every feature |"
            print "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
            for (i = 1; i <= n; i++) for (c = 1; c <= 2; c++) {
                core = c == 1 ? "M0" : "M4"; s = scene[i]
                own = get("flash", core, "own-" s); full = get("flash", core, "full-" s); any = get("flash", core, "any-" s)
                printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", s, core, number(own), number(full), share(own, full), number(any), share(own, any),
                    number(at["data", "both", "own-" s, "flash"]), number(at["data", "both", "full-" s, "flash"]),
                    number(get("ram", core, "own-" s)) , number(get("ram", core, "full-" s))
            }
        }' "$FIGURES"
}

document() {
    tables >"$work/tables"
    awk -v file="$work/tables" '
        $0 == "<!-- generated: matrix -->" { print; while ((getline line < file) > 0) print line; skip = 1; next }
        $0 == "<!-- end -->" { skip = 0 }
        !skip { print }' "$DOC" >"$work/doc"
    cp "$work/doc" "$DOC"
}

case ${1:-} in
--list) configurations ;;
--tables) tables ;;
--document) document ;;
--scene) # figures of one scene's images on one core: TOOL SCENE CORE
    tool=$2
    scene "$3" >"$work/list"
    sh tests/firmware/size.sh --list "$work/list" "$4" ;;
*)
    tool=${1:?usage: matrix.sh TOOL}
    measure >"$work/figures"
    cp "$work/figures" "$FIGURES"
    document ;;
esac
