#!/bin/sh
# make report: the page has everything in itself, says what the metrics say, and is shown as it should be. usage: test_report.sh [TOOL]
cd "$(dirname "$0")/../.." || exit 1
tool=${1:-build/gnomon}
. tests/support/check.sh
make -s "$(dirname "$tool")/make_report" >/dev/null || fail "make_report is not built"
scenes="sundial avenue desk room fence mixed"
page=$tmp/report/index.html

# shellcheck disable=SC2046
sh host/report/report.sh "$tool" 64x48 "$tmp/report" $(for name in $scenes; do echo host/scenes/$name.gltf@2; done) >"$tmp/out" 2>&1 && pass ||
    fail "report.sh: $(head -n 1 "$tmp/out")"
grep -q '^report:.*host/report\|^report: .*make_report' Makefile && pass || fail "make report does not make the page"

count() { # count NUMBER PATTERN
    found=$(grep -o -e "$2" "$page" | wc -l)
    [ "$found" = "$1" ] && pass || fail "the page has $found of $2, not $1"
}
count 66 '<img data-picture='
count 66 'src="data:image/png;base64,'
count 6 '<section class="scene" id='
count 10 '<svg role="img"'
count 18 '<td class="word">'
for name in $scenes bias; do grep -q "id=\"$name\"" "$page" && grep -q "href=\"#$name\"" "$page" && pass || fail "no section $name, or no link to it"; done
[ "$(grep -c '<img' "$page")" = "$(grep -c '<img [^>]*width="64" height="48" alt="[A-Z][^"]' "$page")" ] && pass || fail "a picture without a size or a text"
[ "$(tail -n 1 "$page")" = '</html>' ] && pass || fail "the page does not end"

# nothing comes from elsewhere
grep -n -i -E 'https?:|//[a-z]|<link|<iframe|@import|url\(|fetch\(|XMLHttp' "$page" | grep -v '^[0-9]*:.*src="data:image/png' | grep -v '^[0-9]*:[[:space:]]*// ' >"$tmp/found"
[ -s "$tmp/found" ] && fail "the page refers to something: $(head -c 200 "$tmp/found")" || pass
sed 's/src="data:[^"]*"//g' "$page" | grep -q -i ' src=' && fail "a source that is not in the page" || pass

# the pictures and numbers are those of compare
sed -n 's/.*data-picture="fixed" .*alt="Desk[^"]*" src="data:image\/png;base64,\([^"]*\)".*/\1/p' "$page" | base64 -d >"$tmp/desk.png"
cmp -s "$tmp/desk.png" "$tmp/report/desk/balanced/fixed.png" && pass || fail "the desk's picture is not compare's"
for name in $scenes; do
    for preset in fast balanced accurate; do
        want=$(sed 's/.*"fixed_reference"//; s/"reference_truth".*//; s/"lights".*//' "$tmp/report/$name/$preset.json" | sed 's/.*"identical": \([0-9.]*\).*/\1/' | awk '{ printf "%.2f", 100 * $1 }')
        awk -v name="$name" -v preset=$preset '/<tr><th scope="rowgroup"/ { at = index($0, "#" name "\"") } at && index($0, ">" preset "<")' "$page" | grep -q ">$want&#8239;%<" &&
            pass || fail "$name, $preset: the summary does not say $want % identical"
    done
done

# the same atlas: pictures and figures are those of compare without and with tight fits and tiles by worth, and shadows are nearer to exact ones
picture() { sed -n "s/.*data-picture=\"$2\" .*alt=\"$1,.*src=\"data:image\/png;base64,\([^\"]*\)\".*/\1/p" "$page" | base64 -d; }
figure() { sed -n "s/.*data-picture=\"$2\" .*alt=\"$1,.*<b>$2<\/b>[^:]*: mismatch \([0-9.]*\)&#8239;%, PSNR \([0-9.]*\)&#8239;dB.*/\1 \2/p" "$page"; }
for name in Fence Mixed; do
    scene=host/scenes/$(echo $name | tr FM fm).gltf
    set -- --size 64x48 --frame 2 --set preset=balanced --set filter=hard
    for fits in "before stable equal" "after tight worth"; do
        which=${fits%% *} fit=${fits#* }
        "$tool" compare "$scene" "$@" --set fit="${fit% *}" --set tiles="${fit#* }" --with truth --json -o "$tmp/fits" >"$tmp/fits.json" 2>/dev/null
        picture $name $which >"$tmp/shown.png"
        cmp -s "$tmp/shown.png" "$tmp/fits/fixed.png" && pass || fail "$name: the picture $which is not compare's with $fits"
        picture $name error_$which >"$tmp/shown.png"
        cmp -s "$tmp/shown.png" "$tmp/fits/error_fixed_truth.png" && pass || fail "$name: the error $which is not compare's with $fits"
        sed 's/.*"fixed_truth": {\([^[]*\).*/\1/; s/.*"psnr_db": \([0-9.]*\).*"shadow_mismatch": \([0-9.]*\).*/\1 \2/' "$tmp/fits.json" | awk '{ printf "%.2f %.1f\n", 100 * $2, $1 }' >"$tmp/$which"
        [ -s "$tmp/$which" ] && [ "$(figure $name $which)" = "$(cat "$tmp/$which")" ] && pass || fail "$name: $which the page says $(figure $name $which), compare $(cat "$tmp/$which")"
    done
    picture $name exact >"$tmp/shown.png"
    cmp -s "$tmp/shown.png" "$tmp/fits/truth.png" && pass || fail "$name: no exact shadows beside them"
    [ "$(paste -d ' ' "$tmp/before" "$tmp/after" | awk '{ print ($3 < $1 && $4 > $2) }')" = 1 ] && pass || fail "$name: after is not nearer to exact shadows than before: $(cat "$tmp/before" "$tmp/after" | tr '\n' ' ')"
done

# what is missing is named
"$(dirname "$tool")/make_report" "$tmp/none.html" "$tmp" docs/pictures host/report nothing >"$tmp/out" 2>&1 && fail "a missing folder is no error" || pass
grep -q 'nothing/fast.json' "$tmp/out" && pass || fail "a missing folder is not named: $(head -n 1 "$tmp/out")"
"$(dirname "$tool")/make_report" >/dev/null 2>&1
[ $? = 2 ] && pass || fail "make_report without arguments does not exit with 2"

# ---- In a browser --------------------------------------------------------------------------------------------------------------

# Tells on the root element what the browser made of the page, before and after the controls of the first scene are used.
cat >"$tmp/probe.html" <<'PROBE'
<script>
addEventListener("load", () => {
  const root = document.documentElement, stage = document.querySelector(".stage"), slider = stage.querySelector("input");
  const wider = [...document.querySelectorAll("main *")].filter((e) => !e.closest(".wide") && e.getBoundingClientRect().right > root.clientWidth + 1);
  const broken = [...document.images].filter((i) => !i.complete || !i.naturalWidth), said = [];
  said.push(`fits ${root.scrollWidth <= root.clientWidth} at ${innerWidth}`, `wider ${wider.length}`, `broken ${broken.length}`, `stages ${document.querySelectorAll(".stage").length}`);
  slider.value = 250;
  slider.dispatchEvent(new Event("input"));
  said.push(`edge ${getComputedStyle(stage).getPropertyValue("--at")}`);
  document.querySelector(".bar input").click();
  said.push(`right ${stage.querySelector(".right").textContent}`);
  const buttons = document.querySelectorAll(".bar button");
  buttons[0].click();
  said.push(`error ${stage.querySelectorAll("img")[1].src === document.querySelector("[data-picture=error_fixed_reference]").src}`);
  const errors = ["error_before", "error_after"].map((name) => document.querySelector(`[data-picture=${name}]`).src);
  document.querySelectorAll(".bar input")[3].click();
  said.push(`fits ${[...stage.querySelectorAll("img")].every((image, i) => image.src === errors[i])} ${stage.querySelector(".left").textContent.slice(0, 12)}`);
  buttons[1].click();
  said.push(`blink ${getComputedStyle(stage.querySelectorAll("img")[1]).animationName} ${buttons[1].ariaPressed}`);
  const small = [...document.querySelectorAll("nav a, .bar label, .bar button")].filter((e) => e.getBoundingClientRect().height < 32).length;
  said.push(`small ${small}`);
  if (parent === window) root.dataset.probe = said.join("; ");
  else parent.postMessage(said.join("; "), "*");
});
</script>
PROBE
browse() { # browse ARGUMENTS...
    timeout 60 chromium --headless --no-sandbox --disable-gpu --disable-background-networking --disable-sync --no-first-run --hide-scrollbars \
        --user-data-dir="$tmp/browser" --virtual-time-budget=3000 "$@" 2>/dev/null
}
probed() { # probed WORD...: each is in what the probe told
    for word in "$@"; do case "; $told; " in *"; $word; "*) pass ;; *) fail "in the browser, $where: no '$word' in '$told'" ;; esac done
}
if command -v chromium >/dev/null; then
    here=file://$(cd "$tmp" && pwd)
    cat "$page" "$tmp/probe.html" >"$tmp/probed.html"
    # a window has a least width that a phone has not: the page in a frame, which tells its parent
    cat >"$tmp/phone.html" <<'PHONE'
<!doctype html><body style="margin:0"><iframe src="probed.html" style="border:0;width:360px;height:1400px"></iframe>
<script>addEventListener("message", (e) => { document.documentElement.dataset.probe = e.data; });</script>
PHONE
    where=desktop
    told=$(browse --window-size=1280,900 --screenshot="$tmp/desktop.png" --dump-dom "$here/probed.html" | sed -n 's/.*data-probe="\([^"]*\)".*/\1/p')
    probed "fits true at 1280" "wider 0" "broken 0" "stages 6" "edge 25%" "right reference" "error true" "fits true error before" "blink blink true" "small 0"
    where=phone
    told=$(browse --window-size=500,1400 --screenshot="$tmp/phone.png" --dump-dom "$here/phone.html" | sed -n 's/.*data-probe="\([^"]*\)".*/\1/p')
    probed "fits true at 360" "wider 0" "broken 0" "stages 6" "edge 25%" "right reference" "error true" "fits true error before" "blink blink true" "small 0"
    browse --window-size=1280,900 --screenshot="$tmp/light.png" "$here/report/index.html" >/dev/null
    browse --window-size=1280,900 --blink-settings=preferredColorScheme=0 --screenshot="$tmp/dark.png" "$here/report/index.html" >/dev/null
    sed '/^<script>$/,/^<\/script>$/d' "$page" >"$tmp/plain.html" # as without JavaScript
    [ "$(browse --window-size=1280,900 --screenshot="$tmp/plain.png" --dump-dom "$here/plain.html" | grep -o '<img data-picture=' | wc -l)" = 66 ] && pass ||
        fail "pictures are missing without JavaScript"
    for shot in light dark plain; do [ "$(wc -c <"$tmp/$shot.png" 2>/dev/null || echo 0)" -gt 20000 ] && pass || fail "no screenshot, or an empty one: $shot"; done
    cmp -s "$tmp/light.png" "$tmp/dark.png" && fail "a dark screen sees the light page" || pass
else
    echo "chromium is missing: the page is not shown"
fi

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
