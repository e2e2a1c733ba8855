#!/bin/sh
# gnomon info on parts that people own: all of them are there, the estimate is near what the emulator counted, verdicts follow from memory, and a
# scene that cannot be compiled says why. usage: test_parts.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh
table=host/tool/cost/part_table.h

info() { timeout 120 "$tool" info "$@" >"$tmp/out" 2>"$tmp/err" </dev/null; }
# of FRAME NAME: a number of that frame's work; part NAME FIELD: a number of that part
of() { sed -n "s/.*\"$1\": {[^}]*\"$2\": \([0-9.]*\).*/\1/p" "$tmp/out"; }
part() { sed -n "s/.*{\"name\": \"$1\", \([^}]*}[^}]*\)}.*/\1/p" "$tmp/out" | sed -n "s/.*\"$2\": \([a-z0-9.]*\).*/\1/p"; }
holds() { awk "BEGIN { exit !($2) }" && pass || fail "$1: $2"; }

# ---- All parts -----------------------------------------------------------------------------------------------------------------

hound="tests/bench/scenes/hound.gltf --size 240x320 --set preset=fast"
sed -n 's/^PART("\([^"]*\)".*/\1/p' $table >"$tmp/parts"
[ "$(wc -l <"$tmp/parts")" = 11 ] && pass || fail "$table has $(wc -l <"$tmp/parts") parts"
info $hound && pass || fail "info of the hound: $(cat "$tmp/err")"
while read -r name; do
    grep -q -E "^    $name  *(Cortex|RV32|Xtensa).* [0-9.]+p?  *[0-9.]+p?  *[0-9.]+p?  *[0-9]+ of [0-9]+  *[0-9]+ of [0-9]+  *(fits|too much .*)$" "$tmp/out" && pass ||
        fail "info has no line of the $name: $(grep -m 1 "$name" "$tmp/out")"
done <"$tmp/parts"
grep -q '^    STM32F103 .* too much RAM and flash$' "$tmp/out" && grep -q '^    STM32H743 .* fits$' "$tmp/out" && pass || fail "verdicts: $(grep STM32 "$tmp/out")"

info $hound --json && pass || fail "info --json of the hound: $(cat "$tmp/err")"
while read -r name; do
    for field in mhz cores first animated still ram_bytes ram_of flash_bytes flash_of fits; do
        [ -n "$(part "$name" $field)" ] && pass || fail "info --json has no $field of the $name"
    done
done <"$tmp/parts"
# what tests/bench/calibrate.sh reads there: two numbers for each weight
DIR=$tmp
cp "$tmp/out" "$tmp/info"
eval "$(grep '^counts() ' tests/bench/calibrate.sh)"
weights=$(grep -c '^COST(' host/tool/cost/cost_table.h)
for frame in first animated; do [ "$(counts $frame | wc -w)" = $((2 * weights)) ] && pass || fail "calibrate.sh reads $(counts $frame | wc -w) counts of a frame that is $frame"; done
error=$(sed -n 's/.*"error_percent": \([0-9]*\).*/\1/p' "$tmp/out")
stated=$(sed -n 's/.*nine in ten within \([0-9.]*\) % .*/\1/p' docs/COST.md)
holds "COST.md states another error than $error %: $stated" "${stated:-0} > 0 && ${stated:-0} <= ${error:-0} && ${stated:-0} > ${error:-0} - 1"

# frames per second, from the instructions that info says and the table's figures
m3=$(of first instructions)
holds "one core" "($m3 * 1.4 / 64e6 * $(part nRF52840 first) - 1) ^ 2 < 1e-6"
holds "two cores" "$(part RP2040 cores) == 2 && $(part "RP2350 Arm" first) > 1.2 * 150e6 / ($m3 * 1.4) && $(part "RP2350 Arm" first) < 2 * 150e6 / ($m3 * 1.4)"
holds "shadow tiles that are kept" "$(of still instructions) < $(of animated instructions)"

# Only what changes is drawn and sent; in a still frame nothing
game="tests/bench/scenes/game.gltf --set incremental=3 --set fit=compiled"
info $game && grep -q -E '^    RP2040 .* [0-9.]+p?  +[0-9.]+p?  +idle ' "$tmp/out" && pass || fail "info of the game: $(cat "$tmp/err"; grep RP2040 "$tmp/out")"
info $game --json && pass || fail "info --json of the game: $(cat "$tmp/err")"
holds "what is sent" "$(of first sent) == 1 && $(of animated sent) > 0.05 && $(of animated sent) < 0.4 && $(of still sent) == 0"
[ -n "$(part RP2040 animated)" ] && [ -z "$(part RP2040 still)" ] && pass || fail "frames per second of a still frame: $(part RP2040 still)"
info tests/bench/scenes/gauge.gltf --set incremental=2 --set fit=compiled --json
counted=$(awk '$1 == "changes" && $3 == "gauge" { for (i = 5; i <= 12; i++) n[$4] += $i } END { print (n["later"] - n["first"]) / 4 }' tests/bench/bench_target_baseline.txt)
guess=$(of animated instructions)
holds "a later frame: the estimate $guess, counted $counted" "$guess > $counted * (1 - $error / 100) && $guess < $counted * (1 + $error / 100)"

# ---- The estimate and the emulator ---------------------------------------------------------------------------------------------

# near NAME SCENE BASELINE OPTION...: the estimate of a first frame, and what make bench counted on a Cortex-M3
near() {
    name=$1 scene=$2 line=$3
    shift 3
    counted=$(awk -v line="$line" 'index($0, line " ") == 1 { for (i = 5; i <= 12; i++) n += $i; print n }' tests/bench/bench_target_baseline.txt)
    info "$scene" "$@" --json
    guess=$(of first instructions)
    holds "$name: the estimate $guess is not within $error % of $counted" "${counted:-0} > 0 && ${guess:-0} > $counted * (1 - $error / 100) && ${guess:-0} < $counted * (1 + $error / 100)"
}
near hound tests/bench/scenes/hound.gltf "model M3 hound fast" --size 240x320 --set preset=fast
near walker tests/bench/scenes/walker.gltf "model M3 walker fast" --size 240x320 --set preset=fast
for scene in sundial desk room; do near $scene host/scenes/$scene.gltf "scene M3 $scene fast" --size 320x240 --set preset=fast; done

# ---- What is special -----------------------------------------------------------------------------------------------------------

# nothing moves: no animated frame. The panel of a fast part takes longer: 16 bits a pixel over its SPI
info docs/scenes/edge.gltf --size 96x64
grep -q -E '^    nRF52840 .* [0-9.]+  +-  +[0-9.]+p? ' "$tmp/out" && pass || fail "a scene in which nothing moves: $(grep nRF "$tmp/out")"
info docs/scenes/edge.gltf --size 96x64 --set shadows=0 --set preset=tiny --json
holds "the panel" "$(part STM32H743 first) <= 60e6 / (96 * 64 * 16) * 1.001"
# a grey display of 4 bits a pixel takes a quarter of that
info docs/scenes/edge.gltf --size 96x64 --set shadows=0 --set preset=tiny --set output=grey4 --json
holds "a grey panel" "$(part STM32H743 first) > 60e6 / (96 * 64 * 16) * 1.1 && $(part STM32H743 first) <= 60e6 / (96 * 64 * 4) * 1.001"
# what the second core draws in takes RAM: without it one core works
info docs/scenes/edge.gltf --size 96x64 --set atlas_size=256 --set fit=stable --set tiles=equal --set cascades=1 --json
holds "RAM of parts" "$(part RP2040 ram_bytes) > 131072 && $(part STM32F103 ram_bytes) > $(part STM32F103 ram_of)"
[ "$(part STM32F103 fits)" = false ] && [ "$(part STM32H743 fits)" = true ] && pass || fail "fits: F103 $(part STM32F103 fits), H743 $(part STM32H743 fits)"

# compact arithmetic counts nothing: no speed rather than the panel's
info host/scenes/sundial.gltf --size 64x48 --set compact=1
grep -q 'how fast compact arithmetic draws is not estimated' "$tmp/out" && grep -q '^    STM32H743 .* 480  *-  *-  *-  .* fits$' "$tmp/out" && pass || fail "compact arithmetic: $(grep H743 "$tmp/out")"
info host/scenes/sundial.gltf --size 64x48 --set compact=1 --json
grep -q '"fps": {}' "$tmp/out" && ! grep -q -e '"first": ' -e '"work"' "$tmp/out" && pass || fail "compact arithmetic, --json: $(tail -c 300 "$tmp/out")"

# what cannot be compiled says why, and what is no scene is an error of one line
info host/scenes/cube.gltf --size 32x24 --frames 0-20001
grep -q '^  on parts: .*more than 20000' "$tmp/out" && pass || fail "too many frames: $(grep 'on parts' "$tmp/out")"
info host/scenes/cube.gltf --size 32x24 --frames 0-20001 --json
grep -q '"no_parts": ".*more than 20000' "$tmp/out" && ! grep -q '"parts"' "$tmp/out" && pass || fail "too many frames, --json: $(tail -c 300 "$tmp/out")"
printf '{"asset": {"version": "2.0"}, "scenes": [{"nodes": [7]}]}' >"$tmp/broken.gltf"
info "$tmp/broken.gltf"
[ $? = 1 ] && [ "$(wc -l <"$tmp/err")" = 1 ] && [ ! -s "$tmp/out" ] && grep -q 'broken.gltf.*/scenes/0' "$tmp/err" && pass || fail "a broken file: $(cat "$tmp/err")"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
