/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "scene/triangulate/solid.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/growth.h"
#include "scene/triangulate/delaunay.h"
#include "scene/triangulate/pattern.h"

/* Points on an edge of the solid but its ends: both faces of the edge have them all. */
typedef struct EdgePoints {
    int count, room;
    double *place; /* shares of the edge, ascending */
    int first_vertex;
} EdgePoints;

/* The points of one face, as it is made of triangles: its corners, those on its sides, then those
   of its borders that are inside. */
typedef struct FacePoints {
    int count, side_first[HD_MAX_FACE_SIDES];
    HdVec2 *points;
    int32_t *vertex; /* of the mesh */
    int32_t *number; /* of each of the borders' points */
} FacePoints;

typedef struct Work {
    HdMesh *mesh;
    HdPattern pattern;
    HdNetwork network[HD_MAX_FACES]; /* borders in each face */
    EdgePoints edge[HD_MAX_EDGES];
    double circumradius;
    FacePoints list;         /* of one face after the other, with room for the most points */
    int32_t (*triangles)[3]; /* of one face, likewise */
} Work;

/* Where a point of a face's borders is: at a corner, on a side, or (`side` -1) inside. */
typedef struct Whereabouts {
    int side;
    bool is_corner; /* where `side` begins */
    double place;   /* share of the side's edge */
} Whereabouts;

static HdStatus no_memory(HdError *error) {
    return hd_fail(error, HD_FAILED, "out of memory: the solid has too many triangles");
}

static Whereabouts locate(const HdFace *face, double edge_length, HdVec2 point) {
    for (int i = 0; i < face->side_count; i++)
        if (hd_length2(hd_sub2(point, face->corner[i])) <= HD_SAME_PLACE)
            return (Whereabouts){i, true, 0.0};
    for (int i = 0; i < face->side_count; i++) {
        if (hd_face_depth(face, i, point) > HD_SAME_PLACE)
            continue;
        double place = hd_dot2(face->direction[i], hd_sub2(point, face->corner[i])) / edge_length;
        return (Whereabouts){i, false, face->is_reversed[i] ? 1.0 - place : place};
    }
    return (Whereabouts){-1, false, 0.0};
}

/* Finds the borders in a face, and the points where they end on its sides. False: out of memory. */
static bool find_borders(Work *work, int number) {
    const HdFace *face = &work->pattern.face[number];
    HdNetwork *network = &work->network[number];
    if (!hd_pattern_add_borders(&work->pattern, number, network) || !hd_network_cut(network))
        return false;
    for (int i = 0; i < network->point_count; i++) {
        Whereabouts where = locate(face, work->pattern.shape.edge_length, network->points[i]);
        if (where.side < 0 || where.is_corner)
            continue;
        EdgePoints *edge = &work->edge[face->edge[where.side]];
        if (!hd_append(&edge->place, sizeof where.place, &edge->count, &edge->room, &where.place))
            return false;
    }
    return true;
}

static int compare_places(const void *left, const void *right) {
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/* Sorts the points, and keeps the first of those at the same place. */
static void join_edge_points(EdgePoints *edge, double edge_length) {
    int kept = 0;
    if (edge->count > 0)
        qsort(edge->place, (size_t)edge->count, sizeof *edge->place, compare_places);
    for (int i = 0; i < edge->count; i++)
        if (kept == 0 || (edge->place[i] - edge->place[kept - 1]) * edge_length > HD_SAME_PLACE)
            edge->place[kept++] = edge->place[i];
    edge->count = kept;
}

/* The point that was kept for one at this place. */
static int kept_point(const EdgePoints *edge, double place) {
    int low = 0, high = edge->count;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (edge->place[middle] <= place)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Room for all that comes of the points on edges and in faces: a plane with n points has fewer than
   2 n triangles. */
static bool allocate(Work *work) {
    size_t most = 1, sum = 1;
    for (int f = 0; f < work->pattern.shape.face_count; f++) {
        const HdFace *face = &work->pattern.face[f];
        size_t count = (size_t)face->side_count + (size_t)work->network[f].point_count;
        for (int i = 0; i < face->side_count; i++)
            count += (size_t)work->edge[face->edge[i]].count;
        most = count > most ? count : most;
        sum += count;
    }
    FacePoints *list = &work->list;
    list->points = calloc(most, sizeof *list->points);
    list->vertex = calloc(most, sizeof *list->vertex);
    list->number = calloc(most, sizeof *list->number);
    work->triangles = calloc(2 * most, sizeof *work->triangles);
    return list->points != NULL && list->vertex != NULL && list->number != NULL &&
           work->triangles != NULL && hd_mesh_allocate(work->mesh, sum, 2 * sum);
}

static void add_vertex(Work *work, HdVec3 place) {
    work->mesh->vertices[work->mesh->vertex_count++] = hd_scale(place, work->circumradius);
}

static void add_outer_vertices(Work *work) {
    const HdPlatonic *shape = &work->pattern.shape;
    for (int v = 0; v < shape->vertex_count; v++)
        add_vertex(work, shape->vertex[v]);
    for (int e = 0; e < shape->edge_count; e++) {
        EdgePoints *edge = &work->edge[e];
        HdVec3 a = shape->vertex[shape->edge[e].vertex[0]];
        HdVec3 b = shape->vertex[shape->edge[e].vertex[1]];
        edge->first_vertex = work->mesh->vertex_count;
        for (int i = 0; i < edge->count; i++)
            add_vertex(work,
                       hd_add(hd_scale(a, 1.0 - edge->place[i]), hd_scale(b, edge->place[i])));
    }
}

static void add_face_point(FacePoints *face, HdVec2 point, int vertex) {
    face->points[face->count] = point;
    face->vertex[face->count++] = vertex;
}

static void list_outer_points(Work *work, const HdFace *face) {
    FacePoints *list = &work->list;
    list->count = 0;
    for (int i = 0; i < face->side_count; i++)
        add_face_point(list, face->corner[i], face->vertex[i]);
    for (int i = 0; i < face->side_count; i++) {
        const EdgePoints *edge = &work->edge[face->edge[i]];
        HdVec2 a = face->corner[i], b = face->corner[(i + 1) % face->side_count];
        list->side_first[i] = list->count;
        for (int k = 0; k < edge->count; k++) {
            double place = edge->place[k];
            add_face_point(list, hd_mix2(a, b, face->is_reversed[i] ? 1.0 - place : place),
                           edge->first_vertex + k);
        }
    }
}

static void list_inner_points(Work *work, const HdFace *face, const HdNetwork *network) {
    FacePoints *list = &work->list;
    for (int i = 0; i < network->point_count; i++) {
        HdVec2 point = network->points[i];
        Whereabouts where = locate(face, work->pattern.shape.edge_length, point);
        if (where.is_corner) {
            list->number[i] = where.side;
        } else if (where.side >= 0) {
            list->number[i] = list->side_first[where.side] +
                              kept_point(&work->edge[face->edge[where.side]], where.place);
        } else {
            HdVec3 inside = hd_add(hd_scale(face->u, point.x), hd_scale(face->v, point.y));
            list->number[i] = list->count;
            add_face_point(list, point, work->mesh->vertex_count);
            add_vertex(work, hd_add(face->origin, inside));
        }
    }
}

/* The sides that a point lies on, a bit for each. */
static unsigned sides_of(const HdFace *face, const FacePoints *list, int number) {
    unsigned sides = 0;
    for (int i = 0; i < face->side_count; i++)
        if (hd_face_depth(face, i, list->points[number]) <= HD_SAME_PLACE)
            sides |= 1u << i;
    return sides;
}

/* Lets the borders name the face's points; what runs along a side is no border. */
static int number_segments(const HdFace *face, HdNetwork *network, const FacePoints *list) {
    int kept = 0;
    for (int s = 0; s < network->segment_count; s++) {
        int a = list->number[network->segments[s][0]], b = list->number[network->segments[s][1]];
        if (a == b || (sides_of(face, list, a) & sides_of(face, list, b)) != 0)
            continue;
        network->segments[kept][0] = a;
        network->segments[kept++][1] = b;
    }
    return kept;
}

static void add_triangle(Work *work, const int32_t *corner, int face) {
    HdMesh *mesh = work->mesh;
    const FacePoints *list = &work->list;
    int t = mesh->triangle_count++;
    HdVec2 middle = {0.0, 0.0};
    for (int i = 0; i < 3; i++) {
        mesh->corners[t][i] = list->vertex[corner[i]];
        middle.x += list->points[corner[i]].x / 3.0;
        middle.y += list->points[corner[i]].y / 3.0;
    }
    mesh->material_of[t] = hd_pattern_material(&work->pattern, face, middle);
    mesh->group_of[t] = (uint8_t)(face + 1);
}

static HdStatus add_face(Work *work, int f, HdError *error) {
    const HdFace *face = &work->pattern.face[f];
    const FacePoints *list = &work->list;
    HdNetwork *network = &work->network[f];
    int count;
    list_outer_points(work, face);
    list_inner_points(work, face, network);
    const int segments = number_segments(face, network, list);
    HdStatus status = hd_triangulate_plane(list->points, list->count, face->side_count,
                                           (const int32_t(*)[2])network->segments, segments,
                                           work->triangles, &count, error);
    for (int t = 0; t < count; t++)
        add_triangle(work, work->triangles[t], f);
    return status;
}

static HdStatus add_material(HdMesh *mesh, const char *name, const HdMaterial *material,
                             HdError *error) {
    HdMeshMaterial *added = &mesh->materials[mesh->material_count];
    *added = (HdMeshMaterial){.material = *material, .picture = -1, .passes_as = -1};
    added->name = strdup(name);
    mesh->material_count++;
    return added->name != NULL ? HD_OK : no_memory(error);
}

/* A disc shows its own radiance and nothing else. */
static HdStatus add_disc_material(HdMesh *mesh, const HdEdgeLights *lights, int colour, bool on_rim,
                                  HdError *error) {
    static const HdMaterial nothing = {.shininess = 1, .index_of_refraction = 1.0};
    char name[64];
    snprintf(name, sizeof name, "disc of colour %d%s", colour + 1, on_rim ? " on the rim" : "");
    HdStatus status = add_material(mesh, name, &nothing, error);
    if (status != HD_OK)
        return status;
    HdMeshMaterial *added = &mesh->materials[mesh->material_count - 1];
    added->emission = hd_scale(lights->colours[colour], lights->disc_radiance);
    added->passes_as = on_rim ? HD_SOLID_MATERIAL_RIM : HD_SOLID_MATERIAL_FACE;
    return HD_OK;
}

static HdStatus add_materials(HdMesh *mesh, const HdSolid *solid, bool has_discs, HdError *error) {
    int colours = has_discs ? solid->lights.colour_count : 0;
    mesh->materials =
        calloc(HD_SOLID_MATERIAL_DISCS + 2 * (size_t)colours, sizeof *mesh->materials);
    if (mesh->materials == NULL)
        return no_memory(error);
    HdStatus status = add_material(mesh, "face", &solid->face, error);
    if (status == HD_OK)
        status = add_material(mesh, "rim", &solid->rim, error);
    for (int i = 0; i < 2 * colours && status == HD_OK; i++)
        status = add_disc_material(mesh, &solid->lights, i / 2, i % 2 == 1, error);
    return status;
}

static HdStatus add_solid(Work *work, const HdSolid *solid, int divisions, HdError *error) {
    const HdPlatonic *shape = &work->pattern.shape;
    HdStatus status = add_materials(work->mesh, solid, work->pattern.disc_radius > 0.0, error);
    if (status != HD_OK)
        return status;
    for (int f = 0; f < shape->face_count; f++)
        if (!find_borders(work, f))
            return hd_fail(error, HD_FAILED, "out of memory: the outlines on a face are too many");
    for (int e = 0; e < shape->edge_count; e++)
        join_edge_points(&work->edge[e], shape->edge_length);
    if (!allocate(work))
        return no_memory(error);
    add_outer_vertices(work);
    for (int f = 0; f < shape->face_count && status == HD_OK; f++)
        status = add_face(work, f, error);
    return status == HD_OK ? hd_divide_triangles(work->mesh, divisions, error) : status;
}

static HdStatus check_numbers(int disc_sides, int divisions, HdError *error) {
    if (disc_sides < HD_MIN_DISC_SIDES || disc_sides > HD_MAX_DISC_SIDES || disc_sides % 2 != 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "discs have %d sides, expected an even number from %d to %d", disc_sides,
                       (int)HD_MIN_DISC_SIDES, (int)HD_MAX_DISC_SIDES);
    return hd_check_divisions(1, divisions, error);
}

HdStatus hd_triangulate_solid(HdMesh *mesh, const HdSolid *solid, int disc_sides, int divisions,
                              HdError *error) {
    *mesh = (HdMesh){0};
    HdStatus status = check_numbers(disc_sides, divisions, error);
    if (status != HD_OK)
        return status;
    Work *work = calloc(1, sizeof *work);
    if (work == NULL)
        return no_memory(error);
    work->mesh = mesh;
    work->circumradius = solid->circumradius;
    hd_pattern_prepare(&work->pattern, solid, disc_sides);
    status = add_solid(work, solid, divisions, error);
    for (int f = 0; f < HD_MAX_FACES; f++)
        hd_network_free(&work->network[f]);
    for (int e = 0; e < HD_MAX_EDGES; e++)
        free(work->edge[e].place);
    free(work->list.points);
    free(work->list.vertex);
    free(work->list.number);
    free(work->triangles);
    free(work);
    if (status != HD_OK)
        hd_mesh_free(mesh);
    return status;
}

/* The floor's point at a share of the way from corner 0 to 1 and from there towards 3 and 2. */
static HdVec3 floor_point(const HdVec3 corner[4], double s, double t) {
    HdVec3 upper = hd_add(hd_scale(corner[0], 1.0 - s), hd_scale(corner[1], s));
    HdVec3 lower = hd_add(hd_scale(corner[3], 1.0 - s), hd_scale(corner[2], s));
    return hd_add(hd_scale(upper, 1.0 - t), hd_scale(lower, t));
}

static void fill_floor_points(HdMesh *mesh, const HdFloor *floor, int divisions) {
    const HdVec3 centre = hd_floor_centre(floor);
    HdVec3 corner[4];
    for (int i = 0; i < 4; i++)
        corner[i] = hd_sub(floor->corners[i], centre);
    for (int row = 0; row <= divisions; row++)
        for (int column = 0; column <= divisions; column++) {
            double s = (double)column / divisions, t = (double)row / divisions;
            int v = mesh->vertex_count++;
            mesh->vertices[v] = floor_point(corner, s, t);
            mesh->uvs[v][0] = s;
            mesh->uvs[v][1] = 1.0 - t;
        }
    mesh->uv_count = mesh->vertex_count;
}

static void add_floor_triangle(HdMesh *mesh, int a, int b, int c) {
    int t = mesh->triangle_count++;
    int32_t corners[3] = {a, b, c};
    memcpy(mesh->corners[t], corners, sizeof corners);
    memcpy(mesh->corner_uvs[t], corners, sizeof corners);
    mesh->group_of[t] = 1;
}

static void fill_floor_triangles(HdMesh *mesh, int divisions) {
    for (int row = 0; row < divisions; row++)
        for (int column = 0; column < divisions; column++) {
            int upper = row * (divisions + 1) + column, lower = upper + divisions + 1;
            add_floor_triangle(mesh, upper, upper + 1, lower + 1);
            add_floor_triangle(mesh, upper, lower + 1, lower);
        }
}

static HdStatus allocate_floor(HdMesh *mesh, int divisions, HdError *error) {
    size_t n = (size_t)divisions, points = (n + 1) * (n + 1), triangles = 2 * n * n;
    mesh->uvs = malloc(points * sizeof *mesh->uvs);
    mesh->corner_uvs = malloc(triangles * sizeof *mesh->corner_uvs);
    mesh->materials = calloc(1, sizeof *mesh->materials);
    if (mesh->uvs == NULL || mesh->corner_uvs == NULL || mesh->materials == NULL ||
        !hd_mesh_allocate(mesh, points, triangles))
        return hd_fail(error, HD_FAILED, "out of memory: no room for %zu triangles", triangles);
    return HD_OK;
}

HdStatus hd_triangulate_floor(HdMesh *mesh, const HdFloor *floor, int divisions, HdError *error) {
    *mesh = (HdMesh){0};
    HdStatus status = hd_check_divisions(2, divisions, error);
    if (status == HD_OK)
        status = allocate_floor(mesh, divisions, error);
    if (status == HD_OK)
        status = add_material(mesh, "floor", &floor->material, error);
    if (status == HD_OK) {
        fill_floor_points(mesh, floor, divisions);
        fill_floor_triangles(mesh, divisions);
    } else {
        hd_mesh_free(mesh);
    }
    return status;
}
