#!/bin/sh
# Makes build/dist/gnomon-VERSION/ and its .tar.gz from boards/packages/list. usage: dist.sh OUT
# Environment: URL, the address of the project, that the manifests name. The date of a release is that of CHANGELOG; before that, of the
# last commit.
cd "$(dirname "$0")/../.." || exit 1
out=${1:-build/dist}
version=$(sed -n 's/^#define GN_VERSION_STRING "\(.*\)"/\1/p' lib/gnomon.h)
name=gnomon-$version
url=${URL:-https://example.org/gnomon}
date=$(sed -n "s/^## $version, \([0-9]*-[0-9]*-[0-9]*\)\$/\1/p" docs/CHANGELOG.md)
date=${date:-$(git log -1 --format=%cs 2>/dev/null || date -u +%F)}
rm -rf "${out:?}/$name" "$out/$name.tar.gz"
mkdir -p "$out/$name" || exit 1

keywords() { # functions KEYWORD2, types KEYWORD1, constants LITERAL1: a tab between
    cat lib/gnomon.h lib/gn_scene_types.h lib/gn_field.h lib/gn_rig.h | awk '
        { sub(/\/\*.*/, "") }
        /^} gn_[a-z_]*;/ { gsub(/[};]/, ""); print $1 "\tKEYWORD1" }
        match($0, /^[a-z].*[ *]gn_[a-z_0-9]+\(/) { sub(/\(.*/, ""); sub(/.*[ *]/, ""); print $0 "\tKEYWORD2" }
        { while (match($0, /GN_(FORMAT|LIGHT|FILTER|OBJECT|ALPHA|VIEW)_[A-Z0-9_]+/)) {
            print substr($0, RSTART, RLENGTH) "\tLITERAL1"; $0 = substr($0, RSTART + RLENGTH) } }' | sort -u
}

# What the archive is and what is in it; pictures, tools and documents stay behind.
readme() {
    awk '/^## / { exit } !/^!\[/' "$1" | cat -s
    echo "## What is where"
    echo
    awk '/^## / { on = $2 == "Packages" } on && /^\|/' docs/FIRMWARE.md
    echo
    echo "Knobs must be the same for library and program: \`gn_init\` refuses otherwise. \`lib/gnomon.h\` says what the calls do, \`CHANGELOG.md\` what stays. Documents, the host tool and boards are in the sources that this archive is made of."
}

grep -v '^#' boards/packages/list | while read -r how from to; do
    mkdir -p "$(dirname "$out/$name/$to")"
    case $how in
    copy) cp -r "$from" "$out/$name/$to" ;;
    fill) sed "s/@VERSION@/$version/g; s|@URL@|$url|g; s/@DATE@/$date/g" "$from" >"$out/$name/$to" ;;
    one) awk -f boards/packages/one_file.awk -v root=lib "$from" >"$out/$name/$to" ;;
    options | header | wizard) sh boards/packages/kconfig.sh "$how" >"$out/$name/$to" ;;
    readme) readme "$from" >"$out/$name/$to" ;;
    keywords) keywords >"$out/$name/$to" ;;
    *) false ;;
    esac || { echo "list: $how $from $to" >&2; exit 1; }
done || exit 1
tar -C "$out" --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner -cf - "$name" | gzip -n >"$out/$name.tar.gz" && echo "$out/$name.tar.gz"
