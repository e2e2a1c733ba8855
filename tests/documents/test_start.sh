#!/bin/sh
# docs/START.md: every command of it does what it should, in a copy of the project, where it makes a board and an app of its own.
# usage: test_start.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh

# Objects that are there need not be compiled again; images need not be fast.
tree=$tmp/tree
mkdir -p "$tree/build"
cp -pR Makefile lib host boards port docs "$tree"
cp -al build/obj "$tree/build/" && cp -p "$tool" "$tree/build/gnomon"
export FW_OPT=-Og

block() { awk -v kind="$1" '$0 == "```" { on = 0 } on { print } $0 == "```" kind { on = 1 }' docs/START.md; } # block sh|c
block c >"$tree/boards/apps/mine.c"
block sh >"$tmp/commands"
[ "$(grep -c . "$tmp/commands")" -gt 50 ] && pass || fail "docs/START.md has $(grep -c . "$tmp/commands") lines of commands"
if (cd "$tree" && sh -eux ../commands) >"$tmp/log" 2>&1 </dev/null; then pass
else fail "a command fails: $(grep '^+' "$tmp/log" | tail -n 1): $(tail -n 1 "$tmp/log")"; fi

# what the text says of their output
says() { grep -q -e "$1" "$tmp/log" && pass || fail "no command says: $1"; }
says 'added: ground, camera, light'
says '^      bias: set by hand, bias_normal 1, bias_constant 24; automatic alone: --set bias_constant@0=0 --set auto_bias@0=depth$'
says '^      bias: automatic$'
says 'does not fit that: .*nearest that does: '
says '^  fits that: .* of flash (Cortex-M0, -O2) of 131072$'
says '^  fits mine: '
says '^--set '
says '^ok$'
[ "$(grep '^[0-9a-f]* frame 0\|crc\|^[0-9A-F]* frame' "$tmp/log" | grep -v '^+' | sort | uniq -c | awk '{ print $1 }')" = 2 ] && pass || fail "board and host print other CRCs: $(grep frame "$tmp/log" | tail -n 2)"
psnr() { grep -A 30 "+ .*-o build/start/$1 " "$tmp/log" | grep -A 3 'reference against truth' | sed -n 's/^  PSNR (8-bit) *\([0-9.]*\) .*/\1/p' | head -n 1; }
awk -v good="$(psnr good)" -v bad="$(psnr bad)" 'BEGIN { exit !(bad > 0 && good > bad + 3) }' && pass || fail "against exact shadows $(psnr bad) dB with the bias, $(psnr good) dB without"
for file in sundial house other fit panel compare/beside bad/beside good/beside; do
    [ -s "$tree/build/start/$file.png" ] && pass || fail "$file.png was not made"
done

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
