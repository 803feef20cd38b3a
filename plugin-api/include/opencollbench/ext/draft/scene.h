/* SPDX-License-Identifier: MIT OR Apache-2.0 */
/*
 * ocb.scene/1: a scene of many objects in one process. How fast is the algorithm when a program asks about all of them?
 *
 * Read plugin.h first; its rules on units, frames, poses, ownership and threads hold here too.
 *
 * The extension adds no function. An algorithm that offers the table promises that the functions which it has anyway work for
 * more than two objects:
 *
 *   [build]    load_mesh once for each object of the scene, one after the other: 1 object or more, as many as memory holds.
 *              Each call is timed, and the sum is reported as the build time. When two objects of the scene have the same
 *              mesh, load_mesh is called for each of them: what an algorithm remembers about an object belongs to that object.
 *   [query]    collide, distance, contacts, whichever the algorithm has, about any two of these objects, in any order of pairs
 *              and of kinds. Every query gives both objects and both poses; an object has no pose of its own between queries,
 *              and the same object may be `a` in one query and `b` in the next, or both. Timed as usual; `counts` is NULL.
 *
 * Lifetime. Objects live until the process ends or free_mesh is called; no object is loaded after the first query, and none is
 * replaced. What belongs to a pair (the features where the last query ended, say) may be kept in the instance. Whether earlier
 * queries may speed up later ones is for OCB_CAPABILITY_COHERENT to say, as without a scene.
 *
 * Errors. When load_mesh fails for one object, the run of the algorithm on the scene ends, with the plugin's own words.
 *
 * The queries of a scene come in the order in which a program asked them. A structure for all pairs that is built with the
 * first query is on the clock as well: what queries take beyond their usual time counts as building.
 */
#ifndef OPENCOLLBENCH_EXT_SCENE_H
#define OPENCOLLBENCH_EXT_SCENE_H

#include "../../plugin.h"

#define OCB_EXT_SCENE "ocb.scene/1"

#ifdef __cplusplus
extern "C" {
#endif

/* The table that get_extension("ocb.scene/1") returns. Static. */
typedef struct ocb_scene {
    uint32_t struct_size;
} ocb_scene;

#ifdef __cplusplus
}
#endif

#endif
