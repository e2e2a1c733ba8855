#!/bin/sh
# The rules that no compiler checks: no floating point, no hidden state, who may include whom, sizes, and documents in step.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh
# none WHAT FILE: the file must be empty; each of its lines is named
none() {
    if [ -s "$2" ]; then fail "$1: $(head -n 5 "$2" | tr '\n' ';')"; else pass; fi
}

variable() { make -s --no-print-directory WERROR=-Werror --eval="print: ; @echo \$($1)" print; }
warn=$(variable WARN)

# Comments and strings gone, line numbers kept.
code() {
    awk '{
        out = ""; s = $0
        while (s != "") {
            if (inside) { at = index(s, "*/"); if (!at) { s = ""; break } s = substr(s, at + 2); inside = 0; continue }
            if (match(s, /\/\*|"/)) {
                out = out substr(s, 1, RSTART - 1); opener = substr(s, RSTART, RLENGTH); s = substr(s, RSTART + RLENGTH)
                if (opener == "/*") inside = 1
                else { while (match(s, /["\\]/)) { c = substr(s, RSTART, 1); s = substr(s, RSTART + (c == "\\" ? 2 : 1)); if (c == "\"") break } out = out "\"\"" }
            } else { out = out s; s = "" }
        }
        print FILENAME ":" FNR ":" out
    }' "$1"
}

# ---- The library's objects -------------------------------------------------------------------------------------------------

find lib -name '*.[ch]' | sort >"$tmp/lib_files"
[ "$(wc -l <"$tmp/lib_files")" -gt 60 ] && pass || fail "only $(wc -l <"$tmp/lib_files") files of lib/ are found"
while read -r file; do code "$file"; done <"$tmp/lib_files" >"$tmp/lib_code"
grep -E '\<(float|double|_Complex|long double)\>' "$tmp/lib_code" >"$tmp/found"
none "floating-point type in lib/" "$tmp/found"
grep -E '[^A-Za-z0-9_.](([0-9]+\.[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?|[0-9]+[eE][-+]?[0-9]+)[fFlL]?' "$tmp/lib_code" |
    grep -v -E '^lib/gnomon\.h:[0-9]+:#define GN_(FIX_|U?Q[0-9]+|TURN)\(' >"$tmp/found"
none "floating-point constant in lib/ outside the macros of gnomon.h" "$tmp/found"

# Any floating-point arithmetic is an error; nothing is inlined, for the graph of calls below.
mkdir -p "$tmp/objects"
for arithmetic in 0 1; do # of either, GN_COMPACT
    if gcc -std=c99 -pedantic $warn -Ilib -DGN_PICTURES=$((15 - 15 * arithmetic)) -DGN_COMPACT=$arithmetic -O0 -mgeneral-regs-only -Wvla -ffreestanding -fno-inline \
        -fdump-rtl-expand -c -o "$tmp/objects/$arithmetic.o" lib/gnomon.c >"$tmp/log" 2>&1; then pass
    else fail "lib/ with GN_COMPACT=$arithmetic does not compile: $(grep -m 1 error "$tmp/log")"; fi
done
objdump -d --no-show-raw-insn "$tmp"/objects/*.o | cut -s -f 2- | grep -E '%[xyz]mm|%st|^f(ld|st|add|mul|div|sub|ild|ist)' >"$tmp/found"
none "floating-point instruction" "$tmp/found"
[ "$(objdump -d "$tmp"/objects/*.o | wc -l)" -gt 1000 ] && pass || fail "objdump shows no instructions"

nm -A -u "$tmp"/objects/*.o | awk '{ print $NF }' | sort -u >"$tmp/undefined"
nm -A --defined-only "$tmp"/objects/*.o | awk '{ print $NF }' | sort -u >"$tmp/defined"
comm -23 "$tmp/undefined" "$tmp/defined" | grep -v -x -E \
    'mem(set|cpy|move|cmp)|_GLOBAL_OFFSET_TABLE_|__(u?(div|mod|divmod)|mul|ash[lr]|lshr|clz|popcount)[a-z]*[sdt]i[234]' >"$tmp/found"
none "lib/ needs more than the mem functions and integer helpers" "$tmp/found"
grep -x -q memset "$tmp/undefined" && pass || fail "nm lists no undefined symbols"
nm -A --defined-only "$tmp"/objects/*.o | awk '$(NF - 1) ~ /^[dDbBCsSgG]$/ { print $1, $NF }' >"$tmp/found"
none "writable static data in lib/" "$tmp/found"
size -A "$tmp"/objects/*.o | awk '/:$/ { f = $1 } $1 ~ /^\.(data|bss|tdata|tbss)/ && $2 > 0 { print f, $1, $2 }' >"$tmp/found"
none ".data or .bss in lib/ is not empty" "$tmp/found"
size -A "$tmp"/objects/*.o | grep -q '^\.text' && pass || fail "size lists no sections"
grep -E '\<(malloc|calloc|realloc|free|alloca|setjmp|longjmp|goto)\>' "$tmp/lib_code" >"$tmp/found"
none "malloc and the like in lib/" "$tmp/found"

# No recursion: the graph of calls has no cycle.
find "$tmp/objects" -name '*.expand' | xargs cat | awk '
    /^;; Function / { from = $3 }
    /\(call / && match($0, /symbol_ref[^"]*\("[^"]*"/) { to = substr($0, RSTART, RLENGTH); gsub(/.*\("|"/, "", to); print from, to }' |
    sort -u >"$tmp/graph"
[ "$(wc -l <"$tmp/graph")" -gt 50 ] && pass || fail "the graph of calls has $(wc -l <"$tmp/graph") edges"
awk '$1 == $2 { print $1 " calls itself" }' "$tmp/graph" >"$tmp/found"
tsort "$tmp/graph" >/dev/null 2>>"$tmp/found"
none "recursion in lib/" "$tmp/found"

# Hot code, port/gn_port.h: in a file with marked functions all are marked.
grep -l '^GN_HOT' lib/*/*.c >"$tmp/hot"
[ "$(wc -l <"$tmp/hot")" -gt 20 ] && pass || fail "$(wc -l <"$tmp/hot") files of hot code"
xargs awk 'FNR == 1 { head = "" } /^[A-Za-z_]/ && !/;/ { head = $0 }
    /^\{/ { if (head ~ /\(/ && head !~ /^(GN_HOT|GN_COLD|GN_INLINE) /) print FILENAME ": " head; head = "" }' <"$tmp/hot" >"$tmp/found"
none "a function of a hot file without GN_HOT" "$tmp/found"

# ---- Who includes whom -----------------------------------------------------------------------------------------------------

find lib -name '*.[ch]' | xargs grep -H -E '^[[:space:]]*#[[:space:]]*include' | grep -v -E '<(limits|stdint|stddef|string)\.h>|"([a-z]+/)?(gnomon|gn_[a-z_]+)\.[ch]"|(GN_USER_CONFIG|GN_PORT)$' >"$tmp/found"
none "lib/ includes more than itself, limits.h, stdint.h, stddef.h and string.h" "$tmp/found"
find lib -name '*.[ch]' | xargs grep -h -E '^ *#include "' | sed 's/.*"\(.*\)".*/\1/' | sort -u | while read -r header; do
    [ -f "lib/$header" ] || echo "$header"
done >"$tmp/found"
none "lib/ includes a header that it does not have" "$tmp/found"

# Folders, as lib/README.md and host/README.md list them: none includes from one that stands below it. An include is looked up in
# the roots, then beside the file that has it.
arrows() { # arrows TREE: "FOLDER FOLDER" for every include of another folder of the tree
    find "$1" -name '*.[ch]' | xargs awk -v tree="$1" '/^[[:space:]]*#[[:space:]]*include "/ {
        match($0, /"[^"]*"/)
        name = substr($0, RSTART + 1, RLENGTH - 2)
        from = FILENAME
        sub(/\/[^\/]*$/, "", from)
        if (tree == "host" && name ~ /(^|\/)gn_/) next # of the library
        if (tree == "lib") path = name ~ /\// ? "lib/" name : ""
        else path = from "/" name
        n = split(path, part, "/") - 1
        folder = ""
        m = 0
        for (i = 1; i <= n; i++) if (part[i] == "..") m--; else kept[++m] = part[i]
        for (i = 1; i <= m; i++) folder = folder (i > 1 ? "/" : "") kept[i]
        if (index(folder, tree "/") == 1 && folder != from && from != tree) print from, folder
    }' | sort -u
}
for tree in lib host; do
    sed -n "s/^| \`\([a-z/]*\)\/\` .*/$tree\/\1/p" $tree/README.md >"$tmp/rooms"
    find $tree -mindepth 2 -name '*.[ch]' | sed 's|/[^/]*$||' | sort -u | grep -v -x -F -f "$tmp/rooms" >"$tmp/found"
    none "a folder that $tree/README.md does not list" "$tmp/found"
    arrows $tree >"$tmp/arrows"
    [ "$(wc -l <"$tmp/arrows")" -gt 20 ] && pass || fail "the folders of $tree/ have $(wc -l <"$tmp/arrows") arrows"
    awk 'NR == FNR { rank[$1] = FNR; next } !($2 in rank) || rank[$2] >= rank[$1] { print $1 " includes " $2 }' "$tmp/rooms" "$tmp/arrows" >"$tmp/found"
    none "a folder of $tree/ includes one that stands below it in $tree/README.md" "$tmp/found"
done

# comments name files that there are
grep -n -o -E '\bgn_[a-z0-9_]+\.[ch]\b' -r lib port | while IFS=: read -r file line name; do
    [ -n "$(find lib port -name "$name")" ] || echo "$file:$line: $name"
done >"$tmp/found"
none "files that are named and are not there" "$tmp/found"

# gnomon.c includes every part once; in gn_frame.c the table of contents names the stages in the order of gn_internal.h.
find lib -mindepth 2 -name "*.c" | sed "s|^lib/||" | sort >"$tmp/parts"
sed -n "s/^#include \"\(.*\.c\)\"/\1/p" lib/gnomon.c | sort | diff "$tmp/parts" - >"$tmp/found"
none "not what lib/gnomon.c includes" "$tmp/found"
sed "/What a frame need not draw/,\$d" lib/gn_internal.h >"$tmp/stages.h"
sed -n "s/.*[ *]\(gn_[a-z_]*\)(gn_frame .*/\1/p; s/.*[ *]\(gn_[a-z_]*\)(const gn_frame .*/\1/p" "$tmp/stages.h" >"$tmp/stages"
[ "$(wc -l <"$tmp/stages")" = 8 ] && pass || fail "lib/gn_internal.h declares $(wc -l <"$tmp/stages") stages, not 8"
awk "NR == FNR { name[NR] = \$1; n = NR; next } /\*\// { exit } at < n && index(\$0, name[at + 1] \":\") { at++ } END { for (i = at + 1; i <= n; i++) print name[i] }" \
    "$tmp/stages" lib/frame/gn_frame.c >"$tmp/found"
none "stages that are not named in order in the table of contents of lib/frame/gn_frame.c" "$tmp/found"

grep -H -E '#[[:space:]]*include[^"<]*["<][^">]*(lib/|gnomon\.h|gn_)' host/ref/*.[ch] host/truth/*.[ch] >"$tmp/found"
none "host/ref/ or host/truth/ includes from lib/" "$tmp/found"
grep -H -E '\<(gn|GN)_[A-Za-z]' host/ref/*.[ch] host/truth/*.[ch] | while IFS= read -r line; do
    code "${line%%:*}" | grep -E '\<(gn|GN)_[A-Za-z]'
done | sort -u >"$tmp/found"
none "host/ref/ or host/truth/ uses the library" "$tmp/found"
find lib host port -name '*.[ch]' 2>/dev/null | xargs grep -H -E '#[[:space:]]*include.*(tests/|boards/|"(\.\./)*check\.h)' >"$tmp/found"
none "product code includes tests/ or boards/" "$tmp/found"
if [ -d port ]; then
    find port -name '*.[ch]' | xargs grep -H -E '#[[:space:]]*include.*"(\.\./)*(lib/)?gn_' | grep -v '"gn_port' >"$tmp/found"
    none "port/ includes a private header of lib/" "$tmp/found"
fi

# ---- Sizes -----------------------------------------------------------------------------------------------------------------

# What a coming change replaces or takes apart may be longer until then: names of files without their ending, for either rule.
long_for_now=""
# Lines of #if per thousand lines of lib/: at most so many. To be an error, not a warning, as soon as it holds.
if_lines=25 if_lines_fail=1

long_c() { # the C files of lib/ and port/ that must be short
    find lib port -name '*.[chS]' | while read -r file; do
        case " $long_for_now " in *" $(basename "${file%.*}") "*) ;; *) echo "$file" ;; esac
    done
}
[ "$(long_c | wc -l)" -gt 60 ] && pass || fail "$(long_c | wc -l) files of lib/ and port/ are measured"
long_c | xargs awk 'FNR == 501 { print FILENAME ": over 500 lines" }' >"$tmp/found"
none "a file is too long" "$tmp/found"
long_c | grep '\.c$' | xargs awk '/^\{/ { start = FNR }
    /^\}/ { if (start && FNR - start - 1 > 40) print FILENAME ":" start ": " FNR - start - 1 " lines"; start = 0 }' >"$tmp/found"
none "a function is too long" "$tmp/found"
for name in $long_for_now; do
    [ -n "$(find lib port -name "$name.[chS]")" ] || echo "$name"
done >"$tmp/found"
none "files that may be long and are not there any more" "$tmp/found"

density=$(find lib -name '*.[ch]' | xargs cat | awk '/^ *# *(if|ifdef|ifndef|elif)([^a-z]|$)/ { n++ }
    END { printf "%d", (1000 * n + NR - 1) / NR }')
if [ "$density" -le $if_lines ]; then pass
elif [ $if_lines_fail = 1 ]; then fail "lib/ has $density lines of #if per thousand, at most $if_lines are allowed"
else echo "warning: lib/ has $density lines of #if per thousand, $if_lines will be allowed"; fi

# ---- Format ----------------------------------------------------------------------------------------------------------------

# The project's files, ended by null bytes, also where it was unpacked without .git.
files() {
    if [ -e .git ] && command -v git >/dev/null 2>&1; then git ls-files --cached --others --exclude-standard -z
    else find . -path ./build -prune -o -type f -print0; fi
}
files | tr '\0' '\n' | sed 's|^\./||' | grep -E '^(lib|port|host|tests|boards)/.*\.[ch]$' | sort >"$tmp/c_files"
[ "$(wc -l <"$tmp/c_files")" -gt 300 ] && pass || fail "$(wc -l <"$tmp/c_files") C files are found"
while read -r file; do
    LC_ALL=C.UTF-8 grep -n -E '.{121}' "$file" | sed "s|^\([0-9]*\):.*|$file:\1|"
done <"$tmp/c_files" >"$tmp/found"
none "lines of more than 120 columns" "$tmp/found"
# Versions of the formatter disagree in details; the files are as this one makes them.
formatter=14
version=$(clang-format --version | sed 's/.*version \([0-9]*\).*/\1/')
if [ "$version" = $formatter ]; then
    split -n r/2 "$tmp/c_files" "$tmp/format."
    xargs -P 2 -n 1 sh -c 'xargs clang-format --dry-run -Werror <"$1" >"$1.log" 2>&1' format <<END
$tmp/format.aa
$tmp/format.ab
END
    cat "$tmp"/format.*.log | grep -E '^[^ ]*:[0-9]+:[0-9]+: error' | cut -d: -f1 | sort -u >"$tmp/found"
    none "not as clang-format makes it" "$tmp/found"
else echo "warning: clang-format is version $version, not $formatter: the format is not checked"; fi
files | xargs -0 grep -I -n -H -E '[[:space:]]$' 2>/dev/null | cut -c 1-100 >"$tmp/found"
none "trailing white space" "$tmp/found"
files | xargs -0 grep -I -l -P '\t' 2>/dev/null | grep -v -E '(^|/)(Makefile|[^/]*\.mk)$' >"$tmp/found"
none "tabs outside Makefile" "$tmp/found"
[ "$(grep -c '^{' lib/frame/gn_frame.c)" -gt 10 ] && pass || fail "functions do not begin with a brace in the first column"

# ---- Generated files and documents -----------------------------------------------------------------------------------------

if make -s build/gen_tables >"$tmp/log" 2>&1 && build/gen_tables >"$tmp/gn_tables.c"; then
    if cmp -s "$tmp/gn_tables.c" lib/base/gn_tables.c; then pass; else fail "lib/base/gn_tables.c is not what host/generate/gen_tables.c writes: make tables"; fi
else
    fail "gen_tables does not build: $(grep -m 1 error "$tmp/log")"
fi

# ---- Makefile --------------------------------------------------------------------------------------------------------------

sed -n 's/^\([a-z-]*\):.*/\1/p' Makefile | sort -u >"$tmp/targets"
for target in $(cat "$tmp/targets"); do
    sed -n 's/^\.PHONY: *//p' Makefile | tr ' ' '\n' | grep -q -x -e "$target" || echo "$target"
done >"$tmp/found"
none "targets of the Makefile that are no files, and not .PHONY" "$tmp/found"
mkdir -p "$tmp/clean/obj"
make -s clean BUILD="$tmp/clean" >"$tmp/log" 2>&1 && [ ! -e "$tmp/clean" ] && [ -d build ] && pass || fail "make clean BUILD=... does not remove that folder alone"
make -s help >"$tmp/help" 2>&1
for target in $(sed -n 's/^\.PHONY: *//p' Makefile); do
    case $target in *-programs) continue ;; esac # for the test runner
    grep -q "make $target " "$tmp/help" && pass || fail "make help does not list $target"
done

if [ ! -x build/gnomon ]; then fail "there is no build/gnomon"
elif ! grep -q 'generated' docs/CONFIGURATION.md 2>/dev/null; then fail "docs/CONFIGURATION.md has no generated section"
else
    build/gnomon knobs | sed '/./,$!d' >"$tmp/knobs"
    # the generated section: what stands between the two marker comments
    awk '/<!-- *generated/ { inside = 1; next } /<!-- *(end|\/generated)/ { inside = 0 } inside' docs/CONFIGURATION.md | sed '/./,$!d' >"$tmp/section"
    # blank lines at the ends do not count
    if [ "$(cat "$tmp/knobs")" = "$(cat "$tmp/section")" ] && [ -s "$tmp/knobs" ]; then pass
    else fail "docs/CONFIGURATION.md is not what 'gnomon knobs' prints: make docs ($(diff "$tmp/knobs" "$tmp/section" | sed -n 2p))"; fi
fi

if [ ! -x build/test_extremes_many ]; then fail "there is no build/test_extremes_many"
else
    for part in extremes extremes_light extremes_many; do build/test_$part --table; done | sed '/./,$!d' >"$tmp/extremes"
    awk '/<!-- generated: extremes/ { inside = 1; next } /<!-- end/ { inside = 0 } inside' docs/data/EXTREMES.md | sed '/./,$!d' >"$tmp/section"
    if cmp -s "$tmp/extremes" "$tmp/section" && [ -s "$tmp/section" ]; then pass
    else fail "docs/data/EXTREMES.md is not what the --table of test_extremes, test_extremes_light and test_extremes_many prints: make docs ($(diff "$tmp/extremes" "$tmp/section" | sed -n 2p))"; fi
fi

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
