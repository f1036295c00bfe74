/* The shaders, as text. */
#pragma once
extern const char *const shader_shade_vertex, *const shader_shade_fragment;   /* lit surfaces */
extern const char *const shader_map_fragment;                                 /* with colours of a map */
extern const char *const shader_ball_vertex, *const shader_ball_fragment;     /* marks */
extern const char *const shader_ribbon_vertex, *const shader_ribbon_fragment; /* strokes */
extern const char *const shader_finish_vertex, *const shader_finish_fragment; /* samples to pixels */
