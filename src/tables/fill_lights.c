/* SPDX-License-Identifier: MIT */
/* Tables of lights, occlusion masks and isolated solids (docs/numerics.md, Occlusion masks);
   compiled for each precision. */
#include "tables/builder.h"

#include <math.h>

#include "scene/contact.h"

/* Fills a light's coordinates along the unrounded normals of a solid; the light is exactly on its
   own two faces. */
static void fill_solid_coordinates(const HdBuilder *builder, int light, int solid,
                                   const Plane *planes, real *out) {
    const HdLightSource *source = &builder->sources[light];
    const HdPlatonic *shape = &builder->shapes[solid];
    HdVec3 offset = hd_light_offset(builder, source, solid);
    int step = hd_faces_per_plane(shape);
    for (int i = 0; i < hd_solid_plane_count(shape); i++)
        out[i] = (real)hd_dot(shape->face_normal[i * step], offset);
    for (int i = 0; source->owner == solid && i < 2; i++) {
        int plane = source->face[i] / step;
        out[plane] = source->face[i] % step == 0 ? planes[plane].distance : -planes[plane].distance;
    }
}

static void add_side(LightSides *sides, int bit, real distance) {
    if (distance > R(0.0))
        sides->outside |= (uint)1 << bit;
    else if (!(distance < R(0.0)))
        sides->on_plane |= (uint)1 << bit;
}

/* Returns a light's sides, from the rounded coordinates, so that both tables agree. */
static LightSides sides_of_solid(const Object *solid, const Plane *planes,
                                 const real *coordinates) {
    LightSides sides = {0, 0, {0, 0}};
    for (int i = 0; i < solid->plane_count; i++) {
        add_side(&sides, 2 * i, coordinates[i] - planes[i].distance);
        if (solid->paired)
            add_side(&sides, 2 * i + 1, -coordinates[i] - planes[i].distance);
    }
    return sides;
}

static void fill_floor_distances(const HdBuilder *builder, int light, const HdFloorFrame *frame,
                                 real *out) {
    int first = builder->plane_count - HD_FLOOR_PLANES;
    HdVec3 offset = hd_light_offset(builder, &builder->sources[light], builder->solid_count);
    out[first] = (real)hd_dot(frame->normal, offset);
    const Plane *planes = (const Plane *)builder->table[HD_TABLE_planes] + first;
    for (int i = 1; i < 5; i++)
        out[first + i] = (real)((double)planes[i].x * offset.x + (double)planes[i].y * offset.y +
                                (double)planes[i].z * offset.z - (double)planes[i].distance);
}

static void fill_falloff(Light *light, const HdFalloff *falloff) {
    double length = falloff->end > 0.0 ? falloff->end : falloff->distance;
    real inverse = length > 0.0 ? (real)(1.0 / (length * length)) : R(0.0);
    light->inverse_falloff_squared = falloff->end > 0.0 ? -inverse : inverse;
}

/* Returns the kernels' number of a solid's face, 2 * plane + side, or its group of triangles; -1:
   the light is on no solid. */
static int own_face(const HdBuilder *builder, const HdLightSource *source, int face) {
    const Object *objects = builder->table[HD_TABLE_objects];
    const Instance *instances = builder->table[HD_TABLE_instances];
    if (source->owner < 0)
        return -1;
    if (builder->scene->geometry == HD_GEOMETRY_TRIANGLES)
        return instances[source->owner].first_face + face;
    const bool is_paired = hd_faces_per_plane(&builder->shapes[source->owner]) == 2;
    return 2 * objects[source->owner].first_plane + (is_paired ? face : 2 * face);
}

/* A sphere about lights near each other. */
typedef struct {
    HdVec3 centre; /* world space */
    double radius, reach;
} LightSphere;

static LightSphere sphere_about(const HdBuilder *builder, const HdClusteredLight *first,
                                int count) {
    LightSphere sphere = {{0.0, 0.0, 0.0}, 0.0, 0.0};
    for (int i = 0; i < count; i++)
        sphere.centre = hd_add(sphere.centre, hd_scale(first[i].position, 1.0 / count));
    for (int i = 0; i < count; i++) {
        double end = builder->sources[first[i].light].falloff.end;
        sphere.reach = fmax(sphere.reach, end > 0.0 ? end : (double)REAL_LARGE);
        sphere.radius = fmax(sphere.radius, hd_length(hd_sub(first[i].position, sphere.centre)));
    }
    return sphere;
}

/* Above all lengths; its square is within a float's range. */
#define MAX_REACH 1e18

/* Returns the sphere relative to an object, enlarged by rounding to either precision. */
static LightRun rounded_sphere(const LightSphere *sphere, HdVec3 object) {
    HdVec3 place = hd_sub(sphere->centre, object);
    return (LightRun){.place = {(real)place.x, (real)place.y, (real)place.z},
                      .radius = (real)(sphere->radius * 1.0001 + hd_length(place) * 1e-5),
                      .reach = (real)fmin(sphere->reach, MAX_REACH)};
}

static void fill_cluster(const HdBuilder *builder, int cluster, const HdClusteredLight *first,
                         int count) {
    size_t clusters = (size_t)HD_LIGHT_CLUSTERS(builder->light_count);
    LightSphere sphere = sphere_about(builder, first, count);
    for (int object = 0; object < builder->object_count; object++) {
        LightRun rounded = rounded_sphere(&sphere, builder->centres[object]);
        real *out = (real *)builder->table[HD_TABLE_light_clusters] +
                    (size_t)object * HD_CLUSTER_ROWS * clusters + cluster;
        out[HD_CLUSTER_X * clusters] = rounded.place[0];
        out[HD_CLUSTER_Y * clusters] = rounded.place[1];
        out[HD_CLUSTER_Z * clusters] = rounded.place[2];
        out[HD_CLUSTER_RADIUS * clusters] = rounded.radius;
        out[HD_CLUSTER_REACH * clusters] = rounded.reach;
    }
}

/* Returns whether enough lights end before the centres of solids for culling of runs to pay. */
static bool runs_pay(const HdBuilder *builder) {
    enum { MIN_SHARE = 4 };
    int64_t beyond = 0, pairs = (int64_t)builder->light_count * builder->solid_count;
    for (int i = 0; i < builder->light_count; i++)
        for (int s = 0; s < builder->solid_count; s++) {
            const HdLightSource *source = &builder->sources[i];
            double end = source->falloff.end;
            beyond += end > 0.0 && hd_length(hd_light_offset(builder, source, s)) > end;
        }
    return beyond > 0 && beyond * MIN_SHARE >= pairs;
}

/* Testing fewer lights costs less than culling their run. */
enum { MIN_RUN = 3 };

/* Finds the runs of consecutive lights in a cluster, which may have gaps. Packets of several lanes
   need only the length to skip of a culled cluster, so all of its runs count. */
static void fill_runs(const HdBuilder *builder, Light *lights, const HdClusteredLight *first,
                      int count) {
    LightRun *runs = builder->table[HD_TABLE_light_runs];
    for (int i = 0, next; i < count; i = next) {
        int light = first[i].light;
        for (next = i + 1; next < count && first[next].light == light + next - i; next++)
            continue;
        if (builder->lanes == 1 && next - i < MIN_RUN)
            continue;
        lights[light].run = next - i;
        if (builder->lanes > 1)
            continue;
        LightSphere sphere = sphere_about(builder, first + i, next - i);
        for (int object = 0; object < builder->object_count; object++)
            runs[object * builder->light_count + light] =
                rounded_sphere(&sphere, builder->centres[object]);
    }
}

static void fill_clusters(const HdBuilder *builder, Light *lights) {
    const HdClusteredLight *clustered = builder->clustered;
    int count = HD_LIGHT_CLUSTERS(builder->light_count) > 0 ? builder->light_count : 0;
    bool has_runs = builder->lanes > 1 || runs_pay(builder);
    for (int i = 0, next; i < count; i = next) {
        int cluster = clustered[i].cluster;
        for (next = i; next < count && clustered[next].cluster == cluster; next++)
            lights[clustered[next].light].cluster = cluster;
        fill_cluster(builder, cluster, clustered + i, next - i);
        if (has_runs)
            fill_runs(builder, lights, clustered + i, next - i);
    }
}

static void fill_lights(const HdBuilder *builder) {
    Light *lights = builder->table[HD_TABLE_lights];
    const Plane *planes = builder->table[HD_TABLE_planes];
    Vector *offsets = builder->table[HD_TABLE_light_offsets];
    const Object *objects = builder->table[HD_TABLE_objects];
    HdFloorFrame frame = {0};
    if (builder->has_floor)
        frame = hd_floor_frame(&builder->scene->floor);
    for (int i = 0; i < builder->light_count; i++) {
        const HdLightSource *source = &builder->sources[i];
        hd_store3(lights[i].intensity, source->intensity);
        fill_falloff(&lights[i], &source->falloff);
        lights[i].own_face[0] = own_face(builder, source, source->face[0]);
        lights[i].own_face[1] = own_face(builder, source, source->face[1]);
        for (int object = 0; object < builder->object_count; object++)
            offsets[object * builder->light_count + i] =
                hd_as_vector(hd_light_offset(builder, source, object));
        real *row = (real *)builder->table[HD_TABLE_light_coordinates] +
                    (size_t)i * (size_t)builder->plane_count;
        LightSides *sides = (LightSides *)builder->table[HD_TABLE_light_sides] +
                            (size_t)i * (size_t)builder->object_count;
        for (int s = 0; s < builder->solid_count; s++) {
            int first = objects[s].first_plane;
            fill_solid_coordinates(builder, i, s, planes + first, row + first);
            sides[s] = sides_of_solid(&objects[s], planes + first, row + first);
        }
        if (builder->has_floor)
            fill_floor_distances(builder, i, &frame, row);
    }
    fill_clusters(builder, lights);
}

/* ---- distances and radii ---- */

static HdVec3 vector_between(const HdBuilder *builder, int from, int to) {
    return hd_sub(builder->centres[to], builder->centres[from]);
}

static double circumradius(const HdBuilder *builder, int object) {
    if (object < builder->solid_count)
        return builder->scene->solids[object].circumradius;
    if (!builder->has_floor || object != builder->solid_count)
        return sqrt(3.0) * builder->mesh_reach;
    double radius = 0.0;
    for (int i = 0; i < 4; i++) {
        HdVec3 corner = builder->scene->floor.corners[i];
        radius = fmax(radius, hd_length(hd_sub(corner, builder->centres[object])));
    }
    return radius;
}

/* Returns an upper bound of the distance from a point to the eye on its camera path. */
static double farthest_eye(const HdPath *path, HdVec3 point) {
    const HdCylinderPath *cylinder = &path->cylinder;
    if (path->is_fixed)
        return hd_length(hd_sub(path->point, point));
    return hd_length(point) + fabs(cylinder->r0) + fabs(cylinder->r_amplitude) +
           fabs(cylinder->z0) + fabs(cylinder->z_amplitude);
}

/* Returns the radius of a sphere about all computed hits of an object; their error is relative to
   the ray's length. */
static double radius_about(const HdBuilder *builder, int object) {
    double way = farthest_eye(&builder->scene->eye, builder->centres[object]);
    for (int i = 0; i < builder->object_count; i++)
        way = fmax(way, hd_length(vector_between(builder, object, i)) + circumradius(builder, i));
    return 1.001 * circumradius(builder, object) + 1e-6 * way;
}

/* ---- occlusion masks ---- */

/* Returns the distance of a point from the convex hull of a sphere about the origin and a light: a
   cone with a round end. */
static double distance_to_cone(double radius, HdVec3 light, HdVec3 point) {
    double length = hd_length(light), share = 0.0;
    if (length > radius) {
        double along = hd_dot(point, light) / length;
        double across = sqrt(fmax(hd_dot(point, point) - along * along, 0.0));
        double sine = radius / length; /* sine of half the cone's angle */
        along -= across * sine / sqrt(1.0 - sine * sine);
        share = fmin(fmax(along / length, 0.0), 1.0);
    }
    double left = radius * (1.0 - share); /* radius of the hull there */
    return hd_length(hd_sub(point, hd_scale(light, share))) - left;
}

static bool solid_cannot_occlude(const HdBuilder *builder, const HdLightSource *source, int object,
                                 double radius, int solid) {
    HdVec3 centre = vector_between(builder, object, solid);
    double slack = (hd_length(centre) + radius) * 1e-4 +
                   hd_length(hd_light_offset(builder, source, solid)) * 1e-5;
    double least = builder->scene->solids[solid].circumradius * 1.001 + slack;
    return distance_to_cone(radius, hd_light_offset(builder, source, object), centre) > least;
}

/* The lit points of an object. */
typedef struct {
    int object;
    double radius; /* radius of a sphere about all of them */
    int side;      /* side of the floor's plane: 1, -1, or 0 for both */
} LitObject;

/* Finds an object's side of the floor, by a solid's corners or the meshes' sphere. */
static int side_of_floor(const HdBuilder *builder, int object, double radius) {
    HdVec3 normal = hd_floor_frame(&builder->scene->floor).normal;
    HdVec3 centre = vector_between(builder, builder->solid_count, object);
    double reach = radius;
    if (object < builder->solid_count) {
        const HdPlatonic *shape = &builder->shapes[object];
        double most = 0.0;
        for (int i = 0; i < shape->vertex_count; i++)
            most = fmax(most, fabs(hd_dot(normal, shape->vertex[i])));
        reach -= (1.0 - most) * circumradius(builder, object);
    }
    double least = reach + (hd_length(centre) + radius) * 1e-4, height = hd_dot(normal, centre);
    return (height > least) - (height < -least);
}

static bool floor_cannot_occlude(const HdBuilder *builder, int light, const LitObject *lit) {
    if (lit->object == builder->solid_count)
        return true; /* the floor never occludes its own points */
    const real *row = (const real *)builder->table[HD_TABLE_light_coordinates] +
                      (size_t)light * (size_t)builder->plane_count;
    real height = row[builder->plane_count - HD_FLOOR_PLANES];
    return lit->side > 0 ? height > R(0.0) : lit->side < 0 && height < R(0.0);
}

static int occlusion_mask(const HdBuilder *builder, int light, const LitObject *lit) {
    const HdLightSource *source = &builder->sources[light];
    const LightSides *sides = (const LightSides *)builder->table[HD_TABLE_light_sides] +
                              (size_t)light * (size_t)builder->object_count;
    int nonoccluders = 0;
    for (int s = 0; s < builder->solid_count && s < HD_MASKED_OBJECTS; s++) {
        /* A segment leaves its own solid only if the light is outside of a face. */
        bool cannot_occlude =
            s == lit->object ? sides[s].outside == 0
                             : solid_cannot_occlude(builder, source, lit->object, lit->radius, s);
        nonoccluders |= cannot_occlude ? 1 << s : 0;
    }
    if (builder->has_floor && builder->solid_count < HD_MASKED_OBJECTS)
        nonoccluders |= floor_cannot_occlude(builder, light, lit) ? 1 << builder->solid_count : 0;
    return nonoccluders;
}

/* Fills the masks of an object; the first one is the intersection of all lights' masks, since
   kernels skip its objects altogether. */
static void fill_occlusion_masks(const HdBuilder *builder, int object) {
    int *nonoccluders = (int *)builder->table[HD_TABLE_occlusion_masks] +
                        (size_t)object * ((size_t)builder->light_count + 1);
    double radius = radius_about(builder, object);
    LitObject lit = {object, radius,
                     builder->has_floor ? side_of_floor(builder, object, radius) : 0};
    nonoccluders[0] = -1;
    for (int i = 0; i < builder->light_count; i++) {
        nonoccluders[i + 1] = occlusion_mask(builder, i, &lit);
        nonoccluders[0] &= nonoccluders[i + 1];
    }
}

/* ---- isolated solids ---- */

/* Returns the distance below which rounding may make two objects meet. */
static double min_gap(const HdBuilder *builder, int a, int b) {
    return (radius_about(builder, a) + radius_about(builder, b)) * 1.0001 -
           circumradius(builder, a) - circumradius(builder, b);
}

static bool reaches_into(const HdBuilder *builder, int other, int solid) {
    const HdScene *scene = builder->scene;
    double least = -min_gap(builder, solid, other);
    if (other < builder->solid_count)
        return hd_solid_depth(&scene->solids[solid], &scene->solids[other], least) > least;
    if (builder->has_floor && other == builder->solid_count)
        return hd_floor_depth(&scene->solids[solid], &scene->floor, least) > least;
    double sum = circumradius(builder, solid) + circumradius(builder, other);
    return !(hd_length(vector_between(builder, solid, other)) - sum > -least);
}

static bool is_isolated(const HdBuilder *builder, int solid) {
    for (int i = 0; i < builder->object_count; i++)
        if (i != solid && reaches_into(builder, i, solid))
            return false;
    return true;
}

void NAMED(hd_fill_lights)(const HdBuilder *builder) {
    Object *objects = builder->table[HD_TABLE_objects];
    fill_lights(builder);
    for (int i = 0; i < builder->object_count; i++) {
        fill_occlusion_masks(builder, i);
        objects[i].isolated = i < builder->solid_count && is_isolated(builder, i);
    }
}
