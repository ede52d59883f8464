/* SPDX-License-Identifier: MIT */
/* Writes the classic task's input format. */
#include <errno.h>
#include <stdbool.h>
#include <string.h>

#include "base/text.h"
#include "input/classic_read.h"

static void print_number(FILE *out, double value) {
    char text[HD_NUMBER_SIZE];
    hd_exact_number(value, text);
    fputs(text, out);
}

static void print_numbers(FILE *out, const double *values, int count) {
    for (int i = 0; i < count; i++) {
        if (i > 0)
            putc(' ', out);
        print_number(out, values[i]);
    }
}

static void print_vector(FILE *out, HdVec3 v) {
    const double values[3] = {v.x, v.y, v.z};
    print_numbers(out, values, 3);
}

static void print_flight(FILE *out, const HdCylinderPath *path) {
    const double base[3] = {path->r0, path->z0, path->phi0};
    const double amplitudes[2] = {path->r_amplitude, path->z_amplitude};
    const double frequencies[3] = {path->r_frequency, path->z_frequency, path->phi_frequency};
    const double phases[2] = {path->r_phase, path->z_phase};
    print_numbers(out, base, 3);
    fputs("   ", out);
    print_numbers(out, amplitudes, 2);
    fputs("   ", out);
    print_numbers(out, frequencies, 3);
    fputs("   ", out);
    print_numbers(out, phases, 2);
    putc('\n', out);
}

static void print_solid(FILE *out, const HdSolid *solid) {
    const double values[3] = {solid->circumradius, solid->face.reflection,
                              solid->face.transmission};
    print_vector(out, solid->centre);
    fputs("   ", out);
    print_vector(out, solid->face.colour);
    fputs("   ", out);
    print_numbers(out, values, 3);
    fprintf(out, "   %d\n", solid->lights.per_edge);
}

static void print_floor(FILE *out, const HdFloor *floor, const char *texture_path) {
    for (int i = 0; i < 4; i++) {
        print_vector(out, floor->corners[i]);
        fputs("   ", out);
    }
    fprintf(out, "%s   ", texture_path);
    print_vector(out, floor->material.colour);
    fputs("   ", out);
    print_number(out, floor->material.reflection);
    putc('\n', out);
}

static void print_lights(FILE *out, const HdScene *scene) {
    fprintf(out, "%d\n", scene->light_count);
    for (int i = 0; i < scene->light_count; i++) {
        print_vector(out, scene->lights[i].position);
        fputs("   ", out);
        print_vector(out, scene->lights[i].intensity);
        putc('\n', out);
    }
}

static bool is_one_token(const char *path) {
    return path[0] != '\0' && strpbrk(path, " \t\n\v\f\r") == NULL;
}

static HdStatus check_fits(const HdClassicInput *input, HdError *error) {
    const HdScene *scene = &input->scene;
    if (scene->solid_count != HD_CLASSIC_SOLIDS)
        return hd_fail(error, HD_BAD_INPUT, "the scene has %d solids, expected %d",
                       scene->solid_count, HD_CLASSIC_SOLIDS);
    if (!scene->floor.present)
        return hd_fail(error, HD_BAD_INPUT, "the scene has no floor, expected one");
    if (scene->light_count > HD_CLASSIC_MAX_LIGHTS)
        return hd_fail(error, HD_BAD_INPUT, "the scene has %d lights, expected at most %d",
                       scene->light_count, HD_CLASSIC_MAX_LIGHTS);
    if (!is_one_token(input->output_pattern))
        return hd_fail(error, HD_BAD_INPUT,
                       "the output path is '%s', expected one without white space",
                       input->output_pattern);
    if (!is_one_token(input->texture_path))
        return hd_fail(error, HD_BAD_INPUT,
                       "the texture path is '%s', expected one without white space",
                       input->texture_path);
    return HD_OK;
}

HdStatus hd_classic_print(FILE *out, const HdClassicInput *input, HdError *error) {
    const HdScene *scene = &input->scene;
    const HdStatus status = check_fits(input, error);
    if (status != HD_OK)
        return status;
    fprintf(out, "%d\n%s\n%d %d ", scene->frame_count, input->output_pattern, scene->width,
            scene->height);
    print_number(out, scene->field_of_view_degrees);
    putc('\n', out);
    print_flight(out, &scene->eye.cylinder);
    print_flight(out, &scene->target.cylinder);
    for (int i = 0; i < HD_CLASSIC_SOLIDS; i++)
        print_solid(out, &scene->solids[i]);
    print_floor(out, &scene->floor, input->texture_path);
    print_lights(out, scene);
    fprintf(out, "%d %d\n", scene->depth, scene->samples_per_side);
    if (fflush(out) != 0 || ferror(out))
        return hd_fail(error, HD_FAILED, "cannot write the configuration: %s", strerror(errno));
    return HD_OK;
}
