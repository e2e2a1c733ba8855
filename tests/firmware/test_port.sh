#!/bin/sh
# Every port's kernels, on every emulated board and on the host, give the oracle's bits; a port that is wrong in one bit is found.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh

setting() { sed -n "s/^$2 := *//p" "boards/$1/board.mk"; }
# run NAME MAKE_ARGUMENTS...: what the comparison printed
run() {
    log=$tmp/$1
    shift
    make -s --no-print-directory emulate APP=port "$@" >"$log" 2>&1
}
found() { sed -n 's/^[0-9]* checked, \([0-9]*\) wrong$/\1/p' "$tmp/$1"; }
right() { # right NAME MAKE_ARGUMENTS...
    if run "$@" && [ "$(found "$1")" = 0 ] && [ "$(sed -n 's/^\([0-9]*\) checked.*/\1/p' "$tmp/$1")" -gt 80000 ]; then pass
    else fail "$*: $(grep -v '^  ' "$tmp/$1" | head -n 2 | tr '\n' ';')"; fi
}
# wrong NAME FILE SED: the template or a port with one bit changed
wrong() {
    name=$1 board=$2 ports=$3 file=$4 edit=$5
    first=${ports%% *}
    rm -rf "$tmp/wrong"
    mkdir -p "$tmp/wrong"
    for port in $ports; do cp port/"$port"/*.[ch] "$tmp/wrong/"; done
    mv "$tmp/wrong/gn_port_$first.h" "$tmp/wrong/gn_port_wrong.h"
    sed -i "s/\"gn_port_$first.h\"/\"gn_port_wrong.h\"/" "$tmp"/wrong/*.[ch]
    cp "$tmp/wrong/$file" "$tmp/before"
    sed -i "$edit" "$tmp/wrong/$file"
    if cmp -s "$tmp/before" "$tmp/wrong/$file"; then fail "$name: nothing was changed"; return; fi
    run "wrong-$name" BOARD="$board" "BOARD_PORT=../$tmp/wrong" IMAGE=port-wrong
    case $(found "wrong-$name") in
    '' | 0) fail "$name: a wrong port was not found: $(grep -v '^  ' "$tmp/wrong-$name" | head -n 2 | tr '\n' ';')" ;;
    *) pass ;;
    esac
}

right host BOARD=host BOARD_PORT=
right template BOARD=host BOARD_PORT=template IMAGE=port-template
right template-m32 BOARD=host BOARD_PORT=template IMAGE=port-template32 "BOARD_CPU=-m32" "BOARD_EMULATOR=$(sh tests/support/words32.sh)"
right portable BOARD=host BOARD_PORT=portable IMAGE=port-portable
ports=
for file in boards/*/board.mk; do
    board=$(basename "$(dirname "$file")")
    [ "$board" = host ] && continue
    ports="$ports $(setting "$board" BOARD_PORT)"
    [ "$(setting "$board" BOARD_RUNS)" = qemu ] && right "$board" BOARD="$board"
done
for folder in port/*/; do # none that no board has
    case " $ports template " in
    *" $(basename "$folder") "*) pass ;;
    *) fail "no board has the port $folder" ;;
    esac
done

# Hot functions go where the port says, each by itself, and nowhere else than others if it says nothing.
section=.time_critical.gnomon
sections() { gcc -std=c99 -O0 -ffunction-sections -Ilib -Iport -Iport/portable '-DGN_PORT="gn_port_portable.h"' "$@" -c lib/gnomon.c -o "$tmp/hot.o" && objdump -h "$tmp/hot.o" | awk '{ print $2 }' >"$tmp/sections"; }
sections "-DGN_PORT_HOT_SECTION=\"$section\"" && [ "$(grep -c "^$section\.[0-9]*$" "$tmp/sections")" -gt 50 ] && pass || fail "no hot functions in $section"
[ "$(grep "^$section\." "$tmp/sections" | sort | uniq -d | wc -l)" = 0 ] && pass || fail "two hot functions in one section"
sections && ! grep -q gnomon "$tmp/sections" && pass || fail "hot functions are placed, though no port says where"

# The recipe of docs/FIRMWARE.md, line by line, in a copy of the tree.
mkdir "$tmp/tree"
cp -r Makefile lib port boards host tests "$tmp/tree/"
sed -n '/^##* Write a port/,$s/^       \(cp\|mv\|sed\) /\1 /p' docs/FIRMWARE.md | sed 's/NAME/mine/g; s/GN_PORT_mine/GN_PORT_MINE/' >"$tmp/recipe"
[ "$(wc -l <"$tmp/recipe")" = 4 ] && pass || fail "docs/FIRMWARE.md has a recipe of $(wc -l <"$tmp/recipe") lines"
if (cd "$tmp/tree" && sh -e ../recipe) && make -s -C "$tmp/tree" --no-print-directory emulate BOARD=host APP=port BOARD_PORT=mine >"$tmp/mine" 2>&1 &&
    [ "$(found mine)" = 0 ]; then pass
else fail "the recipe of docs/FIRMWARE.md: $(grep -v '^  ' "$tmp/mine" | head -n 2 | tr '\n' ';')"; fi

wrong template host template gn_port_template.c 's/return any | all << 16;/return any | (all ^ (n == 6 \&\& dark[5] == 63)) << 16;/'
wrong template-edge host template gn_port_template.c 's/< (least + 0xFFFFU) >> 16/< least >> 16/'
wrong product nrf51-large armv6m gn_port_armv6m.c 's/"adcs r1, r2\\n"/"add r1, r2\\n"/'
wrong clear mps2-an385 armv7m gn_port_armv7m.c 's/"7: strb r1, \[ip\], #1\\n"/"7: strb r1, [ip], #2\\n"/'
wrong pair mps2-an386 'armv7em armv7m' gn_port_armv7em.c 's/"usub16 r6, r6, r2\\n"/"ssub16 r6, r6, r2\\n"/'
wrong vector mps3-an547 'helium armv7m' gn_port_helium.c 's/"vcmpt.u16 cs, q0, r2\\n"/"vcmpt.u16 hi, q0, r2\\n"/'

# It pays where multiplication is narrow.
for ports in "" armv6m; do
    make -s --no-print-directory emulate BOARD=microbit APP=pocket IMAGE=pocket-count "BOARD_PORT=$ports" COUNT=1 2>&1 | sed -n 's/^instructions //p'
done >"$tmp/count"
awk 'NR == 1 { without = $1 } END { exit !(NR == 2 && $1 < 0.92 * without) }' "$tmp/count" && pass || fail "instructions without and with the port of ARMv6-M: $(tr '
' ' ' <"$tmp/count")"

# The library's own definition is under the same test; the library with a port draws the golden frames in test_boards.sh.
grep -q 'gn_portable_dark_texels16(texel' boards/apps/port.c && pass || fail "boards/apps/port.c does not test the library's own kernel"
grep -l '__ARM\|__riscv\|__thumb' lib/*.[ch] | grep -v '^lib/base/gn_base_types.h$' >"$tmp/found"
if [ -s "$tmp/found" ]; then fail "lib/ asks for an architecture: $(tr '\n' ' ' <"$tmp/found")"; else pass; fi

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
