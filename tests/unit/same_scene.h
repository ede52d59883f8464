/* SPDX-License-Identifier: MIT */
/* Compares two scene files bit by bit: 0 and -0 differ. */
#ifndef HD_SAME_SCENE_H
#define HD_SAME_SCENE_H

#include "input/scene_file.h"
#include "unit_test.h"

typedef struct Member {
    const char *name;
    size_t offset, size;
} Member;

#define MEMBER(type, member)                                                                       \
    { #type "." #member, offsetof(type, member), sizeof(((type *)NULL)->member) }
#define EXPECT_SAME(members, a, b)                                                                 \
    expect_same_members(members, sizeof(members) / sizeof *(members), a, b)

static inline void expect_same_members(const Member *members, size_t count, const void *a,
                                       const void *b) {
    for (size_t i = 0; i < count; i++)
        if (memcmp((const char *)a + members[i].offset, (const char *)b + members[i].offset,
                   members[i].size) != 0)
            fail_msg("%s differs", members[i].name);
}

static inline void expect_same_material(const HdMaterial *a, const HdMaterial *b) {
#define M(member) MEMBER(HdMaterial, member)
    static const Member members[] = {
        M(colour),       M(mirror_tint),    M(ambient),        M(diffuse),
        M(specular),     M(shininess),      M(reflection),     M(index_of_refraction),
        M(transmission), M(has_inner_side), M(lit_from_behind)};
    static const Member inner[] = {M(inner_reflection), M(inner_transmission)};
#undef M
    EXPECT_SAME(members, a, b);
    if (a->has_inner_side)
        EXPECT_SAME(inner, a, b);
}

static inline void expect_same_solid(const HdSolid *a, const HdSolid *b) {
#define M(member) MEMBER(HdSolid, member)
#define L(member) MEMBER(HdEdgeLights, member)
    static const Member members[] = {M(kind), M(centre), M(circumradius), M(rotation_degrees),
                                     M(rim_width)};
    static const Member lights[] = {L(per_edge), L(colour_count), L(intensity),
                                    L(falloff),  L(disc_radius),  L(disc_radiance)};
#undef M
#undef L
    EXPECT_SAME(members, a, b);
    expect_same_material(&a->face, &b->face);
    if (a->rim_width > 0.0)
        expect_same_material(&a->rim, &b->rim);
    EXPECT_SAME(lights, &a->lights, &b->lights);
    for (int i = 0; i < a->lights.colour_count; i++)
        assert_memory_equal(&a->lights.colours[i], &b->lights.colours[i], sizeof(HdVec3));
}

static inline void expect_same_path(const HdPath *a, const HdPath *b) {
    assert_int_equal(a->is_fixed, b->is_fixed);
    if (a->is_fixed)
        assert_memory_equal(&a->point, &b->point, sizeof a->point);
    else
        assert_memory_equal(&a->cylinder, &b->cylinder, sizeof a->cylinder);
}

static inline void expect_same_mesh(const HdMeshEntry *a, const HdMeshEntry *b) {
#define M(member) MEMBER(HdMeshEntry, member)
    static const Member members[] = {
        M(normals),        M(crease_degrees),        M(instance.position),         M(size),
        M(instance.scale), M(instance.has_material), M(instance.rotation_degrees), M(instance.up),
        M(ambient)};
#undef M
    assert_string_equal(a->file, b->file);
    EXPECT_SAME(members, a, b);
    if (a->instance.has_material)
        expect_same_material(&a->instance.material, &b->instance.material);
}

static inline void expect_same_scene(const HdScene *a, const HdScene *b) {
#define M(member) MEMBER(HdScene, member)
    static const Member members[] = {M(width),
                                     M(height),
                                     M(depth),
                                     M(cutoff),
                                     M(sampling),
                                     M(max_error),
                                     M(exposure),
                                     M(background),
                                     M(frame_count),
                                     M(solid_count),
                                     M(light_count),
                                     M(floor.present),
                                     M(environment.curve),
                                     M(environment.intensity),
                                     M(environment.rotation_degrees)};
    static const Member others[] = {M(samples_per_side), M(field_of_view_degrees)};
#undef M
    EXPECT_SAME(members, a, b);
    EXPECT_SAME(others, a, b);
    assert_int_equal(a->environment.file != NULL, b->environment.file != NULL);
    if (a->environment.file != NULL)
        assert_string_equal(a->environment.file, b->environment.file);
    expect_same_path(&a->eye, &b->eye);
    expect_same_path(&a->target, &b->target);
    for (int i = 0; i < a->solid_count; i++)
        expect_same_solid(&a->solids[i], &b->solids[i]);
    for (int i = 0; i < a->light_count; i++)
        assert_memory_equal(&a->lights[i], &b->lights[i], sizeof(HdLight));
    if (!a->floor.present)
        return;
    assert_memory_equal(a->floor.corners, b->floor.corners, sizeof a->floor.corners);
    expect_same_material(&a->floor.material, &b->floor.material);
}

static inline void expect_same_file(const HdSceneFile *a, const HdSceneFile *b) {
    expect_same_scene(&a->scene, &b->scene);
    assert_string_equal(a->output.path, b->output.path);
    const HdOutputStyle *style = &a->output.style, *other = &b->output.style;
    assert_true(style->picture.curve == other->picture.curve &&
                style->picture.bits == other->picture.bits &&
                style->picture.has_alpha == other->picture.has_alpha &&
                style->frames_per_second == other->frames_per_second &&
                style->is_ntsc == other->is_ntsc);
    assert_string_equal(a->texture_path, b->texture_path);
    if (a->texture_path[0] != '\0')
        assert_int_equal(a->texture_curve, b->texture_curve);
    assert_int_equal(a->mesh_entry_count, b->mesh_entry_count);
    for (int i = 0; i < a->mesh_entry_count; i++)
        expect_same_mesh(&a->mesh_entries[i], &b->mesh_entries[i]);
}

#endif
