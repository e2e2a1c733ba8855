#!/bin/sh
# gnomon sweep and gnomon advise: the front, budgets kept, what they promise reproduced by gnomon compare. usage: test_sweep.sh [TOOL]
# THOROUGH=1: advice at either end of the budgets for each of three scenes, more budgets of a second scene, and advice that counts on a target.
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh
size=32x24

run() { timeout 300 "$tool" "$@" >"$tmp/out" 2>"$tmp/err" </dev/null; }

good() { # good ARGUMENTS...: exit 0, nothing on stderr: no progress either
    run "$@"
    status=$?
    if [ $status != 0 ]; then fail "'$*' exits with $status: $(head -n 1 "$tmp/err")"
    elif [ -s "$tmp/err" ]; then fail "'$*' succeeds and writes to stderr: $(head -n 1 "$tmp/err")"
    else pass; fi
}

bad() { # bad STATUS WORD ARGUMENTS...: that exit status, nothing on stdout, a first line with that word
    expected=$1 word=$2
    shift 2
    run "$@"
    status=$?
    if [ $status != "$expected" ]; then fail "'$*' exits with $status, not $expected: $(head -n 1 "$tmp/err")"
    elif ! head -n 1 "$tmp/err" | grep -q -e "^gnomon: .*$word"; then fail "'$*' does not name '$word': $(head -n 1 "$tmp/err")"
    elif [ "$(grep -v -c "^'gnomon help[a-z ]*' says" "$tmp/err")" != 1 ]; then fail "'$*' complains in several lines"
    elif [ -s "$tmp/out" ]; then fail "'$*' fails and prints: $(head -n 1 "$tmp/out")"
    else pass; fi
}

# field NAME [OBJECT]: a number of the JSON object on one line in $tmp/out, outside its lists; of one of the objects in it
field() {
    sed 's/"lights": \[[^]]*\]//g; s/"sets": \[[^]]*\]//g' "$tmp/out" | sed "s/.*\"${2:-xx no such object}\": {/{/" |
        sed -n "s/^[^}]*\"$1\": \([-+.0-9a-z]*\).*/\1/p"
}

# ---- The sweep -----------------------------------------------------------------------------------------------------------------

head='configuration,front,ram_bytes,instructions_per_pixel,truth_identical,truth_within1,truth_psnr_db,truth_atten_rms,truth_shadow_mismatch,reference_identical,reference_within1,reference_psnr_db,reference_atten_rms,reference_shadow_mismatch,later_frames,later_instructions_per_pixel,later_most_instructions_per_pixel,later_truth_psnr_db,later_truth_worst_psnr_db,later_reference_psnr_db,later_reference_worst_psnr_db,target_instructions_per_pixel,target_later_instructions_per_pixel,n_tile_texels,'
for name in sundial desk mixed; do
    scene=host/scenes/$name.gltf csv=$tmp/$name.csv
    good sweep "$scene" --quick --size $size --csv "$csv" --svg "$tmp/$name.svg"
    cp "$tmp/out" "$tmp/$name.out"
    grep -q "configurations, [0-9]* of them on the front" "$tmp/out" && pass || fail "sweep of $name does not say how many are on the front"
    case $(head -n 1 "$csv") in "$head"*) pass ;; *) fail "columns of the CSV: $(head -n 1 "$csv")" ;; esac
    rows=$(($(wc -l <"$csv") - 1))
    [ $rows -ge 8 ] && pass || fail "sweep of $name has $rows rows"
    [ "$(sed 's/"[^"]*"//' "$csv" | awk -F, '{ print NF }' | sort -u | wc -l)" = 1 ] && pass || fail "rows of the CSV differ in length"

    # the front is one, of the frames that are played: nothing dominates what is on it, something dominates whatever is not
    awk -F '"' 'NR > 1 { split($3, v, ","); n++; front[n] = v[2]; ram[n] = v[3]; cost[n] = v[16]; db[n] = v[18] == "inf" ? 1e9 : v[18] + 0; if (v[15] != 8) print "row " n " frames" }
        END {
            for (i = 1; i <= n; i++) {
                beaten = 0
                for (k = 1; k <= n; k++)
                    if (ram[k] <= ram[i] && cost[k] <= cost[i] && db[k] >= db[i] && (ram[k] < ram[i] || cost[k] < cost[i] || db[k] > db[i])) beaten = 1
                if (beaten == front[i]) print "row " i
                on += front[i]
            }
            if (!on) print "no row"
        }' "$csv" >"$tmp/found"
    [ -s "$tmp/found" ] && fail "front of $name: wrong about $(head -n 3 "$tmp/found" | tr '\n' ' ')" || pass

    # more accurate is not worse
    awk -F '"' '$2 ~ /^preset=tiny( atlas_size=16)?$/ { split($3, tiny, ",") } $2 ~ /^preset=accurate( atlas_size=16)?$/ { split($3, best, ",") }
        END { exit !(best[7] >= tiny[7] && best[10] >= tiny[10] && best[3] >= tiny[3] && tiny[3] > 0) }' "$csv" &&
        pass || fail "sweep of $name: the accurate preset is not better than tiny"

    # every number of two rows is what compare says of these settings
    for row in 3 $rows; do
        line=$(sed -n "${row}p" "$csv")
        settings=$(echo "$line" | awk -F '"' '{ print $2 }')
        [ "$settings" = "the scene's own" ] && settings=
        set --
        for setting in $settings; do set -- "$@" --set "$setting"; done
        good compare "$scene" --size $size --json --with truth "$@"
        got="$(field ram_bytes) $(field psnr_db fixed_truth) $(field shadow_mismatch fixed_truth) $(field psnr_db fixed_reference) $(field identical fixed_reference)"
        want=$(echo "$line" | awk -F '"' '{ split($3, v, ","); print v[3], v[7], v[9], v[12], v[10] }' | sed 's/ inf / null /g') # JSON has no infinity
        [ "$got" = "$want" ] && pass || fail "$name with '$settings': compare says $got, the sweep $want"
    done

    # the picture: one root, all points in both panels, nothing that runs or is fetched
    [ "$(grep -c '<circle' "$tmp/$name.svg")" = $((2 * rows)) ] && pass || fail "$name.svg has $(grep -c '<circle' "$tmp/$name.svg") points"
    [ "$(tail -n 1 "$tmp/$name.svg")" = '</svg>' ] && [ "$(grep -c '<svg' "$tmp/$name.svg")" = 1 ] && pass || fail "$name.svg does not end"
    grep -q -i -E '<script|<image|href|@import|url\(|nan|inf' "$tmp/$name.svg" && fail "$name.svg is not self-contained, or has no number" || pass
    if command -v xmllint >/dev/null; then xmllint --noout "$tmp/$name.svg" 2>"$tmp/found" && pass || fail "$name.svg: $(head -n 1 "$tmp/found")"; fi
done

good sweep host/scenes/sundial.gltf --quick --size $size --json
[ "$(grep -o '"front": ' "$tmp/out" | wc -l)" = $(($(wc -l <"$tmp/sundial.csv") - 1)) ] && [ "$(wc -l <"$tmp/out")" = 1 ] && pass || fail "sweep --json has other rows than the CSV"
good sweep host/scenes/sundial.gltf --quick --size $size --set filter=5x5 --set preset=tiny --all
grep -q 'filter=\|preset=' "$tmp/out" && fail "sweep varies what --set holds" || pass
good sweep host/scenes/sundial.gltf --quick --size $size --set shadows=0

# ---- Fits and tiles ------------------------------------------------------------------------------------------------------------

# the same atlas without tight fits and tiles by worth: farther from exact shadows, and not more bytes; a single spot has nothing to fit
for name in sundial mixed; do
    awk -F '"' '$2 ~ /^preset=balanced filter=hard( (other_)?atlas_size=64)+( fit=stable tiles=equal)?$/ { split($3, v, ","); i = $2 ~ /fit=/; n++; ram[i] = v[3]; db[i] = v[7]; off[i] = v[9] }
        END { exit !(n == 2 && off[0] < off[1] && db[0] > db[1] && ram[1] < ram[0]) }' "$tmp/$name.csv" || fail "sweep of $name: fits and tiles make no difference in the same atlas"
    pass
done
grep -q 'fit=\|tiles=' "$tmp/desk.csv" && fail "the sweep of desk varies fits of a single spot" || pass
good sweep host/scenes/sundial.gltf --quick --size $size --set fit=tight --all
! grep -q 'fit=' "$tmp/out" && grep -q 'tiles=equal$' "$tmp/out" && pass || fail "sweep varies the fit that --set holds, or not the tiles"
good sweep host/scenes/sundial.gltf --quick --size $size --set tile_sizes=0 --all
grep -q 'fit=\|tiles=' "$tmp/out" && fail "sweep varies fits that are not built" || pass
# a compiled fit where a light stands while something moves: what compare says of the first frame and of a later one
held="--size 16x12 --set preset=balanced --set filter=hard --set atlas_size=64 --set other_atlas_size=64 --set depth_bits=16 --set other_depth_bits=16 --set cascades=2 --set persp_step=8 --set triangle_groups=0 --set subpixel_bits=6"
for name in sundial mixed; do
    # shellcheck disable=SC2086
    good sweep host/scenes/$name.gltf $held --csv "$tmp/$name.fits.csv"
    sed 's/^"\([^"]*\)".*/\1/' "$tmp/$name.fits.csv" | tr '\n' ';' >"$tmp/found"
    for fits in 'fit=stable;' 'tiles=equal;' 'fit=stable tiles=equal;'; do grep -q ";$fits" "$tmp/found" && pass || fail "the sweep of $name has no $fits of $(cat "$tmp/found")"; done
done
grep -q '^"fit=compiled"' "$tmp/sundial.fits.csv" && fail "the sweep of sundial compiles fits for a light that turns" || pass
worst=
for frame in 0 1 2 3 4 5 6 7 8; do
    # shellcheck disable=SC2086
    run compare host/scenes/mixed.gltf $held --json --with truth --frame $frame --set fit=compiled
    [ $frame = 0 ] && first=$(field psnr_db fixed_truth) || worst=$(printf '%s\n%s\n' "$worst" "$(field psnr_db fixed_truth)" | grep . | sort -g | sed 1q)
done
[ -n "$first" ] && [ "$(awk -F '"' '$2 == "fit=compiled" { split($3, v, ","); print v[7], v[19] }' "$tmp/mixed.fits.csv")" = "$first $worst" ] && pass ||
    fail "with compiled fits compare says $first, and $worst at worst; the sweep $(grep '^"fit=compiled' "$tmp/mixed.fits.csv" | cut -d , -f 1-7,19)"

# ---- From frame to frame -------------------------------------------------------------------------------------------------------

# what is played, its tiles kept, is what each frame is on its own
frames=
for frame in 1 2 3 4 5 6 7 8; do
    good compare host/scenes/mixed.gltf --size $size --json --with truth --frame $frame
    frames="$frames $(field psnr_db fixed_truth)"
done
awk -F '"' -v frames="$frames" 'NR > 1 && $2 == "the scene'"'"'s own" {
        split($3, v, ",")
        n = split(frames, db, " ")
        worst = db[1]
        for (i = 1; i <= n; i++) { sum += 10 ^ (-db[i] / 10) / n; if (db[i] < worst) worst = db[i] }
        apart = v[18] + 10 * log(sum) / log(10)
        exit !(n == 8 && apart < 1e-6 && apart > -1e-6 && v[19] == worst && v[17] >= v[16])
    }
    END { if (!NR) exit 1 }' "$tmp/mixed.csv" && pass || fail "the frames that are played of mixed are not those that compare draws: $frames"

# a schedule changes nothing in the first frame, and saves in later ones
for name in sundial mixed; do
    awk -F '"' 'NR > 1 {
            m = split($3, v, ",")
            key = v[3]; for (i = 5; i <= 14; i++) key = key "," v[i]
            if ($2 ~ / refresh=4$/) { n++; scheduled = key; cost = v[16]; most = v[17] }
            else later[key] = v[16] " " v[17]
        }
        END { split(later[scheduled], base, " "); exit !(n == 1 && cost < base[1] && most <= base[2]) }' "$tmp/$name.csv" &&
        pass || fail "refresh=4 of $name is not the same first frame for less"
done
grep -q 'Cascades on a schedule' "$tmp/mixed.out" && grep -q ' dB  preset=balanced refresh=4$' "$tmp/mixed.out" && pass || fail "the sweep of mixed says nothing of schedules"
good sweep host/scenes/mixed.gltf --quick --size $size --set refresh=2 --all
grep -q 'refresh=' "$tmp/out" && fail "sweep varies the schedule that --set holds" || pass
good sweep host/scenes/mixed.gltf --quick --size $size --set incremental=0 --csv "$tmp/each.csv"
awk -F '"' 'NR > 1 { split($3, v, ","); if ($2 ~ /refresh/ || v[16] < 0.9 * v[4]) exit 1 }' "$tmp/each.csv" && pass || fail "without incremental something is kept"

# nothing moves: the second frame has its tiles, and there is no schedule to look at
good sweep host/scenes/avenue.gltf --quick --size $size --csv "$tmp/avenue.csv" --all
grep -q '^nothing moves' "$tmp/out" && ! grep -q 'refresh=' "$tmp/out" && pass || fail "the sweep of avenue does not say that nothing moves"
awk -F '"' 'NR > 1 { split($3, v, ","); if (v[15] != 1 || v[16] >= v[4] || v[16] != v[17] || v[18] != v[7] || v[20] != v[12]) exit 1 }' "$tmp/avenue.csv" &&
    pass || fail "what a later frame of avenue costs"

# ---- Advice --------------------------------------------------------------------------------------------------------------------

for name in sundial desk ${THOROUGH:+mixed}; do
    scene=host/scenes/$name.gltf csv=$tmp/$name.csv
    least=$(awk -F '"' 'NR > 1 { split($3, v, ","); if (!n++ || v[3] < least) least = v[3] } END { print least }' "$csv")
    case $name$THOROUGH in desk) factors=11 ;; sundial) factors=60 ;; *) factors='11 60' ;; esac
    for factor in $factors; do
        budget=$((least * factor / 10))
        good advise "$scene" --quick --size $size --ram $budget --json
        arguments=$(sed -n 's/.*"arguments": "\([^"]*\)".*/\1/p' "$tmp/out")
        ram=$(field ram_bytes) cost=$(field instructions_per_pixel later) db=$(field truth_psnr_db later) first=$(field psnr_db truth)
        promised="$ram $(field psnr_db reference) $(field shadow_mismatch reference)"
        [ "$ram" -le $budget ] && pass || fail "advice for $name: $ram bytes do not fit into $budget"
        awk -F '"' -v ram="$ram" -v cost="$cost" -v db="$db" -v budget=$budget 'NR > 1 {
                split($3, v, ",")
                if (v[3] <= budget && v[18] > db + 0.01) exit 1
                if (v[3] <= ram && v[16] <= cost && v[18] >= db && (v[3] < ram || v[16] < cost - 1e-6 || v[18] > db + 1e-6)) exit 1
            }' "$csv" && pass || fail "advice for $name in $budget bytes is not on the front: $arguments"
        # shellcheck disable=SC2086
        good compare "$scene" --size $size --json $arguments
        got="$(field ram_bytes) $(field psnr_db) $(field shadow_mismatch)"
        [ "$got" = "$promised" ] && pass || fail "$name with $arguments: promised $promised, compare says $got"
        case $arguments in *cascades* | *preset=fast*) continue ;; esac # where shadows end, and light at vertices: in the truth too
        # shellcheck disable=SC2086
        good compare "$scene" --size $size --json --with truth $arguments
        [ "$(field psnr_db fixed_truth)" = "$first" ] && pass || fail "$name with $arguments: promised $first dB against the truth, compare says $(field psnr_db fixed_truth)"
    done
done

# more of either budget is never worse, and no row of the sweep that fits is better than the advice
for name in fence $([ -z "$THOROUGH" ] || echo avenue); do
    case $name in fence) costs='2500 5000' ;; *) costs='4600 7000' ;; esac
    scene=host/scenes/$name.gltf csv=$tmp/$name.csv
    good sweep "$scene" --quick --size 32x24 --csv "$csv"
    : >"$tmp/answers"
    for ram in 22000 400000; do
        for cost in $costs; do
            run advise "$scene" --quick --size 32x24 --ram $ram --instructions-per-pixel $cost --json
            [ $? = 2 ] && fail "advice for $name in $ram bytes: $(head -n 1 "$tmp/err")"
            echo "$ram $cost $(field ram_bytes) $(field instructions_per_pixel) $(field truth_psnr_db later)" >>"$tmp/answers"
        done
    done
    awk -F '"' 'NR == FNR { split($0, v, " "); n++; ram[n] = v[1]; cost[n] = v[2]; db[n] = v[5] == "" ? -1 : v[5] + 0; answers += db[n] > 0
                    if (v[3] + 0 > v[1] || v[4] + 0 > v[2]) print "beyond " $0
                    next }
        FNR > 1 { split($3, v, ","); for (i = 1; i <= n; i++) if (v[3] <= ram[i] && v[4] <= cost[i] && v[18] > db[i] + 0.01) print "sweep: " $2 " in " ram[i], cost[i] }
        END {
            if (answers < 4) print answers " answers"
            for (i = 1; i <= n; i++) for (k = 1; k <= n; k++)
                if (ram[k] >= ram[i] && cost[k] >= cost[i] && db[k] < db[i] - 0.02) print ram[k], cost[k] ": " db[k] ", but in " ram[i], cost[i] ": " db[i]
        }' "$tmp/answers" "$csv" >"$tmp/found"
    [ -s "$tmp/found" ] && fail "advice for $name: $(head -n 3 "$tmp/found" | tr '\n' ';')" || pass
done

# what is left of the RAM buys fewer instructions: no other screen tile that fits is cheaper, and as accurate
held="--size $size --set preset=tiny --set filter=hard --set persp_step=1"
good advise host/scenes/desk.gltf --quick $held --ram 30000 --json
advised=$(field instructions_per_pixel later) db=$(field truth_psnr_db later) arguments=$(sed -n 's/.*"arguments": "\([^"]*\)".*/\1/p' "$tmp/out")
for tile in "16 4" "32 4" "32 16" "64 4" ${THOROUGH:+"16 16" "64 8" "64 16" "128 8"}; do
    # shellcheck disable=SC2086
    run compare host/scenes/desk.gltf --json $held $arguments --set tile_width="${tile% *}" --set tile_height="${tile#* }"
    [ "$(field ram_bytes)" -le 30000 ] || continue
    # shellcheck disable=SC2086
    run sweep host/scenes/desk.gltf --quick $held $arguments --set tile_width="${tile% *}" --set tile_height="${tile#* }" --csv "$tmp/tile.csv"
    awk -F '"' -v tile="$tile" -v advised="$advised" -v db="$db" 'NR > 1 { split($3, v, ","); if (v[16] < advised - 1e-4 && v[18] >= db) print tile ": " v[16] " < " advised }' "$tmp/tile.csv" >>"$tmp/cheaper"
    n_tiles=$((n_tiles + 1))
done
[ "${n_tiles:-0}" -ge 3 ] && [ ! -s "$tmp/cheaper" ] && pass || fail "of $n_tiles other tiles, cheaper than advised: $(head -n 2 "$tmp/cheaper")"

# advice takes tight fits where they pay, and says what they are good for: what compare says of the same atlas
good advise host/scenes/fence.gltf --quick --size $size --set preset=accurate --ram 100000
grep -q '^--set preset=accurate .*--set fit=tight' "$tmp/out" && pass || fail "advice for fence has no tight fit: $(head -n 1 "$tmp/out")"
said=$(sed -n 's/^  with fit=stable  *\([0-9.]*\) dB,.* mismatch \([0-9.]*\) %, \([0-9]*\) bytes .*/\1 \2 \3/p' "$tmp/out")
# shellcheck disable=SC2046
good compare host/scenes/fence.gltf --size $size --json --with truth $(sed 1q "$tmp/out") --set fit=stable
[ "$said" = "$(printf '%.2f %.3f %d' "$(field psnr_db fixed_truth)" "$(awk "BEGIN { print 100 * $(field shadow_mismatch fixed_truth) }")" "$(field ram_bytes)")" ] && pass || fail "advice for fence says of stable fits: $said"
good advise host/scenes/desk.gltf --quick --size $size --ram 100000
grep -q '^  with ' "$tmp/out" && fail "advice for desk has something to say of fits" || pass

# a budget of both kinds, and those that nothing fits: what is named would do, and a byte less would not
good advise host/scenes/fence.gltf --quick --size $size --ram 100000 --instructions-per-pixel 100000
bad 1 'no configuration fits into 1000 bytes at 32x24; the least RAM found: [0-9]* bytes and .* by --set' advise host/scenes/fence.gltf --quick --size $size --ram 1000
least=$(sed -n 's/.*the least RAM found: \([0-9]*\) bytes.*/\1/p' "$tmp/err")
good advise host/scenes/fence.gltf --quick --size $size --ram "$least"
bad 1 'no configuration fits' advise host/scenes/fence.gltf --quick --size $size --ram $((least - 1))
bad 1 'the fewest instructions found within the RAM: [0-9]* bytes' advise host/scenes/fence.gltf --quick --size $size --ram 100000 --instructions-per-pixel 5
bad 1 'the nearest: [0-9]* bytes' advise host/scenes/fence.gltf --quick --size $size --ram 1000 --instructions-per-pixel 5 --json

# ---- On a target ---------------------------------------------------------------------------------------------------------------

# one configuration of a still scene, so that one image is built; a terminal sees what is at work
one="--set preset=tiny --set filter=hard --set atlas_size=64 --set fit=tight --set tiles=worth"
counted="$tool sweep host/scenes/fence.gltf --quick --size $size $one --target mps2-an385 --csv $tmp/counted.csv --svg $tmp/counted.svg"
if command -v script >/dev/null; then
    script -q -e -c "$counted" "$tmp/typescript" >/dev/null 2>&1 </dev/null
    grep -q '0 of 1 counted on mps2-an385' "$tmp/typescript" && pass || fail "a terminal does not see that something is counted"
else $counted >/dev/null 2>&1; fi
got=$(awk -F '"' 'NR == 2 { split($3, v, ","); printf "%.3f %.3f", v[22], v[23] }' "$tmp/counted.csv")
# the same, counted by hand
sh boards/tools/count.sh mps2-an385 test-sweep "0,0 1" FW_OPT=-O2 SCENE=host/scenes/fence.gltf PRESET=tiny \
    SCENE_FLAGS="--size $size --frames 0-1 --simplify safe --set filter=hard --set atlas_size=64 --set output=rgb565" >"$tmp/stages" 2>&1
want=$(awk '/^args:/ { run++ } $1 == "stage" { n[run] += $3 } END { printf "%.3f %.3f", n[1] / 32 / 24, (n[2] - n[1]) / 32 / 24 }' "$tmp/stages")
[ "$got" = "$want" ] && pass || fail "counted on mps2-an385: $got, and by hand $want"
sh boards/tools/count.sh --remove mps2-an385 test-sweep
echo "$got" | awk '{ exit !($1 > 100 && $2 > 100 && $2 < $1) }' && pass || fail "tiles that are kept save nothing on mps2-an385: $got"
[ "$(grep -c '<circle' "$tmp/counted.svg")" = 3 ] && grep -q 'Cost on mps2-an385' "$tmp/counted.svg" && pass || fail "the plot has no panel of mps2-an385"
ls build/firmware/mps2-an385 | grep -q '^sweep-' && fail "the sweep leaves images behind" || pass
# shellcheck disable=SC2086
if [ "$THOROUGH" ]; then # an image more
    good advise host/scenes/fence.gltf --quick --size $size $one --set persp_step=8 --set subpixel_bits=4 --set tile_width=32 --set tile_height=8 --set depth_bits=16 --set cascades=1 \
        --ram 100000 --instructions-per-pixel 100000 --target mps2-an385 --json
    grep -q '"target": {"board": "mps2-an385", "instructions_per_pixel": [0-9.]*, ' "$tmp/out" && pass || fail "advice for mps2-an385 was not counted: $(head -c 300 "$tmp/out")"
fi

# where nothing counts, the reason is said once; a board that there is not, or that QEMU does not run, is an error
scene=host/scenes/fence.gltf
mkdir -p "$tmp/ghost"
printf '# A core that nobody has a compiler for.\nBOARD_RUNS := qemu\nBOARD_CROSS := ghost-none-\nBOARD_CPU := -mcpu=ghost\nBOARD_COMMON := semihosting\nBOARD_EMULATOR := qemu-system-ghost\n' >"$tmp/ghost/board.mk"
run sweep $scene --quick --size 8x8 --target "../$tmp/ghost" --csv "$tmp/ghost.csv" && pass || fail "without a toolchain the sweep fails: $(head -n 1 "$tmp/err")"
[ "$(grep -c 'ghost-none-gcc is not installed' "$tmp/err")" = 1 ] && [ "$(wc -l <"$tmp/err")" = 1 ] && pass || fail "without a toolchain: $(head -n 2 "$tmp/err")"
awk -F '"' 'NR > 1 { split($3, v, ","); if (v[22] != "" || v[23] != "" || v[24] == "") exit 1 } END { exit !(NR > 5) }' "$tmp/ghost.csv" && pass || fail "columns that were not counted are not empty"
run advise $scene --quick --size 8x8 --ram 100000 --instructions-per-pixel 100000 --target "../$tmp/ghost"
[ $? = 1 ] && grep -q 'is of .*ghost: without --target' "$tmp/err" && pass || fail "a budget that nothing counts is taken: $(tail -n 1 "$tmp/err")"
bad 1 "no board 'nowhere'" sweep $scene --target nowhere
bad 1 'QEMU does not run pico' sweep $scene --target pico
bad 1 "no board 'nowhere'" advise $scene --ram 100000 --target nowhere
bad 2 target compile $scene -o "$tmp/c" --target mps2-an385

# ---- Usage ---------------------------------------------------------------------------------------------------------------------

scene=host/scenes/sundial.gltf
bad 2 ram advise $scene
bad 2 ram advise $scene --ram 0
bad 2 ram advise $scene --ram many
bad 2 instructions advise $scene --ram 1000 --instructions-per-pixel -1
bad 2 csv advise $scene --ram 1000 --csv "$tmp/x.csv"
bad 2 scene sweep
bad 2 engine sweep $scene --engine fixed
bad 2 ram sweep $scene --ram 1000
bad 2 value sweep $scene --csv
bad 1 missing sweep "$tmp/missing.gltf"
bad 1 atlas_size sweep $scene --set atlas_size=3
bad 1 "$tmp/no/x.csv" sweep $scene --quick --size 8x8 --csv "$tmp/no/x.csv"
bad 1 "$tmp/no/x.svg" sweep $scene --quick --size 8x8 --svg "$tmp/no/x.svg"
if command -v script >/dev/null; then # a terminal sees progress
    script -q -e -c "$tool sweep $scene --quick --size 8x8" "$tmp/typescript" >/dev/null 2>&1 </dev/null
    grep -q '3 of [0-9]* configurations' "$tmp/typescript" && pass || fail "no progress on a terminal"
fi

# ---- docs/data/TRADE.md -------------------------------------------------------------------------------------------------------------

# one scene made anew; all of them take minutes: sh docs/trade.sh build/gnomon
mkdir "$tmp/docs"
sh docs/trade.sh "$tool" "$tmp/docs" avenue >/dev/null 2>"$tmp/err" && pass || fail "docs/trade.sh: $(head -n 1 "$tmp/err")"
cmp -s docs/data/TRADE.md "$tmp/docs/data/TRADE.md" && pass || fail "docs/data/TRADE.md is out of date: make docs ($(diff docs/data/TRADE.md "$tmp/docs/data/TRADE.md" | sed -n 2p))"
new=$tmp/docs/pictures/trade-avenue.svg # without what was counted
grep '<circle' docs/pictures/trade-avenue.svg | head -n "$(grep -c '<circle' "$new")" >"$tmp/points"
[ -s "$tmp/points" ] && grep '<circle' "$new" | cmp -s - "$tmp/points" && pass || fail "docs/pictures/trade-avenue.svg is out of date: make docs"
for name in sundial avenue desk room fence mixed; do
    [ "$(grep -c "^| $name | \(128\|64\)² | [0-9]* | [0-9.]* % | [0-9.]* | [0-9]* | [0-9.]* % | [0-9.]* |$" docs/data/TRADE.md)" = 2 ] && pass || fail "docs/data/TRADE.md does not compare fits of $name"
    [ -s docs/pictures/trade-$name.svg ] && grep -q "../pictures/trade-$name.svg" docs/data/TRADE.md && pass || fail "docs/data/TRADE.md has no picture of $name"
done

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
