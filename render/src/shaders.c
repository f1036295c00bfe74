#include "render/src/shaders.h"

/* The light of each vertex comes from shade.c. */
const char *const shader_shade_vertex =
    "#version 330 core\n"
    "layout(location=0) in vec3 position;\n"
    "layout(location=1) in vec4 light;\n"
    "layout(location=2) in vec4 spark;\n"
    "layout(location=3) in vec3 colour;\n"
    "layout(location=4) in vec2 value;\n" /* scalar in parts of the range, 1 if there is data */
    "uniform mat4 move, to_clip;\n"
    "centroid out vec4 lit, added;\n" /* at the border of a triangle too the values lie between its corners' */
    "centroid out vec3 base;\n"
    "centroid out vec2 shown;\n"
    "invariant gl_Position;\n"
    "void main() {\n"
    "    vec4 w = move * vec4(position, 1.0);\n"
    "    lit = light;\n"
    "    added = spark;\n"
    "    base = colour;\n"
    "    shown = value;\n"
    "    gl_Position = to_clip * w;\n"
    "}\n";

#define SHADE_FRAGMENT(albedo)                                                                                         \
    "#version 330 core\n"                                                                                              \
    "centroid in vec4 lit, added;\n"                                                                                   \
    "centroid in vec3 base;\n"                                                                                         \
    "centroid in vec2 shown;\n"                                                                                        \
    "uniform float fade;\n"                                                                                            \
    "uniform sampler2D map;\n"                                                                                         \
    "uniform vec3 no_data;\n"                                                                                          \
    "out vec4 result;\n"                                                                                               \
    "void main() {\n" albedo /* light between the walls of a hollow: 1/(1 - albedo (1 - sky)) sums bounces */          \
    "    vec3 c = albedo * lit.rgb / (1.0 - 0.85 * albedo * lit.a) + added.rgb;\n" /* the inside of an open surface:   \
                                                                                      flat and dull, so that it is not \
                                                                                      taken for an outside */          \
    "    if (!gl_FrontFacing) c = albedo * vec3(0.23, 0.215, 0.22);\n"                                                 \
    "    result = vec4(c * added.a, added.a);\n"                                                                       \
    "}\n"

const char *const shader_shade_fragment = SHADE_FRAGMENT("    vec3 albedo = base;\n");

const char *const shader_map_fragment =
    SHADE_FRAGMENT("    vec3 mapped = texture(map, vec2((clamp(shown.x, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5)).rgb;\n"
                   "    float share = fade > 0.0 ? clamp(shown.x / fade, 0.0, 1.0) : 1.0;\n"
                   "    vec3 albedo = shown.y > 0.999 ? mix(base, mapped, share) : no_data;\n");

const char *const shader_ball_vertex =
    "#version 330 core\n"
    "layout(location=0) in vec3 position;\n"
    "uniform mat4 to_clip;\n"
    "uniform float size;\n"
    "void main() { gl_Position = to_clip * vec4(position, 1.0); gl_PointSize = size + 1.0; }\n";

const char *const shader_ball_fragment =
    "#version 330 core\n"
    "uniform vec3 colour;\n"
    "uniform float flat_shade, size;\n"
    "out vec4 result;\n"
    "void main() {\n"
    "    vec2 d = 2.0 * gl_PointCoord - 1.0;\n"
    "    d *= (size + 1.0) / size;\n"
    "    float r = length(d), inside = clamp(0.5 + (1.0 - r) * size / 2.0, 0.0, 1.0);\n" /* a border of one pixel */
    "    if (inside <= 0.0) discard;\n"
    "    float z = sqrt(max(0.0, 1.0 - r * r));\n"
    "    float light = 0.45 + 0.55 * max(0.0, dot(vec3(d.x, -d.y, z), vec3(-0.36, 0.48, 0.8)));\n"
    "    result = vec4(colour * mix(light, 1.0, flat_shade) * inside, inside);\n"
    "}\n";

/* Also draws depth alone: position by the same expressions as above, so that depths are equal to the bit. */
const char *const shader_ribbon_vertex = "#version 330 core\n"
                                         "layout(location=0) in vec3 position;\n"
                                         "uniform mat4 move, to_clip;\n"
                                         "invariant gl_Position;\n"
                                         "void main() {\n"
                                         "    vec4 w = move * vec4(position, 1.0);\n"
                                         "    gl_Position = to_clip * w;\n"
                                         "}\n";

const char *const shader_ribbon_fragment = "#version 330 core\n"
                                           "uniform vec3 colour;\n"
                                           "out vec4 result;\n"
                                           "void main() { result = vec4(colour, 1.0); }\n";

const char *const shader_finish_vertex =
    "#version 330 core\n"
    "void main() {\n"
    "    vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);\n"
    "    gl_Position = vec4(p, 0.0, 1.0);\n"
    "}\n";

/* Mean of the samples in linear light, a soft shoulder for the highlights, then sRGB over the background. */
const char *const shader_finish_fragment =
    "#version 330 core\n"
    "uniform sampler2D samples;\n"
    "uniform float height, exposure;\n"
    "uniform vec3 top, bottom;\n"
    "out vec4 result;\n"
    "vec3 shoulder(vec3 c) {\n"
    "    vec3 over = max(c - 0.75, 0.0);\n"
    "    return min(c, 0.75) + 0.25 * (1.0 - exp(-over / 0.25));\n"
    "}\n"
    "vec3 encode(vec3 c) {\n"
    "    return mix(12.92 * c, 1.055 * pow(max(c, 0.0031308), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, "
    "c));\n"
    "}\n"
    "void main() {\n"
    "    vec4 sum = texelFetch(samples, ivec2(gl_FragCoord.xy), 0);\n"
    "    vec3 colour = sum.a > 0.0 ? shoulder(exposure * sum.rgb / sum.a) : vec3(0.0);\n"
    "    vec3 ground = mix(bottom, top, smoothstep(0.0, 1.0, gl_FragCoord.y / height));\n"
    /* ordered dither over one step of 8 bits: no bands in the background */
    "    const float bayer[16] = float[16](0., 8., 2., 10., 12., 4., 14., 6., 3., 11., 1., 9., 15., 7., 13., "
    "5.);\n"
    "    ivec2 cell = ivec2(gl_FragCoord.xy) & 3;\n"
    "    float dither = ((bayer[4 * cell.y + cell.x] + 0.5) / 16.0 - 0.5) / 255.0;\n"
    "    result = vec4(mix(ground, encode(colour), min(sum.a, 1.0)) + dither, 1.0);\n"
    "}\n";
