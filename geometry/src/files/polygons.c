#include "geometry/mem.h"
#include "geometry/src/files/read_mesh.h"
#include <stdlib.h>
#include <string.h>

void polygons_free(polygons *p)
{
    free(p->xyz);
    free(p->first);
    free(p->corner);
    free(p->rgb);
    *p = (polygons){0};
}

polygons polygons_new(void)
{
    return (polygons){.xyz = NEW_ARRAY(double, 0), .first = NEW_ARRAY(int64_t, 1), .corner = NEW_ARRAY(int64_t, 0)};
}

/* Room is made for 8, 16, 32 ... items: at these counts the array is full. */
static bool is_full(int64_t count) { return count == 0 || (count >= 8 && !(count & (count - 1))); }

static size_t more_room(int64_t count) { return count ? 2 * (size_t)count : 8; }

void polygons_add_point(polygons *p, const double xyz[3])
{
    if (is_full(p->point_count)) p->xyz = GROW_ARRAY(double, p->xyz, 3 * more_room(p->point_count));
    memcpy(p->xyz + 3 * (size_t)p->point_count++, xyz, 3 * sizeof *xyz);
}

void polygons_add_corner(polygons *p, int64_t point)
{
    int64_t at = p->first[p->polygon_count] + p->open_corners;
    if (is_full(at)) p->corner = GROW_ARRAY(int64_t, p->corner, more_room(at));
    p->corner[at] = point;
    p->open_corners++;
}

void polygons_close_strip(polygons *p)
{
    int64_t corners = p->open_corners, first = p->first[p->polygon_count];
    int64_t *strip = COPY_ARRAY(int64_t, p->corner + first, corners);
    p->open_corners = 0;
    for (int64_t k = 0; k + 2 < corners; k++) { /* every second triangle runs the other way */
        polygons_add_corner(p, strip[k]);
        polygons_add_corner(p, strip[k + 1 + k % 2]);
        polygons_add_corner(p, strip[k + 2 - k % 2]);
        polygons_close(p);
    }
    free(strip);
}

void polygons_close(polygons *p)
{
    int64_t at = p->first[p->polygon_count] + p->open_corners, have = p->polygon_count + 1;
    if (have == 1 || is_full(have)) p->first = GROW_ARRAY(int64_t, p->first, more_room(have < 8 ? 0 : have));
    p->first[++p->polygon_count] = at;
    p->open_corners = 0;
}
