#!/bin/sh
# A sketch through the real Arduino build: the library in one file, once with the library's configuration and once with a knob that
# the library was not compiled with. usage: test_arduino.sh
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh

from=tests/property/arduino
hardware=$tmp/hardware/gnomon/host library=$tmp/libraries/Gnomon
mkdir -p "$hardware" "$library/src"
cp -r $from/platform.txt $from/boards.txt $from/cores "$hardware"
printf '%s\n' name=Gnomon version=0.0.0 author=Gnomon maintainer=Gnomon sentence=test paragraph=test category=Display url=none 'architectures=*' >"$library/library.properties"
awk -f boards/packages/one_file.awk -v root=lib lib/gnomon.h >"$library/src/gnomon.h"
awk -f boards/packages/one_file.awk -v root=lib lib/gnomon.c >"$library/src/gnomon.c"

sketch() { # sketch NAME LINE EXPECTED
    mkdir -p "$tmp/$1" "$tmp/$1.out"
    sed "s|^CAPACITY\$|$2|" $from/sketch.ino >"$tmp/$1/$1.ino"
    if ! arduino-builder -compile -hardware "$tmp/hardware" -tools /usr/bin -libraries "$tmp/libraries" -fqbn gnomon:host:host -ide-version 10819 \
        -build-path "$PWD/$tmp/$1.out" -warnings all -prefs=tools.ctags.path=/usr/bin -prefs=tools.ctags.cmd.path=/usr/bin/arduino-ctags \
        '-prefs=tools.ctags.pattern="{cmd.path}" -u --language-force=c++ -f - --c++-kinds=svpf --fields=KSTtzns --line-directives "{source_file}"' \
        "$tmp/$1/$1.ino" >"$tmp/$1.log" 2>&1; then
        fail "$1: does not build: $(grep -m 1 -i error "$tmp/$1.log")"
    elif [ "$("$tmp/$1.out/$1.ino.elf")" = "$3" ]; then pass
    else fail "$1: says '$("$tmp/$1.out/$1.ino.elf")', not '$3'"; fi
}

sketch alike "" "ok, 75 tiles"
sketch mixed "#define GN_MAX_TRIANGLES 64" \
    "program and library were compiled with different configurations: the size of gn_renderer or a knob differs, 0 tiles"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
