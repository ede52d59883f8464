/* SPDX-License-Identifier: MIT */
/* Triangles of a mesh in the lanes of a bundle: one for all of them, or one for each. */
#ifndef HD_MESH_TRIANGLES_H
#define HD_MESH_TRIANGLES_H

#include "triangle.h"

/* Triangles of a mesh, one for all lanes or one for each. */
typedef struct {
    Vec3 a, b, c;
    vint number, face, skin;
} TriangleLanes;

/* Reals in a row of the table, and from one corner to the next. */
enum { TRIANGLE_STRIDE = sizeof(Triangle) / sizeof(real), CORNER_STRIDE = TRIANGLE_STRIDE / 3 };

/* Triangles of a group count as one face; others have a negative number each. */
FN vint face_of_triangle(vint number, vint group, int first_face) {
    vmask grouped = lt_int(splat_int(0), group);
    return pick_int(grouped, group + (first_face - 1), splat_int(-2) - number);
}

FN void name_triangles(TriangleLanes *lanes, vint number, vint tag, int first_face,
                       int first_skin) {
    vint group = tag & (HD_TRIANGLE_GROUPS - 1);
    lanes->number = number;
    lanes->skin = (tag >> HD_TRIANGLE_GROUP_BITS) + first_skin;
    lanes->face = face_of_triangle(number, group, first_face);
}

/* One triangle, its coordinates in the order of `axis`. */
FN TriangleLanes same_triangle(GLOBAL const Triangle *triangles, int number, const int axis[3],
                               int first_face, int first_skin) {
    GLOBAL const Triangle *triangle = triangles + number;
    TriangleLanes lanes;
    lanes.a = vec3_splat(triangle->a[axis[0]], triangle->a[axis[1]], triangle->a[axis[2]]);
    lanes.b = vec3_splat(triangle->b[axis[0]], triangle->b[axis[1]], triangle->b[axis[2]]);
    lanes.c = vec3_splat(triangle->c[axis[0]], triangle->c[axis[1]], triangle->c[axis[2]]);
    name_triangles(&lanes, splat_int(number), splat_int((int)triangle->tag), first_face,
                   first_skin);
    return lanes;
}

FN TriangleLanes fetch_triangles(GLOBAL const Triangle *triangles, vint number, int first_face,
                                 int first_skin) {
    GLOBAL const real *table = (GLOBAL const real *)triangles;
    vint place = number * TRIANGLE_STRIDE;
    FourReals a = fetch_four_reals(table, place);
    FourReals b = fetch_four_reals(table, place + CORNER_STRIDE);
    FourReals c = fetch_four_reals(table, place + 2 * CORNER_STRIDE);
    TriangleLanes lanes;
    lanes.a = vec3(a.number[0], a.number[1], a.number[2]);
    lanes.b = vec3(b.number[0], b.number[1], b.number[2]);
    lanes.c = vec3(c.number[0], c.number[1], c.number[2]);
    name_triangles(&lanes, number, to_int(a.number[3]), first_face, first_skin);
    return lanes;
}

/* As long as twice the area. */
FN Vec3 normal_of(const TriangleLanes *triangle) {
    return vec3_cross(vec3_sub(triangle->b, triangle->a), vec3_sub(triangle->c, triangle->a));
}

#endif
