#!/bin/sh
# Generated tables agree with their committed baselines, docs/ has its documents and no other, and nothing in the project names one that is not there.
# usage: test_tables.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh
none() { # none WHAT FILE: the file must be empty
    if [ -s "$2" ]; then fail "$1: $(head -n 5 "$2" | tr '\n' ';')"; else pass; fi
}

# ---- Tables and baselines --------------------------------------------------------------------------------------------------

# part FILE NAME: what stands between the markers
part() { awk -v begin="<!-- generated: $2 -->" '$0 == "<!-- end -->" { on = 0 } on { print } $0 == begin { on = 1 }' "$1"; }
agrees() { # agrees FILE NAME TABLE REMEDY
    part "$1" "$2" >"$tmp/part"
    [ -s "$3" ] && cmp -s "$tmp/part" "$3" && pass || fail "$1 has another table of $2 than its baseline: $4"
}
for name in sizes speed builds; do
    sh docs/cost.sh --table $name >"$tmp/$name"
    agrees README.md $name "$tmp/$name" "sh docs/cost.sh"
    agrees docs/COST.md $name "$tmp/$name" "sh docs/cost.sh"
done
for name in cores parts characters changes model; do
    sh docs/cost.sh --table $name >"$tmp/$name"
    agrees docs/COST.md $name "$tmp/$name" "sh docs/cost.sh"
done
sh tests/firmware/size.sh --tables tests/firmware/size_baseline.txt >"$tmp/all"
agrees docs/data/SIZES.md sizes "$tmp/all" "sh tests/firmware/size.sh --document"
for bench in bench bench_target; do
    sh tests/bench/$bench.sh --check >"$tmp/log" 2>&1 && pass || fail "tests/bench/$bench.sh --check: $(tail -n 1 "$tmp/log")"
done
sh docs/matrix.sh --tables >"$tmp/matrix" 2>/dev/null
agrees docs/data/MATRIX.md matrix "$tmp/matrix" "sh docs/matrix.sh --document"
mkdir "$tmp/features" && sh docs/features.sh "$tmp/features" && cmp -s "$tmp/features/data/FEATURES.md" docs/data/FEATURES.md && pass || fail "docs/data/FEATURES.md: sh docs/features.sh"

tool=${1:-build/gnomon}
sh docs/edges.sh "$tool" "$tmp/edges" 2>"$tmp/log" || fail "docs/edges.sh: $(head -n 1 "$tmp/log")"
for picture in "$tmp"/edges/pictures/edge-*.png; do
    cmp -s "$picture" "docs/pictures/${picture##*/}" && pass || fail "docs/pictures/${picture##*/} is not what docs/edges.sh draws"
done

# no table holds what a failing test printed
grep -n ': failed: ' README.md docs/*.md docs/data/*.md >"$tmp/failed"
none "a test failed while it printed a table" "$tmp/failed"

# every table is one that a script writes, and every marker is closed
for file in README.md docs/*.md docs/data/*.md; do
    sed -n 's/^<!-- generated: \(.*\) -->$/\1/p' "$file" | while read -r name; do
        grep -q -e "\b$name\b" docs/*.sh tests/firmware/size.sh || echo "$file: $name"
    done
    awk -v file="$file" '/^<!-- (begin: )?generated/ { open++ } /^<!-- end/ { open-- } open > 1 || open < 0 { print file ":" FNR; exit } END { if (open == 1) print file }' "$file"
done >"$tmp/found"
none "generated parts that no script writes, or that do not end" "$tmp/found"

# ---- Which documents there are ---------------------------------------------------------------------------------------------

echo ACCURACY ARCHITECTURE CHANGELOG CONFIGURATION CONTRIBUTING COST FIRMWARE GALLERY MODEL NUMERICS SECURITY START TESTING TUTORIAL | tr ' ' '\n' >"$tmp/wanted"
(cd docs && ls ./*.md) | sed 's|^\./||; s/\.md$//' | sort >"$tmp/have"
cmp -s "$tmp/wanted" "$tmp/have" && pass || fail "docs/ has other documents: $(diff "$tmp/wanted" "$tmp/have" | grep '^[<>]' | tr '\n' ' ')"

git ls-files >"$tmp/files" 2>/dev/null || find README.md Makefile docs lib host tests port boards -type f >"$tmp/files"
grep -v -e '^docs/pictures/' -e '\.png$' "$tmp/files" | xargs grep -I -n -o -E '\b(docs/)?(data/)?[A-Z]{4,}\.md\b' 2>/dev/null | while IFS=: read -r file line name; do
    [ -e "$name" ] || [ -e "docs/${name#docs/}" ] || [ -e "docs/data/${name#docs/}" ] || [ -e "$(dirname "$file")/$name" ] || echo "$file:$line: $name"
done >"$tmp/found"
none "documents that are named and are not there" "$tmp/found"
# "MODEL 7" or "NUMERICS 4.12" in a comment is a section that there is
for document in MODEL NUMERICS ARCHITECTURE; do
    sed -n 's/^##* \([0-9][0-9.]*[0-9]\|[0-9]\)\.* .*/\1/p' docs/$document.md | sort -u >"$tmp/sections"
    xargs grep -I -h -o -E "\b$document [0-9]+(\.[0-9]+)?" <"$tmp/files" 2>/dev/null | sed "s/.* //" | sort -u | grep -v -x -F -f "$tmp/sections" | sed "s/^/$document /"
done >"$tmp/found"
xargs grep -I -n -E '\bDESIGN [0-9]' <"$tmp/files" 2>/dev/null | grep -v '^tests/documents/test_tables' >>"$tmp/found"
none "sections that are named and are not there" "$tmp/found"

# ---- How long they are -----------------------------------------------------------------------------------------------------

words=$(sh docs/words.sh | sed -n 's/^| README and docs\/ | \([0-9]*\) .*/\1/p')
[ "${words:-99999}" -le 25300 ] && pass || fail "the documents have $words words that are written by hand, more than 25300"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
