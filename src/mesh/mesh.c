/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "mesh/mesh.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

bool hd_mesh_allocate(HdMesh *mesh, size_t vertices, size_t triangles) {
    mesh->vertices = calloc(vertices, sizeof *mesh->vertices);
    mesh->corners = calloc(triangles, sizeof *mesh->corners);
    mesh->material_of = calloc(triangles, sizeof *mesh->material_of);
    mesh->group_of = calloc(triangles, sizeof *mesh->group_of);
    return mesh->vertices != NULL && mesh->corners != NULL && mesh->material_of != NULL &&
           mesh->group_of != NULL;
}

static void free_material(HdMeshMaterial *material) {
    free(material->name);
    free(material->texture);
    free(material->mask);
}

/* Copies an owned text, which may be NULL. Clears `*has_memory` if there is none. */
static char *copy_text(const char *text, bool *has_memory) {
    char *copy = text != NULL ? strdup(text) : NULL;
    *has_memory &= (copy != NULL) == (text != NULL);
    return copy;
}

bool hd_mesh_copy_material(HdMesh *mesh, int material) {
    const size_t count = (size_t)mesh->material_count + 1;
    HdMeshMaterial *grown = realloc(mesh->materials, count * sizeof *grown);
    bool has_memory = grown != NULL;
    if (!has_memory)
        return false;
    mesh->materials = grown;
    HdMeshMaterial copy = grown[material];
    copy.name = copy_text(copy.name, &has_memory);
    copy.texture = copy_text(copy.texture, &has_memory);
    copy.mask = copy_text(copy.mask, &has_memory);
    if (has_memory)
        grown[mesh->material_count++] = copy;
    else
        free_material(&copy);
    return has_memory;
}

/* Returns whether two corners coincide, or the height over the longest side is within the rounding
   of such coordinates. Rounding may then have made any area. */
static bool is_degenerate(const HdMesh *mesh, int triangle) {
    const int32_t *corners = mesh->corners[triangle];
    const HdVec3 a = mesh->vertices[corners[0]], b = mesh->vertices[corners[1]],
                 c = mesh->vertices[corners[2]];
    const HdVec3 ab = hd_sub(b, a), ac = hd_sub(c, a), bc = hd_sub(c, b);
    const double longest = sqrt(fmax(hd_dot(ab, ab), fmax(hd_dot(ac, ac), hd_dot(bc, bc))));
    const double size = fmax(hd_largest(a), fmax(hd_largest(b), hd_largest(c)));
    return hd_length(hd_cross(ab, ac)) <= 4.0 * DBL_EPSILON * size * longest;
}

static void move_triangle(HdMesh *mesh, int from, int to) {
    memcpy(mesh->corners[to], mesh->corners[from], sizeof *mesh->corners);
    if (mesh->corner_normals != NULL)
        memcpy(mesh->corner_normals[to], mesh->corner_normals[from], sizeof *mesh->corner_normals);
    if (mesh->corner_uvs != NULL)
        memcpy(mesh->corner_uvs[to], mesh->corner_uvs[from], sizeof *mesh->corner_uvs);
    if (mesh->material_of != NULL)
        mesh->material_of[to] = mesh->material_of[from];
    if (mesh->group_of != NULL)
        mesh->group_of[to] = mesh->group_of[from];
}

void hd_mesh_drop_degenerate(HdMesh *mesh) {
    int kept = 0;
    for (int i = 0; i < mesh->triangle_count; i++) {
        if (is_degenerate(mesh, i))
            continue;
        if (kept != i)
            move_triangle(mesh, i, kept);
        kept++;
    }
    mesh->degenerate_count += mesh->triangle_count - kept;
    mesh->triangle_count = kept;
}

static void find_box(const HdMesh *mesh, HdVec3 *lower, HdVec3 *upper) {
    *lower = *upper = mesh->vertices[mesh->corners[0][0]];
    for (int i = 0; i < mesh->triangle_count; i++)
        for (int k = 0; k < 3; k++) {
            const HdVec3 at = mesh->vertices[mesh->corners[i][k]];
            *lower = hd_vec3(fmin(lower->x, at.x), fmin(lower->y, at.y), fmin(lower->z, at.z));
            *upper = hd_vec3(fmax(upper->x, at.x), fmax(upper->y, at.y), fmax(upper->z, at.z));
        }
}

/* Costs of a node relative to a triangle, measured with packets of 16 rays. */
static const HdHierarchyOptions tree_options = {.node_cost = 1.0f, .max_in_leaf = 8};

/* Returns the float below a number, never denormal: many processors multiply those a hundred times
   as slowly. */
static float below(float number) {
    float next = nextafterf(number, -FLT_MAX);
    return fabsf(next) < FLT_MIN ? -FLT_MIN : next;
}

/* Kernels store corners in float or double; the box contains either. */
static HdBox box_of(const HdMesh *mesh, int triangle, HdVec3 middle, double scale) {
    HdBox box = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
    for (int k = 0; k < 3; k++) {
        const HdVec3 corner = mesh->vertices[mesh->corners[triangle][k]];
        const HdVec3 at = hd_scale(hd_sub(corner, middle), scale);
        const float near[3] = {(float)at.x, (float)at.y, (float)at.z};
        for (int axis = 0; axis < 3; axis++) {
            box.lower[axis] = fminf(box.lower[axis], below(near[axis]));
            box.upper[axis] = fmaxf(box.upper[axis], -below(-near[axis]));
        }
    }
    return box;
}

HdStatus hd_mesh_build_tree(HdHierarchy *tree, const HdMesh *mesh, const int32_t *triangles,
                            int count, HdThreadPool *pool, HdError *error) {
    const HdVec3 middle = hd_mesh_centre(mesh);
    const double scale = 1.0 / hd_mesh_half_side(mesh);
    HdBox *boxes = calloc((size_t)count, sizeof *boxes);
    if (boxes == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: a mesh has %d triangles", count);
    for (int i = 0; i < count; i++)
        boxes[i] = box_of(mesh, triangles != NULL ? triangles[i] : i, middle, scale);
    const HdStatus status = hd_hierarchy_build(tree, boxes, count, &tree_options, pool, error);
    free(boxes);
    for (int i = 0; i < count && triangles != NULL && status == HD_OK; i++)
        tree->order[i] = triangles[tree->order[i]];
    return status;
}

HdStatus hd_mesh_build(HdMesh *mesh, HdThreadPool *pool, HdError *error) {
    find_box(mesh, &mesh->lower, &mesh->upper);
    return hd_mesh_build_tree(&mesh->tree, mesh, NULL, mesh->triangle_count, pool, error);
}

static double reach_of_box(const HdBox *box, HdVec3 d) {
    return d.x * (double)(d.x > 0.0 ? box->upper[0] : box->lower[0]) +
           d.y * (double)(d.y > 0.0 ? box->upper[1] : box->lower[1]) +
           d.z * (double)(d.z > 0.0 ? box->upper[2] : box->lower[2]);
}

static double reach_of_leaf(const HdMesh *mesh, int32_t leaf, HdVec3 direction) {
    const HdVec3 middle = hd_mesh_centre(mesh);
    const int first = leaf >> HD_LEAF_SHIFT, count = leaf & HD_MAX_LEAF;
    double most = -HUGE_VAL;
    for (int i = first; i < first + count; i++)
        for (int k = 0; k < 3; k++) {
            const HdVec3 corner = mesh->vertices[mesh->corners[mesh->tree.order[i]][k]];
            most = fmax(most, hd_dot(direction, hd_sub(corner, middle)));
        }
    return most / hd_mesh_half_side(mesh);
}

/* Looks only into boxes that reach farther than the corners found so far. */
double hd_mesh_reach(const HdMesh *mesh, HdVec3 direction) {
    struct {
        int32_t child;
        double reach;
    } waiting[HD_MAX_HIERARCHY_DEPTH + 1] = {{0, HUGE_VAL}};
    double most = -HUGE_VAL;
    for (int count = 1; count > 0;) {
        const int32_t child = waiting[--count].child;
        if (waiting[count].reach <= most)
            continue;
        if (child < 0) {
            most = fmax(most, reach_of_leaf(mesh, ~child, direction));
            continue;
        }
        const HdBuildNode *node = &mesh->tree.nodes[child];
        const double reach[2] = {reach_of_box(&node->box[0], direction),
                                 reach_of_box(&node->box[1], direction)};
        const int farther = reach[1] > reach[0];
        for (int i = 0; i < 2; i++) {
            const int next = i == 0 ? !farther : farther;
            waiting[count].child = node->child[next];
            waiting[count++].reach = reach[next];
        }
    }
    return most;
}

void hd_mesh_free(HdMesh *mesh) {
    for (int i = 0; mesh->materials != NULL && i < mesh->material_count; i++)
        free_material(&mesh->materials[i]);
    free(mesh->materials);
    free(mesh->vertices);
    free(mesh->colours);
    free(mesh->normals);
    free(mesh->uvs);
    free(mesh->corners);
    free(mesh->corner_normals);
    free(mesh->corner_uvs);
    free(mesh->material_of);
    free(mesh->group_of);
    hd_hierarchy_free(&mesh->tree);
    *mesh = (HdMesh){0};
}
