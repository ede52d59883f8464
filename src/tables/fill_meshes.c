/* SPDX-License-Identifier: MIT */
/* Tables of meshes; compiled for each precision. */
#include "tables/builder.h"

#include <math.h>
#include <string.h>

/* ---- triangles ---- */

static void store_corner(real out[3], const HdMesh *mesh, int corner) {
    HdVec3 from_middle = hd_sub(mesh->vertices[corner], hd_mesh_centre(mesh));
    hd_store3(out, hd_scale(from_middle, 1.0 / hd_mesh_half_side(mesh)));
}

static int triangle_in_order(const HdMesh *mesh, int place) {
    return mesh->tree.order != NULL ? mesh->tree.order[place] : place;
}

static void fill_triangles(const HdBuilder *builder, const HdMesh *mesh, const HdMeshPlace *place) {
    Triangle *out = (Triangle *)builder->table[HD_TABLE_triangles] + place->first.triangles;
    for (int i = 0; i < mesh->triangle_count; i++) {
        int number = triangle_in_order(mesh, i);
        const int32_t *corner = mesh->corners[number];
        int material = mesh->material_of != NULL ? mesh->material_of[number] : 0;
        int group = mesh->group_of != NULL ? mesh->group_of[number] : 0;
        store_corner(out[i].a, mesh, corner[0]);
        store_corner(out[i].b, mesh, corner[1]);
        store_corner(out[i].c, mesh, corner[2]);
        out[i].tag = (real)(material * HD_TRIANGLE_GROUPS + group);
    }
}

/* Fills the corners' places; -1 for a triangle that lacks one of them. */
static void fill_corners(int *out, const HdMesh *mesh, int32_t (*const corners)[3], size_t first) {
    for (int i = 0; i < mesh->triangle_count; i++) {
        const int32_t *corner = corners[triangle_in_order(mesh, i)];
        bool is_whole = corner[0] >= 0 && corner[1] >= 0 && corner[2] >= 0;
        for (int k = 0; k < 3; k++)
            *out++ = is_whole ? (int)first + corner[k] : -1;
    }
}

static void fill_normals_and_uvs(const HdBuilder *builder, const HdMesh *mesh,
                                 const HdMeshPlace *place) {
    const HdMeshSizes *first = &place->first;
    Vector *normals = (Vector *)builder->table[HD_TABLE_mesh_normals] + first->normals;
    TextureCoordinates *uvs = (TextureCoordinates *)builder->table[HD_TABLE_mesh_uvs] + first->uvs;
    int *corner_normals = (int *)builder->table[HD_TABLE_corner_normals] + first->corner_normals;
    int *corner_uvs = (int *)builder->table[HD_TABLE_corner_uvs] + first->corner_uvs;
    for (int i = 0; i < mesh->normal_count; i++)
        normals[i] = hd_as_vector(hd_normalize(mesh->normals[i]));
    for (int i = 0; i < mesh->uv_count; i++) /* rows of pictures count downwards */
        uvs[i] = (TextureCoordinates){
            (real)mesh->uvs[i][0], (real)(1.0 - mesh->uvs[i][1]), {R(0.0), R(0.0)}};
    if (mesh->normals != NULL)
        fill_corners(corner_normals, mesh, mesh->corner_normals, first->normals);
    if (mesh->uvs != NULL)
        fill_corners(corner_uvs, mesh, mesh->corner_uvs, first->uvs);
}

static void fill_colours(const HdBuilder *builder, const HdMesh *mesh, size_t first) {
    Vector *out = (Vector *)builder->table[HD_TABLE_corner_colours] + first;
    for (int i = 0; mesh->colours != NULL && i < mesh->triangle_count; i++)
        for (int k = 0; k < 3; k++)
            *out++ = hd_as_vector(mesh->colours[mesh->corners[triangle_in_order(mesh, i)][k]]);
}

/* ---- hierarchies ---- */

/* Returns a child moved by `first_node`, or by `first_item` if it is a leaf. */
static int move_child(int child, size_t first_node, size_t first_item) {
    if (child >= 0)
        return (int)first_node + child;
    return ~(~child + (int)first_item * (1 << HD_LEAF_ITEM_BITS));
}

/* Copies a hierarchy into the table `out`. */
static void fill_nodes(MeshNode *out, const HdHierarchy *tree, size_t first_node,
                       size_t first_item) {
    out += first_node;
    for (int i = 0; i < tree->node_count; i++) {
        const HdBuildNode *node = &tree->nodes[i];
        for (int child = 0; child < 2; child++) {
            for (int axis = 0; axis < 3; axis++) {
                out[i].bounds[axis][0][child] = (real)node->box[child].lower[axis];
                out[i].bounds[axis][1][child] = (real)node->box[child].upper[axis];
            }
            out[i].child[child] = move_child(node->child[child], first_node, first_item);
        }
        out[i].axis = node->axis;
    }
}

static void fill_wide_nodes(const HdBuilder *builder, const HdMeshPlace *place) {
    size_t lanes = (size_t)builder->lanes, count = (size_t)place->wide.node_count;
    size_t first = place->first.wide_nodes;
    real *bounds = (real *)builder->table[HD_TABLE_wide_bounds] + first * 6 * lanes;
    int *child = (int *)builder->table[HD_TABLE_wide_children] + first * lanes;
    for (size_t i = 0; i < count * 6 * lanes; i++)
        bounds[i] = (real)place->wide.bounds[i];
    for (size_t i = 0; i < count * lanes; i++)
        child[i] = move_child(place->wide.child[i], first, place->first.triangles);
}

/* ---- instances ---- */

static void store_rows(real rows[3][3], const HdVec3 columns[3]) {
    for (int i = 0; i < 3; i++) {
        rows[0][i] = (real)columns[i].x;
        rows[1][i] = (real)columns[i].y;
        rows[2][i] = (real)columns[i].z;
    }
}

/* Returns a generous bound, in mesh coordinates, of the distance that rounding may put between a
   point and the mesh. World coordinates round relative to the longest axis of `to`; the inverse
   enlarges that along the shortest. */
static double contact_distance(const HdVec3 to[3]) {
    double precision = sizeof(real) == sizeof(double) ? 0x1p-52 : 0x1p-23;
    double x = hd_length(to[0]), y = hd_length(to[1]), z = hd_length(to[2]);
    return precision * (64.0 + fmax(x, fmax(y, z)) / fmin(x, fmin(y, z)));
}

static void fill_instance(const HdBuilder *builder, Instance *out, int number,
                          int first_mesh_material, int first_face) {
    const HdMeshPlace *place = &builder->places[builder->scene->instances[number].mesh];
    HdPlacement to = hd_placement_of(builder->scene, number);
    HdVec3 back[3];
    hd_store3(out->start, hd_sub(to.start, builder->mesh_centre));
    hd_invert_columns(to.columns, back);
    store_rows(out->to_world, to.columns);
    store_rows(out->to_mesh, back);
    double contact = contact_distance(to.columns);
    out->contact_squared = (real)(contact * contact);
    const HdMesh *mesh = hd_mesh_of(builder->scene, number);
    const HdMeshSizes *first = &place->first;
    out->root = (int)(builder->lanes > 1 ? first->wide_nodes : first->nodes);
    if (!hd_has_hierarchy(builder->scene, mesh))
        out->root = -1;
    out->first_triangle = (int)first->triangles;
    out->triangle_count = mesh->triangle_count;
    out->first_mesh_material = first_mesh_material;
    out->first_face = first_face;
    out->first_corner_normals = mesh->normals != NULL ? (int)first->corner_normals : -1;
    out->first_corner_uvs = mesh->uvs != NULL ? (int)first->corner_uvs : -1;
    out->first_corner_colours = mesh->colours != NULL ? (int)first->corner_colours : -1;
}

/* ---- mesh materials ---- */

/* Returns the optical density, in factors of two, of a share 0 < x <= 1. Digit by digit, as library
   functions differ; errors of late digits matter little. */
static double density_of_share(double x) {
    int exponent;
    double fraction = 2.0 * frexp(x, &exponent), digits = 0.0;
    for (int i = 1; i <= 52; i++) {
        fraction *= fraction;
        if (fraction >= 2.0) {
            fraction *= 0.5;
            digits += ldexp(1.0, -i);
        }
    }
    return (double)(1 - exponent) - digits;
}

/* Sets the optical density of a share of light, and the remainder. */
static void set_filter(MeshMaterial *mesh_material, int side, int channel, double passes) {
    if (!(passes > 0.0)) {
        mesh_material->filter[side][channel] = HD_OPAQUE_DENSITY;
        return;
    }
    double density = density_of_share(passes) * (double)HD_DENSITY_ONE;
    double whole = floor(density);
    if (whole >= (double)HD_OPAQUE_DENSITY) {
        mesh_material->filter[side][channel] = HD_OPAQUE_DENSITY;
        return;
    }
    mesh_material->filter[side][channel] = (int)whole;
    mesh_material->filter_rest[side][channel] = (int)((density - whole) * (double)HD_DENSITY_ONE);
}

static void set_filters(MeshMaterial *mesh_material, const HdMaterial *material, bool is_opaque) {
    double outer = is_opaque ? 0.0 : material->transmission;
    double inner = is_opaque                  ? 0.0
                   : material->has_inner_side ? material->inner_transmission
                                              : material->transmission;
    double shares[2] = {outer, inner};
    for (int side = 0; side < 2; side++) {
        set_filter(mesh_material, side, 0, shares[side] * material->colour.x);
        set_filter(mesh_material, side, 1, shares[side] * material->colour.y);
        set_filter(mesh_material, side, 2, shares[side] * material->colour.z);
        bool passes_nothing = true;
        for (int channel = 0; channel < 3; channel++)
            passes_nothing &= mesh_material->filter[side][channel] == HD_OPAQUE_DENSITY;
        mesh_material->filter[side][3] = passes_nothing;
    }
}

/* Fills the materials of an instance and returns their count. */
static int fill_mesh_materials(const HdBuilder *builder, int number, MeshMaterial *mesh_materials,
                               Material *materials, int first) {
    const HdInstance *instance = &builder->scene->instances[number];
    const HdMesh *mesh = hd_mesh_of(builder->scene, number);
    for (int i = 0; i < mesh->material_count; i++) {
        const HdMeshMaterial *material = &mesh->materials[i];
        const int passes_as = material->passes_as >= 0 ? material->passes_as : i;
        const HdMaterial own = hd_instance_material(builder->scene, instance, i);
        const HdMaterial filter = hd_instance_material(builder->scene, instance, passes_as);
        MeshMaterial *mesh_material = &mesh_materials[first + i];
        hd_store3(mesh_material->emission, material->emission);
        mesh_material->material = builder->first_mesh_material + first + i;
        mesh_material->picture = material->picture;
        mesh_material->mask = mesh->uvs != NULL ? material->mask_picture : -1;
        NAMED(hd_fill_material)
        (&materials[mesh_material->material], &own);
        set_filters(mesh_material, &filter, mesh->materials[passes_as].is_opaque_to_shadows);
    }
    return mesh->material_count;
}

/* ---- all meshes ---- */

void NAMED(hd_fill_meshes)(const HdBuilder *builder) {
    const HdScene *scene = builder->scene;
    Header *header = builder->table[HD_TABLE_header];
    MeshNode *nodes = builder->table[HD_TABLE_mesh_nodes];
    if (scene->instance_count == 0)
        return;
    header->instance_count = scene->instance_count;
    header->node_stack = builder->node_stack;
    header->wide_stack = builder->wide_stack;
    header->mesh_reach = (real)builder->mesh_reach;
    for (int i = 0; i < scene->mesh_count; i++) {
        const HdMesh *mesh = &scene->meshes[i];
        const HdMeshPlace *place = &builder->places[i];
        fill_triangles(builder, mesh, place);
        fill_normals_and_uvs(builder, mesh, place);
        fill_colours(builder, mesh, place->first.corner_colours);
        if (!hd_has_hierarchy(scene, mesh))
            continue;
        if (builder->lanes > 1)
            fill_wide_nodes(builder, place);
        else
            fill_nodes(nodes, &mesh->tree, place->first.nodes, place->first.triangles);
    }
    int mesh_material = 0;
    for (int i = 0; i < scene->instance_count; i++) {
        fill_instance(builder, (Instance *)builder->table[HD_TABLE_instances] + i, i, mesh_material,
                      2 * builder->plane_count + i * HD_TRIANGLE_GROUPS);
        mesh_material += fill_mesh_materials(builder, i, builder->table[HD_TABLE_mesh_materials],
                                             builder->table[HD_TABLE_materials], mesh_material);
    }
    if (builder->top.node_count > 0) {
        header->top_root = (int)builder->first_top_node;
        fill_nodes(nodes, &builder->top, builder->first_top_node, 0);
        memcpy(builder->table[HD_TABLE_top_items], builder->top.order,
               (size_t)scene->instance_count * sizeof(int));
    }
}
