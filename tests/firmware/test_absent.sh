#!/bin/sh
# Off means absent: a feature that is not built leaves no symbol and takes no flash. And no call of the compiler's library but for what a core lacks.
# Sizes are of Cortex-M3 where its compiler is installed, else of this machine. "--table" prints them.
# That nothing is called which is not there: here of all but one feature.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/check.sh

features=$(sed -n '/GN_FEATURE_KNOBS/,$s/^    X([a-z_0-9]*, \([A-Z_0-9]*\), .*/\1/p' lib/gn_knobs.h)
cc=gcc prefix=
if command -v arm-none-eabi-gcc >/dev/null 2>&1; then
    cc="arm-none-eabi-gcc -mcpu=cortex-m3 -mthumb" prefix=arm-none-eabi-
    printf '#include <stddef.h>\nvoid *memset(void *, int, size_t);\nvoid *memcpy(void *, const void *, size_t);\n' >"$tmp/string.h"
fi
most() {
    case $1 in
    SHADOWS) echo 6 ;;
    VERTEX_JOINTS) echo 4 ;;
    MANY_CASCADES | BIASES | OTHER_LIGHTS | VERTEX_VALUES) echo 3 ;;
    INCREMENTAL) echo 3 ;;
    TILE_SIZES | CLIPPING | VALIDATION) echo 2 ;;
    TEXTURE_FORMATS) echo 2047 ;;
    PICTURES | MATERIALS) echo 15 ;;
    *) echo 1 ;;
    esac
}
# but WORD VALUE FEATURE...: all features off (none) or on (all), but these VALUE
but() {
    base=$1 value=$2
    shift 2
    for f in $features; do
        v=0
        [ "$base" = none ] || v=$(most "$f")
        for one in "$@"; do
            [ "$one" != "$f" ] || v=$value
            [ "$one" != "$f" ] || [ "$value" = 0 ] || v=$(most "$f")
        done
        echo "-DGN_$f=$v"
    done
}
object() { # object NAME FLAGS...
    name=$1
    shift
    $cc -std=c99 -ffreestanding -I"$tmp" -Ilib "$@" -c lib/gnomon.c -o "$tmp/$name.o" 2>"$tmp/log" || fail "$*: $(grep -m 1 error "$tmp/log")"
}
bytes() { # of flash: code and constants
    object size -Os "$@"
    size_of size
}
size_of() { ${2-$prefix}size -A "$tmp/$1.o" | awk '/^\.(text|rodata)/ { n += $2 } END { print n }'; }
# Of all that is built, with one feature off: nothing inlined, for its symbols and what it saves. Clang compiles it for this machine in a
# quarter of the time that GCC takes for a Cortex-M3.
if [ "$1" = --table ]; then
    whole() { object "$1" -Og -fno-inline $(but all 0 "$2") $3; }
    whole_prefix=$prefix
else
    whole() { of=$cc cc=clang && object "$1" -O0 $(but all 0 "$2") $3; cc=$of; }
    whole_prefix=
fi
without() { whole "all-$1" "$1"; }

# ---- Flash -----------------------------------------------------------------------------------------------------------------

# What a feature stands on: alone it has nothing to do.
under() {
    case $1 in
    CLIPPING | INCREMENTAL | SHADOWS | OTHER_LIGHTS | MATERIALS | PICTURES | VERTEX* | VALID* | *FORMATS) ;;
    *) echo SHADOWS ;;
    esac
}
without NOTHING
none=$(bytes $(but none 0)) all=$(size_of all-NOTHING "$whole_prefix")
if [ "$1" = --table ]; then
    shadows=$(bytes $(but none 1 SHADOWS))
    printf '%-18s %8s %14s %14s\n' feature alone "on its basis" "off, of all" "" "$none" "" "$all"
fi
idle= # what has nothing to do without shadows
for feature in $features; do
    [ "$(under $feature | cut -d ' ' -f 1)" != SHADOWS ] || idle="$idle $feature"
    without "$feature"
    ${whole_prefix}nm -u "$tmp/all-$feature.o" | grep ' gn_' >"$tmp/found" && fail "$feature is off, and missed: $(tr -s ' \n' ' ' <"$tmp/found")" || pass
    saved=$((all - $(size_of "all-$feature" "$whole_prefix")))
    # a constant that a check compares with is no code
    if [ $saved -ge -64 ]; then pass; else fail "$feature: off saves $saved bytes of all"; fi
    if [ "$1" = --table ]; then
        alone=$(($(bytes $(but none 1 $feature)) - none))
        basis=$alone
        case "$(under $feature)" in
        "") ;;
        SHADOWS) basis=$(($(bytes $(but none 1 $feature SHADOWS)) - shadows)) ;;
        *) basis=$(($(bytes $(but none 1 $feature $(under $feature))) - $(bytes $(but none 1 $(under $feature))))) ;;
        esac
        printf '%-18s %8s %14s %14s\n' "$feature" $alone $basis $saved
    fi
done
# Without shadows all of these together are a few comparisons.
[ "$(echo $idle | wc -w)" -ge 4 ] && pass || fail "what builds on shadows is $idle"
together=$(($(bytes $(but none 1 $idle)) - none))
if [ $together -le 32 ]; then pass
else fail "without shadows $together bytes:$(for feature in $idle; do echo " $feature $(($(bytes $(but none 1 $feature)) - none))"; done)"; fi

# ---- Symbols ---------------------------------------------------------------------------------------------------------------

symbols() { ${whole_prefix}nm --defined-only "$tmp/all-$1.o" | awk '{ print $3 }'; }
# gone NAME FEATURE PATTERN FLAG: no such symbol is in it. Without optimisation some are kept that nothing reaches: asked again with it.
gone() {
    symbols "$1" | grep -x -E "$3" | sort -u >"$tmp/found"
    [ -s "$tmp/found" ] || return 0
    object "reached-$1" -Og -fno-inline $(but all 0 "$2") $4
    ${prefix}nm --defined-only "$tmp/reached-$1.o" | awk '{ print $3 }' | grep -x -E "$3" | sort -u >"$tmp/found"
    [ ! -s "$tmp/found" ]
}
symbols NOTHING >"$tmp/all_symbols"
while read -r feature pattern; do
    grep -q -x -E "$pattern" "$tmp/all_symbols" && pass || fail "$feature: there is no symbol $pattern at all"
    gone "$feature" "$feature" "$pattern" && pass || fail "$feature is off, and there is $(tr '\n' ' ' <"$tmp/found")"
done <<'LIST'
SHADOWS gn_(atlas|caster|cascade|ortho|persp|filter|blocks|cull|tiles|bias)_.*|gn_tent.*|gn_disk_.*
OTHER_LIGHTS gn_(persp|punctual|object_list)_.*|main_light
MANY_CASCADES gn_cull_shown_nearer
TEXTURE_FORMATS gn_texture_(level_at|level_depth2|use_level)|gn_texture_colour|gn_alpha_coords|gn_srgb_decode_table|gn_linear_(31|63)_table|gn_texel_decode_.*
MATERIALS highlight_q30|emitted_light|begin_glow|alpha_plane|cut_begin|cut_row|gn_texture_mask
VERTEX_JOINTS gn_skin_.*|mean_matrix|skin_signature|gn_scene_skin_check
BIASES corner_normals|start_plane|dark_on_plane|gn_bias_auto_.*|.*_share_q3[02]|auto_.*
INCREMENTAL gn_kept_.*|view_signature|stays|gn_static_layer_.*|gn_sign_.*|gn_changes_.*|gn_touch|gn_note_.*
VALIDATION gn_scene_validate|check_.*light|gn_fail_field
PICTURES gradient_row|draw_behind|luminance_q20|fill_(grey4|mono)|flat_plane|flat_sphere|intersect_flat
TILE_SIZES sizes_by_importance|weight_of|gn_seen_.*|gn_ortho_(fit_tight|covers)|sides_by_worth|sixteenth_octaves|place_by_worth
OBJECT_BOXES gn_cull_sees|.*_sees
CLIPPING project_cut|general_triangle|clip_side|clip_to_reach
LIST

# Nor of a level what only a higher one has: a line has levels of features that do not call each other, and what none of them may leave.
while read -r levels; do
    flags= patterns=
    for word in $levels; do
        case $word in [A-Z]*=*) flags="$flags -UGN_${word%=*} -DGN_$word" ;; *) patterns=$patterns${patterns:+|}$word ;; esac
    done
    n_levels=$((n_levels + 1))
    whole all-level-$n_levels NOTHING "$flags"
    gone level-$n_levels NOTHING "$patterns" "$flags" && pass || fail "with$flags there is $(tr '\n' ' ' <"$tmp/found")"
done <<'LIST'
SHADOWS=1 gn_tent_weights|gn_disk_.*|disk.*|gn_blocks_.* PICTURES=6 luminance_q20|fill_(grey4|mono) MATERIALS=13 emitted_light|begin_glow CLIPPING=1 clip_side|clip_to_reach
SHADOWS=5 gn_disk_.*|gn_blocks_.* PICTURES=5 gradient_row|draw_behind MATERIALS=14 highlight_q30 TEXTURE_FORMATS=1 gn_texture_(level_at|level_depth2|use_level)|gn_linear_(31|63)_table|gn_texel_decode_(565|grey)
PICTURES=3 flat_plane|flat_sphere|intersect_flat MATERIALS=11 alpha_plane|cut_begin|cut_row BIASES=1 corner_normals|start_plane|dark_on_plane VALIDATION=1 gn_fail_field
OTHER_LIGHTS=1 main_light MATERIALS=7 gn_texture_mask INCREMENTAL=1 gn_static_layer_.*|gn_changes_.*|gn_touch|gn_note_.*|gn_kept_.*squares|gn_sign_(object|light|settings)
OTHER_LIGHTS=2 gn_(persp|punctual|object_list)_.* MANY_CASCADES=2 gn_cull_shown_nearer TEXTURE_FORMATS=1023 gn_texture_(level_at|level_depth2|use_level)
BIASES=2 gn_bias_auto_.*|.*_share_q3[02]|auto_.* INCREMENTAL=2 gn_static_layer_.* TILE_SIZES=1 gn_seen_.*|gn_ortho_(fit_tight|covers)|sides_by_worth
LIST

# Neither way of keeping triangles knows the other's functions.
gone NOTHING NOTHING 'gn_setup_tile|gn_raster_triangle|setup_.*groups|count_group|check_tiles' && pass || fail "groups of triangles without triangle_groups: $(tr '\n' ' ' <"$tmp/found")"
whole all-GROUPS NOTHING -DGN_TRIANGLE_GROUPS=64
gone GROUPS NOTHING 'raster_records|sort_triangles|bin_by_bounds|count_record|count_(few_)?tiles' -DGN_TRIANGLE_GROUPS=64 && pass || fail "records of triangles with triangle_groups: $(tr '\n' ' ' <"$tmp/found")"
symbols GROUPS | grep -q -x gn_setup_tile && pass || fail "triangle_groups: there is no symbol gn_setup_tile at all"

# Layers of transparent surfaces; "all" has none.
layers='gn_layers_.*|gn_mix_.*|shade_layers|link_layer|alpha_at'
gone NOTHING NOTHING "$layers" && pass || fail "layers without transparent_layers"
whole all-LAYERS NOTHING -DGN_TRANSPARENT_LAYERS=1
[ "$(symbols LAYERS | grep -c -x -E "$layers")" -ge 8 ] && pass || fail "transparent_layers: its functions are not there at all"

# ---- Divisions -------------------------------------------------------------------------------------------------------------

# The library has its own 64-bit division (that no pixel reaches it is tests/firmware/test_size.sh's to say) and calls no other.
if [ -n "$prefix" ]; then
    object divide -Os -fno-inline -DGN_PRESET=GN_PRESET_ACCURATE $(but all 0)
    ${prefix}nm "$tmp/divide.o" | awk '$1 == "U" { print $2 }' | grep -v -x -E 'mem(set|cpy|cmp|move)|__aeabi_u?idivmod|__aeabi_u?idiv|__aeabi_(mem|l?l[as][rl]).*' >"$tmp/found"
    if [ -s "$tmp/found" ]; then fail "the library calls $(tr '\n' ' ' <"$tmp/found")"; else pass; fi
    ${prefix}size "$tmp/divide.o" | awk 'NR == 2 { exit $2 + $3 != 0 }' && pass || fail ".data or .bss is not empty"
fi

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
