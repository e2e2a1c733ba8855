#!/bin/sh
# Proves that what is listed can do nothing undefined, and the bounds that are asserted, for every operand that a contract allows: by
# the value analysis of Frama-C, over the C code of the library, 32-bit int. Each harness, prove_NAME in prove_*.c, names its functions
# in the comment above it. A minute or two. make prove; [NAMES="prove_clz"]: these alone.
# Without Frama-C (Debian: frama-c-base) it says so and does nothing.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh
if ! command -v frama-c >/dev/null 2>&1; then
    echo "nothing proved: frama-c is not installed (Debian: frama-c-base)"
    exit 0
fi

# Of these the code itself stands where others take the contract of prove.h.
whole() {
    case $1 in
    prove_clz | prove_bfloat | prove_quotient | prove_add_over_depth | prove_place_flat) echo "-DWHOLE_CLZ" ;;
    prove_long_division) echo "-DWHOLE_DIVISION" ;;
    esac
}
contracts() {
    case $1 in
    prove_clz | prove_bfloat | prove_quotient | prove_add_over_depth | prove_place_flat) echo "gn_udiv64_rest" ;;
    prove_long_division) echo "gn_clz32,gn_clz64" ;;
    *) echo "gn_clz32,gn_clz64,gn_udiv64_rest" ;;
    esac
}

# Accuracy is first without cells.
preset() { case $1 in *_shade.c) echo GN_PRESET_BALANCED ;; *) echo GN_PRESET_ACCURATE ;; esac; }

# prove FILE NAME: no alarm, and every assertion valid. -U__GNUC__: portable C instead of builtins and hints.
prove() {
    name=$2
    timeout 300 frama-c -eva -main "$name" -lib-entry -machdep gcc_x86_32 -eva-no-show-progress -eva-slevel 3000 -eva-min-loop-unroll 70 \
        -eva-use-spec "$(contracts "$name")" -cpp-extra-args="-Ilib -Itests/prove -DGN_ONE_FILE -DGN_PRESET=$(preset "$1") -U__GNUC__ $(whole "$name")" \
        "$1" >"$tmp/$name" 2>&1
    status=$?
    problem=$(grep -m 1 -A 2 -E 'eva:alarm|got status unknown|got status invalid|rror:' "$tmp/$name" | tr '\n' ' ')
    if [ $status != 0 ]; then fail "$name: frama-c ends with $status: $problem"
    elif [ -n "$problem" ]; then fail "$name: $problem"
    elif ! grep -q "done for function $name" "$tmp/$name"; then fail "$name: was not analysed to its end"
    else pass && echo "proved: $name"; fi
}

for file in tests/prove/prove_*.c; do
    for name in $(sed -n 's/^void \(prove_[a-z0-9_]*\)(void)$/\1/p' "$file"); do
        case " ${NAMES:-$name} " in *" $name "*) prove "$file" "$name" ;; esac
    done
done
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
