#!/bin/sh
# Knobs as Kconfig options, or as a header with annotations of the CMSIS Configuration Wizard, from lib/gn_knobs.h and what
# lib/gn_config.h makes of them. usage: kconfig.sh options|header|wizard
# Capacities, features and the preset, which sets the quality knobs: one of those alone is set by a definition, as anywhere.
cd "$(dirname "$0")/../.." || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cat >"$work/list.c" <<'LIST'
#include <stdio.h>
#include "gnomon.h"
#define KNOB(name, MACRO, lo, hi, meaning, cost) printf("%s|%d|%d|%d|%s|%s\n", #MACRO, lo, hi, (int)(GN_##MACRO), meaning, cost);
int main(void)
{
    printf("PRESET|0|3|%d|quality: 0 tiny, 1 fast, 2 balanced, 3 accurate|see the documents\n", (int)(GN_PRESET));
    GN_CAPACITY_KNOBS(KNOB)
    GN_FEATURE_KNOBS(KNOB)
    return 0;
}
LIST
${CC:-cc} -std=c99 -w -Ilib -o "$work/list" "$work/list.c" && "$work/list" >"$work/all" || exit 1
grep -v -E '^(ATLAS_TEXELS|OTHER_ATLAS_TEXELS)\|' "$work/all" >"$work/knobs" # atlases: by their size

case $1 in
options)
    awk -F '|' '
        { text = $5; gsub(/"/, "", text) }
        {
            print "config GNOMON_" $1
            print ($2 == 0 && $3 == 1 ? "    bool" : "    int") " \"" text "\""
            if ($2 != 0 || $3 != 1) print "    range " $2 " " $3
            print "    default " ($2 != 0 || $3 != 1 ? $4 : $4 ? "y" : "n")
            print "    help\n        Costs: " $6 ".\n"
        }' "$work/knobs" ;;
header)
    echo "/* Knobs from Kconfig: GN_USER_CONFIG of the ESP-IDF component and of the Zephyr module. */"
    printf '#ifdef ESP_PLATFORM\n#include "sdkconfig.h"\n#endif\n\n'
    awk -F '|' '
        $2 == 0 && $3 == 1 { printf "#ifdef CONFIG_GNOMON_%s\n#define GN_%s 1\n#else\n#define GN_%s 0\n#endif\n", $1, $1, $1; next }
        { printf "#define GN_%s CONFIG_GNOMON_%s\n", $1, $1 }' "$work/knobs" ;;
wizard)
    printf '/* Knobs of Gnomon: GN_USER_CONFIG of the CMSIS-Pack. */\n// <<< Use Configuration Wizard in Context Menu >>>\n'
    awk -F '|' '
        { text = $5; gsub(/[<>]/, "", text); costs = $6; gsub(/[<>]/, "", costs); is_switch = $2 == 0 && $3 == 1 }
        { printf "// %s %s: %s%s\n// <i> Costs: %s.\n", is_switch ? "<q>" : "<o>", $1, text, is_switch ? "" : " <" $2 "-" $3 ">", costs }
        { printf "#define GN_%s %s\n", $1, $4 }' "$work/knobs"
    echo '// <<< end of configuration section >>>' ;;
*) exit 2 ;;
esac
