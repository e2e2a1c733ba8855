#!/bin/sh
# The playground: the tool as WebAssembly in node gives the native tool's bytes, and the page works in a headless browser. Pictures of
# the page are in build/web. It takes minutes and a browser, so that make test leaves it out: make test-playground. usage: playground.sh
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh

# The browser is installed as root; else it is named. Everything else: tests/deps.sh.
if ! command -v chromium >/dev/null; then
    if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
        echo "installing chromium"
        apt-get -o DPkg::Lock::Timeout=500 update >"$tmp/log" 2>&1
        DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=500 install -y --no-install-recommends chromium >>"$tmp/log" 2>&1 || {
            echo "could not install chromium: $(tail -n 1 "$tmp/log")"
            echo "0 passed, 1 failed"
            exit 1
        }
    else
        echo "not root; please install: chromium"
        echo "0 passed, 1 failed"
        exit 1
    fi
fi

# add COMMAND...: a test that counts for itself
add() {
    "$@" >"$tmp/out" 2>&1 || [ -s "$tmp/out" ] || echo "$* says nothing" >"$tmp/out"
    grep -v '^[0-9]* passed, ' "$tmp/out"
    line=$(tail -n 1 "$tmp/out" | grep -E '^[0-9]+ passed, [0-9]+ failed$' || echo "0 passed, 1 failed")
    passed=$((passed + ${line%% *})) failed=$((failed + $(echo "$line" | cut -d' ' -f3)))
}

make -s -j2 build/gnomon playground >"$tmp/log" 2>&1 && pass || fail "make playground: $(grep -m 1 -E 'error|Error' "$tmp/log")"
[ "$(wc -c <build/playground.html)" -lt 1300000 ] && pass || fail "the page has $(wc -c <build/playground.html) bytes"
grep -n -E '^@[a-z.]*@$|https?://|@import|url\(|<link|<iframe' build/playground.html >"$tmp/found"
[ -s "$tmp/found" ] && fail "the page refers to something: $(head -c 200 "$tmp/found")" || pass

add node tests/web/node.js build/gnomon.wasm build/gnomon "$tmp"
add node tests/web/page.js build/playground.html build/web "$tmp"

# What the page gave away: the picture is the native tool's, and the sketch draws.
(cd host && ../build/gnomon render scenes/cube.gltf --set output=rgb565 -o "../$tmp/native.png" >/dev/null) && cmp -s "$tmp/native.png" "$tmp/cube.png" && pass ||
    fail "the picture that was saved is not the native tool's"
unpack() { # unpack ZIP: nothing in it is compressed
    node -e '
        const fs = require("fs"), {crc32} = require("./tests/web/check.js"), zip = fs.readFileSync(process.argv[1]);
        for (let at = 0; zip.readUInt32LE(at) === 0x04034b50; ) {
            const [n, name] = [zip.readUInt32LE(at + 18), zip.readUInt16LE(at + 26)], file = `${process.argv[2]}/${zip.toString("utf8", at + 30, at + 30 + name)}`;
            fs.mkdirSync(file.replace(/[^\/]*$/, ""), {recursive: true});
            const bytes = zip.subarray(at + 30 + name, at + 30 + name + n);
            if (parseInt(crc32(bytes), 16) !== zip.readUInt32LE(at + 14)) throw new Error(`${file}: another checksum`);
            fs.writeFileSync(file, bytes);
            at += 30 + name + n;
        }' "$1" "$2" 2>"$tmp/log"
}
for zip in cube cube-sketch; do
    unpack "$tmp/$zip.zip" "$tmp/$zip" && [ -s "$tmp/$zip/cube/scene.c" ] && [ -s "$tmp/$zip/cube/gn_scene_config.h" ] && pass || fail "$zip.zip: $(head -n 1 "$tmp/log")"
done
cat >"$tmp/board.cpp" <<'END'
#include <cstdint>
#include <cstdio>
static struct {
    void begin(long) {}
    void print(const char *s) { fputs(s, stdout); }
    void print(uint32_t n) { printf("%u", (unsigned)n); }
    void println(const char *s) { puts(s); }
    void println(unsigned long) { puts("-"); }
} Serial;
static unsigned long millis() { return 0; }
#include "cube.ino"
int main() { setup(); loop(); }
END
(cd "$tmp/cube-sketch/cube" && gcc -std=c99 -O1 -Wall -Wextra -Werror -c gnomon.c scene.c && g++ -std=c++11 -Wall -Wextra -Werror -I. -o ../run ../../board.cpp gnomon.o scene.o) >"$tmp/log" 2>&1 &&
    [ "$("$tmp/cube-sketch/run")" = "ok, pixels: 76800, ms: -" ] && pass || fail "the sketch: $(head -n 3 "$tmp/log")"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
