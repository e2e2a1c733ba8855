#!/bin/sh
# Budgets of flash, RAM and stack on the targets, and what linked images must not hold. Figures: tests/firmware/size.sh. THOROUGH=1: of every preset.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh

if ! command -v arm-none-eabi-gcc >/dev/null 2>&1; then
    echo "arm-none-eabi-gcc is not installed"
    echo "0 passed, 1 failed"
    exit 1
fi
sh tests/firmware/size.sh --figures some >"$tmp/now" || fail "tests/firmware/size.sh fails"

# within: KIND CORE CONFIGURATION NAME LIMIT
within() {
    value=$(awk -v key="$1 $2 $3 $4" '$1 " " $2 " " $3 " " $4 == key { print $5 }' "$tmp/now")
    if [ -n "$value" ] && [ "$value" -le "$5" ]; then pass; else fail "$1 of $3 on $2: ${value:-not measured}, at most $5"; fi
}

# ---- Faults of images -------------------------------------------------------------------------------------------------------

grep '^fault' "$tmp/now" | while read -r kind core configuration what n; do
    if [ "$n" = 0 ]; then echo pass; else echo "$core, $configuration: $n of $what"; fi
done >"$tmp/faults"
passed=$((passed + $(grep -c '^pass$' "$tmp/faults")))
grep -v '^pass$' "$tmp/faults" >"$tmp/found"
while read -r line; do fail "$line"; done <"$tmp/found"
[ "$passed" -ge 35 ] && pass || fail "only $passed checks of images"

# The graph finds what it looks for: an image with all of it.
cat >"$tmp/bad.c" <<'EOF_C'
int deep(int n, int (*of)(int));
int deep(int n, int (*of)(int))
{
    volatile char room[n + 1];
    room[n] = 0;
    return n > 0 ? deep(n - 1, of) + room[n] + of(n) + 1 : 0;
}
long long slow(long long a, long long b);
long long slow(long long a, long long b)
{
    volatile int frame[25];
    frame[0] = 1;
    return a / b + frame[0];
}
int entry(int n);
int entry(int n) { return (int)slow(n, 3) + deep(n, entry); }
EOF_C
if arm-none-eabi-gcc -mcpu=cortex-m3 -mthumb -O1 -ffreestanding -fstack-usage -nostdlib -Wl,-e,entry -o "$tmp/bad" "$tmp/bad.c" -lgcc 2>"$tmp/log"; then
    find "$tmp" build/tmp -maxdepth 1 -name '*bad.su' >"$tmp/su"
    arm-none-eabi-objdump -d --no-show-raw-insn "$tmp/bad" | awk -f tests/firmware/call_graph.awk $(cat "$tmp/su") - >"$tmp/graph"
    for line in "recursion deep" "unbounded deep" "indirect deep" "call slow __aeabi_ldivmod"; do
        grep -q -x "$line" "$tmp/graph" && pass || fail "the call graph does not see: $line"
    done
    depth=$(awk '$1 == "stack" && $2 == "slow" { print $3 }' "$tmp/graph")
    [ "${depth:-0}" -ge 116 ] && [ "${depth:-0}" -le 200 ] && pass || fail "stack of slow: $depth"
else fail "$(cat "$tmp/log")"; fi

# ---- The stack in the emulator: the bound holds, and is not far off -----------------------------------------------------------

# emulated NAME FLAGS...
emulated() {
    name=$1
    shift
    at=build/firmware/mps2-an385/stack-$name
    measured=$(make -s --no-print-directory emulate BOARD=mps2-an385 APP=stack IMAGE="stack-$name" FW_OPT=-Os FW_FLAGS="-fstack-usage $*" 2>&1 | tee "$tmp/log" | sed -n 's/^stack \([0-9]*\) tiles [1-9].*/\1/p')
    bound=$(arm-none-eabi-objdump -d --no-show-raw-insn "$at.elf" | awk -f tests/firmware/call_graph.awk $(find "$at.obj" -name '*.su') - |
        awk '$1 == "stack" && $2 == "board_start" { print $3 }')
    if [ "${measured:-99999}" -le "${bound:-0}" ] && [ $((measured * 10)) -ge $((bound * 7)) ]; then pass
    else fail "stack, $name: measured ${measured:-nothing: $(tail -n 1 "$tmp/log")}, bound ${bound:-none}"; fi
}
emulated balanced
emulated small "$(sh tests/firmware/size.sh --flags small | sed 's/-DGN_CLIPPING=0/-DGN_CLIPPING=1/')" # the app's scene is clipped

# ---- Budgets ----------------------------------------------------------------------------------------------------------------

for configuration in smallest small ${THOROUGH:+tiny fast} balanced accurate full; do within stack Cortex-M3 $configuration gn_render 1072; done
within flash Cortex-M3 full linked 68800 # what a frame need not draw again takes 2 KB; paths that take a fifth of the instructions off at -Os, 8 KB
within flash Cortex-M3 accurate linked 69100
within flash Cortex-M3 smallest linked 8600
within flash Cortex-M0 smallest linked 10700
within flash Cortex-M3 small linked 22500 # a frame is checked apart from where it begins; 3 KB of these paths
within ram Cortex-M3 smallest total 17000

# ---- Growth -----------------------------------------------------------------------------------------------------------------

awk '
    /^#/ { next }
    FNR == NR { was[$1, $2, $3, $4] = $5; next }
    $1 != "fault" && ($1, $2, $3, $4) in was {
        n++
        if ($5 * 100 > was[$1, $2, $3, $4] * 102 && $5 - was[$1, $2, $3, $4] > 8)
            print $1 ", " $2 ", " $3 ", " $4 ": " $5 ", was " was[$1, $2, $3, $4] ": more than 2 % (sh tests/firmware/size.sh --write accepts it)"
    }
    END { if (n < 50) print "only " n + 0 " figures of the baseline were measured" }' tests/firmware/size_baseline.txt "$tmp/now" >"$tmp/grown"
if [ -s "$tmp/grown" ]; then while read -r line; do fail "$line"; done <"$tmp/grown"; else pass; fi

sh tests/firmware/size.sh --tables tests/firmware/size_baseline.txt >"$tmp/tables"
awk '$0 == "<!-- end -->" { on = 0 } on { print } $0 == "<!-- generated: sizes -->" { on = 1 }' docs/data/SIZES.md | cmp -s - "$tmp/tables" && pass ||
    fail "docs/data/SIZES.md is not what tests/firmware/size_baseline.txt makes it"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
