#!/bin/sh
# The rules that no compiler checks: no floating point, no hidden state, who may include whom, sizes, and documents in step.
cd "$(dirname "$0")/.." || exit 1
. tests/check.sh
# none WHAT FILE: the file must be empty; each of its lines is named
none() {
    if [ -s "$2" ]; then fail "$1: $(head -n 5 "$2" | tr '\n' ';')"; else pass; fi
}

variable() { make -s --no-print-directory --eval="print: ; @echo \$($1)" print; }
warn=$(variable WARN)
strict="-std=c99 -pedantic $warn -Ilib"

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

for file in lib/*.[ch]; do code "$file"; done | grep -E '\<(float|double|_Complex|long double)\>' >"$tmp/found"
none "floating-point type in lib/" "$tmp/found"
for file in lib/*.[ch]; do code "$file"; done | grep -E '[^A-Za-z0-9_.](([0-9]+\.[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?|[0-9]+[eE][-+]?[0-9]+)[fFlL]?' |
    grep -v -E '^lib/gnomon\.h:[0-9]+:#define GN_(FIX_|U?Q[0-9]+|TURN)\(' >"$tmp/found"
none "floating-point constant in lib/ outside the macros of gnomon.h" "$tmp/found"

root=$PWD
for variant in general strict; do
    mkdir -p "$tmp/$variant"
    case $variant in
    general) flags="-O2 -mgeneral-regs-only" ;; # any floating-point arithmetic is an error
    strict) flags="-O2 -Wvla -ffreestanding" ;;
    esac
    if (cd "$tmp/$variant" && gcc -std=c99 -pedantic $warn -I"$root/lib" -DGN_RAW_VIEWS=1 $flags -c "$root"/lib/*.c) >"$tmp/log" 2>&1; then pass
    else fail "lib/ does not compile with $flags: $(grep -m 1 error "$tmp/log")"; fi
done
objdump -d --no-show-raw-insn "$tmp"/general/*.o | grep -E '%[xyz]mm|%st|[[:space:]]f(ld|st|add|mul|div|sub|ild|ist)' >"$tmp/found"
none "floating-point instruction" "$tmp/found"
[ "$(objdump -d "$tmp"/general/*.o | wc -l)" -gt 1000 ] && pass || fail "objdump shows no instructions"

nm -A -u "$tmp"/strict/*.o | awk '{ print $NF }' | sort -u >"$tmp/undefined"
nm -A --defined-only "$tmp"/strict/*.o | awk '{ print $NF }' | sort -u >"$tmp/defined"
comm -23 "$tmp/undefined" "$tmp/defined" | grep -v -x -E \
    'mem(set|cpy|move|cmp)|_GLOBAL_OFFSET_TABLE_|__(u?(div|mod|divmod)|mul|ash[lr]|lshr|clz|popcount)[a-z]*[sdt]i[234]' >"$tmp/found"
none "lib/ needs more than the mem functions and integer helpers" "$tmp/found"
grep -x -q memset "$tmp/undefined" && pass || fail "nm lists no undefined symbols"
nm -A --defined-only "$tmp"/strict/*.o | awk '$(NF - 1) ~ /^[dDbBCsSgG]$/ { print $1, $NF }' >"$tmp/found"
none "writable static data in lib/" "$tmp/found"
size -A "$tmp"/strict/*.o | awk '/:$/ { f = $1 } $1 ~ /^\.(data|bss|tdata|tbss)/ && $2 > 0 { print f, $1, $2 }' >"$tmp/found"
none ".data or .bss in lib/ is not empty" "$tmp/found"
size -A "$tmp"/strict/*.o | grep -q '^\.text' && pass || fail "size lists no sections"
for file in lib/*.[ch]; do code "$file"; done | grep -E '\<(malloc|calloc|realloc|free|alloca|setjmp|longjmp|goto)\>' >"$tmp/found"
none "malloc and the like in lib/" "$tmp/found"

# No recursion: the graph of calls, from the relocations of each function compiled into its own section, has no cycle.
mkdir -p "$tmp/calls"
(cd "$tmp/calls" && gcc -std=c99 -I"$root/lib" -DGN_RAW_VIEWS=1 -O0 -fno-inline -fdump-rtl-expand -c "$root"/lib/*.c) >"$tmp/log" 2>&1
cat "$tmp"/calls/*.expand | awk '
    /^;; Function / { from = $3 }
    /\(call / && match($0, /symbol_ref[^"]*\("[^"]*"/) { to = substr($0, RSTART, RLENGTH); gsub(/.*\("|"/, "", to); print from, to }' |
    sort -u >"$tmp/graph"
[ "$(wc -l <"$tmp/graph")" -gt 50 ] && pass || fail "the graph of calls has $(wc -l <"$tmp/graph") edges"
awk '$1 == $2 { print $1 " calls itself" }' "$tmp/graph" >"$tmp/found"
tsort "$tmp/graph" >/dev/null 2>>"$tmp/found"
none "recursion in lib/" "$tmp/found"

# ---- Who includes whom -----------------------------------------------------------------------------------------------------

grep -H -E '^[[:space:]]*#[[:space:]]*include' lib/*.[ch] | grep -v -E '<(stdint|stddef|string)\.h>|"(gnomon|gn_[a-z_]+)\.h"|(GN_USER_CONFIG|GN_PORT)$' >"$tmp/found"
none "lib/ includes more than itself, stdint.h, stddef.h and string.h" "$tmp/found"
grep -h -E '^ *#include "gn' lib/*.[ch] | sed 's/.*"\(.*\)".*/\1/' | sort -u | while read -r header; do
    [ -f "lib/$header" ] || echo "$header"
done >"$tmp/found"
none "lib/ includes a header that it does not have" "$tmp/found"

# gn_frame.c's table of contents, as "name rank kind": its lines are in the order of the stages; what stands in parentheses is a
# service, which ranks as the stage that it is first named for. Nobody includes a stage of a later rank.
awk 'FNR > 1 && /\*\// { exit } /^ \*   / {
    line = $0 # parentheses may go on in the next
    while (match(line, /[()]|gn_[a-z_]+/)) {
        word = substr(line, RSTART, RLENGTH)
        line = substr(line, RSTART + RLENGTH)
        if (word == "(") depth++
        else if (word == ")") depth--
        else if (!seen[word]++ && word !~ /^gn_(begin|shadow_tile|prepare|screen_tile)$/) print word, FNR, depth ? "service" : "stage"
    }
}' lib/gn_frame.c >"$tmp/order"
for stage in gn_scene gn_xform gn_views gn_atlas gn_setup gn_bin gn_raster gn_shade; do
    grep -q "^$stage [0-9]* stage$" "$tmp/order" && pass || fail "lib/gn_frame.c's table of contents has no stage $stage"
done
while read -r name rank kind; do
    [ -f "lib/$name.c" ] || echo "$name is named in lib/gn_frame.c, and there is no such file"
    for file in "lib/$name.c" "lib/$name.h"; do
        [ -f "$file" ] || continue
        for header in $(sed -n 's/^#include "\(gn_[a-z]*\)\.h"/\1/p' "$file"); do
            awk -v header="$header" -v rank="$rank" -v file="$file" \
                '$1 == header && $2 > rank && $3 == "stage" { print file " includes " header ".h" }' "$tmp/order"
        done
    done
done <"$tmp/order" >"$tmp/found"
none "a stage includes a later one" "$tmp/found"
for file in lib/*.c; do # and nobody below the frame includes it, nor is left out of the table of contents
    name=$(basename "$file" .c)
    case $name in gn_frame | gn_affine | gn_curves | gn_math | gn_q | gn_tables) continue ;; esac
    grep -q "^$name " "$tmp/order" || echo "$name"
done >"$tmp/found"
none "not named in lib/gn_frame.c's table of contents" "$tmp/found"

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

# ---- Folders of the host: host/README.md lists them, each above those that may include it ---------------------------------

sed -n 's/^| `\([a-z/]*\)\/` .*/host\/\1/p' host/README.md >"$tmp/rooms"
find host -name '*.[ch]' | sed 's|/[^/]*$||' | sort -u | grep -v -x -F -f "$tmp/rooms" >"$tmp/found"
none "a folder that host/README.md does not list" "$tmp/found"
# "folder folder" for every include of another folder, the path of the header resolved
find host -name '*.[ch]' | xargs awk '/^#[[:space:]]*include "[^"]*\// {
    match($0, /"[^"]*"/)
    n = split(FILENAME, path, "/") - 1 # without the file itself
    m = split(substr($0, RSTART + 1, RLENGTH - 2), part, "/")
    for (i = 1; i < m; i++) if (part[i] == "..") n--; else path[++n] = part[i]
    folder = path[1]
    for (i = 2; i <= n; i++) folder = folder "/" path[i]
    from = FILENAME
    sub(/\/[^\/]*$/, "", from)
    if (folder ~ /^host/) print from, folder
}' | sort -u >"$tmp/arrows"
[ "$(wc -l <"$tmp/arrows")" -gt 30 ] && pass || fail "the folders of the host have $(wc -l <"$tmp/arrows") arrows"
awk 'NR == FNR { rank[$1] = FNR; next } !($2 in rank) || rank[$2] >= rank[$1] { print $1 " includes " $2 }' "$tmp/rooms" "$tmp/arrows" >"$tmp/found"
none "a folder of the host includes one that stands below it in host/README.md" "$tmp/found"

# ---- Sizes -----------------------------------------------------------------------------------------------------------------

find lib port -name '*.[chS]' 2>/dev/null | xargs awk 'FNR == 1 { n = 0 } ++n == 701 { print FILENAME ": over 700 lines" }' >"$tmp/found"
none "a file is too long" "$tmp/found"
find lib port -name '*.c' 2>/dev/null | xargs awk '/^\{/ { start = FNR } /^\}/ { if (start && FNR - start - 1 > 70) print FILENAME ":" start ": " FNR - start - 1 " lines"; start = 0 }' >"$tmp/found"
none "a function is too long" "$tmp/found"
[ "$(grep -c '^{' lib/gn_frame.c)" -gt 10 ] && pass || fail "functions do not begin with a brace in the first column"

# ---- Generated files and documents -----------------------------------------------------------------------------------------

if make -s BUILD="$tmp/gen" "$tmp/gen/gen_tables" >"$tmp/log" 2>&1 && "$tmp/gen/gen_tables" >"$tmp/gn_tables.c"; then
    if cmp -s "$tmp/gn_tables.c" lib/gn_tables.c; then pass; else fail "lib/gn_tables.c is not what host/generate/gen_tables.c writes: make tables"; fi
else
    fail "gen_tables does not build: $(grep -m 1 error "$tmp/log")"
fi

if [ -f README.md ]; then
    awk '/^```c$/ { inside = 1; text = ""; next } /^```/ { if (inside && text ~ /gnomon\.h/) { printf "%s", text; exit } inside = 0 }
        inside { text = text $0 "\n" }' README.md >"$tmp/example.c"
    if [ ! -s "$tmp/example.c" ]; then fail "README.md has no C example that includes gnomon.h"
    elif ! gcc $strict -O1 -o "$tmp/example" "$tmp/example.c" lib/*.c >"$tmp/log" 2>&1; then
        fail "README.md's example does not build: $(grep -m 1 -E 'error|undefined' "$tmp/log")"
    elif ! (cd "$tmp" && timeout 20 ./example >example.out 2>&1 </dev/null); then
        fail "README.md's example exits with a failure"
    else pass; fi
else
    fail "there is no README.md"
fi

make -s help >"$tmp/help" 2>&1
for target in $(sed -n 's/^\.PHONY: *//p' Makefile); do
    [ "$target" = test-programs ] && continue # for the test runner
    grep -q "make $target " "$tmp/help" && pass || fail "make help does not list $target"
done

if [ ! -x build/gnomon ]; then fail "there is no build/gnomon"
elif ! grep -q 'generated' docs/CONFIG.md 2>/dev/null; then fail "docs/CONFIG.md has no generated section"
else
    build/gnomon knobs | sed '/./,$!d' >"$tmp/knobs"
    # the generated section: what stands between the two marker comments
    awk '/<!-- *generated/ { inside = 1; next } /<!-- *(end|\/generated)/ { inside = 0 } inside' docs/CONFIG.md | sed '/./,$!d' >"$tmp/section"
    # blank lines at the ends do not count
    if [ "$(cat "$tmp/knobs")" = "$(cat "$tmp/section")" ] && [ -s "$tmp/knobs" ]; then pass
    else fail "docs/CONFIG.md is not what 'gnomon knobs' prints: make docs ($(diff "$tmp/knobs" "$tmp/section" | sed -n 2p))"; fi
fi

if [ ! -x build/test_extremes_many ]; then fail "there is no build/test_extremes_many"
else
    for part in extremes extremes_light extremes_many; do build/test_$part --table; done | sed '/./,$!d' >"$tmp/extremes"
    awk '/<!-- generated: extremes/ { inside = 1; next } /<!-- end/ { inside = 0 } inside' docs/EXTREMES.md | sed '/./,$!d' >"$tmp/section"
    if cmp -s "$tmp/extremes" "$tmp/section" && [ -s "$tmp/section" ]; then pass
    else fail "docs/EXTREMES.md is not what the --table of test_extremes, test_extremes_light and test_extremes_many prints: make docs ($(diff "$tmp/extremes" "$tmp/section" | sed -n 2p))"; fi
fi

git ls-files --cached --others --exclude-standard -z | xargs -0 grep -I -n -H -E '[[:space:]]$' 2>/dev/null | cut -c 1-100 >"$tmp/found"
none "trailing white space" "$tmp/found"
git ls-files --cached --others --exclude-standard -z | xargs -0 grep -I -l -P '\t' 2>/dev/null | grep -v -E '(^|/)(Makefile|[^/]*\.mk)$' >"$tmp/found"
none "tabs outside Makefile" "$tmp/found"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
