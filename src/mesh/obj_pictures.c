/* SPDX-License-Identifier: MIT */
/* Places the pictures of an OBJ file's materials: the options of map statements. */
#include <math.h>

#include "mesh/obj_reading.h"

/* ---- options ---- */

/* Reads `least` to `most` numbers; the last word of the line is the name. Others stay. */
static bool take_numbers(HdSpan *line, int least, int most, double *values) {
    for (int i = 0; i < most; i++) {
        HdSpan rest = *line;
        const HdSpan word = hd_next_word(&rest);
        double value;
        if (hd_number_fault(word, &value) != NULL || hd_span_size(hd_rest(rest)) == 0)
            return i >= least;
        values[i] = value;
        *line = rest;
    }
    return true;
}

static bool take_option(HdSpan *line, HdSpan word, HdMapOptions *options) {
    static const char *const words[] = {"-blendu", "-blendv",  "-cc", "-texres",
                                        "-type",   "-imfchan", "-bm", "-boost"};
    double unused[3];
    if (hd_span_is(word, "-s"))
        return take_numbers(line, 1, 2, options->scale) && take_numbers(line, 0, 1, unused);
    if (hd_span_is(word, "-o"))
        return take_numbers(line, 1, 2, options->offset) && take_numbers(line, 0, 1, unused);
    if (hd_span_is(word, "-t"))
        return take_numbers(line, 1, 3, unused);
    if (hd_span_is(word, "-mm"))
        return take_numbers(line, 2, 2, unused);
    if (hd_span_is(word, "-clamp")) {
        options->is_clamped = hd_span_is(hd_next_word(line), "on");
        return true;
    }
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (hd_span_is(word, words[i]))
            return hd_span_size(hd_next_word(line)) > 0;
    return false;
}

bool hd_take_map_options(HdSpan *line, HdMapOptions *options, HdSpan *fault) {
    *options = (HdMapOptions){.scale = {1.0, 1.0}};
    for (;;) {
        HdSpan rest = *line;
        const HdSpan word = hd_next_word(&rest);
        if (hd_span_size(word) == 0 || *word.begin != '-')
            return true;
        *fault = word;
        if (!take_option(&rest, word, options))
            return false;
        *line = rest;
    }
}

/* ---- coordinates ---- */

static int material_of(const HdMesh *mesh, int triangle) {
    return mesh->material_of != NULL ? mesh->material_of[triangle] : 0;
}

static bool is_moved(const HdMapOptions *options) {
    return options->scale[0] != 1.0 || options->scale[1] != 1.0 || options->offset[0] != 0.0 ||
           options->offset[1] != 0.0;
}

/* Gives the corners of moved pictures texture coordinates of their own: other materials may share
   the old ones. */
static bool move_pictures(HdMesh *mesh, const HdMapOptions *options, HdObjMemory *memory) {
    size_t count = (size_t)mesh->uv_count, before = count;
    for (int i = 0; i < mesh->triangle_count; i++)
        count += is_moved(&options[material_of(mesh, i)]) ? 3 : 0;
    if (count == before)
        return true;
    double(*uvs)[2] = hd_obj_resize(memory, mesh->uvs, sizeof *uvs, before, count);
    if (uvs == NULL)
        return false;
    mesh->uvs = uvs;
    for (int i = 0; i < mesh->triangle_count; i++) {
        const HdMapOptions *o = &options[material_of(mesh, i)];
        for (int k = 0; k < 3 && is_moved(o); k++) {
            int32_t *corner = &mesh->corner_uvs[i][k];
            if (*corner < 0)
                continue;
            for (int axis = 0; axis < 2; axis++)
                uvs[mesh->uv_count][axis] = o->scale[axis] * uvs[*corner][axis] + o->offset[axis];
            *corner = mesh->uv_count++;
        }
    }
    return true;
}

static bool is_within(const double uv[2]) {
    const double slack = 0.001; /* exporters write -0.00001 for 0 */
    return fmin(uv[0], uv[1]) >= -slack && fmax(uv[0], uv[1]) <= 1.0 + slack;
}

/* Repeating would blend the border of a picture with the opposite one. */
static void clamp_pictures(HdMesh *mesh, const HdMapOptions *options) {
    for (int i = 0; i < mesh->material_count; i++)
        mesh->materials[i].is_clamped = true;
    for (int i = 0; i < mesh->triangle_count; i++)
        for (int k = 0; k < 3; k++) {
            const int32_t corner = mesh->corner_uvs[i][k];
            if (corner >= 0 && !is_within(mesh->uvs[corner]))
                mesh->materials[material_of(mesh, i)].is_clamped = false;
        }
    for (int i = 0; i < mesh->material_count; i++)
        mesh->materials[i].is_clamped |= options[i].is_clamped;
}

bool hd_obj_place_pictures(HdMesh *mesh, const HdMapOptions *options, HdObjMemory *memory) {
    if (mesh->uvs == NULL)
        return true;
    if (!move_pictures(mesh, options, memory))
        return false;
    clamp_pictures(mesh, options);
    return true;
}
