#!/bin/sh
# What make dist packs is unpacked elsewhere, built by the tools of each ecosystem that are here, and run. Manifests are held against
# what their ecosystems require of them. No network. Not optimised: the compiler takes most of the time.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh
root=$PWD
case $tmp in /*) ;; *) tmp=$root/$tmp ;; esac
version=$(sed -n 's/^#define GN_VERSION_STRING "\(.*\)"/\1/p' lib/gnomon.h)
export CC=clang # also of CMake: it compiles the library in a third of the time of gcc
kept=-Wno-unused-function # which gcc does not warn of in functions that are inline
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
for example in boards/packages/[a-l]*/*.ino boards/packages/[a-l]*/*.c boards/packages/*/*/*.c; do
    [ "$(wc -l <"$example")" -le 70 ] && pass || fail "$example has more than 70 lines"
done

# ---- One header, one source: the same picture as from lib/ -------------------------------------------------------------------

spin=$package/examples/cmake/spin.c
ok $CC -std=c99 -Wall -Wextra -Werror $kept -I"$package/single" -c -o "$tmp/single.o" "$package/single/gnomon.c"
ok gcc -std=c99 -Wall -Wextra -Werror -I"$package/single" -o "$tmp/single" "$tmp/single.o" "$spin"
ok $CC -std=c99 -Wall -Wextra -Werror $kept -Ilib -o "$tmp/parts" lib/gnomon.c "$spin"
ok g++ -x c++ -std=c++11 -Wall -Wextra -Werror -I"$package/single" -fsyntax-only "$spin"
"$tmp/parts" >"$tmp/wanted"
same() { "$1" >"$tmp/shown" 2>&1 && cmp -s "$tmp/shown" "$tmp/wanted" && pass || fail "$1 shows another picture: $(head -n 1 "$tmp/shown")"; }
same "$tmp/single"
[ "$(wc -l <"$tmp/wanted")" = 96 ] && [ "$(tr -d ' \n' <"$tmp/wanted" | wc -c)" -gt 2000 ] && pass || fail "spin shows nothing"

# ---- Two scratches: tiles go to a panel that takes them as late as it may, or are drawn by two threads ---------------------------

cat >"$tmp/two_buffers.c" <<'C'
#define main example
#include TWO_BUFFERS
#undef main
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
static unsigned char got[2 * 160 * 128], wanted[sizeof got];
static const unsigned char *source;
static unsigned long under_way, n_done, n_frames;
static int at[4];
static void put(unsigned char *to, int x, int y, int w, int h, const unsigned char *from)
{
    for (int row = 0; row < h; row++) memcpy(to + 2 * ((y + row) * 160 + x), from + 2 * row * w, 2 * (size_t)w);
}
static void keep(void *user, int x, int y, int w, int h, const void *pixels) { put(user, x, y, w, h, pixels); }
void panel_window(int x, int y, int w, int h) { at[0] = x, at[1] = y, at[2] = w, at[3] = h; }
void panel_start(const void *pixels, unsigned long n_bytes) { source = pixels, under_way = n_bytes; }
void panel_wait(void)
{
    if (under_way) put(got, at[0], at[1], at[2], at[3], source);
    n_done += under_way;
    under_way = 0;
    if (n_done < sizeof got) return;
    n_done = 0;
    if (++n_frames < 3) return;
    gn_scene scene = *renderer.frame.scene;
    if (gn_render(&renderer, &scene, keep, wanted)) exit(2);
    exit(memcmp(got, wanted, sizeof got) != 0);
}
int main(void) { return example() ? 3 : 4; }
C
ok gcc -std=c99 -Wall -Wextra -Werror -I"$package/single" "-DTWO_BUFFERS=\"$package/examples/cmake/two_buffers.c\"" -o "$tmp/two" "$tmp/two_buffers.c" "$tmp/single.o"
ok "$tmp/two"
cat >"$tmp/two_cores.cpp" <<'C'
#include <string.h>
#include <Arduino.h>
#include <thread>
#include TWO_CORES
static void reference(void *to, int x, int y, int w, int h, const void *pixels)
{
    for (int row = 0; row < h; row++) memcpy((uint16_t *)to + (y + row) * 160 + x, (const uint16_t *)pixels + row * w, 2 * (size_t)w);
}
int main()
{
    static uint16_t wanted[128 * 160];
    static volatile bool over;
    setup();
    std::thread core([] { while (!over) loop1(); });
    for (int i = 0; i < 3; i++) loop();
    over = true;
    core.join();
    const int32_t eye[] = {0, GN_Q16(4), GN_Q16(7)}, target[] = {0, GN_Q16(1), 0};
    const gn_camera camera = gn_camera_default(eye, target);
    const gn_light sun = gn_light_sun(-1, -2, -1);
    const gn_scene scene = gn_scene_default(&camera, objects, 2, &sun, 1); // the loop's is gone
    return gn_render(&renderer, &scene, reference, wanted) ? 2 : memcmp(picture, wanted, sizeof wanted) != 0;
}
C
host=tests/property/arduino
ok g++ -std=c++11 -Wall -Wextra -Werror -pthread -I$host/cores/host -I"$package/arduino/Gnomon/src" "-DTWO_CORES=\"$package/arduino/Gnomon/examples/TwoCores/TwoCores.ino\"" -o "$tmp/cores" "$tmp/two_cores.cpp" $host/cores/host/main.cpp "$tmp/single.o"
ok "$tmp/cores"

# ---- The sketch that drives a panel by itself, on models of both controllers, from power-on -------------------------------------

for file in tests/tool/packages/glass tests/firmware/panel_model tests/firmware/panel_model_st7789 tests/firmware/panel_model_ssd1306 tests/firmware/panel_model_ssd1327; do
    ok gcc -std=c11 -Wall -Wextra -Werror -O1 -Itests/support -c -o "$tmp/$(basename $file).o" $file.c
done
sketch=$package/arduino/Gnomon/examples/Panel/Panel.ino
sed 's/IS_ST7789 = 0/IS_ST7789 = 1/' "$sketch" >"$tmp/st7789.ino"
for panel in "$sketch" "$tmp/st7789.ino"; do
    ok g++ -std=c++11 -Wall -Wextra -Werror -I$host/cores/host -I$host/libraries/SPI -I"$package/arduino/Gnomon/src" "-DPANEL=\"$panel\"" -o "$tmp/panel" \
        tests/tool/packages/panel_sketch.cpp $host/cores/host/main.cpp $host/libraries/SPI/SPI.cpp "$tmp/glass.o" "$tmp"/panel_model*.o "$tmp/single.o"
    ok "$tmp/panel"
done

# ---- CMake: as a folder, installed and found, by pkg-config -------------------------------------------------------------------

if command -v cmake >/dev/null 2>&1; then
    example=$package/examples/cmake
    ok cmake -S "$example" -B "$tmp/sub"
    ok cmake --build "$tmp/sub"
    same "$tmp/sub/spin"
    ok cmake -S "$package" -B "$tmp/lib" -DCMAKE_INSTALL_PREFIX="$tmp/elsewhere" "-DGNOMON_DEFINITIONS=GN_MAX_TRIANGLES=77;GN_MATERIALS=0"
    ok cmake --build "$tmp/lib"
    ok cmake --install "$tmp/lib" --prefix "$tmp/prefix" # another than was configured
    mkdir -p "$tmp/alone" # without the source beside it
    cp "$example"/* "$tmp/alone"
    ok cmake -S "$tmp/alone" -B "$tmp/found" -DCMAKE_PREFIX_PATH="$tmp/prefix"
    ok cmake --build "$tmp/found"
    same "$tmp/found/spin"
    # a program asks for the version that it was written for; a patch is no reason to refuse, another minor version is
    for wanted in "${version%.*}" "$version" 0.1 0.99; do
        printf 'cmake_minimum_required(VERSION 3.13)\nproject(any C)\nfind_package(gnomon %s QUIET)\nmessage("found ${gnomon_FOUND}")\n' $wanted >"$tmp/any.cmake"
        rm -rf "$tmp/any" && mkdir "$tmp/any" && mv "$tmp/any.cmake" "$tmp/any/CMakeLists.txt"
        case $wanted in "${version%.*}" | "$version") is=1 ;; *) is=0 ;; esac
        cmake -S "$tmp/any" -B "$tmp/any/build" -DCMAKE_PREFIX_PATH="$tmp/prefix" 2>&1 | grep -q "^found $is" && pass || fail "find_package(gnomon $wanted) of $version: not $is"
    done
    # the archive as it is, with a knob that the project sets; the library refuses a program with another
    mkdir -p "$tmp/fetch" && cp "$spin" "$tmp/fetch"
    cat >"$tmp/fetch/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.14)
project(fetch C)
include(FetchContent)
set(GNOMON_DEFINITIONS GN_MAX_TRIANGLES=77)
FetchContent_Declare(gnomon URL $archive)
FetchContent_MakeAvailable(gnomon)
add_executable(spin spin.c)
target_link_libraries(spin gnomon::gnomon)
CMAKE
    ok cmake -S "$tmp/fetch" -B "$tmp/fetch/build" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
    ok cmake --build "$tmp/fetch/build"
    same "$tmp/fetch/build/spin"
    [ "$(grep -c 'DGN_MAX_TRIANGLES=77 ' "$tmp/fetch/build/compile_commands.json")" = 2 ] && pass || fail "FetchContent: a knob that the project sets is lost"
    if command -v pkg-config >/dev/null 2>&1; then
        flags=$(PKG_CONFIG_PATH=$(dirname "$(find "$tmp/prefix" -name gnomon.pc)") pkg-config --cflags --libs gnomon)
        case $flags in *GN_MAX_TRIANGLES=77*) pass ;; *) fail "pkg-config says '$flags'" ;; esac
        ok gcc -std=c99 -o "$tmp/config" "$spin" $flags
        same "$tmp/config"
    fi
else fail "cmake is missing: apt-get install cmake"
fi

# ---- ESP-IDF and Zephyr: their build files, on stand-ins of what an SDK gives them, with the defaults of Kconfig ------------------

# Capacities and features of lib/gn_knobs.h and the preset, without two atlases by their texels.
n_options=$(awk '/^#define GN_[A-Z]*_KNOBS\(/ { on = /CAPACITY|FEATURE/ } on && /^ *X\(/ { n++ } END { print n + 1 - 2 }' lib/gn_knobs.h)
# A header of what menuconfig would write. Each option: a kind with a text, a range unless it is a switch, a default in it.
defaults() {
    awk -v all="$n_options" '
        $1 == "config" { name = $2; n++ }
        $1 == "bool" || $1 == "int" { kind = $1; kinds++ }
        $1 == "range" { lo = $2; hi = $3 }
        $1 == "default" && kind == "bool" { if ($2 == "y") print "#define CONFIG_" name " 1"; good += $2 == "y" || $2 == "n" }
        $1 == "default" && kind == "int" { print "#define CONFIG_" name " " $2; good += $2 >= lo && $2 <= hi }
        END { if (n != all || kinds != n || good != n) exit 1 }' "$1"
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
ok $CC -std=c99 -w -include "$tmp/sdk/other.h" $kconfig -c -o "$tmp/other.o" "$package/zephyr/gnomon/src/gnomon.c"
ok gcc -std=c99 -w -include "$tmp/sdk/sdkconfig.h" $kconfig -o "$tmp/mixed" "$spin" "$tmp/other.o"
"$tmp/mixed" 2>&1 | grep -q "different configurations" && pass || fail "an option of Kconfig does not reach the library"
for key in version description url repository license dependencies; do
    grep -q "^$key: *" "$package/esp-idf/gnomon/idf_component.yml" && pass || fail "idf_component.yml has no $key"
done
for file in $(sed -n 's/^  \(cmake\|kconfig\): //p' "$package/zephyr/gnomon/zephyr/module.yml") samples/spin/sample.yaml samples/spin/prj.conf samples/spin/src/main.c; do
    [ -e "$package/zephyr/gnomon/$file" ] && pass || fail "zephyr: there is no $file"
done

# The clock for an ESP32-S3: a stand-in of its drivers that sends a tile as late as it may, and ends after a picture.
idf=$tmp/idf clock=$package/esp-idf/gnomon/examples/clock
mkdir -p "$idf/driver"
cat >"$idf/esp_lcd_panel_io.h" <<'C'
#pragma once
#include <stddef.h>
#include <stdbool.h>
#include <stdint.h>
typedef int esp_err_t;
typedef struct panel_io *esp_lcd_panel_io_handle_t;
typedef struct panel *esp_lcd_panel_handle_t;
typedef void *esp_lcd_spi_bus_handle_t;
typedef struct { int cs_gpio_num, dc_gpio_num, spi_mode; unsigned pclk_hz; size_t trans_queue_depth; int lcd_cmd_bits, lcd_param_bits; } esp_lcd_panel_io_spi_config_t;
typedef struct { int sclk_io_num, mosi_io_num, miso_io_num, quadwp_io_num, quadhd_io_num, max_transfer_sz; } spi_bus_config_t;
typedef struct { int reset_gpio_num; unsigned bits_per_pixel; } esp_lcd_panel_dev_config_t;
enum { SPI2_HOST = 1, SPI_DMA_CH_AUTO = 3, LCD_CMD_NOP = 0 };
esp_err_t spi_bus_initialize(int host, const spi_bus_config_t *bus, int dma);
esp_err_t esp_lcd_new_panel_io_spi(esp_lcd_spi_bus_handle_t bus, const esp_lcd_panel_io_spi_config_t *config, esp_lcd_panel_io_handle_t *io);
esp_err_t esp_lcd_new_panel_st7789(esp_lcd_panel_io_handle_t io, const esp_lcd_panel_dev_config_t *config, esp_lcd_panel_handle_t *panel);
esp_err_t esp_lcd_panel_reset(esp_lcd_panel_handle_t panel);
esp_err_t esp_lcd_panel_init(esp_lcd_panel_handle_t panel);
esp_err_t esp_lcd_panel_invert_color(esp_lcd_panel_handle_t panel, bool invert);
esp_err_t esp_lcd_panel_disp_on_off(esp_lcd_panel_handle_t panel, bool on);
esp_err_t esp_lcd_panel_draw_bitmap(esp_lcd_panel_handle_t panel, int x_start, int y_start, int x_end, int y_end, const void *pixels);
esp_err_t esp_lcd_panel_io_tx_param(esp_lcd_panel_io_handle_t io, int command, const void *bytes, size_t n);
C
for header in driver/spi_master.h esp_lcd_panel_commands.h esp_lcd_panel_ops.h esp_lcd_panel_vendor.h; do
    echo '#include "esp_lcd_panel_io.h"' >"$idf/$header"
done
cat >"$idf/board.c" <<'C'
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include "esp_lcd_panel_io.h"
static unsigned char screen[240][480];
static int at[4], is_on;
static const unsigned char *under_way;
static long seconds;
time_t __wrap_time(time_t *now);
unsigned __wrap_sleep(unsigned s);
void app_main(void);
time_t __wrap_time(time_t *now) { return now ? (*now = seconds) : seconds; }
unsigned __wrap_sleep(unsigned s) { exit(!is_on || under_way || !s || fwrite(screen, 1, sizeof screen, stdout) != sizeof screen); }
esp_err_t spi_bus_initialize(int host, const spi_bus_config_t *bus, int dma) { return host != SPI2_HOST || dma != SPI_DMA_CH_AUTO || bus->miso_io_num != -1; }
esp_err_t esp_lcd_new_panel_io_spi(esp_lcd_spi_bus_handle_t bus, const esp_lcd_panel_io_spi_config_t *c, esp_lcd_panel_io_handle_t *io) { *io = (void *)screen; return !bus || c->lcd_cmd_bits != 8; }
esp_err_t esp_lcd_new_panel_st7789(esp_lcd_panel_io_handle_t io, const esp_lcd_panel_dev_config_t *c, esp_lcd_panel_handle_t *panel) { *panel = (void *)at; return !io || c->bits_per_pixel != 16; }
esp_err_t esp_lcd_panel_reset(esp_lcd_panel_handle_t panel) { return !panel; }
esp_err_t esp_lcd_panel_init(esp_lcd_panel_handle_t panel) { return !panel; }
esp_err_t esp_lcd_panel_invert_color(esp_lcd_panel_handle_t panel, bool invert) { return !panel || !invert; }
esp_err_t esp_lcd_panel_disp_on_off(esp_lcd_panel_handle_t panel, bool on) { is_on = on; return !panel; }
esp_err_t esp_lcd_panel_draw_bitmap(esp_lcd_panel_handle_t panel, int x0, int y0, int x1, int y1, const void *pixels)
{
    at[0] = x0, at[1] = y0, at[2] = x1, at[3] = y1, under_way = pixels;
    return !panel;
}
esp_err_t esp_lcd_panel_io_tx_param(esp_lcd_panel_io_handle_t io, int command, const void *bytes, size_t n)
{
    const size_t row = 2 * (size_t)(at[2] - at[0]);
    for (int y = at[1]; under_way && y < at[3]; y++, under_way += row) memcpy(&screen[y][2 * at[0]], under_way, row);
    under_way = NULL;
    return !io || command != LCD_CMD_NOP || bytes || n;
}
int main(int argc, char **argv) { seconds = argc > 1 ? atol(argv[1]) : 0; app_main(); return 2; }
C
ok gcc -std=c99 -D_POSIX_C_SOURCE=200809L -Wall -Wextra -Werror -I"$idf" -I"$package/single" -Wl,--wrap=time,--wrap=sleep -o "$idf/clock" "$clock/main/clock.c" "$clock/main/st7789.c" "$idf/board.c" "$tmp/single.o"
for at in 36600 79800 36660; do TZ=UTC "$idf/clock" $at >"$idf/$at" && [ "$(wc -c <"$idf/$at")" = 115200 ] && pass || fail "the clock shows nothing $at seconds after midnight"; done
cmp -s "$idf/36600" "$idf/79800" && pass || fail "the clock at 10:10 and at 22:10 differs"
cmp -s "$idf/36600" "$idf/36660" && fail "the clock at 10:10 and at 10:11 is the same" || pass
# The registry puts the component elsewhere, and the example anywhere: its manifest names the component, and finds it while it lies in it.
manifest=$clock/main/idf_component.yml
grep -q 'SRCS "clock.c" "st7789.c"' "$clock/main/CMakeLists.txt" && grep -q "^  gnomon/gnomon:" "$manifest" && grep -q "version: \"~$version\"" "$manifest" &&
    [ -e "$clock/main/$(sed -n 's/^ *override_path: "\([^"]*\)".*/\1/p' "$manifest")/idf_component.yml" ] && pass || fail "the project of the clock does not name its sources and the component"
grep -r -n -F '..' "$clock" --include=CMakeLists.txt >"$tmp/matches" && fail "the project of the clock needs what is not in its folder: $(head -n 1 "$tmp/matches")" || pass
[ -s "$package/esp-idf/gnomon/README.md" ] && pass || fail 'the component has no README'

# ---- Pico SDK: its example by CMake on a stand-in of the SDK, whose second core is a thread; it ends after three pictures ---------------

pico=$tmp/pico
mkdir -p "$pico/hardware" "$pico/pico"
cat >"$pico/sdk.h" <<'C'
#pragma once
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
typedef struct spi_inst spi_inst_t;
enum gpio_function { GPIO_FUNC_SPI = 1 };
#define spi0 ((spi_inst_t *)16)
unsigned spi_init(spi_inst_t *spi, unsigned hz);
int spi_write_blocking(spi_inst_t *spi, const uint8_t *bytes, size_t n);
void gpio_init(unsigned pin);
void gpio_set_dir(unsigned pin, bool out);
void gpio_put(unsigned pin, bool value);
void gpio_set_function(unsigned pin, enum gpio_function function);
void sleep_ms(uint32_t ms);
bool stdio_init_all(void);
uint32_t time_us_32(void);
void multicore_launch_core1(void (*entry)(void));
void multicore_fifo_push_blocking(uint32_t data);
uint32_t multicore_fifo_pop_blocking(void);
C
for header in hardware/gpio.h hardware/spi.h pico/multicore.h pico/stdlib.h; do echo '#include "sdk.h"' >"$pico/$header"; done
cat >"$pico/sdk.c" <<'C'
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>
#include "sdk.h"
static int fifo[2][2], is_data, is_command, is_out[32], n_shown;
static uint8_t command;
static void (*second)(void);
static _Thread_local int core;
unsigned spi_init(spi_inst_t *spi, unsigned hz) { return spi == spi0 ? hz : 0; }
void gpio_init(unsigned pin) { is_out[pin] = 0; }
void gpio_set_dir(unsigned pin, bool out) { is_out[pin] = out; }
void gpio_set_function(unsigned pin, enum gpio_function function) { (void)pin, (void)function; }
void gpio_put(unsigned pin, bool value) { if (!is_out[pin]) exit(3); if (pin == 16) is_data = value; if (pin == 17) is_command = !value; }
int spi_write_blocking(spi_inst_t *spi, const uint8_t *bytes, size_t n)
{
    if (spi != spi0 || !is_command) exit(4);
    if (!is_data) command = bytes[0];
    else if (command == 0x2C && (n != 115200 || fwrite(bytes, 1, n, stderr) != n || ++n_shown == 3)) exit(n != 115200);
    return (int)n;
}
void sleep_ms(uint32_t ms) { (void)ms; }
bool stdio_init_all(void) { return pipe(fifo[0]) == 0 && pipe(fifo[1]) == 0; }
uint32_t time_us_32(void) { return 0; }
static void *run(void *user) { core = 1; second(); return user; }
void multicore_launch_core1(void (*entry)(void)) { pthread_t t; second = entry; if (pthread_create(&t, NULL, run, NULL)) exit(5); }
void multicore_fifo_push_blocking(uint32_t data) { if (write(fifo[!core][1], &data, 4) != 4) exit(6); }
uint32_t multicore_fifo_pop_blocking(void) { uint32_t data; if (read(fifo[core][0], &data, 4) != 4) exit(7); return data; }
C
cat >"$pico/pico_sdk_init.cmake" <<'C'
macro(pico_sdk_init)
  find_package(Threads REQUIRED)
  foreach(part pico_stdlib pico_multicore hardware_spi)
    add_library(${part} INTERFACE)
  endforeach()
  target_sources(pico_stdlib INTERFACE ${PICO_SDK_PATH}/sdk.c)
  target_include_directories(pico_stdlib INTERFACE ${PICO_SDK_PATH})
  target_compile_options(pico_stdlib INTERFACE -Wall -Wextra -Werror -D_GNU_SOURCE)
  target_link_libraries(pico_stdlib INTERFACE Threads::Threads)
endmacro()
macro(pico_enable_stdio_usb)
endmacro()
macro(pico_add_extra_outputs)
endmacro()
C
if command -v cmake >/dev/null 2>&1; then
    ok cmake -S "$package/examples/pico-sdk" -B "$pico/build" -DPICO_SDK_PATH="$pico"
    ok cmake --build "$pico/build"
else
    ok gcc -std=c99 -D_GNU_SOURCE -w -pthread -I"$pico" -I"$package/single" -o "$pico/build-turn" "$package/examples/pico-sdk/turn.c" "$package/examples/pico-sdk/st7789.c" \
        "$pico/sdk.c" "$tmp/single.o" && mkdir -p "$pico/build" && mv "$pico/build-turn" "$pico/build/turn"
fi
for run in 1 2; do "$pico/build/turn" >"$pico/said" 2>"$pico/shown$run" && [ "$(wc -c <"$pico/shown$run")" = 345600 ] && pass || fail "pico-sdk: no three pictures: $(head -n 1 "$pico/said")"; done
cmp -s "$pico/shown1" "$pico/shown2" && pass || fail "pico-sdk: two cores draw other pictures in other runs"
head -c 115200 "$pico/shown1" | cmp -s - "$pico/shown1" && fail "pico-sdk: one picture" || pass
[ "$(head -c 115200 "$pico/shown1" | cksum)" != "$(tail -c 115200 "$pico/shown1" | cksum)" ] && pass || fail "pico-sdk: nothing turns"
for word in single/ examples/pico-sdk/ micropython/; do grep -q "$word" "$package/README.md" && pass || fail "the archive's README does not tell of $word"; done
grep -o '](\([^)]*\))' "$package/README.md" | grep -v '](http' && fail "the archive's README has links to what is not there" || pass

# ---- CMSIS-Pack: the description, the header of the Configuration Wizard, the example with two buttons -----------------------------

pdsc=$package/cmsis/Gnomon.Gnomon.pdsc
# Every element is closed in its turn; prints "ELEMENT ATTRIBUTES" of each.
elements() {
    awk 'BEGIN { RS = "<" }
        NR == 1 || /^[?!]/ { next }
        { tag = $0; sub(/>.*/, "", tag); gsub(/[ \n]+/, " ", tag); name = tag; sub(/[ \/].*/, "", name) }
        tag ~ /^\// { sub(/^\//, "", tag); if (open[n--] != tag) exit 1; next }
        { print tag }
        tag !~ /\/$/ { open[++n] = name }
        END { exit n != 0 }' "$1"
}
elements "$pdsc" >"$tmp/pdsc" && pass || fail "Gnomon.Gnomon.pdsc is not well-formed"
for element in 'package schemaVersion="[0-9.]*"' vendor name description url releases "release version=\"$version\" date=\"[0-9-]*\"" examples 'example name="Lamp" folder="examples/lamp"' 'environment name="csolution"' \
    "component Cclass=\"Graphics\" Cgroup=\"Gnomon\" Cversion=\"$version\"" files; do
    grep -q "^$element" "$tmp/pdsc" && pass || fail "Gnomon.Gnomon.pdsc has no $element"
done
sed -n 's/^file category="\([a-zA-Z]*\)" name="\([^"]*\)".*/\1 \2/p' "$tmp/pdsc" >"$tmp/pdsc.files"
[ "$(wc -l <"$tmp/pdsc.files")" = "$(grep -c '^file ' "$tmp/pdsc")" ] && pass || fail "Gnomon.Gnomon.pdsc: a file without category or name"
while read -r category name; do
    case $category in doc | header | include | source) pass ;; *) fail "Gnomon.Gnomon.pdsc: category $category" ;; esac
    [ -e "$package/cmsis/$name" ] && pass || fail "Gnomon.Gnomon.pdsc: there is no $name"
done <"$tmp/pdsc.files"
if command -v xmllint >/dev/null 2>&1; then ok xmllint --noout ${PACK_XSD:+--schema "$PACK_XSD"} "$pdsc"; fi
# Each knob has its line for the wizard before it: a switch, or a range that its value lies in.
wizard() {
    awk -v all="$n_options" '
        /<<< Use Configuration Wizard/ { begins = NR }
        /^\/\/ <[oq]> / { items++; rest = substr($0, 7) }
        /^\/\/ <o> / { if (!match(rest, /<[0-9]+-[0-9]+>$/)) exit 1; split(substr(rest, RSTART + 1, RLENGTH - 2), range, "-"); rest = substr(rest, 1, RSTART - 1) }
        /^\/\/ <q> / { range[1] = 0; range[2] = 1 }
        /^\/\/ <[oq]> / { if (rest ~ /[<>]/) exit 1 }
        /^#define/ { n++; if (n != items || $3 < range[1] + 0 || $3 > range[2] + 0) exit 1 }
        END { exit !(n == all && n == items && begins > 0 && begins <= 100) }' "$1"
}
ok wizard "$package/cmsis/config/gnomon_config.h"
pre_include=$(sed -n '/<Pre_Include_Global_h>/,/<\/Pre_Include_Global_h>/s/^ *#define \([A-Z_]*\) \(.*\)/-D\1=\2/p' "$pdsc")
cmsis="-std=c99 -Wall -Wextra -Werror $kept -I$package/cmsis/src -I$package/cmsis/config"
ok $CC $cmsis "$pre_include" -o "$tmp/cmsis" "$spin" "$package/cmsis/src/gnomon.c"
same "$tmp/cmsis"
sed 's/GN_MAX_TRIANGLES 500/GN_MAX_TRIANGLES 501/' "$package/cmsis/config/gnomon_config.h" >"$tmp/sdk/gnomon_config.h"
ok $CC -std=c99 -I"$tmp/sdk" -I"$package/cmsis/src" "$pre_include" -c -o "$tmp/other.o" "$package/cmsis/src/gnomon.c"
ok $CC $cmsis "$pre_include" -o "$tmp/mixed" "$spin" "$tmp/other.o"
"$tmp/mixed" 2>&1 | grep -q "different configurations" && pass || fail "a knob of the wizard does not reach the library"
# A board of ten pictures: nothing, the left button, the right one. Prints a sum of each.
cat >"$tmp/lamp_board.c" <<'C'
#include <stdio.h>
#include <stdlib.h>
void panel_write(int x, int y, int w, int h, const void *pixels);
int button_is_down(int left_or_right);
static unsigned long sum = 5381, n_pictures;
void panel_write(int x, int y, int w, int h, const void *pixels)
{
    const unsigned char *p = pixels;
    for (int i = 0; i < 2 * w * h; i++) sum = sum * 33 + p[i];
    if (x + w < 160 || y + h < 128) return;
    printf("%lx\n", sum);
    sum = 5381;
    if (++n_pictures == 10) exit(0);
}
int button_is_down(int left_or_right) { return n_pictures == 1 + 2 * (unsigned long)left_or_right; }
C
for file in $(sed -n 's/^ *- file: //p; s/^ *- project: //p' "$package"/cmsis/examples/lamp/*.yml); do [ -e "$package/cmsis/examples/lamp/$file" ] && pass || fail "cmsis: there is no $file"; done
ok $CC $cmsis "$pre_include" -o "$tmp/lamp-example" "$package"/cmsis/examples/lamp/*.c "$package/cmsis/src/gnomon.c"
ok $CC $cmsis "$pre_include" -o "$tmp/lamp" "$package/cmsis/examples/lamp/lamp.c" "$tmp/lamp_board.c" "$package/cmsis/src/gnomon.c"
"$tmp/lamp" | awk '{ sum[NR] = $1 } END { exit !(NR == 10 && sum[1] != sum[2] && sum[2] == sum[3] && sum[4] == sum[1] && sum[10] == sum[1]) }' && pass ||
    fail "the lamp does not go there and back"

# ---- LVGL and MicroPython: on stand-ins of their headers; both draw the same scene ---------------------------------------------------

mkdir -p "$tmp/micropython"
standins=$root/tests/tool/packages
view=$package/examples/lvgl/gnomon_view.c
ok $CC -std=c99 -g1 -fsanitize=address,undefined -fno-sanitize-recover=all -Wall -Wextra -Werror $kept -I"$package/single" -I"$standins/lvgl" -o "$tmp/view" "$view" "$standins/lvgl/main.c" "$package/single/gnomon.c"
"$tmp/view" >"$tmp/view.rgb565" && pass || fail "lvgl: a view draws beside its rows, or not at all, or stays when it is deleted: status $?"
if [ -n "$LVGL" ]; then ok gcc -std=c99 -Wall -Wextra -Werror -DLV_CONF_SKIP -isystem "$LVGL" -isystem "$LVGL/include" -I"$package/single" -fsyntax-only "$view"; fi

module=$package/micropython/gnomon
printf 'USERMOD_DIR := %s\ninclude $(USERMOD_DIR)/micropython.mk\nall:\n\tclang -std=c11 -Wall -Wextra -Werror -Wno-unused-function $(CFLAGS_USERMOD) -I%s -o %s $(SRC_USERMOD_C) $(SRC_USERMOD_LIB_C) %s\n' \
    "$module" "$standins/micropython" "$tmp/upy" "$standins/micropython/main.c" >"$tmp/micropython/Makefile"
ok make -s -f "$tmp/micropython/Makefile" all
"$tmp/upy" >"$tmp/upy.rgb565" && pass || fail "micropython: the module raises no error, or none of its kind"
cmp -s "$tmp/view.rgb565" "$tmp/upy.rgb565" && pass || fail "LVGL and MicroPython show other pictures"
[ "$(od -An -v -tx2 -w2 "$tmp/upy.rgb565" | sort -u | wc -l)" -gt 5 ] && pass || fail "LVGL and MicroPython show nothing"
if command -v cmake >/dev/null 2>&1; then
    printf 'cmake_minimum_required(VERSION 3.13)\nproject(upy C)\nadd_library(usermod INTERFACE)\ninclude(%s)\nadd_executable(upy ${STANDINS}/main.c)\ntarget_include_directories(upy PRIVATE ${STANDINS})\ntarget_link_libraries(upy usermod)\n' \
        "$module/micropython.cmake" >"$tmp/micropython/CMakeLists.txt"
    ok cmake -S "$tmp/micropython" -B "$tmp/micropython/build" -DSTANDINS="$standins/micropython"
    ok cmake --build "$tmp/micropython/build"
    "$tmp/micropython/build/upy" | cmp -s - "$tmp/upy.rgb565" && pass || fail "micropython.cmake: another picture"
fi

# ---- Arduino: the examples by its own builder, on a host platform --------------------------------------------------------------

if command -v arduino-builder >/dev/null 2>&1; then
    mkdir -p "$tmp/hardware/gnomon/host" "$tmp/sketches" # one for all: the library is compiled once
    cp -r tests/property/arduino/platform.txt tests/property/arduino/boards.txt tests/property/arduino/cores tests/property/arduino/libraries "$tmp/hardware/gnomon/host"
    for sketch in "$package"/arduino/Gnomon/examples/*/*.ino; do
        rm -rf "$tmp/sketches/sketch"
        ok arduino-builder -compile -hardware "$tmp/hardware" -tools /usr/bin -libraries "$package/arduino" -fqbn gnomon:host:host -ide-version 10819 \
            -build-path "$tmp/sketches" -warnings all -prefs=tools.ctags.path=/usr/bin -prefs=tools.ctags.cmd.path=/usr/bin/arduino-ctags \
            '-prefs=tools.ctags.pattern="{cmd.path}" -u --language-force=c++ -f - --c++-kinds=svpf --fields=KSTtzns --line-directives "{source_file}"' "$sketch"
    done
else fail "arduino-builder is missing: apt-get install arduino-builder"
fi

# TFT_eSPI sends bytes as they lie in memory; a status is looked at; each tells its speed.
for sketch in boards/packages/arduino/*.ino; do
    ! grep -q pushImage "$sketch" || grep -q 'picture = .*RGB565_SWAPPED\|size = .*RGB565_SWAPPED' "$sketch" && pass || fail "$sketch: pushImage with bytes in the wrong order"
    grep -n -E '^ *gn_(init|render|begin|shadow_tile|prepare|screen_tile|pick)\(' "$sketch" >"$tmp/matches" && fail "$sketch: a status is not looked at: $(head -n 1 "$tmp/matches")" || pass
    grep -q 'Serial.println(1000.0 / (millis() - start))' "$sketch" && pass || fail "$sketch does not print its frames per second"
done

# ---- Manifests: library.properties of Arduino, keywords.txt, library.json of PlatformIO ------------------------------------------

# Addresses are filled in everywhere, and can be others.
URL=https://example.com/other sh boards/packages/dist.sh "$tmp/c" >/dev/null
grep -r -l '@[A-Z]*@' "$package" --include=*.json --include=*.yml --include=*.pdsc --include=*.properties >"$tmp/matches" && fail "not filled in: $(head -n 1 "$tmp/matches")" || pass
for file in arduino/Gnomon/library.properties arduino/Gnomon/library.json esp-idf/gnomon/idf_component.yml cmsis/Gnomon.Gnomon.pdsc; do
    grep -q 'https://example.org/gnomon' "$package/$file" && grep -q 'https://example.com/other' "$tmp/c/${package##*/}/$file" && pass || fail "$file does not name URL"
done

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
for key in name version description keywords authors repository homepage license examples headers frameworks platforms; do
    grep -q "^  \"$key\": " "$json" && pass || fail "library.json has no $key"
done
grep -q "\"version\": \"$version\"" "$json" && pass || fail "library.json has another version than $version"
awk '{ open += gsub(/[{[]/, "&"); shut += gsub(/[}\]]/, "&"); quotes += gsub(/"/, "&") } END { exit open != shut || quotes % 2 }' "$json" && pass || fail "library.json is not closed"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
