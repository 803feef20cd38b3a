/* Records by hand what a program asks of any collision library, for `ocb bench --workload`.
 *
 * A program is linked with `libocb_record.so`, which lies in the folder `record` beside `ocb` and needs no other library:
 *
 *     ocb_recording *recording = ocb_recording_open("spool", "planner", "my library", "1.2");
 *     int32_t arm = ocb_recording_mesh(recording, "arm", vertices, num_vertices, corners, num_triangles);
 *     int32_t can = ocb_recording_primitive(recording, OCB_CYLINDER, sizes);
 *     ocb_query query = {.kind = OCB_COLLIDE, .objects = {arm, can}, .answered = OCB_ANSWERED | OCB_HIT, .seconds = -1};
 *     ...
 *     ocb_recording_query(recording, &query);
 *     ocb_recording_close(recording);
 *
 * Then `ocb record --spool spool --out planner.ocbrec` makes the recording, also if the program ended without closing it.
 *
 * Lengths are in one unit for the whole recording. All functions may be called by several threads at once, and none of them throws
 * or ends the program. A null pointer as recording is allowed everywhere, and records nothing. */
#ifndef OPENCOLLBENCH_RECORD_H
#define OPENCOLLBENCH_RECORD_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A spool that is being written. */
typedef struct ocb_recording ocb_recording;

/* The kind of a primitive, and what its sizes are. All stand around the origin of their own frame. */
typedef enum ocb_primitive {
  OCB_BOX,      /* lengths of the edges along x, y and z */
  OCB_SPHERE,   /* radius */
  OCB_CYLINDER, /* radius, length along z */
  OCB_CAPSULE   /* radius, length along z without the caps */
} ocb_primitive;

/* Kinds of queries. */
typedef enum ocb_kind {
  OCB_COLLIDE,  /* do they collide? */
  OCB_CONTACTS, /* where do they collide? `limit` is the most contacts asked for */
  OCB_DISTANCE, /* how far apart are they? */
  OCB_TOLERANCE /* are they closer than `limit`? */
} ocb_kind;

/* Known parts of the answer, added up. */
enum {
  OCB_ANSWERED = 1, /* whether they collide (OCB_TOLERANCE: are closer) was answered */
  OCB_HIT = 2,      /* and they do */
  OCB_MEASURED = 4  /* `distance` was answered; 0 or less where they collide */
};

/* A query with its answer. */
typedef struct ocb_query {
  ocb_kind kind;
  int32_t objects[2];  /* as the functions below gave them */
  double poses[2][12]; /* object to world: the upper three rows of the 4x4 matrix, row-major; a rotation and a translation */
  double limit;        /* see `ocb_kind`; else 0 */
  uint32_t answered;
  double distance;
  double seconds;  /* how long the library took; negative where that is not known */
  uint64_t group;  /* what belongs together has one number: a robot state, a call of a planner, a step of a simulation */
} ocb_query;

/* Makes the spool in a folder that does not exist yet. All queries are of this library. Null when the folder cannot be made. */
ocb_recording *ocb_recording_open(const char *folder, const char *program, const char *library, const char *version);

/* The number of a mesh: `vertices` has three coordinates each, `corners` three numbers of vertices, from 0, for each triangle.
 * Negative if it is not a mesh (no triangle with area, a number out of range); queries about it are counted as not recorded. */
int32_t ocb_recording_mesh(ocb_recording *recording, const char *name, const double *vertices, size_t num_vertices,
                           const uint32_t *corners, size_t num_triangles);

/* The number of a primitive; the same sizes give the same number. Negative where a size is not positive. */
int32_t ocb_recording_primitive(ocb_recording *recording, ocb_primitive kind, const double *sizes);

/* Adds a query; 0, or -1 when it was not recorded, which is counted. It is in the spool when the function returns. */
int ocb_recording_query(ocb_recording *recording, const ocb_query *query);

/* Ends the recording. */
void ocb_recording_close(ocb_recording *recording);

#ifdef __cplusplus
}
#endif
#endif
