/* SPDX-License-Identifier: MIT */
#include "shapes.h"

#include <math.h>
#include <string.h>

#include "../../scenes/models/random.h"

static const double pi = 3.14159265358979323846;

static void add(HdShape *shape, int a, int b, int c, int face) {
    int n = shape->triangle_count++;
    const HdVec3 *v = shape->vertices;
    HdVec3 normal = hd_cross(hd_sub(v[b], v[a]), hd_sub(v[c], v[a]));
    shape->corners[n][0] = a;
    shape->corners[n][1] = b;
    shape->corners[n][2] = c;
    shape->face_of[n] = face;
    shape->normals[n] = face < 0 ? hd_vec3(0.0, 0.0, 0.0) : hd_normalize(normal);
}

/* Fills the face's vertices, counterclockwise from outside; returns their number. */
static int vertices_of_face(const HdPlatonic *solid, int face, int *found) {
    HdVec3 normal = solid->face_normal[face], first = {0.0, 0.0, 0.0};
    double angles[HD_MAX_VERTICES];
    int count = 0;
    for (int v = 0; v < solid->vertex_count; v++) {
        HdVec3 p = solid->vertex[v];
        if (hd_dot(normal, p) < solid->inradius - 1e-9)
            continue;
        HdVec3 across = hd_sub(p, hd_scale(normal, solid->inradius));
        if (count == 0)
            first = hd_normalize(across);
        double angle = atan2(hd_dot(across, hd_cross(normal, first)), hd_dot(across, first)) + 1e-9;
        angle = angle < 0.0 ? angle + 2.0 * pi : angle;
        int place = count++;
        for (; place > 0 && angles[place - 1] > angle; place--) {
            angles[place] = angles[place - 1];
            found[place] = found[place - 1];
        }
        angles[place] = angle;
        found[place] = v;
    }
    return count;
}

void hd_shape_of_platonic(HdShape *shape, const HdPlatonic *solid) {
    memset(shape, 0, sizeof *shape);
    shape->copies = 1;
    shape->vertex_count = solid->vertex_count;
    memcpy(shape->vertices, solid->vertex, sizeof solid->vertex);
    for (int face = 0; face < solid->face_count; face++) {
        int around[HD_MAX_VERTICES];
        int count = vertices_of_face(solid, face, around);
        for (int i = 1; i + 1 < count; i++)
            add(shape, around[0], around[i], around[i + 1], face);
    }
}

/* Returns the index of the edge's middle among the vertices, or -1 if the face has none. */
static int middle_of_edge(const HdShape *shape, const HdPlatonic *solid, int face, int a, int b) {
    for (int e = 0; e < solid->edge_count; e++) {
        const HdPlatonicEdge *edge = &solid->edge[e];
        if ((edge->vertex[0] == a && edge->vertex[1] == b) ||
            (edge->vertex[0] == b && edge->vertex[1] == a))
            return face == edge->face[0] ? shape->vertex_count - solid->edge_count + e : -1;
    }
    return -1;
}

void hd_shape_with_t_junctions(HdShape *shape, const HdPlatonic *solid) {
    hd_shape_of_platonic(shape, solid);
    shape->triangle_count = 0;
    HdVec3 *v = shape->vertices;
    for (int face = 0; face < solid->face_count; face++)
        v[shape->vertex_count++] = hd_scale(solid->face_normal[face], solid->inradius);
    for (int e = 0; e < solid->edge_count; e++)
        v[shape->vertex_count++] =
            hd_scale(hd_add(v[solid->edge[e].vertex[0]], v[solid->edge[e].vertex[1]]), 0.5);
    for (int face = 0; face < solid->face_count; face++) {
        int around[HD_MAX_VERTICES], centre = solid->vertex_count + face;
        int count = vertices_of_face(solid, face, around);
        for (int i = 0; i < count; i++) {
            int a = around[i], b = around[(i + 1) % count];
            int middle = middle_of_edge(shape, solid, face, a, b);
            add(shape, centre, a, middle < 0 ? b : middle, face);
            if (middle >= 0)
                add(shape, centre, middle, b, face);
        }
    }
}

void hd_shape_needle(HdShape *shape) {
    enum { SIDES = 48 };
    memset(shape, 0, sizeof *shape);
    shape->copies = 1;
    shape->vertex_count = SIDES + 2;
    for (int i = 0; i < SIDES; i++) {
        double angle = 2.0 * pi * i / SIDES;
        shape->vertices[i] = hd_vec3(0.01 * cos(angle), 0.01 * sin(angle), 0.0);
    }
    shape->vertices[SIDES] = hd_vec3(0.0, 0.0, 1.0);
    shape->vertices[SIDES + 1] = hd_vec3(0.0, 0.0, -1.0);
    for (int i = 0; i < SIDES; i++) {
        int next = (i + 1) % SIDES;
        add(shape, i, next, SIDES, 2 * i);
        add(shape, next, i, SIDES + 1, 2 * i + 1);
    }
}

void hd_shape_add_zero_areas(HdShape *shape) {
    int count = shape->triangle_count;
    for (int i = 0; i < count; i++) {
        const int *corner = shape->corners[i];
        add(shape, corner[0], corner[1], corner[0], -1);
        add(shape, corner[2], corner[1], corner[1], -1);
        add(shape, corner[2], corner[2], corner[2], -1);
    }
}

void hd_shape_double(HdShape *shape) {
    int count = shape->triangle_count;
    for (int i = 0; i < count; i++)
        add(shape, shape->corners[i][0], shape->corners[i][1], shape->corners[i][2],
            shape->face_of[i]);
    shape->copies = 2;
}

HdVec3 hd_random_turn(uint64_t *random) {
    HdVec3 degrees;
    degrees.x = random_between(random, 0.0, 360.0);
    degrees.y = random_between(random, 0.0, 360.0);
    degrees.z = random_between(random, 0.0, 360.0);
    return degrees;
}

HdVec3 hd_random_direction(uint64_t *random) {
    for (;;) {
        HdVec3 v;
        v.x = random_between(random, -1.0, 1.0);
        v.y = random_between(random, -1.0, 1.0);
        v.z = random_between(random, -1.0, 1.0);
        double squared = hd_dot(v, v);
        if (squared > 0.01 && squared < 1.0)
            return hd_normalize(v);
    }
}

/* Interior points keep away from the edges, so that a ray's own rounding does not count. */
HdAim hd_random_aim(const HdShape *shape, HdAimKind kind, uint64_t *random) {
    HdAim aim = {.triangle = 0};
    do {
        aim.triangle = (int)random_between(random, 0.0, shape->triangle_count);
    } while (shape->face_of[aim.triangle] < 0);
    int corner = (int)random_between(random, 0.0, 3.0);
    double along = random_between(random, 0.05, 0.95), rest = random_between(random, 0.1, 0.8);
    double second = random_between(random, 0.0, 0.9 - rest) + 0.05;
    aim.share[corner] = kind == HD_AIM_CORNER ? 1.0 : kind == HD_AIM_EDGE ? 1.0 - along : rest;
    aim.share[(corner + 1) % 3] = kind == HD_AIM_CORNER ? 0.0
                                  : kind == HD_AIM_EDGE ? along
                                                        : second;
    aim.share[(corner + 2) % 3] = kind == HD_AIM_INTERIOR ? 1.0 - rest - second : 0.0;
    return aim;
}

HdVec3 hd_aim_point(const HdShape *shape, const HdAim *aim, const HdVec3 *vertices) {
    const int *corner = shape->corners[aim->triangle];
    HdVec3 point = hd_vec3(0.0, 0.0, 0.0);
    for (int i = 0; i < 3; i++)
        if (aim->share[i] > 0.0)
            point = hd_add(point, hd_scale(vertices[corner[i]], aim->share[i]));
    return point;
}

double hd_aim_facing(const HdShape *shape, const HdAim *aim, HdVec3 away) {
    const double on_plane = 1e-9;
    HdVec3 point = hd_aim_point(shape, aim, shape->vertices);
    double least = 1.0;
    for (int i = 0; i < shape->triangle_count; i++) {
        HdVec3 from = hd_sub(point, shape->vertices[shape->corners[i][0]]);
        double facing = hd_dot(shape->normals[i], away);
        if (shape->face_of[i] >= 0 && fabs(hd_dot(shape->normals[i], from)) < on_plane)
            least = facing < least ? facing : least;
    }
    return least;
}
