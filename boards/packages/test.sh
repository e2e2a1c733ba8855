#!/bin/sh
# make test-packages: what make dist packs is unpacked elsewhere, built by the tools of each ecosystem that are here, and run.
# Manifests are held against what their ecosystems require of them. No network.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh
root=$PWD
case $tmp in /*) ;; *) tmp=$root/$tmp ;; esac
ok() { if "$@" >"$tmp/log" 2>&1; then pass; else fail "$*: $(grep -m 1 -i -E 'error|fail' "$tmp/log" || head -n 1 "$tmp/log")"; fi; }

# ---- The tarball: twice the same, and all of the list ------------------------------------------------------------------------

archive=$(sh boards/packages/dist.sh "$tmp/a") && pass || fail "dist.sh: no archive"
again=$(sh boards/packages/dist.sh "$tmp/b")
cmp -s "$archive" "$again" && pass || fail "two archives of one source differ"
mkdir -p "$tmp/unpacked"
ok tar -C "$tmp/unpacked" -xzf "$archive"
package=$(echo "$tmp"/unpacked/gnomon-*)
for file in $(awk '!/^#/ { print $3 }' boards/packages/list); do
    [ -e "$package/$file" ] && pass || fail "$file is not in the archive"
done
for example in boards/packages/arduino/*.ino boards/packages/cmake/*.c boards/packages/zephyr/sample/main.c; do
    [ "$(wc -l <"$example")" -le 60 ] && pass || fail "$example has more than 60 lines"
done

# ---- One header, one source: the same picture as from lib/ -------------------------------------------------------------------

spin=$package/examples/cmake/spin.c
ok gcc -std=c99 -Wall -Wextra -Werror -O1 -I"$package/single" -o "$tmp/single" "$package/single/gnomon.c" "$spin"
ok gcc -std=c99 -Wall -Wextra -Werror -O1 -Ilib -o "$tmp/parts" lib/gnomon.c "$spin"
ok g++ -x c++ -std=c++11 -Wall -Wextra -Werror -I"$package/single" -fsyntax-only "$spin"
"$tmp/parts" >"$tmp/wanted"
same() { "$1" >"$tmp/shown" 2>&1 && cmp -s "$tmp/shown" "$tmp/wanted" && pass || fail "$1 shows another picture: $(head -n 1 "$tmp/shown")"; }
same "$tmp/single"
[ "$(wc -l <"$tmp/wanted")" = 96 ] && [ "$(tr -d ' \n' <"$tmp/wanted" | wc -c)" -gt 2000 ] && pass || fail "spin shows nothing"

# ---- CMake: as a folder, installed and found, by pkg-config -------------------------------------------------------------------

if command -v cmake >/dev/null 2>&1; then
    example=$package/examples/cmake
    ok cmake -S "$example" -B "$tmp/sub" -DCMAKE_BUILD_TYPE=Release
    ok cmake --build "$tmp/sub"
    same "$tmp/sub/spin"
    ok cmake -S "$package/lib" -B "$tmp/lib" -DCMAKE_INSTALL_PREFIX="$tmp/prefix" "-DGNOMON_DEFINITIONS=GN_MAX_TRIANGLES=77;GN_CLIPS=0"
    ok cmake --build "$tmp/lib"
    ok cmake --install "$tmp/lib"
    mkdir -p "$tmp/alone" # without the source beside it
    cp "$example"/* "$tmp/alone"
    ok cmake -S "$tmp/alone" -B "$tmp/found" -DCMAKE_PREFIX_PATH="$tmp/prefix"
    ok cmake --build "$tmp/found"
    same "$tmp/found/spin"
    if command -v pkg-config >/dev/null 2>&1; then
        flags=$(PKG_CONFIG_PATH=$(dirname "$(find "$tmp/prefix" -name gnomon.pc)") pkg-config --cflags --libs gnomon)
        case $flags in *GN_MAX_TRIANGLES=77*) pass ;; *) fail "pkg-config says '$flags'" ;; esac
        ok gcc -std=c99 -o "$tmp/config" "$spin" $flags
        same "$tmp/config"
    fi
else fail "cmake is missing: apt-get install cmake"
fi

# ---- ESP-IDF and Zephyr: their build files, on stand-ins of what an SDK gives them, with the defaults of Kconfig ------------------

# A header of what menuconfig would write. Each option: a kind with a text, a range unless it is a switch, a default in it.
defaults() {
    awk '
        $1 == "config" { name = $2; n++ }
        $1 == "bool" || $1 == "int" { kind = $1; kinds++ }
        $1 == "range" { lo = $2; hi = $3 }
        $1 == "default" && kind == "bool" { if ($2 == "y") print "#define CONFIG_" name " 1"; good += $2 == "y" || $2 == "n" }
        $1 == "default" && kind == "int" { print "#define CONFIG_" name " " $2; good += $2 >= lo && $2 <= hi }
        END { if (n < 50 || kinds != n || good != n) exit 1 }' "$1"
}
mkdir -p "$tmp/sdk"
for options in esp-idf/gnomon/Kconfig.knobs zephyr/gnomon/zephyr/Kconfig.knobs; do
    defaults "$package/$options" >"$tmp/sdk/sdkconfig.h" && pass || fail "$options: an option without a kind, or with a default out of range"
done
sed 's/MAX_TRIANGLES 500/MAX_TRIANGLES 501/' "$tmp/sdk/sdkconfig.h" >"$tmp/sdk/other.h"
if command -v cmake >/dev/null 2>&1; then
    cat >"$tmp/sdk/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.13)
project(sdk C)
set(COMPONENT_LIB gnomon)
set(CONFIG_GNOMON y)
macro(idf_component_register)
  cmake_parse_arguments(C "" "" "SRCS;INCLUDE_DIRS" ${ARGN})
  add_library(gnomon STATIC ${C_SRCS})
  target_include_directories(gnomon PUBLIC ${C_INCLUDE_DIRS} ${SDK})
  target_compile_definitions(gnomon PUBLIC ESP_PLATFORM)
endmacro()
macro(zephyr_library_named name)
  add_library(${name} STATIC)
  target_compile_options(${name} PUBLIC -include ${SDK}/sdkconfig.h)
endmacro()
macro(zephyr_library_sources)
  target_sources(gnomon PRIVATE ${ARGN})
endmacro()
macro(zephyr_include_directories)
  target_include_directories(gnomon PUBLIC ${ARGN})
endmacro()
macro(zephyr_compile_definitions)
  target_compile_definitions(gnomon PUBLIC ${ARGN})
endmacro()
add_subdirectory(${MODULE} module)
add_executable(spin ${SPIN})
target_link_libraries(spin gnomon)
CMAKE
    for module in esp-idf/gnomon zephyr/gnomon/zephyr; do
        at=$tmp/sdk-$(dirname "$module" | tr / -)
        ok cmake -S "$tmp/sdk" -B "$at" "-DMODULE=$package/$module" "-DSPIN=$spin" "-DSDK=$tmp/sdk"
        ok cmake --build "$at"
        same "$at/spin"
    done
fi
# Kconfig reaches the library: a library of other options refuses the program.
kconfig="-DGN_USER_CONFIG=\"gnomon_kconfig.h\" -I$package/zephyr/gnomon/src"
ok gcc -std=c99 -w -include "$tmp/sdk/other.h" $kconfig -c -o "$tmp/other.o" "$package/zephyr/gnomon/src/gnomon.c"
ok gcc -std=c99 -w -include "$tmp/sdk/sdkconfig.h" $kconfig -o "$tmp/mixed" "$spin" "$tmp/other.o"
"$tmp/mixed" 2>&1 | grep -q "different configurations" && pass || fail "an option of Kconfig does not reach the library"
for key in version description license dependencies; do
    grep -q "^$key: *" "$package/esp-idf/gnomon/idf_component.yml" && pass || fail "idf_component.yml has no $key"
done
for file in $(sed -n 's/^  \(cmake\|kconfig\): //p' "$package/zephyr/gnomon/zephyr/module.yml") samples/spin/prj.conf samples/spin/src/main.c; do
    [ -e "$package/zephyr/gnomon/$file" ] && pass || fail "zephyr: there is no $file"
done

# ---- Arduino: the examples by its own builder, on a host platform --------------------------------------------------------------

if command -v arduino-builder >/dev/null 2>&1; then
    mkdir -p "$tmp/hardware/gnomon/host"
    cp -r tests/property/arduino/platform.txt tests/property/arduino/boards.txt tests/property/arduino/cores "$tmp/hardware/gnomon/host"
    for sketch in "$package"/arduino/Gnomon/examples/*/*.ino; do
        out=$tmp/out-$(basename "$sketch" .ino)
        mkdir -p "$out"
        ok arduino-builder -compile -hardware "$tmp/hardware" -tools /usr/bin -libraries "$package/arduino" -fqbn gnomon:host:host -ide-version 10819 \
            -build-path "$out" -warnings all -prefs=tools.ctags.path=/usr/bin -prefs=tools.ctags.cmd.path=/usr/bin/arduino-ctags \
            '-prefs=tools.ctags.pattern="{cmd.path}" -u --language-force=c++ -f - --c++-kinds=svpf --fields=KSTtzns --line-directives "{source_file}"' "$sketch"
    done
else fail "arduino-builder is missing: apt-get install arduino-builder"
fi

# ---- Manifests: library.properties of Arduino, keywords.txt, library.json of PlatformIO ------------------------------------------

version=$(sed -n 's/^#define GN_VERSION_STRING "\(.*\)"/\1/p' lib/gnomon.h)
properties=$package/arduino/Gnomon/library.properties
for key in name version author maintainer sentence paragraph category url architectures; do
    grep -q "^$key=." "$properties" && pass || fail "library.properties has no $key"
done
grep -q "^version=$version\$" "$properties" && pass || fail "library.properties has another version than $version"
grep -q -E '^category=(Display|Communication|Signal Input/Output|Sensors|Device Control|Timing|Data Storage|Data Processing|Other)$' "$properties" && pass ||
    fail "library.properties: no such category"
awk -F '\t' 'NF != 2 || $1 !~ /^[A-Za-z_0-9]+$/ || $2 !~ /^(KEYWORD[123]|LITERAL1)$/ { exit 1 }' "$package/arduino/Gnomon/keywords.txt" && pass || fail "keywords.txt"
for word in gn_render gn_scene GN_FORMAT_RGB565 gn_pick; do
    awk -v word="$word" '$1 == word { found = 1 } END { exit !found }' "$package/arduino/Gnomon/keywords.txt" && pass || fail "keywords.txt has no $word"
done
json=$package/arduino/Gnomon/library.json
for key in name version description keywords authors license headers frameworks platforms; do
    grep -q "^  \"$key\": " "$json" && pass || fail "library.json has no $key"
done
grep -q "\"version\": \"$version\"" "$json" && pass || fail "library.json has another version than $version"
awk '{ open += gsub(/[{[]/, "&"); shut += gsub(/[}\]]/, "&"); quotes += gsub(/"/, "&") } END { exit open != shut || quotes % 2 }' "$json" && pass || fail "library.json is not closed"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
