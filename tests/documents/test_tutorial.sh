#!/bin/sh
# docs/TUTORIAL.md: every command of it does what it should, in the document's order; the program is that of boards/apps. usage: test_tutorial.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh
export FW_OPT=-Og # images need not be fast
doc=docs/TUTORIAL.md

block() { awk -v kind="$1" '$0 == "```" { on = 0 } on { print } $0 == "```" kind { on = 1 }' "$doc"; } # block sh|c

# The commands, into a folder of the test's own; the tool is there already. After each, its line and its status.
block sh | sed -e "s|^out=build/tutorial\$|out=$tmp/out|" -e "s|^build/gnomon |$tool |" -e '/^make$/d' |
    awk '/^[a-z]*=/ { print; next } { line = $0; gsub(/\047/, "\047\\\047\047", line); print "{ " $0 "\n} >>\"$log\" 2>&1 </dev/null; echo $? \047" line "\047" }' >"$tmp/commands"
log="$tmp/log" sh -u "$tmp/commands" >"$tmp/statuses" 2>&1
while read -r status line; do
    [ "$status" = 0 ] && pass || fail "status $status: $line: $(tail -n 1 "$tmp/log")"
done <"$tmp/statuses"

[ "$(wc -l <"$tmp/statuses")" -gt 20 ] && pass || fail "$doc has $(wc -l <"$tmp/statuses") commands"
for command in info render compare advise bake compile; do
    grep -q "^0 .*gnomon $command " "$tmp/statuses" || [ "$tool" != build/gnomon ] && pass || fail "$doc does not show gnomon $command"
done
# what the text says of their output
says() { grep -q -e "$1" "$tmp/log" && pass || fail "no command says: $1"; }
says 'fits lm3s6965evb: '
says 'does not fit microbit: .*nearest that does: --set ' # in the picture's size
says 'fits microbit: '
says '^RAM [0-9]* bytes'
says '^--set '
[ "$(wc -c <"$tmp/out/pixels")" = $((3 * 2 * 160 * 120)) ] && pass || fail "the board did not send three frames"
for file in first.png beside.png baked.png frames.png small.png sundial/scene.c sundial/scene.h sundial/gn_scene_config.h; do
    [ -s "$tmp/out/$file" ] && pass || fail "$file was not made"
done
cmp -s "$tmp/out/board.png" "$tmp/out/small.png" && fail "two scenes look the same" || pass

block c >"$tmp/program.c"
sed -n '/^#include/,$p' boards/apps/stream.c | cmp -s - "$tmp/program.c" && pass || fail "$doc does not show boards/apps/stream.c as it is"
[ "$(wc -l <"$tmp/program.c")" -le 40 ] && pass || fail "the program has $(wc -l <"$tmp/program.c") lines"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
