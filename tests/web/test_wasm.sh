#!/bin/sh
# The playground is built, not optimised, with every warning an error, and its tool draws one scene in node as the native tool
# does. The optimised page, in node and in a browser: make test-playground. usage: test_wasm.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh

web=build/test/web
if make -s BUILD=$web WASM_OPT=-O0 WERROR=-Werror $web/playground.html >"$tmp/log" 2>&1; then
    pass
    grep -n -E '^@[a-z.]*@$|https?://|@import|url\(|<link|<iframe' $web/playground.html >"$tmp/found"
    [ -s "$tmp/found" ] && fail "the page refers to something: $(head -c 200 "$tmp/found")" || pass
    node tests/web/one_scene.js $web/gnomon.wasm "$tool" "$tmp" >"$tmp/out" 2>&1
    line=$(tail -n 1 "$tmp/out" | grep -E '^[0-9]+ passed, [0-9]+ failed$' || echo "0 passed, 1 failed")
    grep -v '^[0-9]* passed, ' "$tmp/out" | head -n 8
    passed=$((passed + ${line%% *})) failed=$((failed + $(echo "$line" | cut -d' ' -f3)))
else fail "the playground does not build: $(grep -m 3 -E 'error:|Error |The playground needs' "$tmp/log" || tail -n 1 "$tmp/log")"; fi

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
