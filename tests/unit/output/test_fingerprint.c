/* SPDX-License-Identifier: MIT */
/* Everything that decides a pixel changes the fingerprint, and nothing else does.
   input/scene_file_print checks that all fields of a scene file, which are hashed, are written. */
#include "output/fingerprint.h"
#include "scene_text.h"

static HdSceneFile file;
static HdPictureStyle style = {.curve = HD_CURVE_SRGB, .bits = 8};
static uint64_t usual;

static uint64_t fingerprint(void) {
    return hd_run_fingerprint(&file, HD_PRECISION_FLOAT, &style);
}

static void expect_changed(const char *what, bool expected) {
    if ((fingerprint() != usual) != expected)
        fail_msg("%s is changed, and the fingerprint is %s", what, expected ? "not" : "too");
}

#define BITS(thing)                                                                                \
    { #thing, &(thing), sizeof(thing) }

typedef struct Bits {
    const char *what;
    void *place;
    size_t size;
} Bits;

/* Changes, in each of these, one bit of the first byte and one of the last. */
static void change_each(const Bits *list, size_t count, bool expected) {
    for (size_t i = 0; i < count; i++) {
        unsigned char *bytes = list[i].place;
        for (size_t k = 0; k<list[i].size; k += list[i].size> 1 ? list[i].size - 1 : 1) {
            bytes[k] ^= 1;
            expect_changed(list[i].what, expected);
            bytes[k] ^= 1;
        }
    }
    assert_true(fingerprint() == usual);
}

/* For each type of field, and each struct. */
TEST(scene_values_change_the_fingerprint) {
    HdScene *scene = &file.scene;
    HdSolid *glass = &scene->solids[0], *rimmed = &scene->solids[1];
    HdMeshEntry *entry = file.mesh_entries;
    const Bits list[] = {BITS(scene->frame_count),
                         BITS(scene->eye.cylinder.phi_frequency),
                         BITS(glass->kind),
                         BITS(scene->lights[1].falloff.end),
                         BITS(file.texture_curve),
                         BITS(entry->instance.scale),
                         BITS(entry->instance.material.diffuse)};
    int *const counts[] = {&scene->solid_count, &scene->light_count, &file.mesh_entry_count,
                           &rimmed->lights.colour_count};
    change_each(list, sizeof list / sizeof *list, true);
    for (int i = 0; i < 4; i++) {
        --*counts[i];
        expect_changed("a count", true);
        ++*counts[i];
    }
}

/* Read from files, as a colour and a factor, they may have a rounding error. */
TEST(the_last_digit_of_bright_lights_changes_it) {
    HdVec3 *light = &file.scene.lights[0].intensity;
    const HdVec3 kept = *light;
    for (int i = 0; i < 50; i++) {
        *light = hd_vec3(6e11 + 2e9 / 3.0 * i, 1e11 / 7.0 * i / 50, 1e11 / (i + 1));
        const uint64_t before = fingerprint();
        light->y = nextafter(light->y, 1e12);
        assert_true(fingerprint() != before);
    }
    *light = kept;
}

/* Contents of files */

static HdVec3 vertices[3], normals[1];
static HdVec3 colours[3];
static double uvs[1][2];
static int32_t corners[1][3], corner_normals[1][3], corner_uvs[1][3], material_of[1];
static uint8_t group_of[1];
static uint16_t floor_texels[6], sky_texels[3], texels[3];
static HdMeshMaterial materials[3]; /* the second is the mesh's */
static HdMesh mesh = {.vertex_count = 3,
                      .normal_count = 1,
                      .uv_count = 1,
                      .triangle_count = 1,
                      .material_count = 1,
                      .vertices = vertices,
                      .colours = colours,
                      .normals = normals,
                      .uvs = uvs,
                      .corners = corners,
                      .corner_normals = corner_normals,
                      .corner_uvs = corner_uvs,
                      .material_of = material_of,
                      .group_of = group_of,
                      .materials = &materials[1]};
static HdPicture picture = {.texture = {.width = 1, .height = 1, .texels = texels}};
static HdInstance instance = {.has_material = true};

TEST(file_contents_change_the_fingerprint) {
    HdScene *scene = &file.scene;
    const Bits list[] = {BITS(floor_texels),
                         BITS(sky_texels),
                         BITS(scene->environment.top),
                         BITS(texels),
                         BITS(vertices),
                         BITS(normals),
                         BITS(uvs),
                         BITS(corners),
                         BITS(corner_normals),
                         BITS(corner_uvs),
                         BITS(material_of),
                         BITS(group_of),
                         BITS(materials[1].emission),
                         BITS(materials[1].picture),
                         BITS(materials[1].mask_picture),
                         BITS(colours),
                         BITS(materials[1].passes_as),
                         BITS(materials[1].material.diffuse),
                         BITS(instance.position),
                         BITS(instance.rotation_degrees),
                         BITS(instance.scale),
                         BITS(instance.mesh),
                         BITS(picture.is_clamped),
                         BITS(materials[1].is_opaque_to_shadows),
                         BITS(instance.has_material),
                         BITS(instance.material.reflection),
                         BITS(scene->crop),
                         BITS(scene->crop.left),
                         BITS(scene->crop.top),
                         BITS(scene->crop.whole_height),
                         BITS(scene->geometry),
                         BITS(style.has_alpha),
                         BITS(scene->accel)};
    change_each(list, sizeof list / sizeof *list, true);
    mesh.normals = NULL;
    expect_changed("normals", true);
    mesh.normals = normals;
    instance.around = &(double){1.5};
    expect_changed("around", true);
    instance.around = NULL;
}

TEST(names_and_unused_values_do_not) {
    const Bits list[] = {BITS(materials[0]),
                         BITS(materials[2]),
                         BITS(materials[1].name),
                         BITS(materials[1].texture),
                         BITS(file.output.style.frames_per_second),
                         BITS(file.output.style.is_ntsc),
                         BITS(file.output.path),
                         BITS(file.schema),
                         BITS(file.texture_path),
                         BITS(*file.mesh_entries[0].file)};
    change_each(list, sizeof list / sizeof *list, false);
}

static int read_scene(void **state) {
    (void)state;
    expect_scene(&file, rich_text, NULL);
    file.schema[0] = 's';
    HdScene *scene = &file.scene;
    scene->environment.texture = (HdTexture){.width = 1, .height = 1, .texels = sky_texels};
    scene->floor.texture = (HdTexture){.width = 2, .height = 1, .texels = floor_texels};
    scene->mesh_count = scene->picture_count = scene->instance_count = 1;
    scene->meshes = &mesh;
    scene->pictures = &picture;
    scene->instances = &instance;
    usual = fingerprint();
    return 0;
}

/* A copy whose parts are not all its own to free. */
GROUP(read_scene, NULL)
