#!/bin/sh
# The short tables of cost in README.md and docs/COST.md, from the committed baselines: it measures nothing. Each header names its build.
#   sh docs/cost.sh --table NAME            prints one. sizes: flash, RAM and stack by configuration. speed: instructions, flash and frames per second
#                                           by scene, with -O2. builds: instructions and flash by scene, with -O2 and with -Os. cores, parts: what
#                                           estimates are made of. characters: models that people load, beside a3d. changes: frames that change little.
#                                           model: how far the cost model is off
#   sh docs/cost.sh                         writes them into the documents
# Frames per second: the board's clock / (counted instructions × cycles per instruction), both as in host/tool/cost/part_table.h. A dot: not measured.
cd "$(dirname "$0")/.." || exit 1

sizes() {
    awk '
        /^#/ { next }
        { figure[$1, $2, $3, $4] = $5 }
        function flash(core, c, what) { return ("flash", core, c, what) in figure ? figure["flash", core, c, what] : "·" }
        END {
            print "| configuration | flash, Cortex-M3, -O2 | flash, Cortex-M3, -Os | flash, Cortex-M0+, -Os | flash, RV32IMAC, -Os | RAM | stack, Cortex-M3, -Os |"
            print "| --- | --- | --- | --- | --- | --- | --- |"
            n = split("smallest small tiny fast balanced accurate full", name, " ")
            for (i = 1; i <= n; i++) {
                c = name[i]
                printf "| %s | %s | %s | %s | %s | %d | %d |\n", c, flash("Cortex-M3", c, "linked-O2"), flash("Cortex-M3", c, "linked"), flash("Cortex-M0+", c, "linked"),
                    flash("RV32IMAC", c, "linked"), figure["ram", "Cortex-M3", c, "total"], figure["stack", "Cortex-M3", c, "gn_render"]
            }
        }' tests/firmware/size_baseline.txt
}

# scenes END: the counts of the own scenes, read into total, per_px and flash by core, scene and preset; then END
scenes() {
    awk '
        NR == FNR {
            if (split($0, f, /[(),]/) < 3) next
            gsub(/[" ]/, "", f[2])
            if (f[1] == "BOARD") clock[f[2]] = f[3]
            if (f[1] == "CORE") cycles[f[2]] = f[5]
            next
        }
        $1 != "scene" || $13 != 320 * 240 { next }
        {
            sum = 0
            for (i = 5; i <= 12; i++) sum += $i
            total[$2, $3, $4] = sum
            per_px[$2, $3, $4] = sprintf("%.0f", sum / $13)
            if (NF > 16) flash[$2, $3, $4] = $17
            if (!($3 in seen)) { seen[$3]; scene[++n] = $3 }
        }
        function px(core, s, preset) { return (core, s, preset) in per_px ? per_px[core, s, preset] : "·" }
        function bytes(core, s, preset) { return (core, s, preset) in flash ? flash[core, s, preset] : "·" }
        function per_second(core, s, board, kind) { return sprintf("%.1f", clock[board] * 1e6 / (total[core, s, "balanced"] * cycles[kind])) }
        '"$1" host/tool/cost/part_table.h tests/bench/bench_target_baseline.txt
}

speed() {
    scenes 'END {
        print "| scene, 320×240, -O2 | tiny | fast | balanced | accurate | flash, balanced | balanced, Cortex-M0 | frames per second: Pico, 125 MHz | nRF52840, 64 MHz | STM32F411, 100 MHz | STM32F429, 168 MHz |"
        print "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
        for (i = 1; i <= n; i++) {
            s = scene[i]
            printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", s, px("M3", s, "tiny"), px("M3", s, "fast"), px("M3", s, "balanced"), px("M3", s, "accurate"),
                bytes("M3", s, "balanced"), px("M0", s, "balanced"), per_second("M0", s, "pico", "cortex-m0"), per_second("M4", s, "nrf52840-dk", "cortex-m4"),
                per_second("M4", s, "black-pill", "cortex-m4"), per_second("M4", s, "stm32f429-discovery", "cortex-m4")
        }
    }'
}

builds() {
    scenes 'END {
        print "| scene, 320×240, balanced, Cortex-M3 | instructions per pixel, -O2 | flash, -O2 | instructions per pixel, -Os | flash, -Os |"
        print "| --- | --- | --- | --- | --- |"
        for (i = 1; i <= n; i++) {
            s = scene[i]
            printf "| %s | %s | %s | %s | %s |\n", s, px("M3", s, "balanced"), bytes("M3", s, "balanced"), px("M3-Os", s, "balanced"), bytes("M3-Os", s, "balanced")
        }
    }'
}

# By gn_render_changes, tests/bench/bench_target.sh
changes() {
    echo "| 320×240, balanced, Cortex-M3, -O2; millions of instructions | first frame | a frame in which it moves | of the first | a still frame |"
    echo "| --- | --- | --- | --- | --- |"
    awk '
        BEGIN {
            says["gauge"] = "gauge: a needle turns over a dial"; says["game"] = "game: 3 of 30 boxes move (`incremental` 3)"; says["cube"] = "cube: what casts turns in the middle"
            says["sundial"] = "sundial: the light turns"; says["desk"] = "desk: the lamp swings"; says["mixed"] = "mixed: sails of a mill, lights of all kinds"
        }
        $1 != "changes" { next }
        { sum = 0; for (i = 5; i <= 12; i++) sum += $i; total[$3, $4] = sum / 1e6 }
        $4 == "still" {
            first = total[$3, "first"]; later = (total[$3, "later"] - first) / 4
            printf "| %s | %.2f | %.2f | %.0f %% | %.2f |\n", says[$3] ? says[$3] : $3, first, later, 100 * later / first, (sum / 1e6 - total[$3, "later"]) / 4
        }' tests/bench/bench_target_baseline.txt
}

# Counted: whole frames of scenes and characters, from the least ratio to the largest.
cores() {
    echo "| core | instructions per one of a Cortex-M3 | counted | cycles per instruction |"
    echo "| --- | --- | --- | --- |"
    awk '
        $1 == "model" || ($1 == "scene" && $4 == "balanced" && $13 == 320 * 240) {
            n = 0
            for (i = 5; i <= 12; i++) n += $i
            total[$2, $3] = n
            core[$2]; name[$3]
        }
        function range(kind, as,    k, r, least, most) {
            for (k in name) {
                if (!((kind, k) in total)) continue
                r = total[kind, k] / total["M3", k]
                if (!least || r < least) least = r
                if (r > most) most = r
            }
            counted[as] = least ? sprintf("%.2f to %.2f", least, most) : "·"
        }
        /^CORE/ {
            split($0, f, /[(),]/)
            for (i = 2; i <= 5; i++) { gsub(/"/, "", f[i]); sub(/^ /, "", f[i]) }
            if (f[2] == "") next
            range(f[2] == "cortex-m0" ? "M0" : f[2] == "cortex-m4" ? "M4" : f[2] == "rv32" ? "RV32" : "none", f[2])
            printf "| %s | %s | %s | %s |\n", f[3], f[4] + 0, counted[f[2]], f[5] + 0
        }' tests/bench/bench_target_baseline.txt tests/bench/bench_models.txt host/tool/cost/part_table.h
}

parts() {
    echo "| part | cores | MHz | RAM, KB | flash, KB | SPI of the panel, MHz |"
    echo "| --- | --- | --- | --- | --- | --- |"
    awk -F '[(),]' '$1 == "PART" { gsub(/"/, "", $2); printf "| %s | %d | %s | %d | %d | %s |\n", $2, $4, $5 + 0, $6, $7, $8 + 0 }' host/tool/cost/part_table.h
}

# From counted instructions: of the Cortex-M0 for Cortex-M0+, of the RV32IMAC for RISC-V and Xtensa, of the Cortex-M3 for the others.
characters() {
    awk -F '[(),]' '
        NR == FNR {
            gsub(/"/, "", $2); gsub(/[" ]/, "", $3)
            if ($1 == "CORE") cycles[$2] = $5
            if ($1 == "PART") { part[++n] = $2; core[n] = $3; cores[n] = $4; mhz[n] = $5; panel[n] = $8 }
            next
        }
        { split($0, f, " ") }
        f[1] == "model" { prepare[f[2], f[3]] = f[5] + f[6] + f[7] + f[8] + f[9]; tiles[f[2], f[3]] = f[10] + f[11] + f[12] }
        f[1] == "a3d" { other[f[2], "Fox"] = f[3]; other[f[2], "CesiumMan"] = f[4] }
        function per_second(i, model, n_cores,    kind, render, sent) {
            kind = core[i] == "cortex-m0" ? "M0" : core[i] ~ /^cortex/ ? "M3" : "RV32"
            render = (prepare[kind, model] + tiles[kind, model] / n_cores) * cycles[core[i]] / (mhz[i] * 1e6)
            sent = 240 * 320 * 16 / (panel[i] * 1e6)
            return sprintf("%.1f", 1 / (render > sent ? render : sent))
        }
        function theirs(i, model) { return (part[i], model) in other ? other[part[i], model] : "·" }
        END {
            print "| frames per second, 240×320 | Fox, all cores | CesiumMan, all cores | Fox, one core | CesiumMan, one core | a3d, one core: Fox | a3d: CesiumMan |"
            print "| --- | --- | --- | --- | --- | --- | --- |"
            for (i = 1; i <= n; i++)
                printf "| %s | %s | %s | %s | %s | %s | %s |\n", part[i], per_second(i, "Fox", cores[i]), per_second(i, "CesiumMan", cores[i]),
                    per_second(i, "Fox", 1), per_second(i, "CesiumMan", 1), theirs(i, "Fox"), theirs(i, "CesiumMan")
        }' host/tool/cost/part_table.h tests/bench/bench_models.txt
}

# What cost_table.h says of itself.
model() {
    echo "| pictures | error, RMS | at most |"
    echo "| --- | --- | --- |"
    sed -n 's/^ \* Fitted to \([0-9]*\) pictures of \([0-9]*\) scenes.* total: \([0-9.]* %\) RMS, \([0-9.]* %\) at most.*/| all that it is fitted to: \1 of \2 scenes | \3 | \4 |/p
        s/^ \*   \([^:]*\): \([0-9.]* %\) RMS, \([0-9.]* %\) at most/| \1, when left out | \2 | \3 |/p
        s/^ \* All that were left out: \([0-9.]* %\) RMS, \([0-9.]* %\) at most; nine in ten within \([0-9.]* %\)\./| all, each left out; nine in ten within \3 | \1 | \2 |/p' host/tool/cost/cost_table.h
}

if [ "${1:-}" = --table ]; then "$2"; exit; fi
mkdir -p build/tmp
work=$(mktemp -d build/tmp/cost.XXXXXX)
trap 'rm -rf "$work"' EXIT
for name in sizes speed builds cores parts characters changes model; do
    $name >"$work/table"
    for document in README.md docs/COST.md; do
        awk -v name="$name" -v file="$work/table" '
            $0 == "<!-- generated: " name " -->" { print; while ((getline line < file) > 0) print line; skip = 1; next }
            $0 == "<!-- end -->" { skip = 0 }
            !skip { print }' "$document" >"$work/next"
        cp "$work/next" "$document"
    done
done
