#!/bin/sh
# Draws docs/pictures/frame.svg, the way of a frame. A box below: x y width height kind|title|lines of text, separated by |.
# An arrow: its corners, x,y each. A frame: what repeats. Names of functions are those of lib/ (tests/documents/test_words.sh). usage: frame.sh [OUT.svg]
cd "$(dirname "$0")/.." || exit 1
awk '
BEGIN {
    fill["data"] = "#fff4d6"; line["data"] = "#c9a227"
    fill["stage"] = "#e3eefb"; line["stage"] = "#4a7dbd"
    fill["out"] = "#e2f3e2"; line["out"] = "#4b9a4b"
    print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 960 710\" font-family=\"sans-serif\" font-size=\"14\">"
    print "<defs><marker id=\"tip\" markerWidth=\"9\" markerHeight=\"9\" refX=\"8\" refY=\"4\" orient=\"auto\"><path d=\"M0,0 L9,4 L0,8 z\" fill=\"#555\"/></marker></defs>"
    print "<rect width=\"960\" height=\"710\" fill=\"#ffffff\"/>"
}
/^frame / {
    printf "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" rx=\"8\" fill=\"#f6f6f6\" stroke=\"#999\" stroke-dasharray=\"6 4\"/>\n", $2, $3, $4, $5
    split($0, part, "|")
    printf "<text x=\"%d\" y=\"%d\" fill=\"#444\">%s</text>\n", $2 + 16, $3 + $5 - 10, part[2]
    next
}
/^box / {
    n = split($0, part, "|")
    split(part[1], at, " ")
    printf "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" rx=\"6\" fill=\"%s\" stroke=\"%s\"/>\n", at[2], at[3], at[4], at[5], fill[at[6]], line[at[6]]
    printf "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\" font-weight=\"bold\">%s</text>\n", at[2] + at[4] / 2, at[3] + 22, part[2]
    for (i = 3; i <= n; i++)
        printf "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\" font-size=\"12.5\">%s</text>\n", at[2] + at[4] / 2, at[3] + 22 + 18 * (i - 2), part[i]
    next
}
/^arrow / {
    sub(/^arrow /, "")
    printf "<polyline points=\"%s\" fill=\"none\" stroke=\"#555\" stroke-width=\"1.5\" marker-end=\"url(#tip)\"/>\n", $0
}
END { print "</svg>" }' >"${1:-docs/pictures/frame.svg}" <<'END'
frame 30 448 900 190 |gn_screen_tile, for every tile of the picture, also on several cores: the rest is read-only now
box 300 10 360 68 data|scene|meshes, textures, objects, lights, camera|constant data in flash; what moves in RAM
arrow 480,78 480,102
box 230 104 500 86 stage|gn_begin|refuses what is out of range; the camera|which light reaches which object|which light gets which shadow tile, and what it covers
arrow 360,190 360,206 230,206 230,222
arrow 600,190 600,206 730,206 730,222
box 50 224 360 104 stage|gn_prepare|transforms vertices, culls back faces|clips at the near plane, projects|finds the plane of depth of each triangle|sorts triangles into screen tiles
box 550 224 360 104 stage|gn_shadow_tile, for each that changed|which casters the light sees|projects their triangles, seen from the light|writes the smallest depth per texel|notes bounds of depth per 8 × 8 texels
arrow 230,328 230,348
arrow 730,328 730,348
box 90 350 280 68 data|triangles|32 bytes each, and for every|screen tile the list of those that touch it
box 590 350 280 68 data|shadow atlas|depths, kept from frame to frame|while nothing in a tile changes
arrow 230,418 230,436 156,436 156,466
arrow 730,418 730,436 640,436 640,466
box 46 468 220 140 stage|gn_raster_tile|the nearest triangle|of every pixel: one word,|depth above, triangle below;|then the visible runs|of each triangle
arrow 266,538 286,538
box 288 468 408 140 stage|gn_shade_tile, a triangle at a time|light at the corners of cells of 16 to 2 pixels|shadow: a window says of each texel whether it is before|or behind the surface; the filter counts these bits|parts of one answer are filled, uneven cells split|colours between the corners are linear
arrow 696,538 716,538
box 718 468 196 140 stage|encoding|sRGB curve, rounding|to RGB565, RGB888,|greys or one bit; what|the caller draws over it
arrow 816,608 816,646
box 700 648 232 50 out|flush|the tile goes to the panel
arrow 700,673 482,673
box 248 648 232 50 out|picture|never whole in RAM
END
