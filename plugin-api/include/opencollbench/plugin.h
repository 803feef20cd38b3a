/* SPDX-License-Identifier: MIT OR Apache-2.0 */
/*
 * OpenCollBench plugin interface, ABI 1.0.
 *
 * THIS FILE IS THE SPECIFICATION. A plugin is a shared library that exports one function, `ocb_entry_v1`, and offers
 * one or more algorithms. An algorithm answers queries about pairs of triangle meshes: do they collide, and, with the
 * extensions of `ext/`, how far apart are they, and which triangles intersect?
 *
 * A minimal plugin is a descriptor and two functions: `load_mesh` and `collide`. Everything else may be NULL. C++ authors
 * include `plugin.hpp`, which wraps all of this in a class.
 *
 * THE PHASES OF A PLUGIN
 *
 * Each function says in brackets in which phase it is called. There are no other phases, and the host names them in what it
 * reports about a plugin.
 *
 *   [load]     dlopen; ocb_entry_v1 once; create once, if present; `set` of ocb.parameters/1 any number of times.
 *              In a fresh process with no files, no network and bounded memory.
 *   [build]    load_mesh, once or twice; in a scene, once for each object (ext/draft/scene.h). Timed as the build.
 *   [query]    collide, distance, contacts: any number of times, in any order. Timed, unless the request asks for counts.
 *   [end]      free_mesh, destroy, if present. May never come: the process may simply be ended.
 *   [any]      get_extension, error_message: in any phase.
 *
 * One process runs one algorithm on one pair of meshes, or on one scene if the algorithm offers ocb.scene/1. Another run is
 * another process.
 *
 * RULES THAT HOLD EVERYWHERE
 *
 * - Threads. Every call comes from the same thread, never two at once. A plugin may start threads of its own only in the
 *   multi-threaded track, for algorithms with OCB_CAPABILITY_THREADS; elsewhere starting one ends the process. They must
 *   be idle between calls: work that goes on after a function has returned is neither timed nor fair.
 * - Memory. Whoever allocates frees. What the host passes in is valid only until the call returns: copy what you keep.
 *   What the plugin returns through the descriptor (structs, strings, extension tables) must stay valid and unchanged
 *   until the process ends; static data is meant.
 * - Errors. Functions return an `ocb_status`. A C++ exception or a Rust panic must not leave a function. Aborting is
 *   safe for the host and ends the run with the plugin's outcome "Signaled".
 * - Strings are UTF-8 and end with 0. The host cuts them at 4096 bytes and drops what cannot be seen: control and format
 *   characters, separators of lines. It refuses '<' and '>' in name, version, authors, license and url.
 * - Units. Lengths are in the length unit of the mesh file; the host does not scale. Nothing else has a unit.
 * - Frames. Mesh vertices are in the object's own frame. A pose takes an object's frame to the world frame, and all
 *   points that a plugin returns are in the world frame.
 * - Triangles are closed sets: touching counts as colliding. "Collide" means that the two surfaces have a point in
 *   common; a closed object wholly inside another one does not collide with it, unless the host asks for solid bodies
 *   (OCB_REQUEST_SOLID), which it asks only of algorithms that say that they can tell (OCB_CAPABILITY_SOLID).
 * - Growth. What is new later is a new extension, or a field at the end of a struct. Each struct begins (after the version,
 *   in `ocb_plugin`) with `struct_size`, which its owner sets to the sizeof it was compiled with. Do not read or write
 *   beyond the other side's `struct_size`.
 */
#ifndef OPENCOLLBENCH_PLUGIN_H
#define OPENCOLLBENCH_PLUGIN_H

#include <stdint.h>

/* Two sides fit when their major versions are equal. The minor version grows when something is appended. */
#define OCB_ABI_MAJOR 1u
#define OCB_ABI_MINOR 0u

/* Put before the definition of `ocb_entry_v1`. Everything else should be static or hidden. */
#if defined(__GNUC__)
#define OCB_EXPORT __attribute__((visibility("default")))
#else
#define OCB_EXPORT
#endif

/* "No triangle" where a triangle id may stand. */
#define OCB_NO_TRIANGLE UINT32_MAX

#ifdef __cplusplus
extern "C" {
#endif

/* What a function says about its own success; whether the objects collide is in the result, not here. */
typedef int32_t ocb_status;
enum {
    /* Answered; the result is filled in. */
    OCB_OK = 0,
    /* The algorithm could not decide (iteration limit, precision). An honest answer, not an error; it is counted. */
    OCB_GAVE_UP = 1,
    /* The algorithm does not answer this kind of question, or not for this kind of mesh. */
    OCB_UNSUPPORTED = 2,
    /* Something is broken: out of memory, a violated invariant. The run of this algorithm ends. See `error_message`. */
    OCB_ERROR = 3
};

/*
 * The plugin's own types; the host only carries the pointers. Define them as you like, or cast from and to your own.
 * An instance holds what belongs to one run (parameters, scratch memory); an object is one loaded mesh.
 */
typedef struct ocb_instance ocb_instance;
typedef struct ocb_object ocb_object;

/*
 * The host, as `create` receives it. Valid, and the same, until the process ends.
 */
typedef struct ocb_host ocb_host;
struct ocb_host {
    uint32_t struct_size;
    /* OCB_ABI_MINOR of the host. */
    uint32_t abi_minor;
    /*
     * A table of functions that the host offers, by id, or NULL for an id that it does not know. No id is defined yet.
     * [any]
     */
    const void *(*get_extension)(const ocb_host *host, const char *id);
};

/* Bits of ocb_counts.flags: what the plugin has counted. What is not flagged is not read. */
enum {
    OCB_COUNTS_BV_TESTS = 1,
    OCB_COUNTS_PRIMITIVE_TESTS = 2,
    OCB_COUNTS_PER_TRIANGLE = 4
};

/*
 * The work of one query. Every request has a pointer to one, which is NULL when nothing is to be counted. Counted queries
 * are not timed, so counting may be a separate, slower copy of the query code. It must be the same algorithm: the answer is
 * judged like any other. The host fills it before the call: struct_size, zeros, and the two arrays.
 */
typedef struct ocb_counts {
    uint32_t struct_size;
    /* OCB_COUNTS_* bits, set by the plugin. */
    uint32_t flags;
    /* Overlap or distance tests between two bounding volumes (16 in one SIMD step are 16). */
    uint64_t bv_tests;
    /* Overlap or distance tests between two primitives; for meshes, two triangles. */
    uint64_t primitive_tests;
    /*
     * In how many primitive tests each triangle of A and of B took part: the plugin adds 1 to both for each test. The
     * arrays sum over many queries, so they may not be zero before the call. The host's memory, writable during the call,
     * one entry per triangle of the object; NULL when not wanted. Even when a and b are the same object, these are two
     * arrays.
     */
    uint32_t *tests_a;
    uint32_t *tests_b;
} ocb_counts;

/* Bits of the flags of a request for `collide` and for `distance` (ext/distance.h). */
enum {
    /*
     * The objects are solid bodies: each is its surface and what this encloses (every mesh of such a run is closed: each
     * edge has an even number of triangles). They also collide, at distance 0, when one of them, or a part of one that
     * hangs together, is wholly inside the other; then there is no pair of triangles to name. Set in every request of a
     * run or in none, and only for algorithms with OCB_CAPABILITY_SOLID.
     */
    OCB_REQUEST_SOLID = 1
};

/* What is asked of `collide`. Made by the host. */
typedef struct ocb_collide_request {
    uint32_t struct_size;
    /* OCB_REQUEST_* bits; ignore bits that you do not know. */
    uint32_t flags;
    /* Where to count the work of this query, or NULL: then it is timed. */
    ocb_counts *counts;
} ocb_collide_request;

/*
 * The answer of `collide`. The host fills it before the call with struct_size, hit = 0 and OCB_NO_TRIANGLE; the plugin
 * overwrites hit and, if it can, the pair.
 */
typedef struct ocb_collide_result {
    uint32_t struct_size;
    /* 1: the surfaces (or solid bodies) have a point in common; 0: they have none. Nothing else. */
    uint32_t hit;
    /*
     * One pair of triangles, one of each object, that have a point in common: 0-based positions in the `triangles`
     * given to load_mesh. Both or neither; OCB_NO_TRIANGLE when there is no hit or the algorithm does not know. A named
     * pair is checked.
     */
    uint32_t triangle_a;
    uint32_t triangle_b;
} ocb_collide_result;

/* Bits of ocb_algorithm.capabilities. */
enum {
    /*
     * The algorithm computes in 32-bit floating point somewhere between pose and answer. Its answers are judged with a
     * tolerance of 32 * 2^-24 instead of 32 * 2^-53 times the size of the scene. The coordinates that load_mesh receives
     * are then numbers of single precision: where the file needs more, they are rounded, and the answers are compared
     * with the truth about the rounded mesh. Poses are not rounded.
     */
    OCB_CAPABILITY_SINGLE_PRECISION = 1,
    /* Answering is sped up by earlier queries (temporal coherence, front tracking): the order of queries matters. */
    OCB_CAPABILITY_COHERENT = 2,
    /* `collide` and `distance` heed OCB_REQUEST_SOLID. Without this bit the host never asks for solid bodies. */
    OCB_CAPABILITY_SOLID = 4,
    /*
     * The algorithm can use several threads and may enter the multi-threaded track. There sched_getaffinity, which OpenMP
     * and the like ask, says how many CPUs it has, and it may start 16 threads or as many as these. Where one cannot be
     * started it must answer all the same.
     */
    OCB_CAPABILITY_THREADS = 8,
    /* The algorithm fills `counts` of a request. Without this bit the host never asks for counts. */
    OCB_CAPABILITY_COUNTS = 16
};

/* One algorithm: who made it, and its functions. Owned by the plugin, static. */
typedef struct ocb_algorithm {
    uint32_t struct_size;
    /* OCB_CAPABILITY_* bits. */
    uint32_t capabilities;

    /* Unique and stable: 1 to 64 characters of a-z 0-9 - . _ beginning with a letter, e.g. "box-tree". Required. */
    const char *id;
    /* Name for people. Required. */
    const char *name;
    /* Version of the algorithm, e.g. "1.2.0". A new version is a new competitor. Required. */
    const char *version;
    /* The rest may be NULL: authors separated by commas, SPDX licence expression, home page, paper. */
    const char *authors;
    const char *license;
    const char *url;
    const char *paper;

    /*
     * Makes what belongs to one run and stores it in *instance. `host` may be kept. NULL as function: there is nothing to
     * make, and every other function gets NULL as `instance`.
     * [load]
     */
    ocb_status (*create)(const ocb_host *host, ocb_instance **instance);

    /*
     * Frees an instance. May be NULL.
     * [end]
     */
    void (*destroy)(ocb_instance *instance);

    /*
     * Reads a mesh and builds whatever the queries need; the time is reported as build time. Required.
     *
     *   positions       3 * vertex_count numbers x y z, all finite, in the object's frame
     *   triangles       3 * triangle_count vertex numbers, each below vertex_count
     *   object          store the new object here; it may be any pointer but NULL
     *
     * vertex_count >= 3 and triangle_count >= 1. Nothing else is promised: the mesh is a polygon soup with holes,
     * duplicate vertices, duplicate triangles, vertices that no triangle uses, and triangles without area (a segment or
     * a point, which still are part of the surface). BOTH ARRAYS ARE GONE WHEN THE CALL RETURNS: copy them. They are
     * read-only.
     *
     * When both objects of a pair are the same mesh, load_mesh is called once, and queries get the same object as `a`
     * and as `b`.
     * [build]
     */
    ocb_status (*load_mesh)(ocb_instance *instance, const double *positions, uint32_t vertex_count,
                            const uint32_t *triangles, uint32_t triangle_count, ocb_object **object);

    /*
     * Frees an object. May be NULL.
     * [end]
     */
    void (*free_mesh)(ocb_instance *instance, ocb_object *object);

    /*
     * Collision query, first contact: do the surfaces of a and b meet? Stop at the first pair found. NULL only when the
     * algorithm answers nothing but extensions.
     *
     * pose_a, pose_b: 16 numbers, a row-major 4x4 matrix each, last row 0 0 0 1; a point p of the object lies in the
     * world at
     *     x = m[0] p.x + m[1] p.y + m[2]  p.z + m[3]
     *     y = m[4] p.x + m[5] p.y + m[6]  p.z + m[7]
     *     z = m[8] p.x + m[9] p.y + m[10] p.z + m[11]
     * The 3x3 part is a rotation up to rounding (orthonormal to about 1e-15, determinant +1). BOTH objects are placed:
     * do not assume that pose_a is the identity. The truth that answers are compared with is computed from these very
     * numbers in exact arithmetic.
     *
     * a and b are not const: an algorithm may keep state in them. The query must not depend on anything but its
     * arguments, unless OCB_CAPABILITY_COHERENT is set; even then only its time may.
     * [query]
     */
    ocb_status (*collide)(ocb_instance *instance, ocb_object *a, const double *pose_a, ocb_object *b,
                          const double *pose_b, const ocb_collide_request *request, ocb_collide_result *result);

    /*
     * The table of an optional capability, by id ("ocb.distance/1", see ext/), or NULL for an id that the algorithm
     * does not know. NULL as function: no extensions.
     *
     * Before `create` the host asks with NULL as instance: what can the algorithm do at all? After the parameters are set
     * it asks with the instance: what can it do so? An algorithm that has no distances with some value of a parameter
     * returns NULL for "ocb.distance/1" then, and is not asked for distances. A table may differ from the one of NULL, but
     * not from call to call of one instance.
     * [any]
     */
    const void *(*get_extension)(ocb_instance *instance, const char *id);

    /*
     * One sentence about the latest OCB_ERROR, for the author of the plugin, or NULL. Valid until the next call. May be
     * NULL as function. `instance` is NULL when `create` has failed. Called after a function has returned OCB_ERROR.
     * [any]
     */
    const char *(*error_message)(ocb_instance *instance);
} ocb_algorithm;

/* What a plugin offers. Owned by the plugin, static. */
typedef struct ocb_plugin {
    /* OCB_ABI_MAJOR and OCB_ABI_MINOR that the plugin was compiled with. First, and so for ever. */
    uint32_t abi_major;
    uint32_t abi_minor;
    uint32_t struct_size;
    /* How many algorithms: 1 to 64. */
    uint32_t algorithm_count;
    /* Pointers to them (pointers, so that ocb_algorithm can grow). */
    const ocb_algorithm *const *algorithms;
} ocb_plugin;

/*
 * The one symbol that a plugin exports. `host_abi_major` is the OCB_ABI_MAJOR of the host. Return NULL when it is not
 * the one that the plugin was compiled with; the host then says so and loads nothing. [load]
 *
 * Rust plugins made with the crate `opencollbench-plugin` and its feature `layout` export a second, optional data
 * symbol, `OCB_LAYOUT_V1`; plugins in other languages leave it out.
 */
OCB_EXPORT const ocb_plugin *ocb_entry_v1(uint32_t host_abi_major);

#ifdef __cplusplus
}
#endif

#endif
