/* SPDX-License-Identifier: MIT */
#include "mesh/obj/material.h"

#include "base/limits.h"

const HdMtlParameters hd_mtl_defaults = {.Kd = {1.0f, 1.0f, 1.0f},
                                         .Tf = {1.0f, 1.0f, 1.0f},
                                         .Ns = 64.0f,
                                         .Ni = 1.0f,
                                         .d = 1.0f,
                                         .illum = HD_MTL_NO_ILLUM};

typedef struct Notes {
    const char *place;
    HdProblems *problems;
} Notes;

static double within(const Notes *notes, const char *name, double value, double low, double high) {
    const double legal = value < low ? low : value > high ? high : value;
    if (legal != value)
        hd_problem(notes->problems, "%s: %s is %.9g, expected %.15g to %.15g, and becomes %.15g",
                   notes->place, name, value, low, high, legal);
    return legal;
}

static HdVec3 colour(const Notes *notes, const char *name, const float from[3], double high) {
    return hd_vec3(within(notes, name, (double)from[0], 0.0, high),
                   within(notes, name, (double)from[1], 0.0, high),
                   within(notes, name, (double)from[2], 0.0, high));
}

static double largest(HdVec3 a) {
    return fmax(a.x, fmax(a.y, a.z));
}

static double mean(HdVec3 a) {
    return (a.x + a.y + a.z) / 3.0;
}

/* The colour alone of what has a strength too; white where there is none. */
static HdVec3 tint_of(HdVec3 a) {
    return largest(a) > 0.0 ? hd_scale(a, 1.0 / largest(a)) : hd_vec3(1.0, 1.0, 1.0);
}

static bool is_mirror(int illum) {
    return illum >= 3 && illum <= 9;
}

static bool refracts(int illum) {
    return illum == 6 || illum == 7;
}

/* What of the light passes: what d leaves, or, where light is refracted and d says nothing, Tf. */
static double transmission_of(const Notes *notes, const HdMtlParameters *from, HdVec3 filter) {
    const double passing = 1.0 - within(notes, "d", (double)from->d, 0.0, 1.0);
    return passing > 0.0 || !refracts(from->illum) ? passing : largest(filter);
}

/* Where more would go on than came, both shares shrink alike. */
static void limit_shares(const Notes *notes, HdMaterial *material) {
    const double sum = material->reflection + material->transmission;
    if (sum <= 1.0)
        return;
    hd_problem(notes->problems,
               "%s: Ks makes it reflect %.6g and d or Tf lets %.6g pass, expected at most 1 "
               "together, and both are divided by %.6g",
               notes->place, material->reflection, material->transmission, sum);
    material->reflection /= sum;
    material->transmission = 1.0 - material->reflection;
}

static int shininess_of(const Notes *notes, const HdMtlParameters *from, double specular) {
    if (specular == 0.0)
        return (int)(fmin(fmax((double)from->Ns, 1.0), HD_MAX_SHININESS) + 0.5);
    return (int)(within(notes, "Ns", (double)from->Ns, 1.0, HD_MAX_SHININESS) + 0.5);
}

/* Only where the file does not say that light goes straight on. */
static double index_of(const Notes *notes, const HdMtlParameters *from, double transmission) {
    if (transmission == 0.0 || !(refracts(from->illum) || from->illum == HD_MTL_NO_ILLUM))
        return 1.0;
    return within(notes, "Ni", (double)from->Ni, HD_MIN_INDEX_OF_REFRACTION,
                  HD_MAX_INDEX_OF_REFRACTION);
}

void hd_mtl_material(const HdMtlParameters *from, HdMeshMaterial *material, const char *place,
                     HdProblems *notes) {
    const Notes all = {place, notes};
    const HdVec3 diffuse = colour(&all, "Kd", from->Kd, 1.0);
    const HdVec3 specular = colour(&all, "Ks", from->Ks, 1.0);
    const HdVec3 filter = colour(&all, "Tf", from->Tf, 1.0);
    const double passing = transmission_of(&all, from, filter);
    HdMaterial *to = &material->material;
    *to = (HdMaterial){.colour = diffuse, .mirror_tint = hd_vec3(1.0, 1.0, 1.0)};
    to->ambient = mean(colour(&all, "Ka", from->Ka, 1.0));
    to->diffuse = 1.0 - passing;
    to->transmission = passing;
    if (passing > 0.0 && largest(diffuse) == 0.0) {
        /* Glass is often black but for its filter, and our one colour tints what passes too. */
        to->colour = tint_of(filter);
        to->diffuse = 0.0;
    }
    if (from->illum != 0 && from->illum != 1)
        to->specular = mean(specular);
    if (is_mirror(from->illum)) {
        to->reflection = largest(specular);
        to->mirror_tint = tint_of(specular);
    }
    to->shininess = shininess_of(&all, from, to->specular);
    to->index_of_refraction = index_of(&all, from, to->transmission);
    limit_shares(&all, to);
    material->emission = colour(&all, "Ke", from->Ke, HD_MAX_NUMBER);
}
