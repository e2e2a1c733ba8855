#!/bin/sh
# Documents can be read: no sentence of more than 40 words (docs/words.sh), no dead link, no command, setting or target that there is not.
# usage: test_words.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh
documents="README.md docs/*.md docs/data/*.md boards/README.md host/README.md lib/README.md port/README.md"
none() { # none WHAT FILE: the file must be empty
    if [ -s "$2" ]; then fail "$1: $(head -n 5 "$2" | tr '\n' ';')"; else pass; fi
}

# ---- The measure itself ----------------------------------------------------------------------------------------------------

numbers() { awk -v n="$1" 'BEGIN { for (i = 0; i < n; i++) printf "word%s", i < n - 1 ? " " : "" }' | tr -d 0-9; }
{
    echo "# $(numbers 60)" # a heading
    echo
    echo "$(numbers 20) \`code that is long\` [text of a link](with/an/address) a·b + c(x) = 2⁻¹⁶. Next sentence, short."
    echo "- $(numbers 41)"
    echo "- two words"
    echo
    echo "| $(numbers 50) |"
    echo '```'
    numbers 50
    echo '```'
    echo '<!-- generated: here -->'
    numbers 50
    echo '<!-- end -->'
} >"$tmp/sample.md"
got=$(sh docs/words.sh --sentences "$tmp/sample.md" | cut -f 2,3 | tr '\t\n' ': ')
[ "$got" = "3:24 3:3 4:41 5:2 " ] && pass || fail "docs/words.sh counts lines and words as: $got"

# ---- Sentences -------------------------------------------------------------------------------------------------------------

sh docs/words.sh --sentences >"$tmp/sentences"
[ "$(wc -l <"$tmp/sentences")" -gt 1000 ] && pass || fail "docs/words.sh finds $(wc -l <"$tmp/sentences") sentences"
awk -F '\t' '$3 > 40 { printf "%s:%d: %d words: %.60s...\n", $1, $2, $3, $4 }' "$tmp/sentences" >"$tmp/found"
none "sentences of more than 40 words, make two of them" "$tmp/found"

# ---- Links -----------------------------------------------------------------------------------------------------------------

# prose FILE: without program text
prose() { awk '/^ *```/ { fence = !fence; next } !fence && !/^    [^ ]/' "$1"; }
# anchors FILE: of its headings, as GitHub makes them, and those that are written out
anchors() {
    prose "$1" | sed -n 's/^##* //p' | sed 's/\[\([^]]*\)\]([^)]*)/\1/g' | tr 'A-Z' 'a-z' | LC_ALL=C.UTF-8 sed 's/[^[:alnum:] _-]//g; s/ /-/g'
    sed -n 's/.*<a id="\([^"]*\)".*/\1/p' "$1"
}
for file in $documents; do
    prose "$file" | grep -o ']([^)]*)' | sed 's/^](\(.*\))$/\1/' | sort -u | while read -r link; do
        case $link in http://* | https://* | mailto:*) continue ;; esac
        echo >>"$tmp/n_links"
        path=${link%%#*} target=$file
        [ -z "$path" ] || target=$(dirname "$file")/$path
        [ -e "$target" ] || { echo "$file: $link"; continue; }
        case $link in
        *#*) anchors "$target" | grep -q -x -F -e "${link#*#}" || echo "$file: $link" ;;
        esac
    done
done >"$tmp/found"
none "dead links" "$tmp/found"
[ "$(wc -l <"$tmp/n_links")" -gt 200 ] && pass || fail "$(wc -l <"$tmp/n_links") links are found"
# nothing lies in docs/ that README.md or a document does not lead to
for file in docs/*.md docs/data/*.md; do
    cat $documents | grep -q -F "(${file#docs/}" || grep -q -F "($file" README.md || echo "$file"
done >"$tmp/found"
none "documents that nothing leads to" "$tmp/found"

# files that are named without a link
cat $documents | grep -o '`\(lib\|host\|tests\|boards\|port\|docs\)/[a-zA-Z0-9_/.-]*`' | tr -d '`' | sort -u | grep -v -e NAME -e /mine | while read -r path; do [ -e "$path" ] || echo "$path"; done >"$tmp/found"
none "files of documents that are not there" "$tmp/found"

# files of lib/, by their stem
grep -o '`\(base\|geometry\|scene\|light\|shadow\|visible\|shade\|compact\|frame\)/gn_[a-z_]*`' docs/ARCHITECTURE.md | tr -d '`' | sort -u >"$tmp/stems"
[ "$(wc -l <"$tmp/stems")" -gt 30 ] && pass || fail "docs/ARCHITECTURE.md names $(wc -l <"$tmp/stems") files of lib/"
while read -r stem; do ls lib/"$stem".[ch] >/dev/null 2>&1 || echo "$stem"; done <"$tmp/stems" >"$tmp/found"
none "files of docs/ARCHITECTURE.md that are not in lib/" "$tmp/found"
for figure in frame window cascades; do
    sh docs/$figure.sh "$tmp/$figure.svg" && cmp -s "$tmp/$figure.svg" docs/pictures/$figure.svg && pass || fail "docs/pictures/$figure.svg is not what docs/$figure.sh draws"
done
grep -o '[^a-z_]gn_[a-z_]*' docs/pictures/frame.svg | cut -c 2- | sort -u | while read -r name; do
    grep -q -w "$name" lib/gnomon.h lib/gn_internal.h || echo "$name"
done >"$tmp/found"
none "functions of the figure that the library does not have" "$tmp/found"

# ---- Names -----------------------------------------------------------------------------------------------------------------

"$tool" help | sed -n 's/^  \([a-z]*\) .*/\1/p' | sort -u >"$tmp/commands"
cat $documents | grep -o '\(build/\|`\|^    \|| \)gnomon [a-z][a-z]*' | sed 's/.*gnomon //' | sort -u | grep -v -x -F -f "$tmp/commands" >"$tmp/found"
none "commands of documents that the tool does not have" "$tmp/found"
"$tool" knobs | sed -n 's/^| `\([a-z_0-9]*\)`.*/\1/p' >"$tmp/knobs"
cat $documents | grep -o -e '--set [a-z_0-9]*[=@]' | sed 's/--set \(.*\)./\1/' | sort -u | grep -v -x -F -f "$tmp/knobs" >"$tmp/found"
none "settings of documents that the tool does not know" "$tmp/found"
"$tool" help | grep -o -e '^  --*[a-z][a-z-]*' | tr -d ' ' | sort -u >"$tmp/options"
cat $documents | grep -o 'gnomon [a-z][a-z]* [^|]*' | sed 's/[`#].*//' | grep -o -e ' --[a-z][a-z-]*' | tr -d ' ' | sort -u | grep -v -x -F -f "$tmp/options" -e --help >"$tmp/found"
none "options of documents that the tool does not have" "$tmp/found"
sed -n 's/^\.PHONY: *//p' Makefile | tr ' ' '\n' >"$tmp/targets"
cat $documents | grep -o '\(`\|^    \|^\)make [a-z][a-z/-]*' | sed 's/.*make //' | grep -v / | sort -u | grep -v -x -F -f "$tmp/targets" >"$tmp/found"
none "targets of documents that the Makefile does not have" "$tmp/found"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
