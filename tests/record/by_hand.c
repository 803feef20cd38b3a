/* Records itself into the folder that it is given, until its disk is full, and is killed. */
#include <math.h>
#include <opencollbench/record.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>

int main(int argc, char **argv) {
  /* A capsule without a radius; one without a length is a ball. */
  static const double thin[] = {0, 1};
  static const double vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, radius = 0.5, none = 0;
  static const uint32_t corners[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}, wrong[] = {0, 1, 4};
  if (argc != 2 || ocb_recording_open("/nonexistent/spool", "p", "l", "1"))
    return 1;
  ocb_recording *recording = ocb_recording_open(argv[1], "by \"hand\"", "some library", "1.2");
  const int32_t corner = ocb_recording_mesh(recording, "corner", vertices, 4, corners, 4);
  const int32_t ball = ocb_recording_primitive(recording, OCB_SPHERE, &radius);
  if (corner != 0 || ball != 1 || ocb_recording_primitive(recording, OCB_SPHERE, &radius) != ball)
    return 2;
  const int32_t no_mesh = ocb_recording_mesh(recording, "wrong", vertices, 4, wrong, 1);
  if (no_mesh >= 0 || ocb_recording_primitive(recording, OCB_SPHERE, &none) >= 0 || ocb_recording_query(NULL, NULL) != -1)
    return 3;
  if (ocb_recording_primitive(recording, OCB_CAPSULE, thin) >= 0)
    return 10;
  ocb_query query = {.kind = OCB_DISTANCE, .objects = {corner, ball}, .answered = OCB_MEASURED, .seconds = 1e-6};
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 3; ++k)
      query.poses[i][5 * k] = 1;
  for (int i = 0; i < 10; ++i) {
    /* Along the x axis from the corner's tip at 1. */
    query.poses[1][3] = 2 + i;
    query.distance = 0.5 + i;
    query.group = (uint64_t)i / 2;
    if (ocb_recording_query(recording, &query) != 0)
      return 4;
  }
  /* The other primitives, and the other kinds of queries, whose times are not known. */
  static const double box_size[] = {1, 2, 0.1}, cylinder_size[] = {0.5, 2}, capsule_size[] = {0.25, 0};
  const int32_t others[] = {ocb_recording_primitive(recording, OCB_BOX, box_size),
                            ocb_recording_primitive(recording, OCB_CYLINDER, cylinder_size),
                            ocb_recording_primitive(recording, OCB_CAPSULE, capsule_size)};
  static const ocb_kind kinds[] = {OCB_COLLIDE, OCB_CONTACTS, OCB_TOLERANCE, OCB_TOLERANCE};
  static const double limits[] = {0, 3, 0.25, 20};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 4; ++k) {
      const int hit = k == 0 || k == 3;
      ocb_query other = {.kind = kinds[k], .objects = {corner, others[i]}, .limit = limits[k], .seconds = -1, .group = 5 + (uint64_t)i};
      other.answered = hit ? OCB_ANSWERED | OCB_HIT : OCB_ANSWERED;
      memcpy(other.poses, query.poses, sizeof query.poses);
      other.poses[1][3] = k == 0 ? 0 : 10;
      if (ocb_recording_query(recording, &other) != 0)
        return 7;
    }
  query.poses[1][3] = NAN;
  if (ocb_recording_query(recording, &query) != -1)
    return 5;
  query.poses[1][3] = 0, query.objects[0] = no_mesh;
  if (ocb_recording_query(recording, &query) != -1)
    return 6;
  /* A disk that is full in the middle of a row ends the recording: a row behind it could not be read. */
  query.objects[0] = corner;
  signal(SIGXFSZ, SIG_IGN);
  struct rlimit limit;
  getrlimit(RLIMIT_FSIZE, &limit);
  const struct rlimit full = {22 * 256 + 100, limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &full);
  if (ocb_recording_query(recording, &query) != -1)
    return 8;
  setrlimit(RLIMIT_FSIZE, &limit);
  if (ocb_recording_query(recording, &query) != -1)
    return 9;
  raise(SIGKILL);
  ocb_recording_close(recording);
  return 0;
}
