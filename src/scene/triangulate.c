/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "scene/triangulate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/trigonometry.h"
#include "mesh/mesh.h"
#include "scene/facets.h"
#include "system/machine.h"

/* In circumradii: the least rim and the least side of a disc or of what a rim leaves of a face.
   Smaller ones could hardly be told from points that are one. */
static const double least_length = 1e-8;

/* A solid on the way, in units of its circumradius. */
typedef struct Work {
    const HdSolid *solid;
    HdPlatonic shape; /* turned as it is in the scene */
    HdFacets facets;
    double rim_width;   /* 0: no rim */
    double disc_radius; /* 0: no discs */
    int disc_sides;
    double widening;                    /* from a disc's radius to that of its polygon's corners */
    double flatness;                    /* from that to the radius of the middles of its sides */
    HdVec2 outwards[HD_MAX_DISC_SIDES]; /* the directions to the middles of its sides */
    HdHalfSpace borders[HD_MAX_DISC_SIDES + 6];
} Work;

static HdStatus no_memory(HdError *error) {
    return hd_fail(error, HD_FAILED, "out of memory: the solid has too many triangles");
}

/* The half space beyond a point in some direction. */
static HdHalfSpace beyond(HdVec3 point, HdVec3 direction) {
    return (HdHalfSpace){direction, hd_dot(direction, point)};
}

static HdVec3 middle_of_face(const Work *work, int face) {
    return hd_scale(work->shape.face_normal[face], work->shape.inradius);
}

static HdVec3 middle_of_edge(const Work *work, int edge) {
    const int *ends = work->shape.edge[edge].vertex;
    return hd_scale(hd_add(work->shape.vertex[ends[0]], work->shape.vertex[ends[1]]), 0.5);
}

static bool face_has_edge(const Work *work, int face, int edge) {
    const int *faces = work->shape.edge[edge].face;
    return faces[0] == face || faces[1] == face;
}

/* The whole face is rim at first; what the rim leaves becomes the face. */
static bool carve_rim(Work *work, int face, int first) {
    const HdVec3 middle = middle_of_face(work, face);
    int count = 0;
    for (int e = 0; e < work->shape.edge_count; e++) {
        if (!face_has_edge(work, face, e))
            continue;
        const HdVec3 side = middle_of_edge(work, e), inwards = hd_sub(middle, side);
        const double inradius = hd_length(inwards);
        if (inradius - work->rim_width <= least_length * inradius)
            return true;
        work->borders[count] = beyond(side, hd_scale(inwards, 1.0 / inradius));
        work->borders[count++].offset += work->rim_width;
    }
    return hd_facets_carve(&work->facets, face, first, work->borders, count,
                           HD_SOLID_MATERIAL_FACE);
}

static HdVec3 direction_of(const Work *work, int edge) {
    const int *ends = work->shape.edge[edge].vertex;
    return hd_normalize(hd_sub(work->shape.vertex[ends[1]], work->shape.vertex[ends[0]]));
}

/* Light k of an edge is at k + 1/2, and nearest from k to k + 1. */
static HdVec3 point_of_edge(const Work *work, int edge, double k) {
    const double place = work->shape.edge_length * (k / work->solid->lights.per_edge - 0.5);
    return hd_add(middle_of_edge(work, edge), hd_scale(direction_of(work, edge), place));
}

/* A unit vector in the face that is along a direction as far as it can be. */
static HdVec3 along_face(const Work *work, int face, HdVec3 direction) {
    const HdVec3 normal = work->shape.face_normal[face];
    const HdVec3 along = hd_sub(direction, hd_scale(normal, hd_dot(direction, normal)));
    if (hd_length(along) > 1e-6)
        return hd_normalize(along);
    const HdVec3 axis = fabs(normal.x) < 0.5 ? hd_vec3(1.0, 0.0, 0.0) : hd_vec3(0.0, 1.0, 0.0);
    return hd_normalize(hd_cross(normal, axis));
}

/* The polygon that stands for what a disc, seen as a ball, has of a face's plane. */
typedef struct Disc {
    HdVec3 centre;
    HdVec3 along, across; /* unit, in the plane; along the edge where the face has it */
    double corner_radius;
} Disc;

/* Of a disc's polygon: the number of its borders, whose inner sides they leave in common. Two that
   only touch it come first, then the sides that are steepest on the edge: they end where those are,
   so that no cut leaves the disc's surroundings. */
static int list_sides(Work *work, const Disc *disc) {
    const int half = work->disc_sides / 2;
    int count = 0;
    for (int sign = -1; sign <= 1; sign += 2) {
        const HdVec3 inwards = hd_scale(disc->across, sign);
        work->borders[count] = beyond(disc->centre, inwards);
        work->borders[count++].offset -= disc->corner_radius;
    }
    for (int k = 0; 2 * k < half; k++) {
        const int sides[4] = {k, half - 1 - k, half + k, 2 * half - 1 - k};
        for (int i = 0; i < 4; i++) {
            const HdVec2 outwards = work->outwards[sides[i]];
            const HdVec3 inwards =
                hd_add(hd_scale(disc->along, -outwards.x), hd_scale(disc->across, -outwards.y));
            work->borders[count] = beyond(disc->centre, inwards);
            work->borders[count++].offset -= work->flatness * disc->corner_radius;
        }
    }
    return count;
}

/* Adds the borders beyond which another light of the edge is nearer. */
static int list_cell(Work *work, int edge, int light, int count) {
    const HdVec3 direction = direction_of(work, edge);
    if (light > 0)
        work->borders[count++] = beyond(point_of_edge(work, edge, light), direction);
    if (light < work->solid->lights.per_edge - 1)
        work->borders[count++] =
            beyond(point_of_edge(work, edge, light + 1), hd_scale(direction, -1.0));
    return count;
}

/* What the ball about a light has of the face, as far as the light is the nearest of its edge. Of
   overlapping discs the last edge's shows, as in the kernels. These ask of a disc's points that
   they be near a side, too: all are, for no edge is nearer to a point of a face than the face's
   nearest side. */
static bool carve_disc(Work *work, int face, int first, int edge, int light) {
    const HdVec3 normal = work->shape.face_normal[face];
    const HdVec3 place = point_of_edge(work, edge, light + 0.5);
    double height = 0.0;
    if (!face_has_edge(work, face, edge))
        height = hd_dot(hd_sub(place, middle_of_face(work, face)), normal);
    const double squared = work->disc_radius * work->disc_radius - height * height;
    if (!(squared > 0.0))
        return true;
    const HdVec3 along = along_face(work, face, direction_of(work, edge));
    const Disc disc = {hd_sub(place, hd_scale(normal, height)), along, hd_cross(normal, along),
                       work->widening * sqrt(squared)};
    const int count = list_cell(work, edge, light, list_sides(work, &disc));
    const int colour = edge % work->solid->lights.colour_count;
    return hd_facets_carve(&work->facets, face, first, work->borders, count,
                           HD_SOLID_MATERIAL_DISCS + 2 * colour);
}

static bool carve_face(Work *work, int face) {
    const int first = work->facets.facet_count;
    bool is_done = work->rim_width == 0.0 || carve_rim(work, face, first);
    for (int e = 0; e < work->shape.edge_count && work->disc_radius > 0.0; e++)
        for (int k = 0; k < work->solid->lights.per_edge && is_done; k++)
            is_done = carve_disc(work, face, first, e, k);
    return is_done;
}

/* A regular polygon of n sides has the area n / 2 sin(2 pi / n) of its circumradius squared. */
static void prepare(Work *work, const HdSolid *solid, int disc_sides) {
    /* Discs of two circumradii cover everything, and so do polygons of twice that. */
    static const double largest = 4.0;
    const double rim = solid->rim_width / solid->circumradius;
    const double disc = fmin(solid->lights.disc_radius / solid->circumradius, largest);
    double sine, cosine;
    work->solid = solid;
    work->shape = hd_solid_shape(solid);
    work->disc_sides = disc_sides;
    if (rim > least_length)
        work->rim_width = rim;
    if (solid->lights.per_edge > 0 && disc * 2.0 * HD_PI / disc_sides > least_length)
        work->disc_radius = disc;
    hd_sine_cosine(HD_PI / disc_sides, &sine, &cosine);
    work->widening = sqrt(HD_PI / (disc_sides * sine * cosine));
    work->flatness = cosine;
    for (int i = 0; i < disc_sides; i++)
        hd_sine_cosine(HD_PI * (2 * i + 1) / disc_sides, &work->outwards[i].y,
                       &work->outwards[i].x);
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

static HdStatus make_solid(Work *work, HdMesh *mesh, int divisions, HdError *error) {
    const int material = work->rim_width > 0.0 ? HD_SOLID_MATERIAL_RIM : HD_SOLID_MATERIAL_FACE;
    HdStatus status = add_materials(mesh, work->solid, work->disc_radius > 0.0, error);
    if (status != HD_OK)
        return status;
    bool is_done = hd_facets_start(&work->facets, &work->shape, material);
    for (int f = 0; f < work->shape.face_count && is_done; f++)
        is_done = carve_face(work, f);
    if (!is_done ||
        !hd_facets_fill_mesh(&work->facets, &work->shape, work->solid->circumradius, mesh))
        return no_memory(error);
    return hd_divide_triangles(mesh, divisions, error);
}

HdStatus hd_triangulate_solid(HdMesh *mesh, const HdSolid *solid, int disc_sides, int divisions,
                              HdError *error) {
    *mesh = (HdMesh){0};
    if (disc_sides < HD_MIN_DISC_SIDES || disc_sides > HD_MAX_DISC_SIDES || disc_sides % 2 != 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "discs have %d sides, expected an even number from %d to %d", disc_sides,
                       (int)HD_MIN_DISC_SIDES, (int)HD_MAX_DISC_SIDES);
    Work *work = calloc(1, sizeof *work);
    if (work == NULL)
        return no_memory(error);
    prepare(work, solid, disc_sides);
    const HdStatus status = make_solid(work, mesh, divisions, error);
    hd_facets_free(&work->facets);
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

/* ---- the scene ---- */

/* In `made` is what the scene gets in front of its own meshes and instances, and behind its
   pictures, in arrays that have room for those too. */

/* Gives the mesh that was made last its place. */
static void place(HdScene *made, HdVec3 position) {
    made->instances[made->instance_count++] = (HdInstance){
        .mesh = made->mesh_count++, .position = position, .scale = hd_vec3(1.0, 1.0, 1.0)};
}

/* It goes on at its border instead of repeating. */
static HdStatus copy_texture(HdPicture *picture, const HdTexture *texture, HdError *error) {
    size_t bytes = (size_t)texture->width * (size_t)texture->height * 3 * sizeof *texture->texels;
    *picture = (HdPicture){.texture = *texture, .is_clamped = true};
    picture->texture.texels = malloc(bytes);
    if (picture->texture.texels == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: the floor's texture has %zu bytes", bytes);
    memcpy(picture->texture.texels, texture->texels, bytes);
    return HD_OK;
}

static HdStatus make_floor(HdScene *made, const HdScene *scene, int divisions, HdError *error) {
    const HdFloor *floor = &scene->floor;
    HdMesh *mesh = &made->meshes[made->mesh_count];
    HdStatus status = hd_triangulate_floor(mesh, floor, divisions, error);
    if (status != HD_OK)
        return status;
    place(made, hd_floor_centre(floor));
    mesh->materials[0].is_opaque_to_shadows = true;
    if (floor->texture.width == 0)
        return HD_OK;
    mesh->materials[0].picture = scene->picture_count;
    made->picture_count = scene->picture_count + 1;
    return copy_texture(&made->pictures[scene->picture_count], &floor->texture, error);
}

static HdStatus build_meshes(const HdScene *made, HdError *error) {
    HdThreadPool *pool = NULL;
    HdStatus status = hd_thread_pool_create(&pool, hd_processor_count(), error);
    for (int i = 0; status == HD_OK && i < made->mesh_count; i++)
        status = hd_mesh_build(&made->meshes[i], pool, error);
    hd_thread_pool_destroy(pool);
    return status;
}

static HdStatus make(HdScene *made, const HdScene *scene, int disc_sides, int divisions,
                     HdError *error) {
    size_t own = (size_t)scene->solid_count + 1;
    HdStatus status = HD_OK;
    made->meshes = calloc(own + (size_t)scene->mesh_count, sizeof *made->meshes);
    made->instances = calloc(own + (size_t)scene->instance_count, sizeof *made->instances);
    made->pictures = calloc((size_t)scene->picture_count + 1, sizeof *made->pictures);
    if (made->meshes == NULL || made->instances == NULL || made->pictures == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for %zu meshes",
                       own + (size_t)scene->mesh_count);
    for (int s = 0; s < scene->solid_count && status == HD_OK; s++) {
        const HdSolid *solid = &scene->solids[s];
        status = hd_triangulate_solid(&made->meshes[s], solid, disc_sides, divisions, error);
        if (status == HD_OK)
            place(made, solid->centre);
    }
    if (status == HD_OK && scene->floor.present)
        status = make_floor(made, scene, divisions, error);
    return status == HD_OK ? build_meshes(made, error) : status;
}

static void take(HdScene *scene, const HdScene *made) {
    const int count = made->mesh_count;
    for (int i = 0; i < scene->mesh_count; i++)
        made->meshes[count + i] = scene->meshes[i];
    for (int i = 0; i < scene->instance_count; i++) {
        made->instances[count + i] = scene->instances[i];
        made->instances[count + i].mesh += count;
    }
    for (int i = 0; i < scene->picture_count; i++)
        made->pictures[i] = scene->pictures[i];
    free(scene->meshes);
    free(scene->instances);
    free(scene->pictures);
    scene->meshes = made->meshes;
    scene->instances = made->instances;
    scene->pictures = made->pictures;
    scene->mesh_count += count;
    scene->instance_count += count;
    scene->picture_count += made->picture_count > 0;
    scene->geometry = HD_GEOMETRY_TRIANGLES;
}

HdStatus hd_scene_triangulate(HdScene *scene, int disc_sides, int divisions, HdError *error) {
    HdScene made = {0};
    HdStatus status = make(&made, scene, disc_sides, divisions, error);
    if (status == HD_OK)
        take(scene, &made);
    else
        hd_scene_drop_meshes(&made);
    return status;
}
