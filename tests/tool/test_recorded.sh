#!/bin/sh
# gnomon config: a recorded program draws the same with its own configuration, and what that lacks is refused. The commands of
# docs/CONFIGURATION.md, with README's program. usage: test_recorded.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh

program=tests/tool/recorded_program.c
things=$(grep -o 'THING([a-z_]*)' $program | sed 's/.*(\(.*\))/\1/' | grep -v -x name)
[ "$(echo "$things" | wc -l)" -gt 30 ] && pass || fail "$(echo "$things" | wc -l) things are found in $program"

record="-Ilib -Ihost/record -DGN_USER_CONFIG=\"recording.h\""
gcc -std=c99 -Wall -Wextra -Werror $record -o "$tmp/record" $program host/record/recording.c >"$tmp/log" 2>&1 && pass || {
    echo "the recording: $(grep -m 1 'error\|undefined' "$tmp/log")"
    echo "$passed passed, 1 failed"
    exit 1
}
clang -std=c99 -w -O0 -Ilib -o "$tmp/full" $program lib/gnomon.c || fail "the program does not compile"

# build THING [OPTIONS...]: records it, and compiles the program with the configuration: $tmp/THING/run, once for all whose knobs are the same
build() {
    thing=$1
    shift
    mkdir -p "$tmp/$thing"
    (cd "$tmp/$thing" && ../record "$thing") >"$tmp/$thing/log" 2>&1 &&
        "$tool" config "$tmp/$thing/gnomon.log" -o "$tmp/$thing/own.h" "$@" >"$tmp/$thing/log" 2>&1 &&
        own=$tmp/own.$(sed 's|/[*].*||' "$tmp/$thing/own.h" | cksum | tr ' ' .) &&
        { [ -x "$own" ] || clang -std=c99 -w -O0 -Ilib -I"$tmp/$thing" -DGN_USER_CONFIG=\"own.h\" -o "$own" $program lib/gnomon.c 2>"$tmp/$thing/log"; } &&
        cp "$own" "$tmp/$thing/run"
}

# ---- Each thing with its own configuration -----------------------------------------------------------------------------------

for thing in $things; do "$tmp/full" "$thing" >"$tmp/$thing.full" || fail "$thing is refused by the whole library"; done
for thing in $things; do
    if ! build "$thing"; then fail "$thing: $(head -n 1 "$tmp/$thing/log")"; continue; fi
    "$tmp/$thing/run" "$thing" >"$tmp/out"
    cmp -s "$tmp/out" "$tmp/$thing.full" && pass || fail "$thing with its own configuration: $(cat "$tmp/out"), not $(cat "$tmp/$thing.full")"
done

# ---- Any thing with the configuration of another: the same picture, or an error -----------------------------------------------

for base in plain bare hard sharp stable unbiased point; do
    for thing in $things; do
        if "$tmp/$base/run" "$thing" >"$tmp/out"; then cmp -s "$tmp/out" "$tmp/$thing.full" && pass || fail "$thing with the configuration of $base: another picture"
        else grep -q '[a-z] [a-z]' "$tmp/out" && pass || fail "$thing with the configuration of $base: no text"; fi
    done
done

refused() { # refused BASE THING WORDS
    "$tmp/$1/run" "$2" >"$tmp/out" && fail "$2 is not refused with the configuration of $1" || { grep -q "$3" "$tmp/out" && pass || fail "$2 with the configuration of $1: $(cat "$tmp/out")"; }
}
refused bare plain 'a shadow that is not built in'
refused sharp plain 'shadow filter, one that is not built in'
refused stable plain 'tile sizes, refresh or list length, or one that is not built in'
refused unbiased plain 'a bias or a shadow that is not built in'
for thing in suns spot main_light; do refused plain $thing 'more lights than GN_MAX_LIGHTS'; done
refused plain point 'kind, mode or softness of light, or one that is not built in'
for thing in filter disk; do refused plain $thing 'shadow filter, one that is not built in'; done
refused plain soft 'kind, mode or softness of light, or one that is not built in'
for thing in cascades blend; do refused plain $thing 'more than 4 cascades'; done
for thing in alpha caster specular emissive glow; do refused plain $thing 'that is not built in'; done
for thing in textured grey levels; do refused plain $thing 'texture'; done
for thing in masked lit; do refused plain $thing 'masks or baked light where they are not built in'; done
for thing in receiver thin plane; do refused plain $thing 'a bias or a shadow that is not built in'; done
refused plain refresh 'refresh or list length, or one that is not built in'
for thing in normals colours; do refused plain $thing 'normals or colours that gnomon config left out'; done
refused plain skinned 'skin:'
for thing in gradient behind over; do refused plain $thing 'draw_behind or draw_over, which are not built in'; done
refused plain format 'pixel format or view, or one that is not built in'
refused plain orthographic 'half_height outside 1/256 .. 8192 units or not built in'
refused plain objects 'more objects than GN_MAX_OBJECTS'
refused plain wide 'above GN_MAX_WIDTH'

# what is set to less than was used is left out
build normals --set vertex_values=0 && "$tmp/normals/run" normals >"$tmp/out" && cmp -s "$tmp/out" "$tmp/plain.full" && pass || fail "normals left out: $(cat "$tmp/out" "$tmp/normals/log")"
build objects --set max_objects=1 && refused objects objects 'more objects than GN_MAX_OBJECTS'

# ---- Errors -------------------------------------------------------------------------------------------------------------------

log=$tmp/plain/gnomon.log
wrong() { # wrong STATUS WORDS ARGUMENTS...
    expected=$1 words=$2
    shift 2
    "$tool" config "$@" >"$tmp/out" 2>"$tmp/err"
    status=$?
    [ $status = "$expected" ] && grep -q -e "$words" "$tmp/err" && [ ! -e "$tmp/no.h" ] && pass || fail "config $*: status $status, $(head -n 1 "$tmp/err")"
}
broken() { # broken WORDS SED: of a log that was changed
    sed "$2" "$log" >"$tmp/broken.log"
    wrong 1 "broken.log: $1" "$tmp/broken.log" -o "$tmp/no.h"
}
wrong 1 "No such file" "$tmp/none.log" -o "$tmp/no.h"
wrong 1 "not the log of a recorded program" README.md -o "$tmp/no.h"
wrong 2 "a log is missing" -o "$tmp/no.h"
wrong 2 "FILE.h is missing" "$log"
wrong 2 "must end in .h" "$log" -o "$tmp/no.c"
wrong 2 "does not use --size" "$log" -o "$tmp/no.h" --size 8x8
wrong 1 "no.h: " "$log" -o "$tmp/none/no.h"
wrong 1 "not a knob" "$log" -o "$tmp/no.h" --set preset=tiny
wrong 1 "not a knob" "$log" -o "$tmp/no.h" --set shadows
wrong 1 "setting 'shadows': '9' is not" "$log" -o "$tmp/no.h" --set shadows=9
broken "another version of the library" '1s/$/9/'
broken "line 2: there is no preset 7" '2s/2 2/2 7/'
broken "the preset is missing" 2d
broken "line 4: setting 'persp_step': '5' is not 1, 4, 8 or 16" '4s/8 8/5 5/'
broken "line 4: setting 'persp_step': 'x' is not" '4s/8 8/8 x/'
broken "line 4: not a knob, two numbers and a reason" '4s/ 8.*/ 8/'
broken "line 4: not a knob, two numbers and a reason" '4s/.*//'
broken "line 4: this version has no knob 'tile_lights'" '4s/persp_step/tile_lights/'
broken "line 4: 'subpixel_bits' is there twice" '4s/.*/subpixel_bits 7 7 again/'
broken "the knob 'persp_step' is missing" 4d
broken "its end is missing" '$d'
broken 'line [0-9]*: not a knob, two numbers and a reason' '$s/[0-9]*$/none/'

# text of a log cannot end the comment that it stands in
sed 's|nothing uses it|*/ #error|' "$log" >"$tmp/odd.log"
"$tool" config "$tmp/odd.log" -o "$tmp/plain/own.h" >"$tmp/log" 2>&1 && clang -w -fsyntax-only -Ilib -I"$tmp/plain" -DGN_USER_CONFIG=\"own.h\" lib/gnomon.c 2>"$tmp/err" && pass || fail "odd text: $(head -n 1 "$tmp/err")"

# ---- The document's commands, with README's program ----------------------------------------------------------------------------

mkdir -p "$tmp/work/build"
for folder in lib host; do ln -s "$PWD/$folder" "$tmp/work/$folder"; done
ln -s "$(realpath "$tool")" "$tmp/work/build/gnomon"
awk '/^```c$/ { inside = 1; text = ""; next } /^```/ { if (inside && text ~ /gnomon\.h/) { printf "%s", text; exit } inside = 0 }
    inside { text = text $0 "\n" }' README.md |
    sed 's|^    (void)pixels;.*|    for (int i = 0; i < w * h; i++) printf("%04x", ((const uint16_t *)pixels)[i]);|' >"$tmp/work/program.c"
grep -q '%04x' "$tmp/work/program.c" && pass || fail "README's program has no pixels"
commands=$(awk '/^## / { inside = /^## A program of your own/ } inside && /^```$/ { shown = 0 } inside && shown { print } inside && /^```sh$/ { shown = 1 }' docs/CONFIGURATION.md)
[ "$(echo "$commands" | wc -l)" = 3 ] && pass || fail "docs/CONFIGURATION.md has these commands for a program of one's own: $commands"
(cd "$tmp/work" && PATH=$PATH sh -e -c "cc -Ilib program.c lib/gnomon.c -o full && ./full >full.out
$commands" >log 2>&1 && ./program >own.out) && cmp -s "$tmp/work/full.out" "$tmp/work/own.out" && pass || fail "the document's commands: $(tail -n 1 "$tmp/work/log")"
[ "$(wc -c <"$tmp/work/own.out")" -gt 300000 ] && pass || fail "README's program has printed $(wc -c <"$tmp/work/own.out") bytes"

# flash on a Cortex-M3 with -Os of the library as README's program links it: what the document says
m3="-mcpu=cortex-m3 -mthumb -std=c99 -Os -ffunction-sections -fdata-sections -Ilib"
flash() { # flash FLAGS...
    arm-none-eabi-gcc $m3 "$@" -c lib/gnomon.c -o "$tmp/lib.o" && arm-none-eabi-gcc $m3 "$@" -c "$tmp/work/program.c" -o "$tmp/program.o" &&
        arm-none-eabi-gcc -mcpu=cortex-m3 -mthumb -nostdlib -nostartfiles -Wl,--gc-sections,-e,main,--unresolved-symbols=ignore-all -Wl,--no-warn-rwx-segments \
            -o "$tmp/image" "$tmp/program.o" "$tmp/lib.o" -lgcc && arm-none-eabi-size "$tmp/image" | awk 'NR == 2 { print $1 }'
}
says() { # says WHAT FLASH: the row of the document, within 1 %; README has it in KB
    said=$(sed -n "s/^| $1 | \([0-9]*\) |.*/\1/p" docs/CONFIGURATION.md)
    [ "$said" ] && [ $((100 * $2)) -le $((101 * said)) ] && [ $((101 * $2)) -ge $((100 * said)) ] && pass || fail "$1: $2 bytes of flash, docs/CONFIGURATION.md says $said"
    sed -n "/#a-program-of-your-own/p" README.md | grep -q -w "$(((said + 500) / 1000)) KB" && pass || fail "$1: README does not say $said"
}
says "every feature" "$(flash)"
says "as recorded" "$(flash -I"$tmp/work" -DGN_USER_CONFIG=\"my_config.h\")"
program_with() { # program_with FLAGS...: records README's program with these
    (cd "$tmp/work" && gcc $record "$@" program.c host/record/recording.c -o recorded && ./recorded >log && build/gnomon config gnomon.log -o my_config.h) >"$tmp/log" || fail "with $*: $(tail -n 1 "$tmp/log")"
}
program_with -DGN_PRESET=GN_PRESET_ACCURATE
says "as recorded with .-DGN_PRESET=GN_PRESET_ACCURATE." "$(flash -I"$tmp/work" -DGN_USER_CONFIG=\"my_config.h\")"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
