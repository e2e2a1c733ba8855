#!/bin/sh
# Regenerates the parts of docs/ between "<!-- generated: NAME -->" and "<!-- end -->". usage: generate.sh TOOL [OUT_DIR]
# The gallery is made as a whole, by gallery.sh; data/BAKE.md by bake.sh; data/TRADE.md by trade.sh, which takes minutes and so is left out with OUT_DIR. With OUT_DIR the documents are written there instead of in place: the test compares the two.
set -e
tool=$1 out=${2:-docs}
build=$(dirname "$tool")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

replace() { # replace DOCUMENT NAME FILE
    awk -v name="$2" -v file="$3" '
        $0 == "<!-- generated: " name " -->" { print; while ((getline line < file) > 0) print line; skip = 1; next }
        $0 == "<!-- end -->" { skip = 0 }
        !skip { print }' "$out/$1" >"$work/next"
    cp "$work/next" "$out/$1"
}

[ "$out" = docs ] || { mkdir -p "$out/data" && cp docs/*.md "$out/" && cp docs/data/*.md "$out/data/"; }
"$tool" knobs >"$work/knobs"
replace CONFIGURATION.md knobs "$work/knobs"
"$build/test_stages" --table >"$work/stages"
replace data/BOUNDS.md stages "$work/stages"
for name in casters radiance punctual; do
    "$build/test_$name" --table >"$work/$name"
    replace data/BOUNDS.md $name "$work/$name"
done
"$build/test_accuracy" --table >"$work/accuracy"
replace ACCURACY.md accuracy "$work/accuracy"
if [ -n "$MODELS" ]; then # meshes that are not the project's
    "$build/test_accuracy" --models --table >"$work/models"
    replace data/ACCURACY.md models "$work/models"
fi
sh docs/animation.sh "$tool" "$out"
sh tests/oracle/test_compact.sh --table >"$work/compact"
replace ACCURACY.md compact "$work/compact"
"$build/test_bias" --table >"$work/bias"
replace data/BIAS.md bias "$work/bias"
"$build/test_census" --table >"$work/census"
replace data/BIAS.md census "$work/census"
"$build/test_contact" --table >"$work/contact"
replace data/BIAS.md contact "$work/contact"
mkdir -p "$out/pictures"
"$build/test_census" --plots "$out/pictures"
sh docs/frame.sh "$out/pictures/frame.svg"
sh docs/window.sh "$out/pictures/window.svg"
sh docs/cascades.sh "$out/pictures/cascades.svg"
sh docs/edges.sh "$tool" "$out"
"$tool" render host/scenes/sundial.gltf -o "$out/pictures/day.png" --size 240x180 --set output=rgb565 --frames 30-89 >/dev/null # 08:30 to 13:25
sh docs/gallery.sh "$tool" "$out"
sh docs/features.sh "$out"
sh docs/testing.sh "$out"
sh docs/boards.sh "$out"
sh docs/bake.sh "$tool" "$out"
for part in extremes extremes_light extremes_many; do "$build/test_$part" --table; done >"$work/extremes"
replace data/EXTREMES.md extremes "$work/extremes"
for name in rows seams crawl circle flicker; do
    "$build/test_$name" --table >"$work/$name"
    replace data/ACCURACY.md $name "$work/$name"
done
for name in kept culling lists changes; do "$build/test_$name"; done | sed -n 's/^[a-z].* \(per frame\|left out\|listed\|differ\).*/- &/p' >"$work/kept"
replace data/ACCURACY.md kept "$work/kept"
sh docs/displays.sh "$out" "$work/displays"
replace FIRMWARE.md displays "$work/displays"
if [ "$out" = docs ]; then
    sh docs/words.sh >"$work/words" && replace data/WORDS.md words "$work/words"
    sh docs/trade.sh "$tool"
    sh docs/porting.sh
    # from the committed baselines: make bench, size and matrix measure them
    sh tests/bench/bench.sh --document
    sh tests/bench/bench_target.sh --document
    sh tests/firmware/size.sh --document
    sh docs/matrix.sh --document
fi
