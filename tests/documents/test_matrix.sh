#!/bin/sh
# docs/data/MATRIX.md is what its figures make it and has every feature; an image made for one scene leaves out what it should. usage: test_matrix.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh

sh docs/matrix.sh --tables >"$tmp/tables" 2>"$tmp/err" || fail "docs/matrix.sh: $(head -n 1 "$tmp/err")"
awk '$0 == "<!-- end -->" { on = 0 } on { print } $0 == "<!-- generated: matrix -->" { on = 1 }' docs/data/MATRIX.md | cmp -s - "$tmp/tables" && pass ||
    fail "docs/data/MATRIX.md is not what docs/matrix.txt makes it: sh docs/matrix.sh --document"
sh docs/matrix.sh --list >"$tmp/list"
for name in none all $(sed -n 's/^all-\(.*\) -D.*/\1/p' "$tmp/list" | cut -d ' ' -f 1); do
    case $name in none | all) wanted="^$name " ;; *) wanted="+$name " ;; esac
    grep -q -e "$wanted" "$tmp/list" && pass || fail "$name is not in the list of configurations"
done
for feature in $(sed -n '/GN_FEATURE_KNOBS/,$s/^    X(\([a-z_0-9]*\), .*/\1/p' lib/gn_knobs.h); do
    grep -q "^| \`$feature\` | " "$tmp/tables" && pass || fail "docs/data/MATRIX.md has no row of $feature: make matrix"
done

lacking=$(grep -c '^| `.*·' "$tmp/tables")
[ "$lacking" = 0 ] && pass || fail "docs/data/MATRIX.md lacks figures of $lacking features: make matrix"

for name in $(sed -n "s/^    {\"\([a-z0-9_]*\)\", \"[a-z0-9_]*\", .*/\1/p" boards/apps/features.c); do
    grep -q "^| $name | " "$tmp/tables" && pass || fail "docs/data/MATRIX.md has no row of boards/apps/features.c's $name: make matrix"
done
# Texels of 16 bits are no dearer than those of 32.
awk '$3 ~ /^ground_rg/ { n[$3] = $5 } END { exit !(n["ground_rgba8888"] && n["ground_rgb565"] <= n["ground_rgba8888"] && n["ground_rgb565a1"] <= n["ground_rgba8888"]) }' docs/matrix.txt && pass ||
    fail "docs/matrix.txt: textures of 16 bits take more instructions than those of 32"

# THOROUGH=1, three images of the largest kind: one directional light, where it is hardest (Cortex-M0, preset balanced): against the library that draws every scene at any setting, and against every feature at this scene's settings
if [ "$THOROUGH" ]; then
    sh docs/matrix.sh --scene "$tool" sundial Cortex-M0 >"$tmp/figures" 2>"$tmp/err"
    flash() { sed -n "s/^flash Cortex-M0 $1-sundial linked //p" "$tmp/figures"; }
    ram() { sed -n "s/^ram Cortex-M0 $1-sundial total //p" "$tmp/figures"; }
    own=$(flash own) full=$(flash full) any=$(flash any)
    if [ -n "$own" ] && [ $((100 * own)) -le $((60 * ${any:-0})) ]; then pass; else fail "sundial: $own bytes of flash are not 40 % less than $any: $(head -n 1 "$tmp/err")"; fi
    if [ -n "$own" ] && [ $((100 * own)) -le $((60 * ${full:-0})) ]; then pass; else fail "sundial: $own bytes of flash are not 40 % less than $full"; fi
    [ "$(ram own)" -lt "$(ram full)" ] && pass || fail "sundial: $(ram own) bytes of RAM are not less than $(ram full)"
fi

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
