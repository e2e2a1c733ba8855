#!/bin/sh
# Puts the playground into one file: page.html with the styles, the scripts, and an archive of everything else.
#   page.sh OUT.html GNOMON.wasm
set -eu
cd "$(dirname "$0")/../.."
out=$1 wasm=$2
tmp=$out.parts
rm -rf "$tmp"
mkdir -p "$tmp/library" "$tmp/boards"

cp "$wasm" "$tmp/gnomon.wasm"
cp -r host/scenes "$tmp/scenes"
for board in boards/*/link.ld; do
    folder=$(dirname "$board")
    mkdir -p "$tmp/$folder"
    cp "$board" "$folder/board.mk" "$tmp/$folder"
done
for file in gnomon.h gnomon.c; do awk -f boards/packages/one_file.awk -v root=lib lib/$file >"$tmp/library/$file"; done
cp LICENSE host/web/sketch.ino host/tool/cost/part_table.h "$tmp"
(cd "$tmp" && find . -type f | sed 's|^\./||' | LC_ALL=C sort | tar -c --format=ustar --owner=0 --group=0 --numeric-owner --mode=0644 --mtime=@0 -T - | gzip -9 -n | base64 -w 0) >"$tmp.64"

# A line @NAME@ of the page becomes a file.
awk -v archive="$tmp.64" '
    function insert(path,    line) { while ((getline line < path) > 0) print line; close(path) }
    /^@archive@$/ { insert(archive); next }
    /^@[a-z]*\.[a-z]*@$/ { insert("host/web/" substr($0, 2, length($0) - 2)); next }
    { print }' host/web/page.html >"$out.new"
mv "$out.new" "$out"
rm -rf "$tmp" "$tmp.64"
