#!/bin/sh
# docs/data/FEATURES.md is what docs/features.sh makes of the tags in the code; every row has code, reference, settings, a
# test and pictures (docs/GALLERY.md); every picture is drawn again by both engines, which must agree.
# THOROUGH=1: pixel by pixel, too. usage: test_features.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh
features=docs/data/FEATURES.md gallery=docs/GALLERY.md

"$tool" knobs | sed -n 's/^| `\([a-z_0-9]*\)`.*/\1/p' >"$tmp/knobs"
[ "$(wc -l <"$tmp/knobs")" -gt 60 ] && pass || fail "gnomon knobs lists $(wc -l <"$tmp/knobs") names"

# identifiers PREFIX N
identifiers() { awk -v p="$1" -v n="$2" 'BEGIN { for (i = 1; i <= n; i++) print p i }'; }
{
    identifiers D 12
    identifiers P 10
    identifiers A 7
    identifiers F 7 | grep -v -x F6 # linear kernels: dearer than tents
    identifiers B 6
    identifiers M 11
    identifiers R 13 | grep -v -x R9 # lists of lights per screen tile are gone
} >"$tmp/rows"

# ---- The page and the tags -------------------------------------------------------------------------------------------

mkdir -p "$tmp/page"
if sh docs/features.sh "$tmp/page" >"$tmp/log" 2>&1 && cmp -s "$tmp/page/data/FEATURES.md" $features; then pass
else
    diff $features "$tmp/page/data/FEATURES.md" >"$tmp/diff" 2>&1
    fail "$features is not what docs/features.sh makes, run it: $(sed -n 2p "$tmp/diff")"
fi
sh docs/features.sh --tags >"$tmp/tags"
[ "$(wc -l <"$tmp/tags")" -gt 200 ] && pass || fail "$(wc -l <"$tmp/tags") tags are found"
awk 'NR == FNR { row[$1] = 1; next } !($1 in row)' "$tmp/rows" "$tmp/tags" >"$tmp/found"
[ -s "$tmp/found" ] && fail "tags of rows that are none: $(tr '\n' ';' <"$tmp/found")" || pass
for header in gnomon gn_config gn_knobs; do
    sed "s/Cortex-M[0-9]*//g" lib/$header.h | grep -w -n -F -f "$tmp/rows" | sed "s/^/$header.h:/"
done >"$tmp/found"
[ -s "$tmp/found" ] && fail "public headers name rows instead of things: $(tr '\n' ';' <"$tmp/found")" || pass

# ---- Row by row ------------------------------------------------------------------------------------------------------

# names CELL: what stands in backquotes
names() { echo "$1" | grep -o '`[^`]*`' | tr -d '`'; }
cell() { echo "$line" | awk -F' *[|] *' -v i="$1" '{ print $i }'; }
has_tag() { grep -q "^$1 $2/" "$tmp/tags"; } # has_tag ROW FOLDER

# settings ROW CELL: knobs, and after "file:" keys of the loader
settings() {
    [ -n "$(names "$2")" ] && pass || fail "$1 names no setting"
    for name in $(names "${2%%file:*}"); do
        grep -q -x -e "$name" "$tmp/knobs" && pass ||
            fail "$1 names the setting $name, which 'gnomon knobs' does not list"
    done
    case $2 in
    *file:*)
        for name in $(names "${2#*file:}"); do
            grep -q -F "\"$name\"" host/scene/gltf/*.c && pass ||
                fail "$1 names $name, which the glTF loader does not know"
        done
        ;;
    esac
}

# section ROW: the part of the gallery
section() { awk -v row="$1" '/^## / { inside = $2 == row } inside' $gallery; }

is_png() { [ "$(od -A n -t x1 -N 8 "$1" 2>/dev/null | tr -d ' \n')" = 89504e470d0a1a0a ]; }

while read -r row; do
    line=$(grep "^$row |" docs/features.txt)
    case $(printf '%s\n' "$line" | grep -c .) in
    0) fail "docs/features.txt has no row $row" && continue ;;
    1) pass ;;
    *) fail "docs/features.txt has more than one row $row" ;;
    esac
    [ -n "$(cell 2)" ] && pass || fail "$row does not say what it is"
    has_tag "$row" lib && pass || fail "no comment in lib/ has the tag [$row]"
    case $(cell 4) in
    '') has_tag "$row" host/ref && pass || fail "no comment in host/ref/ has the tag [$row]" ;;
    'none: the same pixels')
        has_tag "$row" host/ref && fail "$row has a reference, and says that it has none" || pass
        ;;
    *) fail "$row says of its reference: $(cell 4)" ;;
    esac
    has_tag "$row" tests && pass || fail "no comment in tests/ has the tag [$row]"
    settings "$row" "$(cell 3)"
    anchor=$(echo "$row" | tr A-Z a-z)
    grep -q "^| $row |.*(../GALLERY.md#$anchor) |\$" $features && pass || fail "$row has no link to its pictures"
    grep -q -F "<a id=\"$anchor\"></a>" $gallery && pass || fail "$gallery has no place $anchor"
    section "$row" | sed -n 's/^!\[.*\](\(.*\))$/docs\/\1/p' >"$tmp/pictures"
    [ -s "$tmp/pictures" ] && pass || fail "$row has no picture"
    while read -r picture; do
        is_png "$picture" && pass || fail "$row shows $picture, which is no PNG file"
    done <"$tmp/pictures"
done <"$tmp/rows"

# nothing beside the list, no picture that no row shows
sed -n 's/^| \([A-Z][0-9]*\) |.*/\1/p' $features | sort >"$tmp/have"
sort "$tmp/rows" | comm -13 - "$tmp/have" >"$tmp/found"
[ -s "$tmp/found" ] && fail "$features has rows that are none: $(tr '\n' ' ' <"$tmp/found")" || pass
for picture in docs/pictures/gallery/*; do
    grep -q -F "(pictures/gallery/${picture##*/})" $gallery && pass || fail "$picture is in no section of $gallery"
done
[ "$(du -s --apparent-size -k docs/pictures/gallery | cut -f 1)" -lt 4096 ] && pass || fail "docs/pictures/gallery is larger than 4 MB"

# ---- The gallery drawn again -----------------------------------------------------------------------------------------

# The same but for digits of its numbers, and both engines agree in every picture. 8 bits of depth, 4 bits and one bit
# of grey have steps so large that a rounding is seen.
mkdir -p "$tmp/again" "$tmp/exact"
export FW_OPT=-O0 # of programs that draw one picture
if sh docs/gallery.sh "$tool" "$tmp/again" >"$tmp/log" 2>&1; then pass
else fail "docs/gallery.sh fails: $(tail -n 1 "$tmp/log")"; fi
without_numbers() { sed -E '/^identical /s/[0-9.]+/0/g' "$1"; }
without_numbers $gallery >"$tmp/committed"
without_numbers "$tmp/again/GALLERY.md" >"$tmp/drawn" 2>/dev/null
cmp -s "$tmp/committed" "$tmp/drawn" && pass ||
    fail "$gallery is not what docs/gallery.sh makes: make docs ($(diff "$tmp/committed" "$tmp/drawn" | sed -n 2p))"
# Pixel by pixel both engines agree. Cells are further from the reference, but no picture as far as shadow maps are from
# exact shadows at their best, 37 dB; of one bit a pixel is black or white.
kinds=again
if [ "$THOROUGH" ]; then
    kinds="exact again"
    GALLERY_SET='--size 120x90 --set persp_step=1' sh docs/gallery.sh "$tool" "$tmp/exact" >"$tmp/log" 2>&1 || fail "docs/gallery.sh fails: $(tail -n 1 "$tmp/log")"
fi
for kind in $kinds; do
    awk -v kind=$kind '/^`gnomon/ { command = $0 }
        /^identical / {
            line = $0
            identical = $2
            sub(/.*PSNR /, "", line)
            psnr = line ~ /^infinite/ ? 999 : line + 0
            sub(/.*shadow mismatch /, "")
            coarse = command ~ /depth_bits=8/
            n++
            if (kind == "exact" ? (identical < 98 || $1 > (coarse ? 2 : 0.6)) : (psnr < 37 && command !~ /mono1/))
                print kind ": " identical " % identical, PSNR " psnr ", shadow mismatch " $1 " %: " command
        }
        END { if (n < 62) print "the metrics of only " n + 0 " pictures" }' "$tmp/$kind/GALLERY.md"
done >"$tmp/found" 2>&1
[ -s "$tmp/found" ] && fail "the engines differ: $(head -n 3 "$tmp/found" | tr '\n' ';')" || pass

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
