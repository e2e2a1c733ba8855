#!/bin/sh
# Draws docs/pictures/cascades.svg: four cascades from above, by the formulas of MODEL 4: slices of the frustum, their spheres, their tiles.
# The sun stands overhead, turned by 20 degrees against the camera, so that tiles are squares here. usage: cascades.sh [OUT.svg]
cd "$(dirname "$0")/.." || exit 1
awk '
function min(a, b) { return a < b ? a : b }
function max(a, b) { return a > b ? a : b }
# centre depth c and radius r of the sphere of the slice from depth n to m, k and q of MODEL 4
function sphere(n, m,    a, b, C, root) {
    a = 1 - q * q; b = n - q * q * m; C = (1 + k * k) * (q * q * m * m - n * n)
    root = b * b + a * C
    c = root >= 0 && C > 0 ? min(m, C / (sqrt(root) - b)) : m
    r = sqrt(max((m - c) ^ 2 + k * k * m * m, ((c - n) ^ 2 + k * k * n * n) / (q * q)))
}
function x(depth) { return 200 + unit * depth }
function y(side) { return 350 + unit * side }
function text(at_x, at_y, what, more) { printf "<text x=\"%.1f\" y=\"%.1f\" %s>%s</text>\n", at_x, at_y, more, what }
BEGIN {
    focal = 1 / (sin(0.349) / cos(0.349)); aspect = 4 / 3 # 40 degrees from top to bottom
    k = sqrt(aspect * aspect + 1) / focal; q = 0.9; near = 0.5; far = 40; unit = 11
    n = split("0.22 0.4 0.6 1", ratio, " ")
    split("#c03030 #2f8f3f #a040a0 #b08a10", colour, " ")
    texels = 64; inner = texels - 2 * 2 * (1 + sqrt(2)) - 1 # a 3x3 filter and bias_normal 1
    print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1060 660\" font-family=\"sans-serif\" font-size=\"14\">"
    print "<rect width=\"1060\" height=\"660\" fill=\"#ffffff\"/>"
    edge = aspect / focal
    begin = near
    for (i = 1; i <= n; i++) {
        end = ratio[i] * far
        sphere(begin, end)
        side = 2 * r * texels / inner # of the tile
        printf "<g transform=\"translate(%.1f %.1f) rotate(20)\"><rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\" fill-opacity=\"0.05\" stroke=\"%s\" stroke-dasharray=\"5 4\"/>", \
            x(c), y(0), -unit * side / 2, -unit * side / 2, unit * side, unit * side, colour[i], colour[i]
        if (i == 1) # the texels of the smallest tile, every fourth line
            for (j = 4; j < texels; j += 4) {
                at = unit * side * (j / texels - 0.5)
                printf "<path d=\"M%.1f,%.1f V%.1f M%.1f,%.1f H%.1f\" stroke=\"%s\" stroke-opacity=\"0.3\" stroke-width=\"0.6\"/>", at, -unit * side / 2, unit * side / 2, -unit * side / 2, at, unit * side / 2, colour[i]
            }
        print "</g>"
        printf "<polygon points=\"%.1f,%.1f %.1f,%.1f %.1f,%.1f %.1f,%.1f\" fill=\"%s\" fill-opacity=\"0.16\" stroke=\"%s\"/>\n", \
            x(begin), y(begin * edge), x(end), y(end * edge), x(end), y(-end * edge), x(begin), y(-begin * edge), colour[i], colour[i]
        printf "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"none\" stroke=\"%s\" stroke-width=\"2\"/>\n", x(c), y(0), unit * r, colour[i]
        text(x(end) - 4, y(0) + 5, i - 1, "text-anchor=\"end\" font-weight=\"bold\" fill=\"" colour[i] "\"")
        text(20, 560 + 20 * i, sprintf("cascade %d: %.1f to %.1f", i - 1, begin, end), "fill=\"" colour[i] "\"")
        text(270, 560 + 20 * i, sprintf("texel %.2f", side / texels), "text-anchor=\"end\" fill=\"" colour[i] "\"")
        begin = end
    }
    printf "<path d=\"M%.1f,%.1f l-16,-9 v18 z\" fill=\"#333\"/>\n", x(0), y(0)
    text(x(0) - 16, y(0) + 28, "camera", "")
    text(20, 30, "Filled: a slice of what the camera sees. Circle: the sphere of the slice; a point is looked up in the first sphere that holds it.", "")
    text(20, 50, "Dashed: its shadow tile, 64 × 64 texels whatever its size. Its grid stands in the world: a moving camera shifts it by whole texels.", "")
    print "</svg>"
}' >"${1:-docs/pictures/cascades.svg}"
