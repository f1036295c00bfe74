#include "render/src/shaders.h"

/* Light reaches a vertex as sum_i light[i] * transfer[i]; each colour channel mixes the sharp and the
 * scattered transfer by its own share, red most. */
const char *const shader_shade_vertex =
    "#version 330 core\n"
    "layout(location=0) in vec3 position;\n"
    "layout(location=1) in vec3 normal;\n"
    "layout(location=2) in vec3 sharp0;\n"
    "layout(location=3) in vec3 sharp1;\n"
    "layout(location=4) in vec3 sharp2;\n"
    "layout(location=5) in vec3 soft0;\n"
    "layout(location=6) in vec3 soft1;\n"
    "layout(location=7) in vec3 soft2;\n"
    "layout(location=8) in vec3 colour;\n"
    "layout(location=9) in vec2 value;\n" /* scalar in parts of the range, 1 if there is data */
    "uniform mat4 move, to_clip;\n"
    "uniform vec3 light[9];\n"
    "uniform vec3 scatter;\n"
    "out vec3 at, facing, lit, base;\n"
    "out vec2 shown;\n"
    "out float open_sky;\n"
    "invariant gl_Position;\n"
    "vec3 gather(vec3 a, vec3 b, vec3 c) {\n"
    "    return light[0]*a.x + light[1]*a.y + light[2]*a.z + light[3]*b.x + light[4]*b.y + light[5]*b.z\n"
    "         + light[6]*c.x + light[7]*c.y + light[8]*c.z;\n"
    "}\n"
    "void main() {\n"
    "    vec4 w = move * vec4(position, 1.0);\n"
    "    at = w.xyz;\n"
    "    facing = mat3(move) * normal;\n"
    "    lit = mix(gather(sharp0, sharp1, sharp2), gather(soft0, soft1, soft2), scatter);\n"
    "    open_sky = clamp(sharp0.x / 0.28209479, 0.0, 1.0);\n" /* T_0 of an unhidden vertex is Y_00 */
    "    base = colour;\n"
    "    shown = value;\n"
    "    gl_Position = to_clip * w;\n"
    "}\n";

const char *const shader_shade_fragment =
    "#version 330 core\n"
    "in vec3 at, facing, lit, base;\n"
    "in vec2 shown;\n"
    "in float open_sky;\n"
    "uniform vec3 eye, back;\n" /* eye only in perspective */
    "uniform float perspective;\n"
    "uniform vec3 key_direction, fill_direction;\n"
    "uniform float gloss, shine, sheen, opacity;\n"
    "uniform float use_map, fade;\n"
    "uniform sampler2D map;\n"
    "uniform vec3 no_data;\n"
    "out vec4 result;\n"
    "float glint(vec3 n, vec3 v, vec3 l) {\n"
    "    vec3 h = normalize(l + v);\n"
    "    float f = 0.04 + 0.96 * pow(1.0 - max(dot(v, h), 0.0), 5.0);\n"
    "    return pow(max(dot(n, h), 0.0), gloss) * (gloss + 8.0) * 0.0398 * f * max(dot(n, l), 0.0);\n"
    "}\n"
    "void main() {\n"
    "    vec3 v = perspective > 0.5 ? normalize(eye - at) : back;\n"
    "    vec3 n = normalize(facing);\n"
    "    vec3 albedo = base;\n"
    "    if (use_map > 0.5) {\n"
    "        vec3 mapped = texture(map, vec2((clamp(shown.x, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5)).rgb;\n"
    "        float share = fade > 0.0 ? clamp(shown.x / fade, 0.0, 1.0) : 1.0;\n"
    "        albedo = shown.y > 0.999 ? mix(base, mapped, share) : no_data;\n"
    "    }\n"
    "    vec3 c;\n"
    "    if (gl_FrontFacing) {\n"
    "        vec3 incoming = max(lit, vec3(0.0));\n"
    /* light between the walls of a hollow: 1/(1 - albedo (1 - sky)) sums the bounces */
    "        vec3 bounced = albedo * incoming / (1.0 - 0.85 * albedo * (1.0 - open_sky));\n"
    "        float nv = clamp(dot(n, v), 0.0, 1.0);\n"
    "        float reach = open_sky * open_sky;\n"
    "        float spark = glint(n, v, key_direction) + 0.35 * glint(n, v, fill_direction);\n"
    "        float edge = pow(1.0 - nv, 4.0);\n"
    "        c = bounced + shine * spark * reach + sheen * edge * reach * vec3(0.85, 0.93, 1.0);\n"
    "    } else {\n" /* the inside of an open surface: flat and dull, so that it is not taken for an outside
                      */
    "        float nv = abs(dot(n, v));\n"
    "        c = albedo * vec3(0.30, 0.28, 0.29) * (0.5 + 0.5 * nv);\n"
    "    }\n"
    "    float a = opacity;\n"
    "    if (opacity < 1.0) {\n" /* clearer where it faces the viewer, denser towards its outline */
    "        float nv = abs(dot(n, v));\n"
    "        a = opacity + (1.0 - opacity) * 0.9 * pow(1.0 - nv, 2.0);\n"
    "    }\n"
    "    result = vec4(c * a, a);\n"
    "}\n";

const char *const shader_ball_vertex =
    "#version 330 core\n"
    "layout(location=0) in vec3 position;\n"
    "uniform mat4 to_clip;\n"
    "uniform float size;\n"
    "void main() { gl_Position = to_clip * vec4(position, 1.0); gl_PointSize = size; }\n";

const char *const shader_ball_fragment =
    "#version 330 core\n"
    "uniform vec3 colour;\n"
    "uniform float flat_shade;\n"
    "out vec4 result;\n"
    "void main() {\n"
    "    vec2 d = 2.0 * gl_PointCoord - 1.0;\n"
    "    float r = dot(d, d);\n"
    "    if (r > 1.0) discard;\n"
    "    float z = sqrt(1.0 - r);\n"
    "    float light = 0.45 + 0.55 * max(0.0, dot(vec3(d.x, -d.y, z), vec3(-0.36, 0.48, 0.8)));\n"
    "    result = vec4(colour * mix(light, 1.0, flat_shade), 1.0);\n"
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
    "uniform int factor;\n"
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
    "    ivec2 at = ivec2(gl_FragCoord.xy) * factor;\n"
    "    vec4 sum = vec4(0.0);\n"
    "    for (int j = 0; j < factor; j++)\n"
    "        for (int i = 0; i < factor; i++) {\n"
    "            vec4 s = texelFetch(samples, at + ivec2(i, j), 0);\n"
    "            if (s.a > 0.0) s.rgb = shoulder(exposure * s.rgb / s.a) * s.a;\n"
    "            sum += s;\n"
    "        }\n"
    "    sum /= float(factor * factor);\n"
    "    vec3 ground = mix(bottom, top, smoothstep(0.0, 1.0, gl_FragCoord.y / height));\n"
    "    vec3 front = sum.a > 0.0 ? encode(sum.rgb / sum.a) : vec3(0.0);\n"
    /* ordered dither over one step of 8 bits: no bands in the background */
    "    const float bayer[16] = float[16](0., 8., 2., 10., 12., 4., 14., 6., 3., 11., 1., 9., 15., 7., 13., "
    "5.);\n"
    "    ivec2 cell = ivec2(gl_FragCoord.xy) & 3;\n"
    "    float dither = ((bayer[4 * cell.y + cell.x] + 0.5) / 16.0 - 0.5) / 255.0;\n"
    "    result = vec4(mix(ground, front, min(sum.a, 1.0)) + dither, 1.0);\n"
    "}\n";
