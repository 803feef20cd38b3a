/* A plugin that works for some 10 us and tells as the distance how many nanoseconds it took by the time stamp counter. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <x86intrin.h>

#include "opencollbench/plugin.h"
#include "opencollbench/ext/distance.h"

struct ocb_object {
    int nothing;
};

static double ns_per_tick;

static double now_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC_RAW, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static ocb_status load_mesh(ocb_instance *instance, const double *positions, uint32_t vertex_count,
                            const uint32_t *triangles, uint32_t triangle_count, ocb_object **object) {
    (void)instance, (void)positions, (void)vertex_count, (void)triangles, (void)triangle_count;
    double begun = now_ns();
    unsigned long long ticks = __rdtsc();
    while (now_ns() - begun < 2e7) {}
    ns_per_tick = (now_ns() - begun) / (double)(__rdtsc() - ticks);
    *object = malloc(sizeof **object);
    return *object ? OCB_OK : OCB_ERROR;
}

static void free_mesh(ocb_instance *instance, ocb_object *object) {
    (void)instance;
    free(object);
}

static ocb_status collide(ocb_instance *instance, ocb_object *a, const double *pose_a, ocb_object *b,
                          const double *pose_b, const ocb_collide_request *request, ocb_collide_result *result) {
    (void)instance, (void)a, (void)pose_a, (void)b, (void)pose_b, (void)request;
    result->hit = 0;
    return OCB_OK;
}

static ocb_status distance(ocb_instance *instance, ocb_object *a, const double *pose_a, ocb_object *b,
                           const double *pose_b, const ocb_distance_request *request, ocb_distance_result *result) {
    (void)instance, (void)a, (void)pose_a, (void)b, (void)pose_b, (void)request;
    unsigned long long begun = __rdtsc();
    unsigned long long product = begun;
    for (int i = 0; i < 12000; i++) {
        product *= 3;
        __asm__ volatile("" : "+r"(product));
    }
    result->distance = (double)(__rdtsc() - begun) * ns_per_tick;
    return OCB_OK;
}

static const ocb_distance table = {sizeof(ocb_distance), distance};

static const void *get_extension(ocb_instance *instance, const char *id) {
    (void)instance;
    return strcmp(id, OCB_EXT_DISTANCE) ? NULL : &table;
}

static const ocb_algorithm algorithm = {
    .struct_size = sizeof(ocb_algorithm),
    .id = "self-timed",
    .name = "Self-timed",
    .version = "1.0.0",
    .authors = "OpenCollBench",
    .load_mesh = load_mesh,
    .free_mesh = free_mesh,
    .collide = collide,
    .get_extension = get_extension,
};
static const ocb_algorithm *const algorithms[] = {&algorithm};
static const ocb_plugin plugin = {
    .abi_major = OCB_ABI_MAJOR,
    .abi_minor = OCB_ABI_MINOR,
    .struct_size = sizeof(ocb_plugin),
    .algorithm_count = 1,
    .algorithms = algorithms,
};

OCB_EXPORT const ocb_plugin *ocb_entry_v1(uint32_t host_abi_major) {
    (void)host_abi_major;
    return &plugin;
}
