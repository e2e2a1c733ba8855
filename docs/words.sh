#!/bin/sh
# What it takes to read the documents: per document the words outside generated parts and program text, of these the words in sentences, the
# longest sentence, and the Flesch reading ease where `style` (package diction) is installed; larger is easier, 60 is plain.
# Tables, program text, formulas and headings are no sentences.
# usage: words.sh [FILE...]             one row per document
#        words.sh --sentences [FILE...] one sentence per line: file, line, words, text
cd "$(dirname "$0")/.." || exit 1
mode=table
[ "$1" = --sentences ] && mode=sentences && shift
[ $# -gt 0 ] || set -- README.md docs/*.md docs/data/*.md boards/README.md host/README.md lib/README.md port/README.md
whole="docs/GALLERY.md docs/data/FEATURES.md" # made by scripts: their sentences count, their words do not

# What is written by hand: no part between the markers of a generator. Line numbers stay.
by_hand() {
    awk '/^<!-- (begin: )?generated/ { skip = 1 } { print skip ? "" : $0 } /^<!-- end/ { skip = 0 }' "$1"
}

# Sentences end at . ! or ? before a capital, a backquote or the end of the paragraph. A word has letters only: formulas have none.
sentences() {
    by_hand "$1" | awk -v file="$1" '
        function flush(   n, i, w, words, s) {
            gsub(/!\[[^]]*\]\([^)]*\)/, "", text)
            while (match(text, /\[[^]]*\]\([^)]*\)/)) {
                s = substr(text, RSTART + 1, RLENGTH - 1)
                sub(/\]\(.*/, "", s)
                text = substr(text, 1, RSTART - 1) s substr(text, RSTART + RLENGTH)
            }
            gsub(/`[^`]*`/, "`x`", text)
            gsub(/\*/, "", text)
            gsub(/e\.g\. /, "eg ", text)
            gsub(/i\.e\. /, "ie ", text)
            while (match(text, /[.!?]\)?("|”)? +[^a-z0-9 ,;:)–-]/)) {
                one(substr(text, 1, RSTART + RLENGTH - 2))
                text = substr(text, RSTART + RLENGTH - 1)
            }
            one(text)
            text = ""
        }
        function one(s,   n, i, w, words) {
            n = split(s, w, /[ \/]+/)
            words = 0
            for (i = 1; i <= n; i++) {
                gsub(/^[("`'"'"'–,;:]+|[).,;:!?"`'"'"']+$/, "", w[i])
                if (w[i] ~ /^[A-Za-z][A-Za-z'"'"'’-]*$/ && (length(w[i]) > 1 || w[i] ~ /^[aAI]$/)) words++
            }
            gsub(/^ +| +$/, "", s)
            if (words) print file "\t" start "\t" words "\t" s
        }
        /^```/ { flush(); fence = !fence; next }
        fence { next }
        /^(    |[|#<])/ || /^ *$/ { flush(); next }
        /^ *([-*]|[0-9]+\.) / { flush(); sub(/^ *([-*]|[0-9]+\.) /, "") }
        { if (text == "") start = NR; text = text (text == "" ? "" : " ") $0 }
        END { flush() }'
}

for file; do sentences "$file"; done >"${TMPDIR:-/tmp}/sentences.$$"
trap 'rm -f "${TMPDIR:-/tmp}/sentences.$$"' EXIT
if [ $mode = sentences ]; then cat "${TMPDIR:-/tmp}/sentences.$$"; exit; fi

echo '| document | words | in sentences | sentences | longest | reading ease |'
echo '| --- | --- | --- | --- | --- | --- |'
for file; do
    ease=-
    if command -v style >/dev/null 2>&1; then
        ease=$(awk -F '\t' -v f="$file" '$1 == f {
                n = split($4, w, " ")
                for (i = 1; i <= n; i++) if (w[i] ~ /^[(]?[A-Za-z]['"'"'A-Za-z-]*[).,;:!?]*$/) printf "%s ", w[i]
                print "."
            }' "${TMPDIR:-/tmp}/sentences.$$" | style 2>/dev/null | sed -n 's/.*Flesch Index: \([-0-9.]*\).*/\1/p' | cut -d / -f 1)
    fi
    case " $whole " in *" $file "*) continue ;; esac
    awk -F '\t' -v f="$file" -v all="$(by_hand "$file" | awk '/^ *```/ { fence = !fence; next } !fence' | tr ' ' '\n' | grep -c '[[:alnum:]]')" -v ease="${ease:--}" '$1 == f { n++; words += $3; if ($3 > most) most = $3 }
        END { printf "| %s | %d | %d | %d | %d | %s |\n", f, all, words, n, most, ease }' "${TMPDIR:-/tmp}/sentences.$$"
done | awk -F ' *[|] *' '{ print; all += $3; words += $4; n += $5; if ($6 > most) most = $6 }
    $2 ~ /^(README|docs)/ { documents += $3 }
    END { printf "| README and docs/ | %d | | | | |\n| all | %d | %d | %d | %d | |\n", documents, all, words, n, most }'
