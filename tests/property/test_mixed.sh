#!/bin/sh
# Program and library of different configurations find out before anything is written; the README's program in C and C++;
# parts of lib/gnomon.c compiled beside it are refused. usage: test_mixed.sh
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh

clang -std=c99 -w -O0 -Ilib -c lib/gnomon.c -o "$tmp/gnomon.o" || fail "the library does not compile"

# mixed WHAT EXPECTED FLAGS...: what gn_init says to a program with these flags
mixed() {
    what=$1 expected=$2
    shift 2
    if ! clang -std=c99 -Wall -Wextra -Werror -O0 -Ilib "$@" -o "$tmp/$what" tests/property/init_mixed.c "$tmp/gnomon.o" 2>"$tmp/$what.log"; then
        echo "$what: does not compile: $(grep -m 1 error "$tmp/$what.log")"
    elif [ "$("$tmp/$what")" != "$expected" ]; then echo "$what: $("$tmp/$what"), not $expected"; fi >"$tmp/$what.found"
    rm -f "$tmp/$what"
}

# Another value of every knob, two at a time: "NAME DEFAULT SMALLEST LARGEST"
sed -n 's/^    X(\([a-z_0-9]*\), \([A-Z_0-9]*\), \([0-9]*\), \([0-9]*\),.*/\1 \2 \3 \4/p' lib/gn_knobs.h >"$tmp/knobs"
[ "$(wc -l <"$tmp/knobs")" -gt 30 ] && pass || fail "$(wc -l <"$tmp/knobs") knobs are found in lib/gn_knobs.h"
{
    echo '#include <stdio.h>'
    echo '#include "gnomon.h"'
    echo 'int main(void) {'
    sed 's/\([^ ]*\) \([^ ]*\) \(.*\)/printf("\1 \2 %d \3\\n", (int)(GN_\2));/' "$tmp/knobs"
    echo 'return 0; }'
} >"$tmp/defaults.c"
gcc -std=c99 -w -Ilib -o "$tmp/defaults" "$tmp/defaults.c" && "$tmp/defaults" >"$tmp/values" || fail "the knobs' values cannot be read"
while read -r name macro now lo hi; do
    other=$lo
    [ "$now" != "$lo" ] || other=$hi
    mixed "$name" "1 untouched" "-DGN_$macro=$other" &
    [ $((count = count + 1)) -lt 2 ] || { wait; count=0; }
done <"$tmp/values"
wait
while read -r name _; do
    [ -s "$tmp/$name.found" ] && fail "$(cat "$tmp/$name.found")" || pass
done <"$tmp/values"
mixed same "0 written" && [ ! -s "$tmp/same.found" ] && pass || fail "$(cat "$tmp/same.found")"
mixed size_first "0 written" -DGN_SIZE_FIRST=1 && [ ! -s "$tmp/size_first.found" ] && pass || fail "$(cat "$tmp/size_first.found")" # no type depends on it
mixed preset "1 untouched" -DGN_PRESET=GN_PRESET_TINY && [ ! -s "$tmp/preset.found" ] && pass || fail "$(cat "$tmp/preset.found")"
mixed enums "1 untouched" -fshort-enums && [ ! -s "$tmp/enums.found" ] && pass || fail "$(cat "$tmp/enums.found")"

# ---- The README's program --------------------------------------------------------------------------------------------------

awk '/^```c$/ { inside = 1; text = ""; next } /^```/ { if (inside && text ~ /gnomon\.h/) { printf "%s", text; exit } inside = 0 }
    inside { text = text $0 "\n" }' README.md >"$tmp/program.c"
cp "$tmp/program.c" "$tmp/program.cpp"
quiet() { # quiet WHAT COMMAND...: it works, and says nothing
    what=$1
    shift
    "$@" >"$tmp/log" 2>&1 && [ ! -s "$tmp/log" ] && pass || fail "$what: $(head -n 1 "$tmp/log")"
}
for cc in gcc clang arm-none-eabi-gcc; do
    case $cc in
    gcc) cxx=g++ core= ;;
    clang) cxx=clang++ core= ;;
    *) cxx=arm-none-eabi-g++ core="-mcpu=cortex-m3 -mthumb" ;;
    esac
    quiet "$cc, library" $cc $core -std=c99 -pedantic -Wall -Wextra -Ilib -c lib/gnomon.c -o "$tmp/lib.$cc.o"
    quiet "$cc, C99" $cc $core -std=c99 -pedantic -Wall -Wextra -Ilib -c "$tmp/program.c" -o "$tmp/c.$cc.o"
    quiet "$cxx, C++11" $cxx $core -std=c++11 -pedantic -Wall -Wextra -Ilib -c "$tmp/program.cpp" -o "$tmp/cpp.$cc.o"
    [ -z "$core" ] || continue
    for language in c cpp; do
        if $cxx -o "$tmp/program" "$tmp/$language.$cc.o" "$tmp/lib.$cc.o" && (cd "$tmp" && timeout 20 ./program) >"$tmp/$language.$cc.out" &&
            grep -q '^ok, 75 tiles$' "$tmp/$language.$cc.out"; then pass
        else fail "$cc: the program in $language says $(tail -n 1 "$tmp/$language.$cc.out")"; fi
    done
done
quiet "as the README says" gcc -Wall -Wextra -Ilib "$tmp/program.c" lib/*.c -o "$tmp/program"

# ---- Parts of the library --------------------------------------------------------------------------------------------------

for part in $(find lib -mindepth 2 -name '*.c'); do
    if gcc -std=c99 -Ilib -fsyntax-only "$part" >"$tmp/log" 2>&1; then fail "$part compiles by itself, unasked"
    elif grep -q 'part of lib/gnomon.c: compile lib/gnomon.c alone' "$tmp/log"; then pass
    else fail "$part: $(grep -m 1 error "$tmp/log")"; fi
done
if awk -f boards/packages/one_file.awk -v root=lib lib/gnomon.c >"$tmp/one.c" &&
    clang -std=c99 -w -O0 -c "$tmp/one.c" -o "$tmp/one.o" 2>"$tmp/log" &&
    [ "$(size "$tmp/one.o" | awk 'NR == 2 { print $4 }')" = "$(size "$tmp/gnomon.o" | awk 'NR == 2 { print $4 }')" ]; then pass
else fail "the library written into one file: $(grep -m 1 error "$tmp/log")"; fi

# ---- Two libraries in one program ------------------------------------------------------------------------------------------

CC=clang sh host/generate/gen_prefix.sh >"$tmp/gn_prefix.h"
cmp -s "$tmp/gn_prefix.h" lib/gn_prefix.h && pass || fail "lib/gn_prefix.h does not name every symbol of the library: make prefix"
for which in general compact; do
    flags="-DGN_PREFIX=${which}_"
    [ $which = general ] || flags="$flags -DGN_COMPACT=1"
    clang -std=c99 -w -O0 -Ilib $flags -c lib/gnomon.c -o "$tmp/$which.lib.o" &&
        gcc -std=c99 -Wall -Wextra -Werror -O0 -Ilib $flags -DDRAW=draw_$which -c tests/property/two_libraries.c -o "$tmp/$which.o"
done
if gcc -Wall -o "$tmp/two" tests/property/two_libraries.c "$tmp"/general.o "$tmp"/general.lib.o "$tmp"/compact.o "$tmp"/compact.lib.o 2>"$tmp/log" &&
    [ "$("$tmp/two")" = "1 1" ]; then pass
else fail "two libraries in one program: $(head -n 1 "$tmp/log") $("$tmp/two")"; fi

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
