#!/bin/sh
# docs/TESTING.md: its tables are what docs/testing.sh makes, and every test that it names is there.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh

sh docs/testing.sh "$tmp" 2>"$tmp/err" && cmp -s "$tmp/TESTING.md" docs/TESTING.md && pass ||
    fail "docs/TESTING.md is not what docs/testing.sh makes, run it: $(diff docs/TESTING.md "$tmp/TESTING.md" | sed -n 2p; cat "$tmp/err")"
grep -o '`[^` ]*`' docs/TESTING.md | tr -d '`' | grep -E '^tests/.*[^/]$|^test_' | sort -u >"$tmp/names"
[ "$(wc -l <"$tmp/names")" -gt 20 ] && pass || fail "docs/TESTING.md names $(wc -l <"$tmp/names") tests"
while read -r name; do
    [ -n "$(find tests -path "*/$(basename "$name")")" ] && { [ "${name#tests/}" = "$name" ] || [ -e "$name" ]; } && pass || fail "docs/TESTING.md names $name"
done <"$tmp/names"
for folder in tests/*/; do # of programs or scripts
    name=$(basename "$folder")
    [ -z "$(find "$folder" -maxdepth 1 -name 'test_*')" ] || grep -q "^| \`$name/\` | ..* | [0-9]* | [0-9]* |\$" docs/TESTING.md && pass || fail "docs/TESTING.md does not say what $folder is"
done

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
