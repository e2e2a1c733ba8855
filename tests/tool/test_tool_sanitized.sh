#!/bin/sh
# Every command of the tool under the address and undefined-behaviour sanitizers, on small pictures of scenes that use most features.
# It has the objects of the programs that tests/run.sh builds before. Environment: SANITIZED_BY=gcc, as make soak runs it, too.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh
. tests/support/sanitized.sh
case ${SANITIZED_BY:-clang} in gcc) flags=$sanitized_gcc ;; *) flags=$sanitized_clang ;; esac
dir=${flags#BUILD=} dir=${dir%% *}
if ! make -s -j2 $flags SAN="$sanitizers" "$dir/gnomon" >"$tmp/log" 2>&1; then
    echo "the sanitized tool does not build: $(grep -m 1 -E 'error|undefined' "$tmp/log")"
    echo "0 passed, 1 failed"
    exit 1
fi

# expect STATUS ARGUMENTS...: that exit status, and no report of a sanitizer
expect() {
    expected=$1
    shift
    timeout 100 "$dir/gnomon" "$@" >"$tmp/out" 2>"$tmp/err" </dev/null
    status=$?
    found=$(grep -m 1 -E 'runtime error|ERROR: .*Sanitizer' "$tmp/err")
    if [ -n "$found" ]; then fail "gnomon $*: $found"
    elif [ $status != "$expected" ]; then fail "gnomon $*: exits with $status, not $expected: $(head -n 1 "$tmp/err")"
    else pass; fi
}

tiny="--size 24x18"
sundial=host/scenes/sundial.gltf
printf 'v -1 0 -1\nv 1 0 -1\nv 0 2 0\nv 0 0 1\nf 1 3 2\nf 2 3 4\nf 4 3 1\n' >"$tmp/solid.obj"

expect 0 --version
expect 0 help
expect 0 knobs
expect 0 compile --help
expect 2 render
for scene in $sundial host/scenes/mixed.gltf host/scenes/fence.gltf "$tmp/solid.obj"; do
    expect 0 render "$scene" -o "$tmp/a.png" $tiny
    expect 0 info "$scene" $tiny
    expect 0 compare "$scene" $tiny --json
done
for engine in reference truth; do expect 0 render $sundial -o "$tmp/a.png" $tiny --engine $engine; done
for view in shadow depth normal cascade atlas; do expect 0 render $sundial -o "$tmp/a.png" $tiny --view $view; done
for preset in tiny fast accurate; do expect 0 render host/scenes/room.gltf -o "$tmp/a.png" $tiny --set preset=$preset; done
expect 0 compare host/scenes/desk.gltf $tiny --with truth -o "$tmp/compared"
expect 0 info $sundial $tiny --json --frames 0-2 --board mps2-an385
expect 0 compile $sundial -o "$tmp/compiled" $tiny --frames 0-2
expect 0 compile host/scenes/mixed.gltf -o "$tmp/compiled" $tiny --frames 0-1 --simplify safe
expect 1 compile "$tmp/solid.obj" -o "$tmp/compiled" $tiny --ram 6000
expect 0 bake host/scenes/room.gltf -o "$tmp/baked.gltf" $tiny --texels 64
expect 0 render "$tmp/baked.gltf" -o "$tmp/a.png" $tiny
expect 0 bake "$tmp/solid.obj" -o "$tmp/baked.glb" $tiny --texels 0
expect 0 sweep "$tmp/solid.obj" $tiny --quick --csv "$tmp/a.csv" --svg "$tmp/a.svg"
expect 0 sweep $sundial --size 16x12 --quick --json
expect 0 advise "$tmp/solid.obj" --size 16x12 --ram 20000 --quick

# what is damaged is refused, not read beyond its end
head -c 700 $sundial >"$tmp/cut.gltf"
printf 'glTF\002\000\000\000\377\377\377\177' >"$tmp/cut.glb"
for file in "$tmp/cut.gltf" "$tmp/cut.glb" "$tmp/missing.obj"; do expect 1 info "$file" $tiny; done

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
