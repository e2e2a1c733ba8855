#!/bin/sh
# The command line: exit codes, one clear line per error, JSON, pictures of every view, every knob. usage: test_tool.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh

run() { timeout 60 "$tool" "$@" >"$tmp/out" 2>"$tmp/err" </dev/null; }

# good ARGUMENTS...: exit 0, nothing on stderr
good() {
    run "$@"
    status=$?
    if [ $status != 0 ]; then fail "'$*' exits with $status: $(head -n 1 "$tmp/err")"
    elif [ -s "$tmp/err" ]; then fail "'$*' succeeds and complains: $(head -n 1 "$tmp/err")"
    else pass; fi
}

# said ARGUMENTS...: exit 0, and something on stderr, each line with the name of the tool
said() {
    run "$@"
    status=$?
    if [ $status != 0 ]; then fail "'$*' exits with $status: $(head -n 1 "$tmp/err")"
    elif [ ! -s "$tmp/err" ]; then fail "'$*' says nothing"
    elif grep -v -q '^gnomon: ' "$tmp/err"; then fail "'$*' does not say who speaks: $(head -n 1 "$tmp/err")"
    else pass; fi
}

# bad STATUS WORD ARGUMENTS...: that exit status, nothing on stdout, one line on stderr with that word (a regular expression); a usage
# error may add the line that names 'gnomon help'
bad() {
    expected=$1 word=$2
    shift 2
    run "$@"
    status=$?
    lines=$(grep -v -c "^'gnomon help[a-z ]*' says" "$tmp/err")
    if [ $status != "$expected" ]; then fail "'$*' exits with $status, not $expected: $(head -n 1 "$tmp/err")"
    elif [ "$lines" != 1 ]; then fail "'$*' complains in $lines lines: $(head -n 2 "$tmp/err" | tr '\n' ';')"
    elif ! head -n 1 "$tmp/err" | grep -q '^gnomon: '; then fail "'$*' does not say who complains: $(head -n 1 "$tmp/err")"
    elif ! head -n 1 "$tmp/err" | grep -q -e "$word"; then fail "'$*' does not name '$word': $(head -n 1 "$tmp/err")"
    elif [ -s "$tmp/out" ]; then fail "'$*' fails and prints: $(head -n 1 "$tmp/out")"
    elif [ "$expected" = 1 ] && [ "$(wc -l <"$tmp/err")" != 1 ]; then fail "'$*' adds a usage hint to a failure of the work"
    else pass; fi
}

# ---- Scenes of the test's own ------------------------------------------------------------------------------------------------

cat >"$tmp/cube.obj" <<'OBJ'
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 3 4 8 7
f 2 3 7 6
f 1 5 8 4
OBJ
cube=$tmp/cube.obj
json='{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36}]}'
while [ $((${#json} % 4)) != 0 ]; do json="$json "; done
word() { # little endian, 4 bytes
    printf "\\$(printf %o $(($1 % 256)))\\$(printf %o $(($1 / 256 % 256)))\\$(printf %o $(($1 / 65536)))\\000"
}
{
    printf glTF && word 2 && word $((12 + 8 + ${#json} + 8 + 36))
    word ${#json} && printf 'JSON%s' "$json"
    word 36 && printf 'BIN\000'
    printf '\000\000\000\000\000\000\000\000\000\000\000\000'           # 0 0 0
    printf '\000\000\200\077\000\000\000\000\000\000\000\000'           # 1 0 0
    printf '\000\000\000\000\000\000\200\077\000\000\000\000'           # 0 1 0
} >"$tmp/triangle.glb"
glb=$tmp/triangle.glb

# ---- What works --------------------------------------------------------------------------------------------------------------

good help
grep -q '^usage: gnomon' "$tmp/out" && pass || fail "help does not say how it is used"
good --help
good knobs
cp "$tmp/out" "$tmp/knobs"
for knob in refresh incremental; do # they act from frame to frame
    grep -q "^| \`$knob\` .*a single picture does not show it" "$tmp/knobs" && pass || fail "knobs does not say that $knob shows in no single picture"
done
good info "$cube" --size 32x24
good info "$glb" --size 32x24
# the arguments that info prints end every bias of the file's: the picture is the one without
good render "$cube" -o "$tmp/without.png" --size 64x48
good info "$cube" --size 64x48
grep -q -x '      bias: automatic' "$tmp/out" && pass || fail "info does not say that the bias is automatic"
for bias in bias_constant=64 bias_slope=9 bias_caster=4 auto_bias=off bias_normal=5 bias_receiver=4 auto_bias=normal "bias_normal=5 --set bias_constant=9 --set bias_caster=1"; do
    # shellcheck disable=SC2086
    good info "$cube" --size 64x48 --set $bias
    mend=$(sed -n 's/^      bias: .*; automatic alone: //p' "$tmp/out")
    # shellcheck disable=SC2086
    good render "$cube" -o "$tmp/a.png" --size 64x48 --set $bias
    cmp -s "$tmp/a.png" "$tmp/without.png" && fail "$bias changes nothing" || pass
    # shellcheck disable=SC2086
    good render "$cube" -o "$tmp/a.png" --size 64x48 --set $bias $mend
    cmp -s "$tmp/a.png" "$tmp/without.png" && pass || fail "$bias is not mended by: $mend"
done
good info "$cube" --size 64x48 --ram 100000
grep -q 'of flash (Cortex-M0, -O2), no --flash given$' "$tmp/out" && pass || fail "info without --flash: $(tail -n 1 "$tmp/out")"
# who set what: a preset sets what belongs to it anew, and a later one of the same name wins
# its tables of RAM have what was set with every preset, before or behind one that is set
for sets in "--set tile_width=16" "--set preset=fast --set tile_width=16"; do
    good info "$cube" --size 64x48 $sets
    for preset in tiny fast balanced accurate; do # 16x16 pixels, or with tiny 16x16, too: cells and pixels, 7 bytes each
        grep -q "^    $preset .*, screen tile 1796, " "$tmp/out" && pass || fail "info $sets: $(grep -m 1 "^    $preset " "$tmp/out")"
    done
    grep "^    .* renderer" "$tmp/out" >"$tmp/set"
    good info "$cube" --size 64x48
    grep "^    .* renderer" "$tmp/out" | cmp -s - "$tmp/set" && fail "info $sets: compiled as without" || pass
done
settings() { # WANTED ARGS: the row of info
    wanted=$1
    shift
    good info "$@" --size 32x24
    grep -q -x "  settings: $wanted" "$tmp/out" && pass || fail "info $*: $(grep '^  settings:' "$tmp/out"), not: $wanted"
}
own='file: cascades=2 max_distance=9 atlas_size=512'
sed '/"fps"/s/"gnomon": {[^}]*}/"gnomon": {"cascades": 2, "max_distance": 9, "atlas_size": 512}/' host/scenes/cube.gltf >"$tmp/own.gltf"
settings 'preset=balanced (default)' "$glb"
settings "preset=balanced (default); $own" "$tmp/own.gltf"
settings "preset=balanced (default); file: cascades=2 (overruled) max_distance=9 atlas_size=512; command line: cascades=3" "$tmp/own.gltf" --set cascades=3
settings "$own (overruled); command line: preset=tiny bias_normal@0=2" "$tmp/own.gltf" --set preset=tiny --set bias_normal@0=2
settings "$own (overruled); command line: preset=tiny (overruled) preset=fast atlas_size=256" "$tmp/own.gltf" --set preset=tiny --set preset=fast --set atlas_size=256
good info "$tmp/own.gltf" --size 32x24 --json --set cascades=3
grep -q '{"key": "cascades", "value": "2", "by": "file", "overruled": 1}' "$tmp/out" && pass || fail "info --json does not say who set cascades"
good compare "$cube" --size 32x24
good render "$glb" -o "$tmp/a.png" --size 32x24
grep -q -x "$tmp/a.png: 32x24, 2 objects, 3 triangles, 1 light; added: ground, camera, light" "$tmp/out" && pass || fail "render says: $(head -n 1 "$tmp/out")"
[ "$(wc -l <"$tmp/out")" = 1 ] && pass || fail "render prints $(wc -l <"$tmp/out") lines"
good render host/scenes/cube.gltf -o "$tmp/a.png" --size 32x24
grep -q -x "$tmp/a.png: 32x24, [0-9]* objects, [0-9]* triangles, 1 light" "$tmp/out" && pass || fail "render of a whole scene says: $(head -n 1 "$tmp/out")"
good render "$glb" -o /dev/stdout --size 32x24 # the picture alone
cp "$tmp/out" "$tmp/b.png"
good render "$glb" -o "$tmp/a.png" --size 32x24
cmp -s "$tmp/a.png" "$tmp/b.png" && pass || fail "render writes more than a picture to /dev/stdout"

# --orbit: around the model, also in the place of a camera of the file
for orbit in 0,0,1 90,-30,2.5 -360,90,0.1; do
    good render "$cube" -o "$tmp/b.png" --size 32x24 --orbit $orbit
    cmp -s "$tmp/a.png" "$tmp/b.png" && fail "--orbit $orbit changes nothing" || pass
done
good render "$cube" -o "$tmp/a.png" --size 32x24
good render "$cube" -o "$tmp/b.png" --size 32x24 --orbit 30,25,1
cmp -s "$tmp/a.png" "$tmp/b.png" && pass || fail "--orbit 30,25,1 is not what is drawn without"
good render host/scenes/cube.gltf -o "$tmp/b.png" --size 32x24 --orbit 0,10,1 # whose own shadows end before that camera begins
grep -q "; added: camera" "$tmp/out" && pass || fail "--orbit leaves the camera of the file: $(head -n 1 "$tmp/out")"
# --turn and --hour: the camera and the sun from where they are; a camera that the file lacks as another's
good render "$cube" -o "$tmp/b.png" --size 32x24 --turn 0,0,1
cmp -s "$tmp/a.png" "$tmp/b.png" && pass || fail "--turn 0,0,1 changes something"
for turn in "--turn 40,0,1" "--turn 0,20,1" "--turn 0,0,1.5" "--hour 8" "--hour 16.5"; do
    good render host/scenes/cube.gltf -o "$tmp/c.png" --size 32x24
    good render host/scenes/cube.gltf -o "$tmp/b.png" --size 32x24 $turn
    cmp -s "$tmp/c.png" "$tmp/b.png" && fail "$turn changes nothing" || pass
done
for hour in "" 5 18.5 nan 9,5 1e1; do bad 2 "^gnomon: --hour: bad value '$hour'" info "$cube" --hour "$hour"; done
bad 2 "^gnomon: --turn: bad value '0,0,0'" info "$cube" --turn 0,0,0
# up=z: what the file's z axis points to is above, and what faces its -y is in front; of OBJ with normals, glTF, and clips
cat >"$tmp/up-y.obj" <<'OBJ'
v -1 0 1
v 1 0 1
v 1 0 -1
v -1 0 -1
v 0 3 0.5
vn 0 0.4 1
f 1//1 2//1 5//1
f 2 3 5
f 3 4 5
f 4 1 5
f 4 3 2 1
OBJ
awk '{ $1 ~ "^v" ? $0 = $1 " " $2 " " (-$4) " " $3 : 0; print }' "$tmp/up-y.obj" >"$tmp/up-z.obj"
good render "$tmp/up-y.obj" -o "$tmp/a.png" --size 48x32
said render "$tmp/up-z.obj" -o "$tmp/b.png" --size 48x32
grep -q -x 'gnomon: the model stands on z = 0 and not on y = 0: if it lies on its side, --set up=z' "$tmp/err" && pass || fail "a model that stands on z = 0: $(cat "$tmp/err")"
cmp -s "$tmp/a.png" "$tmp/b.png" && fail "a model whose z is up stands without up=z"
good render "$tmp/up-z.obj" -o "$tmp/b.png" --size 48x32 --set up=z
cmp -s "$tmp/a.png" "$tmp/b.png" && pass || fail "up=z draws another picture than the model whose y is up"
good render "$tmp/up-z.obj" -o "$tmp/b.png" --size 48x32 --set up=y # who says so needs no remark
awk 'NR == 8 { print "   \"nodes\": [11]"; skip = 1; next } # a root that turns all that were roots
    skip { if (/\]/) skip = 0; next }
    /^ "nodes": \[/ { inside = 1 }
    inside && /^ \]/ { print "  ,{\"matrix\": [1,0,0,0, 0,0,-1,0, 0,1,0,0, 0,0,0,1], \"children\": [0,6,7,8,10]}"; inside = 0 }
    { print }' tests/data/robot.gltf >"$tmp/turned.gltf"
for frame in 0 20; do
    good render "$tmp/turned.gltf" -o "$tmp/a.png" --size 48x32 --frame $frame --clip 0
    good render tests/data/robot.gltf -o "$tmp/b.png" --size 48x32 --frame $frame --set up=z --clip 0
    cmp -s "$tmp/a.png" "$tmp/b.png" && pass || fail "up=z: frame $frame of a glTF file is not the file below a node that turns it"
done
bad 1 'y or z' info "$cube" --set up=x
for orbit in "" 0 0,0 0,0,0 0,0,1, 361,0,1 0,91,1 0,0,101 a,0,1 0,0x1,1 nan,0,1 0,0,1e1 " 0,0,1" 0,,1; do bad 2 "^gnomon: --orbit: bad value '$orbit'" info "$cube" --orbit "$orbit"; done

# png_size FILE: "WIDTHxHEIGHT" from its header, after checking the signature
png_size() {
    od -A n -t u1 -N 24 "$1" 2>/dev/null | tr -s ' \n' '  ' | awk '{
        if ($0 !~ /^ ?137 80 78 71 13 10 26 10 0 0 0 13 73 72 68 82 /) { print "no PNG"; exit }
        print (($17 * 256 + $18) * 256 + $19) * 256 + $20 "x" (($21 * 256 + $22) * 256 + $23) * 256 + $24 }'
}
is_png() { # is_png FILE SIZE WHAT
    size=$(png_size "$1")
    if [ "$size" = "$2" ]; then pass; else fail "$3: $1 is ${size:-missing}, not $2"; fi
    rm -f "$1"
}

plain="--set fit=stable --set tiles=equal" # square tiles of one size

# every view, by either engine [A6]
for engine in fixed reference; do
    for view in colour shadow depth normal cascade atlas; do
        size=33x21
        [ $view = atlas ] && size=64x64
        good render "$cube" -o "$tmp/view.png" --size 33x21 --engine $engine --view $view --set atlas_size=64 $plain
        is_png "$tmp/view.png" $size "--engine $engine --view $view"
    done
done
for engine in fixed reference; do # three of four tiles in a row
    good render "$cube" -o "$tmp/view.png" --size 33x21 --engine $engine --view atlas --set atlas_size=64 $plain --set cascades=3
    is_png "$tmp/view.png" 96x32 "--engine $engine --view atlas, three cascades"
done
for engine in fixed reference; do # a spot light has one tile, a point light six
    good render "$cube" -o "$tmp/view.png" --size 33x21 --engine $engine --view atlas --light 1 --set other_atlas_size=64 $plain --set lights=directional,spot
    is_png "$tmp/view.png" 64x64 "--engine $engine --view atlas, spot light"
    good render "$cube" -o "$tmp/view.png" --size 33x21 --engine $engine --view atlas --set other_atlas_size=64 $plain --set lights=point
    is_png "$tmp/view.png" 96x16 "--engine $engine --view atlas, point light"
    good render "$cube" -o "$tmp/view.png" --size 33x21 --engine $engine --view shadow --light 2 --set lights=point,directional,spot
    is_png "$tmp/view.png" 33x21 "--engine $engine --view shadow, the last of three lights"
done
for view in colour shadow depth normal; do # truth has no maps to show
    good render "$cube" -o "$tmp/view.png" --size 33x21 --engine truth --view $view --samples 2
    is_png "$tmp/view.png" 33x21 "--engine truth --view $view"
done
for view in depth normal; do # what is no shadow is the reference's; so is the colour where there are none
    good render "$cube" -o "$tmp/a.png" --size 33x21 --engine truth --view $view --samples 2
    good render "$cube" -o "$tmp/b.png" --size 33x21 --engine reference --view $view
    cmp -s "$tmp/a.png" "$tmp/b.png" && pass || fail "truth and reference differ in --view $view"
done
good render "$cube" -o "$tmp/a.png" --size 33x21 --engine truth --set strength=0
good render "$cube" -o "$tmp/b.png" --size 33x21 --engine reference --set strength=0
cmp -s "$tmp/a.png" "$tmp/b.png" && pass || fail "truth and reference differ without shadows"
good render "$cube" -o "$tmp/a.png" --size 33x21 --engine truth
good render "$cube" -o "$tmp/b.png" --size 33x21 --engine truth --set atlas_size=16 --set filter=7x7 --set bias_normal=5 # of the maps
cmp -s "$tmp/a.png" "$tmp/b.png" && pass || fail "truth depends on the shadow maps"
good render "$cube" -o "$tmp/b.png" --size 33x21 --engine truth --samples 4
cmp -s "$tmp/a.png" "$tmp/b.png" && fail "--samples changes nothing" || pass
good render "$cube" -o "$tmp/one.png" --size 1x1
is_png "$tmp/one.png" 1x1 "--size 1x1"
good compare "$cube" -o "$tmp/new" --size 33x21
for name in fixed reference error; do is_png "$tmp/new/$name.png" 33x21 "compare -o"; done
good compare "$cube" -o "$tmp/new" --size 16x16 # into a folder that exists
is_png "$tmp/new/beside.png" 56x16 "compare -o, side by side"
for name in fixed reference error; do is_png "$tmp/new/$name.png" 16x16 "compare -o"; done
good compare "$cube" -o "$tmp/new" --size 33x8 --view depth
is_png "$tmp/new/beside.png" 33x32 "compare -o, one below the other"
good compare "$cube" -o "$tmp/new" --size 16x16 --view atlas --set atlas_size=64 $plain --set cascades=3
for name in fixed reference error; do is_png "$tmp/new/$name.png" 96x32 "compare -o --view atlas"; done
is_png "$tmp/new/beside.png" 96x104 "compare -o --view atlas"
bad 1 "no light 1" compare "$cube" -o "$tmp/new" --size 16x16 --view shadow --light 1
bad 1 "tile_height: tiles of 320x240, .*65536" render "$cube" -o "$tmp/a.png" --size 320x240 --set tile_width=320 --set tile_height=240
bad 1 "tiles of 8x1, .*triangle_groups" render "$cube" -o "$tmp/a.png" --size 320x240 --set tile_width=8 --set tile_height=1 --set triangle_groups=16
# lamps inside of unlit bulbs: their insides are turned to the light, and what is seen of them is not
good compare docs/scenes/cones.gltf -o "$tmp/new" --size 64x48 --view shadow --light 3
cmp -s "$tmp/new/fixed.png" "$tmp/new/reference.png" && pass || fail "unlit surfaces in --view shadow differ"

good compare "$cube" --with truth -o "$tmp/three" --size 33x21
for pair in 'fixed against reference: what fixed point' 'reference against truth: what the shadow map' 'fixed against truth: both'; do
    grep -q "$pair" "$tmp/out" && pass || fail "compare --with truth does not report $pair"
done
for name in fixed reference truth error_fixed_reference error_reference_truth error_fixed_truth; do
    is_png "$tmp/three/$name.png" 33x21 "compare --with truth -o"
done
is_png "$tmp/three/beside.png" 107x46 "compare --with truth -o"
# automatic bias at the rim of a spot that grazes, and under one so wide that the normal form would move points too far
for spot in "rim 32 hard" "wide 16 5x5"; do
    set -- $spot
    good compare "tests/data/$1.gltf" --with truth --set "other_atlas_size=$2" --set "other_filter=$3" --json
    grep -qE '"atten_max": (1|0\.[0-9]+)[,}]' "$tmp/out" && fail "a plane shadows itself: $1: $(tr , '\n' <"$tmp/out" | grep atten_max | head -n 1)" || pass
done
# a frustum whose far corners lie beyond the library's coordinates: tight fits hold the picture's edges
good compare tests/data/frustum.gltf --size 128x32 --set preset=balanced --set atlas_size=256 --json
sed -n 's/.*"shadow_mismatch": *\([0-9.e-]*\).*/\1/p' "$tmp/out" | awk '{ n = 1; exit $1 > 0.004 } END { if (!n) exit 1 }' &&
    pass || fail "shadows at the edges of a wide picture: $(cut -c 1-200 "$tmp/out")"
# narrow cones, whose edge turns the last bits of a cosine into much light
for cone in 0.0087 0.0175 0.05 0.1; do
    sed "s/0.0174532925/$cone/" tests/data/narrow.gltf >"$tmp/narrow.gltf"
    for preset in tiny fast balanced accurate; do
        good compare "$tmp/narrow.gltf" --set preset=$preset --json
        [ $preset = accurate ] && same=0.999 psnr=70 || same=0.95 psnr=54 # cells promise a step, not equal pixels: few channels, one step
        sed -n 's/.*"identical": *\([0-9.e-]*\).*"within1": *\([0-9.e-]*\).*"psnr_db": *\([0-9a-z.-]*\).*"shadow_mismatch": *\([0-9.e-]*\).*/\1 \2 \3 \4/p' "$tmp/out" | awk -v same=$same -v psnr=$psnr '{ n = 1; exit $1 < same || $2 < 0.999 || ($3 != "null" && $3 < psnr) || $4 > 0.004 } END { if (!n) exit 1 }' &&
            pass || fail "a spot of $cone around its axis, $preset: $(cut -c 1-200 "$tmp/out")"
    done
done
good compare "$cube" --with truth -o "$tmp/three" --size 60x20 --view shadow # wide pictures: below each other
is_png "$tmp/three/beside.png" 124x68 "compare --with truth -o, wide"

# ---- JSON --------------------------------------------------------------------------------------------------------------------

cat >"$tmp/json.c" <<'EOF_C'
/* json KEY...: stdin is one JSON object on one line, with these keys. */
#include <stdio.h>
#include "host/base/json.h"
int main(int argc, char **argv)
{
    static char text[1 << 20];
    size_t n = fread(text, 1, sizeof text, stdin);
    json_doc doc;
    char error[200];
    if (json_parse(&doc, text, n, error, sizeof error)) {
        printf("%s", error);
        return 1;
    }
    if (doc.root->type != JSON_OBJECT) return printf("no object"), 1;
    for (int i = 1; i < argc; i++)
        if (!json_get(doc.root, argv[i])) return printf("no %s", argv[i]), 1;
    json_free(&doc);
    return 0;
}
EOF_C
if ${CC:-gcc} -std=c11 -D_POSIX_C_SOURCE=200809L -O1 -I. -o "$tmp/json" "$tmp/json.c" host/base/json.c host/base/arena.c -lm >"$tmp/log" 2>&1; then pass
else fail "the JSON checker does not build: $(grep -m 1 error "$tmp/log")"; fi
valid_json() { # valid_json KEYS...: of the last command's output
    if message=$("$tmp/json" "$@" <"$tmp/out") && [ "$(wc -l <"$tmp/out")" = 1 ]; then pass
    else fail "JSON: ${message:-more than one line}: $(head -c 100 "$tmp/out")"; fi
}
odd="$tmp/odd \"name\" \\ é.obj"
cp "$cube" "$odd"
for scene in "$cube" "$odd"; do
    good render "$scene" -o "$tmp/a.png" --size 32x24 --json
    valid_json out width height
    good compare "$scene" --size 32x24 --json
    valid_json identical within1 max_error atten_rms atten_max shadow_mismatch coverage_mismatch ram_bytes
    good compare "$scene" --size 32x24 --with truth --samples 2 --json
    valid_json scene with width height samples ram_bytes fixed_reference reference_truth fixed_truth
    n=$(grep -o '"shadow_mismatch": [^,]*, "coverage_mismatch"' "$tmp/out" | wc -l)
    [ "$n" = 3 ] && pass || fail "compare --with truth --json has $n objects of metrics"
    good info "$scene" --size 32x24 --json
    valid_json objects triangles lights light_list textures alpha casters needs surface_lights shadow_tiles other_tiles ram_bytes settings notes
done
: >"$tmp/empty"
"$tmp/json" <"$tmp/empty" >/dev/null && fail "the JSON checker takes nothing for JSON" || pass

# ---- The command line is wrong: exit 2 ---------------------------------------------------------------------------------------

bad 2 command
bad 2 paint paint "$cube"
bad 2 RENDER RENDER "$cube"
bad 2 scene render
bad 2 scene info --json
bad 2 '-o' render "$cube"
bad 2 '-o' render "$cube" -o
bad 2 '--frobnicate' render "$cube" -o "$tmp/a.png" --frobnicate
bad 2 '-x' info "$cube" -x
bad 2 other.obj info "$cube" other.obj
bad 2 gpu render "$cube" -o "$tmp/a.png" --engine gpu
bad 2 fixed compare "$cube" --with fixed
for view in atlas cascade; do
    bad 2 'no shadow maps' render "$cube" -o "$tmp/a.png" --engine truth --view $view
    bad 2 'no shadow maps' compare "$cube" --with truth --view $view
done
for samples in 0 17 -1 1.5 '' x; do bad 2 '--samples' render "$cube" -o "$tmp/a.png" --engine truth --samples "$samples"; done
bad 2 'truth, not for fixed' render "$cube" -o "$tmp/a.png" --samples 2
bad 2 'truth, not for reference' compare "$cube" --samples 2
bad 2 'info does not use --samples' info "$cube" --samples 2
bad 2 xray render "$cube" -o "$tmp/a.png" --view xray
bad 2 knobs knobs "$cube"
bad 2 'PNG files, .*a.jpg' render "$cube" -o "$tmp/a.jpg"
bad 2 'end in .gltf or .glb, .*a.png' bake "$cube" -o "$tmp/a.png"
said render "$cube" -o "$tmp/a.png" --size 8x8 --frame 3
grep -q 'nothing moves in the file: frame 3 is as frame 0' "$tmp/err" && pass || fail "a frame of a still scene: $(cat "$tmp/err")"
said compare host/scenes/desk.gltf --size 8x8 --frame 900
grep -q 'the animation ends with frame 48, which is drawn for frame 900' "$tmp/err" && pass || fail "a frame beyond the end: $(cat "$tmp/err")"
said render host/scenes/desk.gltf -o "$tmp/a.png" --size 8x8 --frames 47-50
grep -q 'the animation ends with frame 48, which is drawn for frame 50' "$tmp/err" && pass || fail "frames beyond the end: $(cat "$tmp/err")"
for size in 0x0 99999x1 1x99999 -1x5 5x-1 1e3x4 '' x 10 10x 10x10x10 10X10 10.5x10 2049x1 1x2049 99999999999999999999x1 ' 5x5' '5x 5' +5x5; do
    bad 2 '--size' info "$cube" --size "$size"
done
for frame in -1 1.5 '' x 1e3 99999999999999999999; do bad 2 '--frame' info "$cube" --frame "$frame"; done
for light in -1 64 '' one 0.5 - 0x1; do bad 2 "^gnomon: --light: bad value '$light'" render "$cube" -o "$tmp/a.png" --light "$light"; done
bad 2 "^gnomon: --size: bad value 'abc', not WxH" info "$cube" --size abc
bad 2 "bad value 'a?b'" info "$cube" --size "$(printf 'a\nb')" # still one line
bad 2 "bad value ''" render "$cube" -o ''
for flag in -Obanana -Os2 -O4 O2 ''; do bad 2 "--optimise: bad value '$flag'" info "$cube" --optimise "$flag"; done
for flag in -O3:-O2 -Og:-O2 -Oz:-Os; do
    good info "$cube" --size 8x8 --optimise "${flag%:*}"
    grep -q " with ${flag#*:}:$" "$tmp/out" && pass || fail "--optimise $flag: $(grep ' compiled (' "$tmp/out")"
done
# what a command does not use
for option in "--view colour" "--light 0" "--engine fixed"; do bad 2 "info does not use ${option% *}" info "$cube" $option; done
bad 2 "compare does not use --engine" compare "$cube" --engine fixed
bad 2 'render does not use --with' render "$cube" -o "$tmp/a.png" --with reference
bad 2 'info does not use --with' info "$cube" --with reference
bad 2 'info does not use -o' info "$cube" -o "$tmp/a.png"
good compare "$cube" --with reference --size 8x8
set --
while [ $# -lt 130 ]; do set -- "$@" --set strength=1; done
bad 2 '--set' info "$cube" "$@"

# ---- The work fails: exit 1 --------------------------------------------------------------------------------------------------

bad 1 missing.obj info "$tmp/missing.obj"
bad 1 missing.gltf render "$tmp/missing.gltf" -o "$tmp/a.png"
bad 1 'scene.xyz: cannot be opened (no such file)' info "$tmp/scene.xyz"
bad 1 "$tmp" info "$tmp"
mkdir "$tmp/folder.obj" "$tmp/folder.glb" "$tmp/folder.gltf"
for kind in obj glb gltf; do bad 1 "folder.$kind" info "$tmp/folder.$kind"; done
cp "$cube" "$tmp/secret.obj"
chmod 000 "$tmp/secret.obj"
if [ -r "$tmp/secret.obj" ]; then : # root may read anything
else bad 1 secret.obj info "$tmp/secret.obj"; fi
for kind in obj glb gltf; do
    : >"$tmp/empty.$kind"
    bad 1 "empty.$kind" info "$tmp/empty.$kind"
done
total=$(wc -c <"$glb")
for bytes in 1 4 11 12 16 19 20 100 $((total - 37)) $((total - 36)) $((total - 1)); do # inside each part of the file
    head -c "$bytes" "$glb" >"$tmp/cut.glb"
    bad 1 cut.glb info "$tmp/cut.glb"
done
printf '{"asset": {"version": "2.0"},\n "nodes": [1, }\n' >"$tmp/broken.gltf"
bad 1 'broken.gltf.*2:' info "$tmp/broken.gltf"
printf '{"asset":{"version":"2.0"},"scenes":[{"nodes":[7]}],"nodes":[]}' >"$tmp/broken.gltf"
bad 1 'broken.gltf.*/scenes/0' info "$tmp/broken.gltf"
printf '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":3}]}' >"$tmp/broken.gltf"
bad 1 'broken.gltf.*/nodes/0/mesh' info "$tmp/broken.gltf"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 x\nf 1 2 3\n' >"$tmp/broken.obj"
bad 1 'broken.obj:3' info "$tmp/broken.obj"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n' >"$tmp/broken.obj"
bad 1 'broken.obj:4' info "$tmp/broken.obj"
printf 'noise\n' >"$tmp/noise.glb"
bad 1 noise.glb info "$tmp/noise.glb"
cp "$cube" "$tmp/noise.glb" # the first bytes tell the format
good info "$tmp/noise.glb" --size 8x8
grep -q ": the file is OBJ, whatever its name ends in" "$tmp/out" && pass || fail "an OBJ file named .glb: $(cat "$tmp/out")"
bad 1 'no/such' render "$cube" -o "$tmp/no/such/a.png" --size 8x8
bad 1 "$tmp/new" render "$cube" -o "$tmp/new" --size 8x8
bad 2 "cube.obj" compare "$cube" -o "$cube" --size 8x8
bad 1 'no/such' compare "$cube" -o "$tmp/no/such" --size 8x8
if [ -w /dev/full ]; then bad 1 /dev/full render "$cube" -o /dev/full --size 8x8; fi
bad 1 light render "$cube" -o "$tmp/a.png" --size 8x8 --view atlas --light 3
bad 1 light render "$cube" -o "$tmp/a.png" --size 8x8 --view shadow --light 7
bad 1 shadow render "$cube" -o "$tmp/a.png" --size 8x8 --view atlas --set strength=0
[ -e "$tmp/a.png" ] && rm -f "$tmp/a.png"
bad 1 strength render "$cube" -o "$tmp/a.png" --size 8x8 --set strength=2
[ -e "$tmp/a.png" ] && fail "a failed render leaves a picture" || pass

for value in nan inf -inf infinity 1e999 '' ' ' x 1x -1 0 9000 1,2,3 ' 1' '1 ' 0x10 0x1p3 "$(printf '\t5')"; do bad 1 max_distance info "$cube" --size 8x8 --set "max_distance=$value"; done
for value in nan '' 1,2 1,2,3,4 1,,2 -1 red 256 0x1,1,1 1,0x1,1 '1, 2,3' inf,1,1; do bad 1 ambient info "$cube" --size 8x8 --set "ambient=$value"; done
for value in 4.5 '' nan 1e999 x 3 0x40 ' 64'; do bad 1 atlas_size info "$cube" --size 8x8 --set "atlas_size=$value"; done
bad 1 'max_distance' info "$cube" --set max_distance
bad 1 '=1' info "$cube" --set '=1'
bad 1 KEY=VALUE info "$cube" --set ''
bad 1 nonsense info "$cube" --set nonsense=1
bad 1 preset info "$cube" --set preset=huge
bad 1 filter info "$cube" --set filter=9x9
bad 1 cascade_blend info "$cube" --set cascade_blend=mild
bad 1 distance_mode info "$cube" --set distance_mode=far
bad 1 'cascades first' info "$cube" --set cascades=1 --set cascade_ratios=0.5
for value in '' 0.1,0.2 0.1,0.2,0.3,0.4 0.1,0.2,1.5 -0.1,0.2,0.3 0.1,,0.3 0.1,0.2,0.3, nan,1,1 0,0x0,1 '0.1, 0.2,0.3'; do
    bad 1 '3 numbers' info "$cube" --size 8x8 --set cascades=4 --set "cascade_ratios=$value"
done
bad 1 ascending info "$cube" --size 8x8 --set cascades=4 --set cascade_ratios=0.2,0.1,0.3
bad 1 '2 numbers' info "$cube" --size 8x8 --set cascades=3 --set cascade_ratios=0.5
bad 1 '1 number ' info "$cube" --size 8x8 --set cascades=2 --set cascade_ratios=0.1,0.2
bad 1 ground info "$cube" --set ground=2
bad 1 normals info "$cube" --set normals=round
bad 1 'KEY=VALUE' info "$cube" --set "$(printf '%0100d' 0)=1"
bad 1 triangles render "$cube" -o "$tmp/a.png" --size 32x24 --set max_triangles=1
bad 1 references render "$cube" -o "$tmp/a.png" --size 32x24 --set max_tile_refs=1

for value in 1e1 +5 5. .5e1 05; do good info "$cube" --size 8x8 --set "max_distance=$value"; done

# ---- Output that cannot be written, names that are no UTF-8 --------------------------------------------------------------------

if [ -w /dev/full ]; then
    for command in help knobs "info $cube --size 8x8 --json" "compare $cube --size 8x8" "render $cube -o $tmp/a.png --size 8x8 --json"; do
        timeout 60 "$tool" $command >/dev/full 2>"$tmp/err" </dev/null
        status=$?
        if [ $status = 1 ] && [ "$(wc -l <"$tmp/err")" = 1 ] && grep -q '^gnomon: the output' "$tmp/err"; then pass
        else fail "'$command' into a full device exits with $status: $(head -n 1 "$tmp/err")"; fi
    done
fi
wrong=$(printf 'a\377\303\050\355\240\200b') # a stray byte, half a letter, a surrogate
if cp "$cube" "$tmp/$wrong.obj" 2>/dev/null; then
    good info "$tmp/$wrong.obj" --size 8x8 --json
    valid_json objects
    grep -q 'a\\ufffd\\ufffd(\\ufffd\\ufffd\\ufffdb\.obj' "$tmp/out" && pass || fail "no U+FFFD: $(head -c 200 "$tmp/out")"
fi
bad 1 '/a??(???b-é\.obj: cannot be opened (no such file)$' info "$tmp/$wrong-é.obj"
[ "$(grep -c "$tmp.*$tmp" "$tmp/err")" = 0 ] && pass || fail "the path stands twice: $(head -n 1 "$tmp/err")"
bad 1 'a??(???b' render "$cube" -o "$tmp/no/$wrong.png" --size 8x8
sed 's/"Wave!"/"a\\u001b[31m\\u009b"/; s/"torch"/"b\\u0007"/' tests/data/robot.gltf >"$tmp/control.gltf" # nor control characters of a file
good info "$tmp/control.gltf" --size 8x8
grep -q "0 'a?\[31m??', 3 s" "$tmp/out" && grep -q "'b?': " "$tmp/out" && pass || fail "control characters: $(grep "'" "$tmp/out" | cat -v)"
bad 1 "unknown setting 'a?" info "$cube" --set "$(printf 'a\377')=1"

# ---- What the configuration lacks, both engines lack ---------------------------------------------------------------------------

# value NAME: of the last command's JSON, before its lights
value() { sed 's/"lights".*//' "$tmp/out" | sed -n "s/.*\"$1\": *\([-0-9.e+null]*\).*/\1/p"; }
is() { if [ "$(value "$1")" = "$2" ]; then pass; else fail "$3: $1 is $(value "$1"), not $2"; fi; }
differ() { # differ SCENE A B: with these settings, in both engines
    for engine in fixed reference; do
        good render "$1" -o "$tmp/a.png" --size 64x48 --engine $engine --set "$2"
        good render "$1" -o "$tmp/b.png" --size 64x48 --engine $engine --set "$3"
        cmp -s "$tmp/a.png" "$tmp/b.png" && fail "$engine draws $1 alike with $2 and $3" || pass
    done
}
cat >"$tmp/bright.obj" <<'OBJ'
v -1 0 -1 1 0 0
v 1 0 -1 0 1 0
v 0 0 1 0 0 1
v 0 2 0 1 1 1
f 1 2 3
f 1 4 2
f 2 4 3
f 3 4 1
OBJ
differ "$cube" shadows=0 shadows=3
differ "$cube" shadows=3 strength=0
good compare "$cube" --size 64x48 --set shadows=0 --json
is shadow_mismatch 0 'shadows=0'
is atten_max 0 'shadows=0'
for engine in fixed reference; do # no shadows is what lights without a shadow draw
    good render "$cube" -o "$tmp/a.png" --size 64x48 --engine $engine --set shadows=0
    good render "$cube" -o "$tmp/b.png" --size 64x48 --engine $engine --set strength=0
    cmp -s "$tmp/a.png" "$tmp/b.png" && pass || fail "$engine: shadows=0 is not strength=0"
done
bad 1 shadow render "$cube" -o "$tmp/a.png" --size 8x8 --view atlas --set shadows=0
differ "$tmp/bright.obj" vertex_values=1 vertex_values=2
good info "$tmp/bright.obj" --size 8x8
grep -q '^  needs: .* vertex_values=2$' "$tmp/out" && pass || fail "info: $(grep needs: "$tmp/out")"
good compare "$tmp/bright.obj" --size 64x48 --set vertex_values=1 --json
case $(value within1) in 1 | 0.99*) pass ;; *) fail "vertex_values=1: within1 is $(value within1)" ;; esac
for engine in fixed reference; do # smooth normals that are not built are face normals
    good render "$cube" -o "$tmp/a.png" --size 64x48 --engine $engine --set normals=smooth --set vertex_values=2
    good render "$cube" -o "$tmp/b.png" --size 64x48 --engine $engine --set normals=face
    cmp -s "$tmp/a.png" "$tmp/b.png" && pass || fail "$engine: vertex_values=2 does not draw face normals"
    good render "$cube" -o "$tmp/b.png" --size 64x48 --engine $engine --set normals=smooth
    cmp -s "$tmp/a.png" "$tmp/b.png" && fail "$engine: vertex_values=2 changes nothing" || pass
done
for command in info compare; do
    bad 1 "shadows.*3x3" $command "$cube" --size 8x8 --set filter=3x3 --set shadows=2
    bad 1 "many_cascades.*soft" $command "$cube" --size 8x8 --set cascades=2 --set cascade_blend=soft --set many_cascades=1
    bad 1 "shadows.*other_filter" $command "$cube" --size 8x8 --set other_filter=disk --set shadows=5
    bad 1 "setting 'kernel' is gone: .*tents" $command "$cube" --size 8x8 --set kernel=linear
    bad 1 "other_lights.*spot light" $command "$cube" --size 8x8 --set lights=spot --set other_lights=0
    bad 1 "other_lights.*point light" $command "$cube" --size 8x8 --set add_light=point --set other_lights=0
    bad 1 "shadows.*soft light.*4" $command "$cube" --size 8x8 --set softness=soft --set shadows=3
    bad 1 "biases.*bias_receiver" $command "$cube" --size 8x8 --set bias_receiver=0,0,0,1 --set biases=1
    bad 1 "biases.*bias_caster" $command "$cube" --size 8x8 --set bias_caster=1 --set biases=1
    bad 1 "materials.*mixing" $command "$cube" --size 8x8 --set mixing=always --set materials=7
    bad 1 "max_other_tiles is 5" $command "$cube" --size 8x8 --set lights=point --set max_other_tiles=5
    bad 1 "max_width.*8" $command "$cube" --size 8x6 --set max_width=7
    bad 1 "max_height.*6" $command "$cube" --size 8x6 --set max_height=5
    bad 1 "4 needed, max_shadow_tiles is 3" $command "$cube" --size 8x8 --set cascades=4 --set max_shadow_tiles=3
done
good info "$cube" --size 8x6 --set max_width=8 --set max_height=6 --set cascades=4 --set max_shadow_tiles=4 --set filter=3x3 --set shadows=3
good info "$cube" --size 8x6 --set cascades=4 --set cascade_blend=hard --set many_cascades=1
good info "$cube" --size 8x6 --set filter=7x7 --set cascades=4 --set max_shadow_tiles=1 --set shadows=0 # no filter, no tiles
for command in info compare "render -o $tmp/a.png"; do bad 1 "'clipping': 0, and [0-9]* visible triangles are clipped" $command host/scenes/fence.gltf --size 16x12 --set clipping=0; done
bad 1 "'clipping': 1, and casters lie up to [0-9]* texels from a shadow tile's corner, of 8192" render docs/scenes/near.gltf -o "$tmp/a.png" --size 64x64 --set max_distance=1.75 --set cascades=1 --set atlas_size=1024 --set clipping=1
bad 1 'max_objects is 1' compare "$cube" --size 8x8 --set max_objects=1
bad 1 'max_lights is 2' compare "$cube" --size 8x8 --set lights=spot,point,spot --set max_lights=2
bad 1 'surface_lights is 1' compare "$cube" --size 8x8 --set lights=directional,directional --set surface_lights=1
good compare "$cube" --size 8x8 --set lights=directional,directional --set surface_lights=2 --set max_lights=2 --set max_objects=2
good info "$cube" --size 8x8 --set receiver_plane=0 --set receiver_plane@0=1 # what one light uses is built
for knob in object_boxes incremental; do
    for on in 0 1; do
        good render "$cube" -o "$tmp/b.png" --size 64x48 --set $knob=$on --set shadows=3
        [ $on = 0 ] && mv "$tmp/b.png" "$tmp/a.png"
    done
    cmp -s "$tmp/a.png" "$tmp/b.png" && pass || fail "$knob changes the picture"
done
rm -f "$tmp/a.png" "$tmp/b.png"
bad 1 "setting 'tile_lights' is gone: " info "$cube" --size 8x8 --set tile_lights=1
sed 's/{"attributes"/{"material":0,"attributes"/; s/"accessors"/"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1]}}],"accessors"/; s/{"byteLength":36}\]/{"byteLength":36,"uri":"black.bin"}]/' >"$tmp/black.gltf" <<EOF_JSON
$json
EOF_JSON
tail -c 36 "$glb" >"$tmp/black.bin"
good compare "$tmp/black.gltf" --size 16x12 --set background=0 --json # black on black: no error, no PSNR
valid_json psnr_db
is psnr_db null 'equal pictures'
is max_error 0 'equal pictures'

# ---- Lights --------------------------------------------------------------------------------------------------------------------

quiet=       # --json: without remarks
alike() { # alike A B: settings, separated by blanks, that draw the same picture, in both engines
    for engine in fixed reference; do
        good render "$cube" -o "$tmp/a.png" --size 64x48 --engine $engine $quiet $(for set in $1; do echo --set "$set"; done)
        good render "$cube" -o "$tmp/b.png" --size 64x48 --engine $engine $quiet $(for set in $2; do echo --set "$set"; done)
        cmp -s "$tmp/a.png" "$tmp/b.png" && pass || fail "$engine draws $1 and $2 differently"
    done
}
unlike() { # the same, and the pictures differ
    for engine in fixed reference; do
        good render "$cube" -o "$tmp/a.png" --size 64x48 --engine $engine $quiet $(for set in $1; do echo --set "$set"; done)
        good render "$cube" -o "$tmp/b.png" --size 64x48 --engine $engine $quiet $(for set in $2; do echo --set "$set"; done)
        cmp -s "$tmp/a.png" "$tmp/b.png" && fail "$engine draws $1 and $2 alike" || pass
    done
}
unlike 'lights=directional' 'lights=spot'
unlike 'lights=spot' 'lights=point'
unlike 'lights=spot' 'lights=spot,point'
alike 'lights=spot add_light=point' 'lights=spot,point'
alike 'lights=point lights=spot' 'lights=spot'
alike 'lights=spot,point strength@1=0' 'lights=spot,point strength@point=0'
alike 'lights=spot,point strength@1=0' 'lights=spot,point shadow@1=0'
alike 'lights=spot,point strength@0=0 strength@1=0' 'lights=spot,point strength=0'
alike 'lights=spot,point strength=0 strength@1=1' 'lights=spot,point strength@0=0'
unlike 'lights=spot,point strength@0=0' 'lights=spot,point strength@1=0'
unlike 'lights=spot' 'lights=spot shadows=0'
alike 'lights=spot shadows=0' 'lights=spot shadow=0'
unlike 'lights=spot' 'lights=spot mode=baked'
alike 'lights=spot,point mode@1=baked' 'lights=spot'
unlike 'lights=spot filter=hard' 'lights=spot filter=7x7'
alike 'lights=spot filter=hard other_filter=7x7' 'lights=spot filter=7x7'    # other_filter alone is the other atlas's,
alike 'lights=spot other_filter=hard filter=7x7' 'lights=spot filter=7x7'    # filter sets both
alike 'filter=7x7 other_filter=hard' 'filter=7x7'                            # a directional light is in the directional one
alike 'softness=soft filter=hard' 'filter=5x5'
alike 'softness=hard filter=5x5' 'filter=2x2'
alike 'filter=5x5 kernel=tent' 'filter=5x5'
unlike 'filter=disk penumbra=64' 'filter=disk penumbra=0.5'
unlike 'filter=disk penumbra=64 disk_samples=1' 'filter=disk penumbra=64 disk_samples=64'
alike 'bias_receiver=0,0,1,0' 'bias_receiver@0=0,0,1,0'
alike 'auto_bias=normal' 'auto_bias=off bias_normal=4 auto_bias@0=normal'
unlike 'filter=7x7 auto_bias=off bias_normal=0 bias_constant=0' 'filter=7x7 auto_bias=normal'
unlike 'filter=7x7 bias_normal=0 bias_constant=0' 'filter=7x7 bias_normal=0 bias_constant=0 bias_receiver=0,0,8,0'
unlike 'lights=spot' 'lights=spot range=3'
unlike 'lights=spot range=0' 'lights=spot range=3'
unlike 'lights=spot' 'lights=spot near=6.8 range=0'
quiet=--json
alike 'lights=spot range=8 near=9 persp_step=1' 'lights=spot range=8 shadow=0 persp_step=1' # cells are split where they look for shadows
quiet=
unlike 'lights=directional,directional cascades=4' 'lights=directional,directional cascades=4 main_light=1'
unlike 'lights=spot other_atlas_size=32' 'lights=spot other_atlas_size=128'
alike 'refresh=1' 'refresh=2,3'
alike 'caster_culling=0 cascades=4' 'caster_culling=1 cascades=4'
for knob in depth_bits other_depth_bits; do # the reference does not round depths
    kind=directional
    [ $knob = other_depth_bits ] && kind=spot
    for bits in 8 16 32; do good render "$cube" -o "$tmp/view$bits.png" --size 64x48 --view atlas $plain --set lights=$kind --set $knob=$bits; done
    cmp -s "$tmp/view8.png" "$tmp/view16.png" && fail "$knob=8 stores what 16 does" || pass
    good render "$cube" -o "$tmp/b.png" --size 64x48 --view atlas $plain --set lights=$kind --set $knob=32 --engine reference
    is_png "$tmp/b.png" "$(png_size "$tmp/view32.png")" "$knob=32"
done

set --
while [ $# -lt 64 ]; do set -- "$@" spot; done
kinds=$(echo "$@" | tr ' ' ,)
said render "$cube" -o "$tmp/a.png" --size 8x8 --set lights=$kinds # more than lists and atlas hold
grep -q "[0-9] times a light was left out of an object's list of 8: --set object_lights=0 keeps all" "$tmp/err" && pass || fail "render does not say that lights were left out: $(cat "$tmp/err")"
good render "$cube" -o "$tmp/a.png" --size 8x8 --set lights=$kinds --json
good render "$cube" -o "$tmp/a.png" --size 8x8 --set lights=$kinds --set intensity=0.02 --engine reference
said render "$cube" -o "$tmp/a.png" --size 8x8 --set lights=$kinds --set intensity=0.02 --set object_lights=0 --set other_atlas_size=32
grep -q "lights have no shadow tile, so no shadow: [0-9]* 'spot', [0-9]* 'spot'.*, \.\.\.$" "$tmp/err" && [ "$(wc -l <"$tmp/err")" = 1 ] && pass || fail "render does not name lights without a tile: $(cat "$tmp/err")"
said compare "$cube" --size 8x8 --set lights=spot,point,point,point --set other_atlas_size=64 --set tiles=equal --set fit=stable
[ "$(cat "$tmp/err")" = "gnomon: 1 light has no shadow tile, so no shadow: 3 'point'" ] && pass || fail "compare does not name the light without a tile: $(cat "$tmp/err")"
good compare "$cube" --size 8x8 --set lights=spot,point,point,point --set other_atlas_size=64 --json
bad 1 'no more than 64' render "$cube" -o "$tmp/a.png" --size 8x8 --set lights=$kinds,spot
bad 1 'no more than 64' render "$cube" -o "$tmp/a.png" --size 8x8 --set lights=$kinds --set add_light=spot
for value in '' , spot, ,spot sun spot,sun Spot 'spot, point' directionals; do bad 1 "'lights'.*directional, spot and point" info "$cube" --size 8x8 --set "lights=$value"; done
for value in '' spot,point lamp; do bad 1 "'add_light'.*directional, spot and point" info "$cube" --size 8x8 --set "add_light=$value"; done
bad 1 "no light '1', the scene has 1" info "$cube" --size 8x8 --set strength@1=0
bad 1 "no light 'moon'" info "$cube" --size 8x8 --set strength@moon=0
bad 1 "no light ''" info "$cube" --size 8x8 --set strength@=0
bad 1 "no light '99999999999999999999'" info "$cube" --size 8x8 --set strength@99999999999999999999=0
bad 1 "2 lights are named 'spot'" info "$cube" --size 8x8 --set lights=spot,spot --set strength@spot=0
bad 1 "'filter' is not a setting of lights" info "$cube" --size 8x8 --set filter@0=hard
bad 1 "'lights' is not a setting of lights" info "$cube" --size 8x8 --set lights@0=spot
bad 1 "'atlas_size' is not a setting of lights" info "$cube" --size 8x8 --set atlas_size@0=64
bad 1 "'nonsense' is not a setting of lights" info "$cube" --size 8x8 --set nonsense@0=1
bad 1 "'' is not a setting of lights" info "$cube" --size 8x8 --set @0=1
bad 1 "strength" info "$cube" --size 8x8 --set strength@0=2
while read -r key says values; do
    for value in $values; do bad 1 "setting '$key': '$value' is not .*$says" info "$cube" --size 8x8 --set "$key=$value"; done
done <<'LIST'
other_filter disk 9x9 soft 1
mixing always sometimes 1
tiles importance 4 big
softness soft firm 1
auto_bias normal on 2
mode baked dead 0
main_light 1 2 yes
caster_culling 1 2 -1
receiver_plane 1 2 0.5
shadow 1 2 yes
disk_samples 64 0 65 1.5
penumbra 64 -1 65 nan
object_lights 8 -1 9 0.5
mask_channel 3 -2 4 0.5
refresh four 0 1,2,3,4,5 1,2.5 1,,2 -1 65536
bias_receiver four 1,2 1,2,3 1,2,3,4,5 1,2,3,9 -1 1,2,3,x
bias_caster 8 9 -1
near 8192 0 -1 8193
range unlimited 0.001 -1 100001 inf
depth_bits 8 4 12 24
depth_bits 32 0 64
other_depth_bits 8 9 31
other_atlas_size power 100 17
LIST
for set in bias_receiver=1,2,3,4 refresh=1,1,2,4 refresh=3 object_lights=0 mask_channel=-1 range=0.01 range=0 near=0.001 tiles=importance mixing=distance; do
    good info "$cube" --size 8x8 --set lights=spot --set $set
done

# what info says of lights
good info "$cube" --size 16x12 --json --set lights=directional,spot,point,spot --set shadow@3=0 --set other_atlas_size=64 $plain --set atlas_size=64 --set cascades=2
light() { # light WHAT PATTERN: one entry of the last JSON's light_list
    grep -q "$2" "$tmp/out" && pass || fail "info of $1: no $2 in $(sed 's/.*"light_list": \(\[[^]]*\]\).*/\1/' "$tmp/out")"
}
light 'a directional light' '"kind": "directional", "mode": "realtime", "shadow": "realtime", "tiles": 2, "tile_texels": 32}'
light 'a spot light' '"kind": "spot", "mode": "realtime", "shadow": "realtime", "tiles": 1, "tile_texels": 16}'
light 'a point light' '"kind": "point", "mode": "realtime", "shadow": "realtime", "tiles": 6, "tile_texels": 16}'
light 'a light without a shadow' '"kind": "spot", "mode": "realtime", "shadow": "not_wanted", "tiles": 0, "tile_texels": 0}'
light 'what it needs' '"needs": {[^}]*"other_lights": 1'
light 'the tiles of each atlas' '"shadow_tiles": 2, "other_tiles": 7'
good info "$cube" --size 16x12 --json --set lights=point,point,point,spot,spot --set mode@3=baked --set other_atlas_size=64 --set tiles=equal
light 'a spot light after it' '"kind": "spot", "mode": "realtime", "shadow": "realtime", "tiles": 1, "tile_texels": 16}'
light 'a point light without room' '"kind": "point", "mode": "realtime", "shadow": "no_room", "tiles": 0, "tile_texels": 0}'
light 'a baked light' '"kind": "spot", "mode": "baked", "shadow": "not_wanted", "tiles": 0, "tile_texels": 0}'
light 'lights without room' '"other_tiles": 13.*"lights_without_room": 1'
good info "$cube" --size 16x12 --set lights=spot,point,point,point --set other_atlas_size=64 --set tiles=equal --set fit=stable
grep -q "3 'point': point, no room for its shadow" "$tmp/out" && grep -q "0 'spot': spot, 1 shadow tile of 16x16" "$tmp/out" && pass || fail "info does not say which light got a tile"
grep -q 'needs:.* other_lights' "$tmp/out" && pass || fail "info does not name other_lights"
good info host/scenes/mixed.gltf --set preset=balanced
grep -q "'moon': directional, mixed, shadow tiles of [0-9]*x[0-9]* (worth [0-9]* pixels)" "$tmp/out" && pass || fail "info does not say why a tile is as large"
good info host/scenes/mixed.gltf --size 64x48 --orbit 0,0,4 --set cascade_ratios=1 --set range@1=0.01
grep -q "'moon': .* none (its cascade covers no depths)$" "$tmp/out" && grep -q "1 'yard lamp': .*, no shadow: within its range nothing casts, or nothing receives$" "$tmp/out" &&
    grep -q "2 'lantern': .*shadow tiles of +X [0-9]*x[0-9]* (worth [0-9.]* pixels), -X " "$tmp/out" && grep -q "3 'window glow': point, no shadow: none is requested$" "$tmp/out" && pass ||
    fail "info does not say who got what, and why: $(grep "': " "$tmp/out")"
good info host/scenes/room.gltf --size 64x48 --orbit 0,0,20
grep -q "'lamp': point, shadow tiles of +X none (nothing visible needs it), .* -Z [1-9][0-9]*x" "$tmp/out" && pass || fail "info does not say which faces nobody sees"
good info host/scenes/room.gltf --size 64x48 --orbit 0,0,20 --json
light 'a face that nobody sees' '"tile_list": \[{"texels": 0, "rows": 0, "worth_px": 0, "none": "unseen"}'
# texels are shared; even the smallest tiles may be too many
good info host/scenes/room.gltf --size 64x48 --set other_atlas_texels=384 --json
light 'tiles of 8 x 8' '"tile_texels": 8, "tile_list": \[{"texels": 8, "rows": 8, '
bad 1 'shadow tiles take more texels than .*: 384 needed, 320 available' info host/scenes/room.gltf --size 64x48 --set other_atlas_texels=320
good info host/scenes/mixed.gltf --set preset=balanced --set tiles=equal --json
light 'a fitted tile' '"tile_list": \[{"texels": [0-9]*, "rows": [0-9]*, "worth_px": [0-9]*}'
good info "$cube" --size 16x12
grep -q 'needs:.* other_lights' "$tmp/out" && fail "info names other_lights without a need" || pass

# Settings that a light of its kind has no use for.
useless() { # useless LIGHTS SETTING PATTERN: render and compare say so, info lists it
    for command in "render -o $tmp/a.png" compare; do
        said $command "$cube" --size 8x8 --set "lights=$1" --set "$2"
        [ "$(wc -l <"$tmp/err")" = 1 ] && grep -q "^gnomon: $3" "$tmp/err" && pass || fail "$command with $2 does not say '$3': $(cat "$tmp/err")"
    done
    good info "$cube" --size 8x8 --set "lights=$1" --set "$2"
    grep -q "ignored: $3" "$tmp/out" && pass || fail "info with $2 does not list '$3'"
}
useless directional near@0=1 "near of light 'directional' ignored: a directional light has near_offset"
useless point,directional range@1=3 "range of light 'directional' ignored: a directional light reaches everything"
useless spot near_offset@spot=2 "near_offset of light 'spot' ignored: it is not directional"
useless directional,point near_offset@1=2 "near_offset of light 'point' ignored"
good render "$cube" -o "$tmp/a.png" --size 8x8 --set lights=directional,spot --set near@1=1 --set range@1=9 --set near_offset@0=1
good render "$cube" -o "$tmp/a.png" --size 8x8 --set near@0=1 --json

# Lights that cannot do what they are set to: one mask channel for two in one place (M5), baked without anything baked (M9).
lights_noted() { # lights_noted COUNT PATTERN SETTINGS
    good info "$cube" --size 8x8 $(for set in $3; do echo --set "$set"; done)
    [ "$(grep -c "note: .*$2" "$tmp/out")" = "$1" ] && pass || fail "info with $3 does not say '$2' $1 times"
}
shared='share mask channel 2, and their ranges overlap'
lights_noted 1 "lights 0 'spot' and 1 'point' $shared" 'lights=spot,point mode=mixed mask_channel=2'
lights_noted 1 "lights 0 'directional' and 1 'point' $shared" 'lights=directional,point mode=mixed mask_channel=2 range=0.01'
lights_noted 0 "$shared" 'lights=spot,point mode=mixed mask_channel=2 range=0.01' # far from each other
lights_noted 1 "$shared" 'lights=spot,point mode=mixed mask_channel=2 range@0=0.01 range@1=0'
lights_noted 0 'share mask' 'lights=spot,point mode=mixed mask_channel=2 mask_channel@1=1'
lights_noted 0 'share mask' 'lights=spot,point mode=mixed mask_channel=-1'
lights_noted 0 'share mask' 'lights=spot,point mode@0=mixed mask_channel=2'
lights_noted 3 "$shared" 'lights=spot,point,spot mode=mixed mask_channel=2'
lights_noted 1 "light 1 'spot' is baked, but no object has baked light: it contributes nothing" 'lights=point,spot mode@1=baked'
lights_noted 0 'is baked' 'lights=point,spot'
good info "$cube" --size 8x8 --json --set mode=baked
grep -q '"notes": \[.*is baked' "$tmp/out" && pass || fail "info --json does not note a useless baked light"

# A cone that the library cannot draw: what it draws is another, and said to be.
sed 's/"outerConeAngle": [0-9.]*/"outerConeAngle": 1.5707963/' docs/scenes/cones.gltf >"$tmp/cones-wide.gltf"
said render "$tmp/cones-wide.gltf" -o "$tmp/a.png" --size 16x12
grep -q "^gnomon: cone of light [0-9]* '[^']*' is limited to 179 degrees" "$tmp/err" && pass || fail "a cone of 180 degrees is not said to be narrower: $(cat "$tmp/err")"
good render docs/scenes/cones.gltf -o "$tmp/a.png" --size 16x12

# Shadows that are on and in no picture: a near plane beyond all casters. Scenes far beyond the usual shadow distance have shadows.
remarked() { # remarked PATTERN SCENE SETTINGS: render and compare say so in one line, info notes it; all do without
    for command in "render -o $tmp/a.png" compare; do
        said $command "$2" --size 16x12 $(for set in $3; do echo --set "$set"; done)
        [ "$(wc -l <"$tmp/err")" = 1 ] && grep -q "^gnomon: .*$1" "$tmp/err" && pass || fail "$command of $2 with '$3' does not say '$1': $(cat "$tmp/err")"
    done
    good info "$2" --size 16x12 $(for set in $3; do echo --set "$set"; done)
    grep -q "note: .*$1" "$tmp/out" && pass || fail "info of $2 with '$3' does not note '$1'"
}
remarked "light 0 'spot' casts no shadow: its near plane is 90 away, no caster more than [0-9.]*; --set near@0=0\.[0-9]*" "$cube" 'lights=spot near=90 range=0'
remarked "light 1 'point' casts no shadow: .* near@1=" "$cube" 'lights=spot,point near@1=90 range=0'
for set in 'near=90 range=0 shadow=0' 'near=90 range=0 strength=0' 'near=90 range=0 mode=baked' 'near=1 range=0'; do
    good render "$cube" -o "$tmp/a.png" --size 16x12 --set lights=point $(for one in $set; do echo --set "$one"; done)
done
# The floor of near.gltf, seen through a long lens from above and from a thousand units.
far_away() { # far_away HEIGHT: as without a shadow distance of its own
    sed 's/"max_distance": 16, //; s/"zfar": 60/"zfar": 6000/; s/"yfov": 1.22173/"yfov": 0.05/; s/"translation": \[0, 1.1, 0\], "rotation": \[-0.104465, [^]]*\]/"translation": [0, '"$1"', -8], "rotation": [-0.7071068, 0, 0, 0.7071068]/' docs/scenes/near.gltf >"$tmp/away.gltf"
}
far_away 1000
good render "$tmp/away.gltf" -o "$tmp/a.png" --size 64x48
good render "$tmp/away.gltf" -o "$tmp/b.png" --size 64x48 --set shadow=0
cmp -s "$tmp/a.png" "$tmp/b.png" && fail "a scene 1000 away has no shadow" || pass
far_away 99
good render "$tmp/away.gltf" -o "$tmp/a.png" --size 16x12
sed 's/"znear": 0.1/"znear": 100/' "$tmp/away.gltf" >"$tmp/beyond.gltf"
bad 1 'it is 100, the near plane 100; --set max_distance=.*one is [0-9.]* of the scene.s, for [^,]*, [0-9.]* from the origin or the camera' render "$tmp/beyond.gltf" --set max_distance=100 -o "$tmp/a.png" --size 16x12
for scene in host/scenes/*.gltf; do
    good info "$scene" --size 32x24
    grep -q 'note:' "$tmp/out" && fail "info has a note on $scene" || pass
    good render "$scene" -o "$tmp/a.png" --size 32x24
done

# ---- host/run.sh ---------------------------------------------------------------------------------------------------------------

mkdir "$tmp/one" "$tmp/my scenes"
cp "$cube" "$tmp/one/a b.obj"
cp "$cube" "$tmp/my scenes/a b.obj"
sh host/run.sh "$tool" 16x12 "$tmp/run out" "$tmp/one/a b.obj" "$tmp/my scenes/a b.obj" >"$tmp/out" 2>"$tmp/err"
status=$?
[ $status = 0 ] && [ ! -s "$tmp/err" ] && pass || fail "run.sh exits with $status: $(head -n 1 "$tmp/err")"
[ "$(grep -c '^a b\.obj  *\(fast\|balanced\|accurate\)  *[0-9]' "$tmp/out")" = 3 ] && pass || fail "run.sh: no rows of 'a b.obj'"
[ "$(grep -c '^a b\.obj-2  *\(fast\|balanced\|accurate\)  *[0-9]' "$tmp/out")" = 3 ] && pass || fail "run.sh: no rows of the second 'a b.obj'"
for name in 'a b.obj' 'a b.obj-2'; do
    for preset in fast balanced accurate; do is_png "$tmp/run out/$name/$preset/fixed.png" 16x12 run.sh; done
done
sh host/run.sh "$tool" 16x12 "$tmp/run out" "$tmp/missing.obj" "$cube" >"$tmp/out" 2>"$tmp/err"
status=$?
[ $status = 1 ] && pass || fail "run.sh with a missing scene exits with $status"
[ "$(grep -c missing.obj "$tmp/err")" = 1 ] && [ "$(wc -l <"$tmp/err")" = 1 ] && pass || fail "run.sh names the missing scene in $(wc -l <"$tmp/err") lines"
[ "$(grep -c '^cube\.obj ' "$tmp/out")" = 3 ] && pass || fail "run.sh stops at a missing scene"

# ---- Every knob at both ends -------------------------------------------------------------------------------------------------

# "| `name` | low…high |"
sed -n 's/^| `\([a-z_]*\)` | \([0-9.e-]*\)…\([0-9.e-]*\) |.*/\1 \2 \3/p' "$tmp/knobs" >"$tmp/ranges"
[ "$(wc -l <"$tmp/ranges")" -ge 30 ] && pass || fail "'gnomon knobs' lists only $(wc -l <"$tmp/ranges") knobs with a range"
while read -r name low high; do
    for value in "$low" "$high"; do
        run render "$cube" -o "$tmp/knob.png" --size 16x12 --set "$name=$value"
        status=$?
        case $status in
        0) [ -s "$tmp/err" ] && fail "$name=$value: $(head -n 1 "$tmp/err")" || pass ;;
        1) # a capacity that is too small for the scene, or a feature that it needs: said in one line
            if [ "$(wc -l <"$tmp/err")" = 1 ] && grep -q '^gnomon: ' "$tmp/err"; then pass
            else fail "$name=$value is refused without a clear line: $(head -n 1 "$tmp/err")"; fi
            case $name in max_* | atlas_texels | shadows | biases | vertex_* | clipping | persp_step | tile_* | compact) ;;
            *) fail "$name=$value, an end of its range, is refused: $(head -n 1 "$tmp/err")" ;; esac ;;
        *) fail "$name=$value exits with $status" ;;
        esac
    done
    case $low in *[.e]*) below=-1 ;; *) below=$((low - 1)) ;; esac
    bad 1 "$name" info "$cube" --set "$name=$below"
    bad 1 "$name" info "$cube" --set "$name=$((${high%%.*} + 1))"
done <"$tmp/ranges"
for preset in tiny fast balanced accurate; do good info "$cube" --size 16x12 --set preset=$preset; done
for ratios in 0,0,0 1,1,1 0.2,0.2,0.9; do good info "$cube" --size 16x12 --set cascades=4 --set cascade_ratios=$ratios; done
for output in rgb888 rgb565 rgb565_swapped grey8 grey4 mono1; do good compare "$cube" --json --size 33x17 --set output=$output; done
bad 1 output render "$cube" -o "$tmp/x.png" --set output=cmyk
for blend in hard soft dither; do good info "$cube" --size 16x12 --set cascades=4 --set cascade_blend=$blend; done
for mode in depth radius; do good info "$cube" --size 16x12 --set distance_mode=$mode; done
for filter in hard 2x2 3x3 5x5 7x7; do good info "$cube" --size 16x12 --set filter=$filter; done

# Lights that leave most of it white: a remark with an intensity of which the picture is left alone. A factor in the place of the one before.
run render host/scenes/cube.gltf -o "$tmp/a.png" --size 64x48 --set intensity=40
dim=$(sed -n "s/^gnomon: [0-9]* % of what is seen is as bright as it can be: --set \(intensity=[0-9.]*\) dims the lights$/\1/p" "$tmp/err")
[ -n "$dim" ] && pass || fail "lights 40 times as bright: $(head -n 1 "$tmp/err")"
said compare host/scenes/cube.gltf --size 64x48 --set intensity=40
good render host/scenes/cube.gltf -o "$tmp/a.png" --size 64x48 --set intensity=40 --set "${dim:-intensity=0}"
good render host/scenes/cube.gltf -o "$tmp/b.png" --size 64x48 --set "${dim:-intensity=0}"
cmp -s "$tmp/a.png" "$tmp/b.png" && pass || fail "the second intensity is a factor of the first"
good render host/scenes/cube.gltf -o "$tmp/b.png" --size 64x48 --set intensity@0=0.5
good render host/scenes/cube.gltf -o "$tmp/a.png" --size 64x48
cmp -s "$tmp/a.png" "$tmp/b.png" && fail "intensity@0 changes nothing" || pass
good render "$cube" -o "$tmp/a.png" --size 64x48 --set background=1 # white, and not by lights
good render "$cube" -o "$tmp/a.png" --size 64x48 --set intensity=40 --set output=mono1 # white or black

# ---- Animations ------------------------------------------------------------------------------------------------------------

good render "$cube" --size 40x30 --frames 0-3 -o "$tmp/moving.png"
good render "$cube" --size 40x30 --frame 0 -o "$tmp/still.png"
[ "$(grep -a -o fcTL "$tmp/moving.png" | wc -l)" = 4 ] && grep -q -a acTL "$tmp/moving.png" && pass || fail "an animation of four frames has $(grep -a -o fcTL "$tmp/moving.png" | wc -l)"
grep -q -a acTL "$tmp/still.png" && fail "one frame is an animation" || pass
# what later frames take of a first one: all but the shadow tiles, or what changed
later() { good render "$@" -o "$tmp/moving.png"; sed -n 's/.*the next \([0-9]*\) on average [0-9.]* M (\([0-9]*\) %)$/\1 \2/p' "$tmp/out"; }
[ "$(later docs/scenes/edge.gltf --frames 0-4 --set incremental=2)" = "4 0" ] && pass || fail "nothing moves: $(cat "$tmp/out")"
set -- $(later tests/bench/scenes/game.gltf --frames 0-19 --set incremental=2) $(later tests/bench/scenes/game.gltf --frames 0-2)
[ $# = 4 ] && [ $1 = 15 ] && [ $2 -gt 20 ] && [ $2 -lt 60 ] && [ $3 = 2 ] && [ $4 -gt 90 ] && pass || fail "boxes move: $*"
good render "$cube" --size 40x30 --frames 2-2 -o "$tmp/one.png"
grep -q "on average" "$tmp/out" && fail "one frame has later ones" || pass
"$tool" render "$cube" --size 40x30 --frames 0-1 -o /dev/stdout >"$tmp/out" && tail -c 12 "$tmp/out" | grep -q -a IEND && pass || fail "more than the picture in it"
bad 1 "cannot be written\|No such file" render "$cube" --size 8x8 --frames 0-1 -o "$tmp/no/x.png"
bad 2 "bad value" render "$cube" --frames 3-1 -o "$tmp/x.png"

sed 's/"fps": *[0-9]*/"fps": 1000/' host/scenes/cube.gltf >"$tmp/long.gltf"
good info "$tmp/long.gltf" --size 8x8 --set fit=compiled
grep -q "note: fit=compiled looks at 256 of 4001 frames" "$tmp/out" && pass || fail "fits of a long animation: $(grep note: "$tmp/out")"

# ---- Names of what is written ----------------------------------------------------------------------------------------------

cp host/scenes/cube.gltf "$tmp/own.gltf"
bad 2 "must not be" render "$tmp/own.gltf" -o "$tmp/own.gltf"
bad 2 "must not be" render "$cube" -o "$tmp/x.mtl"
for name in a.png a.c a.glb; do
    bad 2 "a folder is written" compile "$cube" -o "$tmp/$name"
    bad 2 "a folder is written" compare "$cube" -o "$tmp/$name"
done
bad 1 "overwrite what the scene is read from" bake "$tmp/own.gltf" -o "$tmp/own.gltf"
cmp -s host/scenes/cube.gltf "$tmp/own.gltf" && pass || fail "the scene was overwritten"
good render "$cube" --size 16x12 -o "$tmp/skin.png"
printf 'newmtl a\nmap_Kd skin.png\n' >"$tmp/skin.mtl"
printf 'mtllib skin.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n' >"$tmp/skin.obj"
bad 1 "overwrite what the scene is read from" render "$tmp/skin.obj" --size 16x12 -o "$tmp/../$(basename "$tmp")/skin.png"
good render "$tmp/own.gltf" --size 16x12 --orbit 0,0,1 -o "$tmp/x.png"
grep -q "sees none" "$tmp/err" && fail "an orbit that sees all is said to see nothing" || pass

# A triangle that shows its back, then what is said to show its front; more triangles than can be drawn, and what is said to help.
printf 'v 0 0 0\nv 0 2 0\nv 1 0 1\nf 1 2 3\n' >"$tmp/back.obj"
"$tool" render "$tmp/back.obj" --size 16x12 -o "$tmp/x.png" >/dev/null 2>"$tmp/err"
orbit=$(sed -n 's/.*backs of faces alone.*--orbit \([0-9.,-]*\) looks.*/\1/p' "$tmp/err")
[ "$orbit" = 135,0,1 ] && pass || fail "a triangle's back: $(cat "$tmp/err")"
good render "$tmp/back.obj" --size 16x12 -o "$tmp/x.png" --orbit "$orbit"
awk 'BEGIN { for (i = 0; i <= 200; i++) for (k = 0; k <= 200; k++) print "v", i, k, sin(i / 9) * sin(k / 9)
    for (i = 0; i < 200; i++) for (k = 1; k <= 200; k++) { a = 201 * i + k; print "f", a, a + 201, a + 202, a + 1 } }' >"$tmp/many.obj"
bad 1 "visible triangles.*: --triangles 58000 leaves few enough" render "$tmp/many.obj" --size 1000x1000 --orbit 0,0,1 -o "$tmp/x.png"
"$tool" render "$tmp/many.obj" --size 1000x1000 --orbit 0,0,1 -o "$tmp/x.png" --triangles 58000 >/dev/null 2>"$tmp/err" && pass || fail "--triangles 58000: $(cat "$tmp/err")"

# ---- Help and version --------------------------------------------------------------------------------------------------------

for command in render compare info sweep advise compile asset bake knobs; do
    good $command --help
    cp "$tmp/out" "$tmp/help"
    head -n 1 "$tmp/help" | grep -q "^usage: gnomon $command" && pass || fail "$command --help does not begin with its usage: $(head -n 1 "$tmp/help")"
    [ "$(grep -c "^  gnomon $command" "$tmp/help")" = 1 ] && pass || fail "$command --help has $(grep -c "^  gnomon $command" "$tmp/help") examples"
    good help $command
    cmp -s "$tmp/out" "$tmp/help" && pass || fail "help $command is not $command --help"
    good $command --set nonsense --help # --help stands above everything else
    [ "$(awk 'length > 100' "$tmp/help" | wc -l)" = 0 ] && pass || fail "$command --help has a line of more than 100 characters"
    # every option that help lists is one of the command
    for option in $(sed -n 's/^  \(--[a-z-]*\).*/\1/p' "$tmp/help"); do
        run $command "$cube" "$option"
        grep -q "does not use\|unknown option" "$tmp/err" && fail "$command --help lists $option, which it does not use" || pass
    done
done
good help
cp "$tmp/out" "$tmp/help"
good --help
cmp -s "$tmp/out" "$tmp/help" && pass || fail "gnomon --help is not gnomon help"
for command in render compare info sweep advise compile asset bake knobs help; do
    grep -q "^  $command\>" "$tmp/help" && pass || fail "help does not list $command"
done
bad 2 nothing help nothing
bad 2 "unknown command rendr: is 'render' meant?" rendr "$cube"
bad 2 "unknown option --frmes: is '--frames' meant?" compile "$cube" --frmes 1-2
bad 2 "unknown command zzzzzz$" zzzzzz
bad 1 "unknown setting 'filtr': is 'filter' meant? ('gnomon knobs' lists them)" info "$cube" --set filtr=2x2
bad 1 "unknown setting 'max_triangle': is 'max_triangles' meant?" info "$cube" --set max_triangle=3
bad 1 "unknown setting 'qqqqqq' (" info "$cube" --set qqqqqq=3
run compile "$cube" --bogus
grep -q "^'gnomon help compile' says how it is used" "$tmp/err" && pass || fail "a mistake after compile does not lead to its help"
for command in render compare info sweep advise compile asset bake; do
    good help $command
    [ "$(sed -n '3,/^options:/p' "$tmp/out" | wc -w)" -ge 15 ] && pass || fail "help $command does not say what it is for"
    example=$(sed -n "s/^  gnomon $command \(.*\)/\1/p" "$tmp/out")
    [ -f "${example%% *}" ] && pass || fail "help $command: there is no ${example%% *}"
    for word in $example; do
        case $word in --*) grep -q -e "^  $word\>" "$tmp/out" && pass || fail "help $command: its example has $word" ;; esac
    done
done
bad 2 also help render bake

# On a terminal: a character for two pixels, no more than fit; elsewhere it says why not.
shown() { # shown COLUMNS ROWS SIZE
    rm -f "$tmp/shown"
    COLORTERM=truecolor script -qec "stty cols $1 rows $2; $tool render host/scenes/cube.gltf --size $3 --set background=1,0,0 --show" /dev/null </dev/null >"$tmp/shown" 2>&1
    awk -v block="$(printf '\342\226\200')" '{ n = gsub(block, "") } n { rows++; all += n } END { print rows + 0 " " all + 0 }' "$tmp/shown"
}
[ "$(shown 80 24 16x8)" = "4 64" ] && pass || fail "--show: a small picture has $(shown 80 24 16x8) characters"
head -n 1 "$tmp/shown" | grep -q "^$(printf '\033')\[38;2;255;0;0m" && grep -q '^16x8, .* triangles' "$tmp/shown" && pass || fail "--show: $(head -n 1 "$tmp/shown" | cut -c 1-60)"
[ "$(shown 8 24 64x48)" = "3 24" ] && [ "$(shown 80 4 64x48)" = "3 24" ] && pass || fail "--show: a large picture has $(shown 80 4 64x48) characters"
bad 1 COLORTERM render "$cube" --show
bad 2 json render "$cube" --show --json
bad 2 nothing nothing --help
bad 2 alone --version now
good --version
wanted=$(sed -n 's/^#define GN_VERSION_STRING "\(.*\)"/gnomon \1/p' lib/gnomon.h)
[ "$(cat "$tmp/out")" = "$wanted" ] && pass || fail "--version prints '$(cat "$tmp/out")', not '$wanted'"
numbers=$(sed -n 's/^#define GN_VERSION_M[A-Z]* *\([0-9]*\)$/\1/p; s/^#define GN_VERSION_PATCH *\([0-9]*\)$/\1/p' lib/gnomon.h | tr '\n' . | sed 's/\.$//')
[ "gnomon $numbers" = "$wanted" ] && pass || fail "GN_VERSION_STRING is '$wanted', the numbers are $numbers"

# ---- Clips, and what surfaces have that the engines have otherwise -----------------------------------------------------------

good info tests/data/robot.gltf --size 16x12 --clip walk
grep -q -x "    0 'Wave!', 3 s" "$tmp/out" && grep -q -x "    1 'walk', 1.5 s, plays" "$tmp/out" && pass || fail "info --clip walk: $(grep -A 2 clips "$tmp/out")"
good info tests/data/robot.gltf --size 16x12 --json --clip 1
valid_json clips
for command in "render -o $tmp/clip" "compare -o $tmp/clip" "compile -o $tmp/clip" "asset -o $tmp/clip" "bake -o $tmp/clip.gltf" sweep; do
    bad 1 "there is no clip 'run': it has 0 'Wave!', 1 'walk'" $command tests/data/robot.gltf --size 16x12 --clip run
done
said render tests/data/robot.gltf -o "$tmp/a.png" --size 48x32 --frame 9
grep -q -x "gnomon: of 2 clips the first plays, 'Wave!': --clip takes another, by name or number" "$tmp/err" && pass || fail "two clips: $(cat "$tmp/err")"
good render tests/data/robot.gltf -o "$tmp/b.png" --size 48x32 --frame 9 --clip 'Wave!'
cmp -s "$tmp/a.png" "$tmp/b.png" && pass || fail "the first clip is not what plays without --clip"
good render tests/data/robot.gltf -o "$tmp/b.png" --size 48x32 --frame 9 --clip walk
cmp -s "$tmp/a.png" "$tmp/b.png" && fail "--clip walk changes nothing" || pass
# alpha of COLOR_0 from 0 at the left to 1 at the right: cut in the middle, mixed with what is behind, and all the same
sed 's/MASK/BLEND/' tests/data/vertex_alpha.gltf >"$tmp/blend.gltf"
for scene in tests/data/vertex_alpha.gltf "$tmp/blend.gltf"; do
    for with in reference truth; do
        good compare "$scene" --set transparent_layers=1 --set background=0 --set shadows=0 --with $with --json
        psnr=$(sed -n 's/.*"psnr_db": *\([0-9.]*\).*/\1/p' "$tmp/out")
        [ "${psnr%.*}" -ge 55 ] && pass || fail "$scene is $psnr dB from $with"
    done
done
# colours that are meant to be of 255 levels
printf 'newmtl a\nKd 0.001 0.002 0.003\n' >"$tmp/dark.mtl"
{ echo 'mtllib dark.mtl'; echo 'usemtl a'; cat "$cube"; } >"$tmp/dark.obj"
good info "$tmp/dark.obj" --size 16x12
grep -q "note: all colours are below 1/256, so that all is black" "$tmp/out" && pass || fail "black colours: $(cat "$tmp/out")"
good info "$cube" --size 16x12
grep -q "all colours are" "$tmp/out" && fail "colours that are not black are said to be" || pass

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
