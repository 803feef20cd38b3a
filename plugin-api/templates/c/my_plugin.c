/* SPDX-License-Identifier: MIT OR Apache-2.0 */
/*
 * A plugin in C: every triangle of A against every triangle of B. Correct, and slow.
 *
 * Replace `struct ocb_object`, `load_mesh` and `collide` by your own, and the descriptor at the end by your name. The
 * rest of the interface (distances, all contacts, counting, parameters) is optional: see opencollbench/ext/.
 */
#include <opencollbench/plugin.h>
#include <stddef.h>
#include <stdlib.h>

typedef struct {
    double x, y, z;
} vector;

typedef struct {
    vector corner[3];
} triangle;

/* Your data structure, made from one mesh. */
struct ocb_object {
    uint32_t triangle_count;
    triangle triangles[];
};

static vector sub(vector a, vector b) { return (vector){a.x - b.x, a.y - b.y, a.z - b.z}; }
static double dot(vector a, vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vector cross(vector a, vector b) {
    return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static ocb_status load_mesh(ocb_instance *instance, const double *positions, uint32_t vertex_count,
                            const uint32_t *triangles, uint32_t triangle_count, ocb_object **object) {
    (void)instance;
    (void)vertex_count;
    ocb_object *built = malloc(sizeof *built + triangle_count * sizeof built->triangles[0]);
    if (built == NULL) return OCB_ERROR;
    built->triangle_count = triangle_count;
    /* Copy: the arrays are gone when this function returns. */
    for (uint32_t i = 0; i < triangle_count; i++)
        for (int k = 0; k < 3; k++) {
            const double *p = positions + 3 * (size_t)triangles[3 * (size_t)i + k];
            built->triangles[i].corner[k] = (vector){p[0], p[1], p[2]};
        }
    *object = built;
    return OCB_OK;
}

static void free_mesh(ocb_instance *instance, ocb_object *object) {
    (void)instance;
    free(object);
}

/* From the object's frame to the world. `m` is a row-major 4x4 matrix. */
static triangle place(const double *m, const triangle *t) {
    triangle placed;
    for (int k = 0; k < 3; k++) {
        vector p = t->corner[k];
        placed.corner[k] = (vector){m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3],
                                    m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                                    m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
    }
    return placed;
}

/* Whether a plane orthogonal to `axis` has all of a on one side and all of b on the other. */
static int separates(vector axis, const triangle *a, const triangle *b) {
    double min_a = dot(axis, sub(a->corner[0], b->corner[0])), max_a = min_a, min_b = 0.0, max_b = 0.0;
    for (int k = 1; k < 3; k++) {
        double in_a = dot(axis, sub(a->corner[k], b->corner[0])), in_b = dot(axis, sub(b->corner[k], b->corner[0]));
        if (in_a < min_a) min_a = in_a;
        if (in_a > max_a) max_a = in_a;
        if (in_b < min_b) min_b = in_b;
        if (in_b > max_b) max_b = in_b;
    }
    return max_a < min_b || max_b < min_a;
}

/*
 * Two convex sets are apart if and only if some direction separates them. For two triangles it is enough to try their
 * normals, the products of an edge of each, and, when they lie in one plane, the normals of the edges in that plane. The
 * directions made of `between` are for triangles without area, which are segments or points. Touching triangles meet.
 */
static int meet(const triangle *a, const triangle *b) {
    vector edge[6], between = sub(b->corner[0], a->corner[0]);
    for (int k = 0; k < 3; k++) {
        edge[k] = sub(a->corner[(k + 1) % 3], a->corner[k]);
        edge[k + 3] = sub(b->corner[(k + 1) % 3], b->corner[k]);
    }
    vector normal_a = cross(edge[0], edge[1]), normal_b = cross(edge[3], edge[4]);
    if (separates(normal_a, a, b) || separates(normal_b, a, b) || separates(between, a, b)) return 0;
    for (int i = 0; i < 6; i++) {
        vector beside = cross(cross(edge[i], between), edge[i]);
        if (separates(cross(normal_a, edge[i]), a, b) || separates(cross(normal_b, edge[i]), a, b)) return 0;
        if (separates(beside, a, b)) return 0;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 3; j < 6; j++)
            if (separates(cross(edge[i], edge[j]), a, b)) return 0;
    return 1;
}

static ocb_status collide(ocb_instance *instance, ocb_object *a, const double *pose_a, ocb_object *b,
                          const double *pose_b, const ocb_collide_request *request, ocb_collide_result *result) {
    (void)instance;
    (void)request;
    for (uint32_t i = 0; i < a->triangle_count; i++) {
        triangle in_a = place(pose_a, &a->triangles[i]);
        for (uint32_t j = 0; j < b->triangle_count; j++) {
            triangle in_b = place(pose_b, &b->triangles[j]);
            if (meet(&in_a, &in_b)) {
                result->hit = 1;
                result->triangle_a = i;
                result->triangle_b = j;
                return OCB_OK;
            }
        }
    }
    result->hit = 0;
    return OCB_OK;
}

static const ocb_algorithm ALGORITHM = {
    .struct_size = sizeof(ocb_algorithm),
    .id = "my-algorithm-c",
    .name = "My algorithm",
    .version = "0.1.0",
    .authors = "Me",
    .license = "MIT OR Apache-2.0",
    .load_mesh = load_mesh,
    .free_mesh = free_mesh,
    .collide = collide,
};

static const ocb_algorithm *const ALGORITHMS[] = {&ALGORITHM};

static const ocb_plugin PLUGIN = {
    .abi_major = OCB_ABI_MAJOR,
    .abi_minor = OCB_ABI_MINOR,
    .struct_size = sizeof(ocb_plugin),
    .algorithm_count = 1,
    .algorithms = ALGORITHMS,
};

const ocb_plugin *ocb_entry_v1(uint32_t host_abi_major) {
    return host_abi_major == OCB_ABI_MAJOR ? &PLUGIN : NULL;
}
