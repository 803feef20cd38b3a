// The queries of one call of a collision manager of Coal are one group.
#include "replaces.hpp"

// A member function of a manager takes the manager, perhaps another object or manager, and what is called for each pair.
#define OCB_SELF (const void *self, void *call)
#define OCB_OTHER (const void *self, void *other, void *call)

#define OCB_MANAGER(name, which)                                                                                                            \
  OCB_GROUPS(_ZNK4coal##name##7collideEPNS_21CollisionCallBackBaseE, which##_collide_self, OCB_SELF, (self, call))                          \
  OCB_GROUPS(_ZNK4coal##name##8distanceEPNS_20DistanceCallBackBaseE, which##_distance_self, OCB_SELF, (self, call))                         \
  OCB_GROUPS(_ZNK4coal##name##7collideEPNS_15CollisionObjectEPNS_21CollisionCallBackBaseE, which##_collide_object, OCB_OTHER,               \
             (self, other, call))                                                                                                           \
  OCB_GROUPS(_ZNK4coal##name##8distanceEPNS_15CollisionObjectEPNS_20DistanceCallBackBaseE, which##_distance_object, OCB_OTHER,              \
             (self, other, call))                                                                                                           \
  OCB_GROUPS(_ZNK4coal##name##7collideEPNS_26BroadPhaseCollisionManagerEPNS_21CollisionCallBackBaseE, which##_collide_manager, OCB_OTHER,   \
             (self, other, call))                                                                                                           \
  OCB_GROUPS(_ZNK4coal##name##8distanceEPNS_26BroadPhaseCollisionManagerEPNS_20DistanceCallBackBaseE, which##_distance_manager, OCB_OTHER,  \
             (self, other, call))

OCB_MANAGER(31DynamicAABBTreeCollisionManager, ocb_tree)
OCB_MANAGER(36DynamicAABBTreeArrayCollisionManager, ocb_array)
OCB_MANAGER(19SaPCollisionManager, ocb_sap)
OCB_MANAGER(20SSaPCollisionManager, ocb_ssap)
OCB_MANAGER(21NaiveCollisionManager, ocb_naive)
OCB_MANAGER(28IntervalTreeCollisionManager, ocb_interval)
