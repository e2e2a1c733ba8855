#!/bin/sh
# Every row of the feature list has code, reference, settings, a test and pictures that exist (docs/FEATURES.md, docs/GALLERY.md); every
# picture is drawn again by both engines, which must agree. usage: test_features.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh
features=docs/FEATURES.md gallery=docs/GALLERY.md

"$tool" knobs | sed -n 's/^| `\([a-z_0-9]*\)`.*/\1/p' >"$tmp/knobs"
[ "$(wc -l <"$tmp/knobs")" -gt 60 ] && pass || fail "gnomon knobs lists $(wc -l <"$tmp/knobs") names"

# identifiers PREFIX N
identifiers() { awk -v p="$1" -v n="$2" 'BEGIN { for (i = 1; i <= n; i++) print p i }'; }
{
    identifiers D 11
    identifiers P 10
    identifiers A 6
    identifiers F 6
    identifiers B 6
    identifiers M 9
    identifiers R 9
} >"$tmp/rows"
not_yet= # nothing is missing any more

# names CELL: what stands in backquotes
names() { echo "$1" | grep -o '`[^`]*`' | tr -d '`'; }
cell() { echo "$line" | awk -F' *[|] *' -v i="$1" '{ print $(i + 1) }'; }

# files ROW FOLDER CELL: at least one, and all exist
files() {
    n=0
    for name in $(names "$3"); do
        n=$((n + 1))
        [ -f "$2/$name" ] && pass || fail "$1 names $2/$name, which does not exist"
    done
    [ "$n" -gt 0 ] && pass || fail "$1 names no file of $2"
}

# settings ROW CELL: knobs, and after "file:" keys of the loader
settings() {
    [ -n "$(names "$2")" ] && pass || fail "$1 names no setting"
    for name in $(names "${2%%file:*}"); do
        grep -q -x -e "$name" "$tmp/knobs" && pass || fail "$1 names the setting $name, which 'gnomon knobs' does not list"
    done
    case $2 in
    *file:*)
        for name in $(names "${2#*file:}"); do
            grep -q -F "\"$name\"" host/scene/gltf/*.c && pass || fail "$1 names $name, which the glTF loader does not know"
        done
        ;;
    esac
}

# tests ROW CELL: pairs of a file and what it must contain; one of the files mentions the row
tests() {
    mentioned=0
    names "$2" >"$tmp/names"
    [ -s "$tmp/names" ] && pass || fail "$1 names no test"
    while read -r file && read -r function; do
        path=$(ls tests/*/"$file" 2>/dev/null)
        if [ -z "$path" ]; then
            fail "$1 names the test $file, which does not exist"
            continue
        fi
        grep -q "\<$function\>" "$path" && pass || fail "$1 names $function, which $path does not have"
        mentions "$1" "$path" && mentioned=1
    done <"$tmp/names"
    [ $mentioned = 1 ] && pass || fail "none of the tests of $1 mentions it"
}

# mentions ROW FILE: by its name, or within a range as in "P2 to P6" or "A1-A3"
mentions() {
    grep -q "\<$1\>" "$2" && return 0
    letter=${1%%[0-9]*} number=${1#?}
    grep -o -E "\<$letter[0-9]+( to |-)$letter[0-9]+\>" "$2" | tr -c '0-9\n' ' ' | awk -v n="$number" '$1 <= n && n <= $2 { found = 1 } END { exit !found }'
}

# section ROW: the part of the gallery
section() { awk -v row="$1" '/^## / { inside = $2 == row } inside' $gallery; }

is_png() { [ "$(od -A n -t x1 -N 8 "$1" 2>/dev/null | tr -d ' \n')" = 89504e470d0a1a0a ]; }

while read -r row; do
    line=$(grep "^| $row |" $features)
    case $(printf '%s\n' "$line" | grep -c .) in
    0) fail "$features has no row $row" && continue ;;
    1) pass ;;
    *) fail "$features has more than one row $row" ;;
    esac
    [ -n "$(cell 2)" ] && pass || fail "$row does not say what it is"
    if [ "$(cell 3)" = "not yet" ]; then
        [ "$row" = "$not_yet" ] && pass || fail "$row is not there yet"
        continue
    fi
    files "$row" lib "$(cell 3)"
    if [ "$(cell 4)" = "none: the same pixels" ]; then pass; else files "$row" host/ref "$(cell 4)"; fi
    settings "$row" "$(cell 5)"
    tests "$row" "$(cell 6)"
    anchor=$(echo "$row" | tr A-Z a-z)
    case $(cell 7) in *"(GALLERY.md#$anchor)"*) pass ;; *) fail "$row has no link to its pictures" ;; esac
    grep -q -F "<a id=\"$anchor\"></a>" $gallery && pass || fail "$gallery has no place $anchor"
    section "$row" | sed -n 's/^!\[.*\](\(.*\))$/docs\/\1/p' >"$tmp/pictures"
    [ -s "$tmp/pictures" ] && pass || fail "$row has no picture"
    while read -r picture; do is_png "$picture" && pass || fail "$row shows $picture, which is no PNG file"; done <"$tmp/pictures"
done <"$tmp/rows"

# nothing beside the list, no picture that no row shows
sed -n 's/^| \([A-Z][0-9]*\) |.*/\1/p' $features | sort >"$tmp/have"
sort "$tmp/rows" | comm -13 - "$tmp/have" >"$tmp/found"
[ -s "$tmp/found" ] && fail "$features has rows that are none: $(tr '\n' ' ' <"$tmp/found")" || pass
for picture in docs/pictures/gallery/*; do
    grep -q -F "(pictures/gallery/${picture##*/})" $gallery && pass || fail "$picture is in no section of $gallery"
done
[ "$(du -sk docs/pictures/gallery | cut -f 1)" -lt 4096 ] && pass || fail "docs/pictures/gallery is larger than 4 MB"

# The gallery drawn again: the same but for digits of its numbers, and both engines agree in every picture. 8 bits of depth, 4 bits and one
# bit of grey have steps so large that a rounding is seen.
mkdir -p "$tmp/again"
if sh docs/gallery.sh "$tool" "$tmp/again" >"$tmp/log" 2>&1; then pass; else fail "docs/gallery.sh fails: $(tail -n 1 "$tmp/log")"; fi
without_numbers() { sed -E '/^identical /s/[0-9.]+/0/g' "$1"; }
without_numbers $gallery >"$tmp/committed"
without_numbers "$tmp/again/GALLERY.md" >"$tmp/drawn" 2>/dev/null
cmp -s "$tmp/committed" "$tmp/drawn" && pass || fail "$gallery is not what docs/gallery.sh makes: make docs ($(diff "$tmp/committed" "$tmp/drawn" | sed -n 2p))"
awk '/^`gnomon/ { command = $0 }
    /^identical / {
        identical = $2
        sub(/.*shadow mismatch /, "")
        coarse = command ~ /depth_bits=8/
        n++
        if (identical < 98 || $1 > (coarse ? 2 : 0.6)) print identical " % identical, shadow mismatch " $1 " %: " command
    }
    END { if (n < 62) print "the metrics of only " n + 0 " pictures" }' "$tmp/again/GALLERY.md" >"$tmp/found" 2>&1
[ -s "$tmp/found" ] && fail "the engines differ: $(head -n 3 "$tmp/found" | tr '\n' ';')" || pass

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
