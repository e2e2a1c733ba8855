#!/bin/sh
# Scene files that ask for far more than they are: each is refused in one line, within two seconds of processor time and 256 MB.
# And what a file may name: regular files, in its own folder. usage: test_budgets.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh

# limited ARGUMENTS...: the tool with so little; a call that waits for something is not ended by its processor time, so by the clock
limited() {
    (
        ulimit -v 262144
        ulimit -t 2
        timeout 20 "$tool" "$@" >"$tmp/out" 2>"$tmp/err" </dev/null
    )
}
# refused WORD SCENE ARGUMENTS...: info and render end with 1 and one line, which has that word (a regular expression)
refused() {
    word=$1
    shift
    for command in info "render -o $tmp/a.png"; do
        limited $command "$@"
        status=$?
        if [ $status != 1 ]; then fail "'$command $*' exits with $status, not 1: $(head -n 1 "$tmp/err")"
        elif [ "$(wc -l <"$tmp/err")" != 1 ]; then fail "'$command $*' complains in $(wc -l <"$tmp/err") lines"
        elif ! grep -q "^gnomon: .*$word" "$tmp/err"; then fail "'$command $*' does not say '$word': $(cat "$tmp/err")"
        elif [ -s "$tmp/out" ]; then fail "'$command $*' fails and prints: $(head -n 1 "$tmp/out")"
        else pass; fi
    done
}
# drawn WORD SCENE ARGUMENTS...: a picture, and the word on stderr; without a word, nothing there
drawn() {
    word=$1
    shift
    rm -f "$tmp/a.png"
    limited render -o "$tmp/a.png" "$@"
    status=$?
    if [ $status != 0 ] || [ ! -s "$tmp/a.png" ]; then fail "'render $*' exits with $status: $(head -n 1 "$tmp/err")"
    elif [ -n "$word" ] && ! grep -q "^gnomon: .*$word" "$tmp/err"; then fail "'render $*' does not say '$word': $(head -n 1 "$tmp/err")"
    elif [ -z "$word" ] && [ -s "$tmp/err" ]; then fail "'render $*' complains: $(head -n 1 "$tmp/err")"
    else pass; fi
}
# repeat N TEXT: so often, with commas between; every @ is the number, from 0
repeat() {
    awk -v n="$1" -v text="$2" 'BEGIN {
        parts = split(text, part, "@")
        for (i = 0; i < n; i++) {
            printf "%s%s", i ? "," : "", part[1]
            for (k = 2; k <= parts; k++) printf "%d%s", i, part[k]
        }
    }'
}
# gltf NAME NODES MESHES MORE...: $tmp/NAME.gltf with accessors of zeros: 0 and 1 of 2^20 corners, 2 of three
zeros='{"componentType":5126,"count":1048576,"type":"VEC3"},{"componentType":5125,"count":1048575,"type":"SCALAR"},{"componentType":5126,"count":3,"type":"VEC3"}'
gltf() {
    name=$1 nodes=$2 meshes=$3
    shift 3
    printf '{"asset":{"version":"2.0"},"nodes":[%s],"meshes":[%s],"accessors":[%s]%s}' "$nodes" "$meshes" "$zeros" "$*" >"$tmp/$name.gltf"
}
small='{"primitives":[{"attributes":{"POSITION":2}}]}'

# ---- Counts without data -----------------------------------------------------------------------------------------------------

gltf huge '{"mesh":0}' '{"primitives":[{"attributes":{"POSITION":3}}]}'
sed 's/"accessors":\[/&{"componentType":5126,"count":2000000000,"type":"VEC3"},/; s/"POSITION":3/"POSITION":0/' "$tmp/huge.gltf" >"$tmp/count.gltf"
refused '/accessors/0: 2000000000 elements without' "$tmp/count.gltf"
gltf vertices '{"mesh":0}' "{\"primitives\":[$(repeat 150 '{"attributes":{"POSITION":0}}')]}"
[ "$(wc -c <"$tmp/vertices.gltf")" -lt 16384 ] && pass || fail "vertices.gltf has $(wc -c <"$tmp/vertices.gltf") bytes"
refused '/POSITION: more than 1048576 vertices: --budget' "$tmp/vertices.gltf"
# vertices of which three are used, with every attribute, in ten meshes
numbers='{"primitives":[{"attributes":{"POSITION":3,"NORMAL":3,"COLOR_0":4,"TEXCOORD_0":5,"TEXCOORD_1":5,"_GNOMON_MASK":4,"_GNOMON_BAKED":3},"indices":6,"material":0}]}'
gltf numbers "$(repeat 10 '{"mesh":@}')" "$(repeat 10 "$numbers")" ',"materials":[{}]'
sed 's|"accessors":\[[^]]*|&,{"componentType":5126,"count":100000,"type":"VEC3"},{"componentType":5126,"count":100000,"type":"VEC4"},{"componentType":5126,"count":100000,"type":"VEC2"},{"componentType":5125,"count":3,"type":"SCALAR"}|' "$tmp/numbers.gltf" >"$tmp/all.gltf"
refused "more than 16777216 numbers" "$tmp/all.gltf"
gltf instances "$(repeat 500 '{"mesh":0}')" '{"primitives":[{"attributes":{"POSITION":2},"indices":1}]}'
refused "object 'node 3': more than 1048576 triangles" "$tmp/instances.gltf"
gltf objects "$(repeat 400 '{"mesh":0}')" "{\"primitives\":[$(repeat 200 '{"attributes":{"POSITION":2}}')]}"
refused 'more than 65535 objects' "$tmp/objects.gltf"
word=$(awk 'BEGIN { for (i = 0; i < 20000; i++) printf "long" }')
gltf names "{\"mesh\":0,\"name\":\"$word\"}" "{\"primitives\":[$(repeat 3000 '{"attributes":{"POSITION":2}}')]}"
refused 'takes more than 160 MiB of memory' "$tmp/names.gltf"
{ printf '[' && head -c 1100000 /dev/zero | tr '\000' 0 | sed 's|0|0,|g' && echo '0]'; } >"$tmp/values.gltf"
refused 'more than 1048576 values' "$tmp/values.gltf"

# ---- Trees of nodes, lights, materials -----------------------------------------------------------------------------------------

gltf deep "$(awk 'BEGIN { for (i = 1; i < 50001; i++) printf "{\"children\":[%d]},", i }'){\"mesh\":0}" "$small"
drawn '' "$tmp/deep.gltf" --set shadow=0
sed 's/{"mesh":0}\]/{"mesh":0,"children":[0]}]/' "$tmp/deep.gltf" >"$tmp/cycle.gltf"
refused 'the hierarchy has a cycle' "$tmp/cycle.gltf"
gltf lights "{\"mesh\":0},$(repeat 50000 '{"extensions":{"KHR_lights_punctual":{"light":0}}}')" "$small" \
    ',"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}}'
refused 'lights' "$tmp/lights.gltf"
gltf materials '{"mesh":0}' "{\"primitives\":[$(repeat 50000 '{"attributes":{"POSITION":2},"material":@}')]}" ",\"materials\":[$(repeat 50000 '{}')]"
refused '/materials: more than 4096 materials' "$tmp/materials.gltf"
awk 'BEGIN { for (i = 0; i < 50000; i++) print "newmtl m" i }' >"$tmp/materials.mtl"
awk 'BEGIN { print "mtllib materials.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3" }' >"$tmp/library.obj"
refused 'materials.mtl:4096: more than 4096 materials' "$tmp/library.obj"
awk 'BEGIN { print "v 0 0 0\nv 1 0 0\nv 0 1 0"; for (i = 0; i < 50000; i++) print "usemtl m" i "\nf 1 2 3" }' >"$tmp/uses.obj"
refused 'uses.obj:8194: more than 4096 materials' "$tmp/uses.obj"
awk 'BEGIN { print "v 0 0 0\nv 1 0 0\nv 0 1 0"; for (i = 0; i < 100000; i++) print "usemtl m" i % 4000 "\nf 1 2 3" }' >"$tmp/turns.obj"
refused 'more visible triangles' "$tmp/turns.obj"
awk 'BEGIN { for (i = 0; i < 1100000; i++) print "v 0 0 0" }' >"$tmp/vertices.obj"
refused 'vertices.obj:1048577: more than 1048576 vertices' "$tmp/vertices.obj"
# a library that is named again and again is read once
{ printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' && awk 'BEGIN { for (i = 0; i < 2000; i++) print "mtllib big.mtl" }'; } >"$tmp/again.obj"
awk 'BEGIN { print "newmtl a"; for (i = 0; i < 200000; i++) print "Kd 1 1 1" }' >"$tmp/big.mtl"
drawn '' "$tmp/again.obj"

# ---- Depth, strides, lengths that are announced ----------------------------------------------------------------------------------

awk 'BEGIN { printf "{\"asset\":{\"version\":\"2.0\"},\"extras\":"; for (i = 0; i < 1000000; i++) printf "["; print "" }' >"$tmp/nested.gltf"
refused 'nested.gltf:1:[0-9]*: nested too deeply' "$tmp/nested.gltf"
# viewed NAME ACCESSOR VIEW: a triangle of that accessor, and 36 bytes in that view
viewed() {
    printf '{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[%s],"accessors":[{},{},{"componentType":5126,"type":"VEC3",%s}],"bufferViews":[{"buffer":0,"byteLength":36%s}],"buffers":[{"byteLength":36,"uri":"data:;base64,%s"}]}' \
        "$small" "$2" "$3" "$(repeat 48 A | tr -d ,)" >"$tmp/$1.gltf"
}
viewed stride '"bufferView":0,"count":3' ',"byteStride":4294967295'
refused '/bufferViews/0/byteStride: an integer from 0 to 2147483647 is expected' "$tmp/stride.gltf"
viewed elements '"bufferView":0,"count":178956970' ',"byteStride":12'
refused '/accessors/2: 178956970 elements reach beyond' "$tmp/elements.gltf"
viewed sparse '"count":1000000,"sparse":{"count":1000000,"indices":{"bufferView":0,"componentType":5125},"values":{"bufferView":0}}'
refused '/accessors/2/sparse/indices: 1000000 elements reach beyond buffer view 0 of 36 bytes' "$tmp/sparse.gltf"
gltf keys '{"mesh":0}' "$small" ',"animations":[{"samplers":[{"input":3,"output":0}],"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}]'
sed 's/,"animations"/@&/; s/\]@/,{"componentType":5126,"count":1048576,"type":"SCALAR"}]/' "$tmp/keys.gltf" >"$tmp/gltf" && mv "$tmp/gltf" "$tmp/keys.gltf"
drawn '' "$tmp/keys.gltf"
gltf joints "{\"mesh\":0,\"skin\":0},$(repeat 65000 '{}')" '{"primitives":[{"attributes":{"POSITION":2,"JOINTS_0":3,"WEIGHTS_0":4}}]}' ",\"skins\":[{\"joints\":[$(awk 'BEGIN { for (i = 1; i < 65000; i++) printf "%d,", i; print 65000 }')]}]"
sed 's/,"skins"/@&/; s/\]@/,{"componentType":5123,"count":3,"type":"VEC4"},{"componentType":5126,"count":3,"type":"VEC4"}]/' "$tmp/joints.gltf" >"$tmp/gltf" && mv "$tmp/gltf" "$tmp/joints.gltf"
drawn 'a skin of 65000 joints is ignored' "$tmp/joints.gltf"
printf 'glTF\002\000\000\000\377\377\377\377\004\000\000\000JSON{}  ' >"$tmp/all.glb"
refused 'the header announces 4294967295 bytes, the file has 24' "$tmp/all.glb"
printf 'glTF\002\000\000\000\030\000\000\000\374\377\377\377JSON{}  ' >"$tmp/chunk.glb"
refused 'byte 12: a chunk of 4294967292 bytes reaches beyond the end' "$tmp/chunk.glb"
awk 'BEGIN { printf "v 0 0 0\nv 1 0 0\nv 0 1 0\nf"; for (i = 0; i < 1000000; i++) printf " %d", 1 + i % 3; print "" }' >"$tmp/face.obj"
refused 'face.obj:4: a face of more than 4096 corners' "$tmp/face.obj"
awk 'BEGIN { printf "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nmtllib"; for (i = 0; i < 200000; i++) printf " m%d.mtl", i; print "" }' >"$tmp/libraries.obj"
refused 'more than 4096 files' "$tmp/libraries.obj"
printf 'mtllib circle.mtl\nmtllib circle.obj\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$tmp/circle.obj"
printf 'mtllib circle.mtl\nmtllib circle.obj\nnewmtl a\n' >"$tmp/circle.mtl"
drawn '' "$tmp/circle.obj"

# ---- Pictures ------------------------------------------------------------------------------------------------------------------

if ! ${CC:-gcc} -std=c11 -O2 -o "$tmp/plain_png" tests/tool/plain_png.c host/scene/image/deflate.c host/scene/image/zlib_tables.c \
    host/scene/image/inflate.c host/scene/image/png_write.c >"$tmp/log" 2>&1; then fail "plain_png does not build: $(grep -m 1 error "$tmp/log")"; fi
png() { "$tmp/plain_png" "$@"; }
# pictures NAME N URI: N textures, each of an image of its own, on N triangles; @ in the URI is the number
pictures() {
    gltf "$1" '{"mesh":0}' "{\"primitives\":[$(repeat "$2" '{"attributes":{"POSITION":2,"TEXCOORD_0":3},"material":@}')]}" \
        ",\"materials\":[$(repeat "$2" '{"pbrMetallicRoughness":{"baseColorTexture":{"index":@}}}')],\"textures\":[$(repeat "$2" '{"source":@}')],\"images\":[$(repeat "$2" "{\"uri\":\"$3\"}")]"
    sed 's/,"materials"/@&/; s/\]@/,{"componentType":5126,"count":3,"type":"VEC2"}]/' "$tmp/$1.gltf" >"$tmp/gltf" && mv "$tmp/gltf" "$tmp/$1.gltf"
}
png 2048 2048 >"$tmp/2048.png"
png 2048 2048 damaged >"$tmp/damaged.png"
png 8192 8192 >"$tmp/8192.png"
png 100000 10 >"$tmp/wide.png"
pictures few 5 2048.png
drawn '' "$tmp/few.gltf"
pictures many 8 2048.png
refused "texture '2048.png' of 2048x2048: more than 100663296 bytes of textures: --budget" "$tmp/many.gltf"
pictures damaged 4000 damaged.png # each is a remark, and work all the same
refused "texture 'damaged.png' of 2048x2048: more than 100663296 bytes of textures" "$tmp/damaged.gltf"
pictures large 1 8192.png
refused "'8192.png' of 8192x8192: more than" "$tmp/large.gltf"
pictures wide 1 wide.png
refused "'wide.png' of 100000x10: sides are at most 8192" "$tmp/wide.gltf"
# jpeg KIND W H COMPONENTS N: the head of a JPEG file and N zero bytes; KIND: C0 sequential, C2 progressive
jpeg() {
    components=$(for i in $(seq "$4"); do printf '\\%03o\\021\\000' "$i"; done)
    printf "\\377\\330\\377\\$(printf %o $((0x$1)))\\000\\$(printf %o $((8 + 3 * $4)))\\010"
    for side in "$3" "$2"; do printf "\\$(printf %o $((side / 256)))\\$(printf %o $((side % 256)))"; done
    printf "\\$(printf %o "$4")$components"
    head -c "$5" /dev/zero
}
jpeg C0 8192 8192 1 140000 >"$tmp/8192.jpg"
jpeg C0 2048 2048 3 30000 >"$tmp/damaged.jpg"
jpeg C0 65535 8 1 2000 >"$tmp/wide.jpg"
jpeg C2 4096 4096 4 140000 >"$tmp/progressive.jpg" # 64 MiB, and twice that for its coefficients
jpeg C0 8192 8192 1 100 >"$tmp/short.jpg"
pictures large 1 8192.jpg
refused "'8192.jpg' of 8192x8192: more than 100663296 bytes of textures: --budget" "$tmp/large.gltf"
pictures damaged 4000 damaged.jpg
refused "texture 'damaged.jpg' of 2048x2048: more than 100663296 bytes of textures" "$tmp/damaged.gltf"
pictures wide 1 wide.jpg
refused "'wide.jpg' of 65535x8: sides are at most 8192" "$tmp/wide.gltf"
pictures progressive 1 progressive.jpg
refused 'takes more than 160 MiB of memory' "$tmp/progressive.gltf"
pictures short 1 short.jpg # so few bytes cannot be so large a picture
drawn "texture 'short.jpg': the file ends early: it is drawn without" "$tmp/short.gltf"
# a progressive picture of 882 scans: of 63 coefficients 14 bits each, of which no block has any
awk 'function octal(hex, i) { for (i = 1; i < length(hex); i += 2) printf "\\%o", 16 * index(digits, substr(hex, i, 1)) + index(digits, substr(hex, i + 1, 1)) }
    BEGIN {
        digits = "123456789ABCDEF"
        octal("FFD8FFDB004300")
        for (i = 0; i < 64; i++) octal("01")
        octal("FFC2000B080800080001011100FFC40014000100000000000000000000000000000000FFC400141001000000000000000000000000000000E0FFDA000801010000000D")
        for (i = 0; i < 8192; i++) octal("00") # 65536 blocks, and in each of the others three runs over all of them
        for (k = 1; k < 64; k++)
            for (bit = 13; bit >= 0; bit--) octal(sprintf("FFDA0008010100%02X%02X%X%X2AAA5554AAB7", k, k, bit < 13 ? bit + 1 : 0, bit))
        octal("FFD9")
    }' >"$tmp/octal"
printf "$(cat "$tmp/octal")" >"$tmp/scans.jpg"
pictures scans 1 scans.jpg
drawn "texture 'scans.jpg': more than 64 scans: it is drawn without" "$tmp/scans.gltf"
pictures one 1 damaged.jpg
drawn "texture 'damaged.jpg': a marker is missing: it is drawn without" "$tmp/one.gltf"
cp tests/data/corpus/jpeg/420-progressive.jpg "$tmp/whole.jpg"
pictures whole 1 whole.jpg
drawn '' "$tmp/whole.gltf"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nmtllib p.mtl\nusemtl a\nf 1/1 2/1 3/1\n' >"$tmp/p.obj"
printf 'newmtl a\nmap_Kd 8192.png\n' >"$tmp/p.mtl"
refused "8192.png' of 8192x8192: more than" "$tmp/p.obj"
printf 'newmtl a\nmap_Kd 8192.jpg\n' >"$tmp/p.mtl"
refused "8192.jpg' of 8192x8192: more than" "$tmp/p.obj"
printf 'newmtl a\nmap_Kd damaged.jpg\n' >"$tmp/p.mtl"
drawn "line 2: texture '.*damaged.jpg' is damaged, a marker is missing: it is drawn without" "$tmp/p.obj"
{ echo 'newmtl a' && awk 'BEGIN { for (i = 0; i < 60; i++) { printf "map_Kd "; for (k = 0; k < i; k++) printf "./"; print "2048.png" } }'; } >"$tmp/p.mtl"
refused 'more than 100663296 bytes of textures' "$tmp/p.obj"
{ echo 'newmtl a' && awk 'BEGIN { for (i = 0; i < 5000; i++) print "map_Kd none" i ".png" }'; } >"$tmp/p.mtl"
refused 'more than 4096 files' "$tmp/p.obj"

# ---- What is larger than usual on purpose ----------------------------------------------------------------------------------------

for scene in library.obj many.gltf; do # 8 pictures of 16 MiB
    timeout 60 "$tool" info "$tmp/$scene" --budget 16 >"$tmp/out" 2>"$tmp/err" && pass || fail "--budget 16 does not load $scene: $(cat "$tmp/err")"
done
for n in 0 65 -1 x ''; do
    "$tool" info "$tmp/few.gltf" --budget "$n" >"$tmp/out" 2>"$tmp/err"
    [ $? = 2 ] && grep -q "^gnomon: --budget: bad value '$n'" "$tmp/err" && pass || fail "--budget '$n': $(head -n 1 "$tmp/err")"
done

# ---- Files that are none -------------------------------------------------------------------------------------------------------

ln -s /dev/zero "$tmp/zero.gltf"
ln -s /dev/zero "$tmp/zero.obj"
ln -s /dev/zero "$tmp/zero.glb"
mkfifo "$tmp/pipe.gltf"
mkdir "$tmp/folder.obj"
for file in zero.gltf zero.obj zero.glb pipe.gltf; do refused "$file: is a device or a pipe, not a file" "$tmp/$file"; done
refused 'folder.obj: is a folder, not a file' "$tmp/folder.obj"
mkfifo "$tmp/pipe"
mkdir "$tmp/folder"
# buffer URI: a triangle of that buffer
buffer() {
    gltf buffer '{"mesh":0}' '{"primitives":[{"attributes":{"POSITION":0}}]}' ",\"buffers\":[{\"byteLength\":36,\"uri\":\"$1\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}]"
    sed 's/"count":1048576/"bufferView":0,"count":3/' "$tmp/buffer.gltf" >"$tmp/gltf" && mv "$tmp/gltf" "$tmp/buffer.gltf"
}
for file in pipe folder none; do
    buffer "$file"
    refused "/buffers/0/uri: .*/$file \(is a device\|is a folder\|cannot be opened\)" "$tmp/buffer.gltf"
    pictures one 1 "$file"
    drawn "texture '$file': .*/$file \(is a device\|is a folder\|cannot be opened\).*: it is drawn without" "$tmp/one.gltf"
    printf 'newmtl a\nKd 1 0 0\nmap_Kd %s\n' "$file" >"$tmp/p.mtl"
    drawn "line 3: texture '.*$file' \(is a device\|is a folder\|cannot be opened\).*: it is drawn without" "$tmp/p.obj"
done
png 4 4 damaged >"$tmp/damaged.png"
pictures one 1 damaged.png
drawn "texture 'damaged.png': the checksum of the compressed data is wrong: it is drawn without" "$tmp/one.gltf"

# ---- Files outside the scene's folder --------------------------------------------------------------------------------------------

mkdir "$tmp/in" "$tmp/in/deeper"
png 4 4 >"$tmp/out.png"
png 4 4 >"$tmp/in/in.png"
head -c 36 /dev/zero >"$tmp/out.bin"
cp "$tmp/out.bin" "$tmp/in/in.bin"
here=$(pwd)/$tmp
ln -s ../out.bin "$tmp/in/link.bin"
ln -s .. "$tmp/in/up"
ln -s ../in/in.bin "$tmp/in/within.bin"
for uri in link.bin up/out.bin ../out.bin "$here/out.bin" deeper/../../out.bin %2e%2e/out.bin ./../in/in.bin /dev/zero; do
    buffer "$uri"
    mv "$tmp/buffer.gltf" "$tmp/in"
    refused "/buffers/0/uri: .*outside the folder of the scene, which only --outside allows" "$tmp/in/buffer.gltf"
    [ "$uri" = /dev/zero ] || drawn '' "$tmp/in/buffer.gltf" --outside
done
refused '/buffers/0/uri: /dev/zero is a device' "$tmp/in/buffer.gltf" --outside
for uri in in.bin within.bin up/in/in.bin ./in.bin deeper/../in.bin; do
    buffer "$uri"
    mv "$tmp/buffer.gltf" "$tmp/in"
    drawn '' "$tmp/in/buffer.gltf"
done
pictures one 1 ../out.png
mv "$tmp/one.gltf" "$tmp/in"
drawn "texture '../out.png': ../out.png is outside the folder of the scene.*: it is drawn without" "$tmp/in/one.gltf"
drawn '' "$tmp/in/one.gltf" --outside
# OBJ files often name files of the machine that they were made on: they are not read, and that is said
cp "$tmp/p.obj" "$tmp/in/p.obj"
for name in ../out.png '..\out.png' "$here/out.png" 'C:\textures\out.png'; do
    printf 'newmtl a\nmap_Kd %s\n' "$name" >"$tmp/in/p.mtl"
    drawn "line 2: texture '.*out.png' is outside the folder of the scene, which only --outside allows: it is drawn without" "$tmp/in/p.obj"
    case $name in C*) ;; *) drawn '' "$tmp/in/p.obj" --outside ;; esac
done
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib ../q.mtl\nf 1 2 3\n' >"$tmp/in/l.obj"
echo 'newmtl a' >"$tmp/q.mtl"
drawn "line 4: material library '../q.mtl' is outside the folder of the scene.*: its colours are missing" "$tmp/in/l.obj"
drawn '' "$tmp/in/l.obj" --outside

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
