#!/bin/sh
# Makes docs/data/FEATURES.md from docs/features.txt and from the tags in the code. usage: features.sh [OUT_DIR] | --tags
# "--tags" prints the tags instead: row, file and, in tests, function ("-": the file as a whole).
#
# A tag is a row in brackets, as [D7], in a comment: in lib/ and host/ref/ where the row is implemented, in tests/ above
# the function that tests it. What code holds in brackets is none. Each line of the table of tests/oracle/test_rows.c
# begins with its row: it needs no tag.
set -e
table=tests/oracle/test_rows.c

# tags_of FILE...: row, file and function of every tag. A comment belongs to the function that it stands in or above.
tags_of() {
    awk '
        function flush(name,   i) {
            for (i = 1; i <= n; i++) print tag[i], file, file ~ /^tests\// ? name : "-"
            n = 0
        }
        function find(text) { # what is in a comment
            while (match(text, /\[[DPAFBMR][0-9][0-9]?\]/)) {
                tag[++n] = substr(text, RSTART + 1, RLENGTH - 2)
                text = substr(text, RSTART + RLENGTH)
            }
        }
        function name_of(text) { # "static int f(" gives f
            sub(/\(.*/, "", text)
            sub(/.*[ *]/, "", text)
            return text
        }
        FNR == 1 { flush("-"); file = FILENAME; inside = 0; body = "" }
        file ~ /\.sh$/ { if (match($0, /(^|[ \t])#/)) { find(substr($0, RSTART)); flush("-") } next }
        {
            code = ""; rest = $0; empty = $0 == ""
            while (rest != "") {
                if (inside) {
                    at = index(rest, "*/")
                    find(at ? substr(rest, 1, at - 1) : rest)
                    rest = at ? substr(rest, at + 2) : ""
                    inside = !at
                } else if (match(rest, /\/\*|"([^"\\]|\\.)*"/)) {
                    code = code substr(rest, 1, RSTART - 1)
                    inside = substr(rest, RSTART, 2) == "/*"
                    rest = substr(rest, RSTART + RLENGTH)
                } else { code = code rest; rest = "" }
            }
            if (code ~ /^[A-Za-z].*\(/ && code !~ /;[ \t]*$/) body = name_of(code)
            if (body != "" && n) flush(body)
            else if (empty || code ~ /[^ \t]/) flush("-")
            if (code ~ /^}/) body = ""
        }
        END { flush("-") }' "$@"
}

tags() {
    tags_of $(find lib host/ref tests -name '*.[ch]' -o -path 'tests/*.sh' | LC_ALL=C sort)
    awk -v file=$table '!/^[ \t]*\/?\*/ && match($0, /^[^"]*[{( ]"[DPAFBMR][0-9][0-9]?",/) {
        split($0, part, "\"")
        print part[2], file, "-"
    }' $table
}

if [ "${1:-}" = --tags ]; then
    tags | LC_ALL=C sort -u
    exit
fi

out=${1:-docs}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tags | LC_ALL=C sort -u >"$work/tags"
{
    cat <<'TEXT'
# Features

Every row of the feature list: where the library has it, where the double-precision reference has it on its own, what
sets it, the test that compares the two and fails when they part, and its pictures. Names of settings are those of
[CONFIGURATION.md](../CONFIGURATION.md); after "file" they are keys of a glTF file or of its `extras.gnomon`. The formulas are in [MODEL.md](../MODEL.md).

`tests/oracle/test_rows.c` runs a table of scenes per row: library and reference, with the row and without it. The
other tests name the function. `docs/features.sh` makes this page from `docs/features.txt` and from tags in the code:
`[D7]` in a comment marks what implements or tests row D7. `tests/documents/test_features.sh` checks that every row
has its tags, and draws every picture of the [gallery](../GALLERY.md) again.

| row | what | library (`lib/`) | reference (`host/ref/`) | settings | tests (`tests/`) | pictures |
|---|---|---|---|---|---|---|
TEXT
    awk -F ' *[|] *' '
        function join(list, separator, item) { return list (list == "" ? "" : separator) item }
        NR == FNR {
            split($0, part, " ")
            row = part[1]; path = part[2]; name = "`" path "`"
            if (sub(/^`lib\//, "`", name)) library[row] = join(library[row], ", ", name)
            else if (sub(/^`host\/ref\//, "`", name)) reference[row] = join(reference[row], ", ", name)
            else if (sub(/^`tests\//, "`", name)) {
                if (path != last[row]) test[row] = join(test[row], "; ", name)
                if (part[3] != "-") test[row] = test[row] " `" part[3] "`"
                last[row] = path
            }
            next
        }
        $1 ~ /^[A-Z][0-9]+$/ {
            if ($4 != "") reference[$1] = join(reference[$1], "; ", $4)
            printf "| %s | %s | %s | %s | %s | %s | [%s](../GALLERY.md#%s) |\n", $1, $2, library[$1],
                reference[$1], $3, test[$1], $1, tolower($1)
        }' "$work/tags" docs/features.txt
} >"$work/FEATURES.md"
mkdir -p "$out/data"
cp "$work/FEATURES.md" "$out/data/FEATURES.md"
