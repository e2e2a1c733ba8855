#!/bin/sh
# Draws docs/pictures/window.svg: how a window of texels answers for the shadow of a surface (docs/NUMERICS.md 4.13). Left, a row of
# texels from the side: which lie before the plane by more than m, which behind it, which in doubt. Right, the window from above, with
# what two lookups of the 3x3 filter read. usage: window.sh [OUT.svg]
cd "$(dirname "$0")/.." || exit 1
awk '
function text(x, y, s, more) { printf "<text x=\"%g\" y=\"%g\" %s>%s</text>\n", x, y, more, s }
function rect(x, y, w, h, more) { printf "<rect x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" %s/>\n", x, y, w, h, more }
function line(x0, y0, x1, y1, more) { printf "<line x1=\"%g\" y1=\"%g\" x2=\"%g\" y2=\"%g\" %s/>\n", x0, y0, x1, y1, more }
function plane(x) { return 150 + 0.22 * (x - 40) } # its depth, downwards, in the drawing
function kind(depth, at) { return depth < at - margin ? "dark" : depth > at + margin ? "lit" : "doubt" }
BEGIN {
    margin = 22
    fill["dark"] = "#5b6b80"; fill["lit"] = "#ffe9a8"; fill["doubt"] = "#f0a35e"
    print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1010 400\" font-family=\"sans-serif\" font-size=\"13\">"
    rect(0, 0, 1010, 400, "fill=\"#ffffff\"")
    text(40, 28, "A row of texels from the side", "font-size=\"15\" font-weight=\"bold\"")
    text(40, 48, "light from above; each texel holds the smallest depth that it saw")
    line(30, 70, 30, 330, "stroke=\"#555\"")
    text(24, 84, "near the light", "text-anchor=\"end\" transform=\"rotate(-90 24 84)\"")
    n = split("72 84 90 126 178 206 188 225 262 240 268 262", depth, " ")
    for (i = 1; i <= n; i++) { # the caster, then the surface itself, kept behind its plane by bias
        x = 40 + 34 * (i - 1)
        k = kind(depth[i], plane(x + 17))
        line(x + 17, 64, x + 17, depth[i] - 3, "stroke=\"#c9b458\" stroke-dasharray=\"2 4\"")
        rect(x + 2, depth[i], 30, 8, "fill=\"" fill[k] "\" stroke=\"#333\"")
    }
    line(36, plane(36), 452, plane(452), "stroke=\"#1f5fa8\" stroke-width=\"2.5\"")
    line(36, plane(36) - margin, 452, plane(452) - margin, "stroke=\"#1f5fa8\" stroke-dasharray=\"6 4\"")
    line(36, plane(36) + margin, 452, plane(452) + margin, "stroke=\"#1f5fa8\" stroke-dasharray=\"6 4\"")
    text(456, plane(452) + 4, "the surface", "fill=\"#1f5fa8\"")
    text(456, plane(452) - margin + 2, "&#8722;m", "fill=\"#1f5fa8\"")
    text(456, plane(452) + margin + 6, "+m", "fill=\"#1f5fa8\"")
    m = split("dark:before the plane by more than m: dark for every pixel|doubt:within m: compared with each pixel that reads it|lit:behind it by more than m: lit for every pixel", legend, "|")
    for (i = 1; i <= m; i++) {
        split(legend[i], part, ":")
        name = part[1]
        words = legend[i]
        sub(/^[a-z]*:/, "", words)
        rect(40, 322 + 22 * i - 11, 16, 12, "fill=\"" fill[name] "\" stroke=\"#333\"")
        text(64, 322 + 22 * i, words)
    }
    text(570, 28, "The window from above: a bit per texel", "font-size=\"15\" font-weight=\"bold\"")
    text(570, 48, "up to 32 &#215; 32 texels, compared once for all pixels")
    for (y = 0; y < 12; y++) for (x = 0; x < 14; x++) {
        edge = 4.6 + 0.35 * y + (y == 3 || y == 8 ? 0.8 : 0)
        k = x + 0.5 < edge - 0.5 ? "dark" : x + 0.5 > edge + 0.5 ? "lit" : (x + y) % 3 == 0 ? "doubt" : x + 0.5 < edge ? "dark" : "lit"
        rect(570 + 24 * x, 64 + 24 * y, 24, 24, "fill=\"" fill[k] "\" stroke=\"#ffffff\"")
    }
    rect(570 + 24 * 9, 64 + 24 * 1, 96, 96, "fill=\"none\" stroke=\"#1b7a1b\" stroke-width=\"3\"")
    text(570 + 24 * 9 + 48, 64 + 24 * 3 + 4, "all lit", "text-anchor=\"middle\" fill=\"#1b7a1b\" font-weight=\"bold\"")
    rect(570 + 24 * 4, 64 + 24 * 6, 96, 96, "fill=\"none\" stroke=\"#b01818\" stroke-width=\"3\"")
    text(570 + 24 * 8 + 8, 64 + 24 * 8 + 4, "an edge: weights", "fill=\"#b01818\" font-weight=\"bold\"")
    text(570 + 24 * 8 + 8, 64 + 24 * 8 + 20, "of lit bits add up", "fill=\"#b01818\" font-weight=\"bold\"")
    text(570, 372, "Squares: the 4 &#215; 4 texels that one lookup of the 3 &#215; 3 filter reads.")
    text(570, 390, "A part that reads only lit, or only dark texels is filled.")
    print "</svg>"
}' >"${1:-docs/pictures/window.svg}"
