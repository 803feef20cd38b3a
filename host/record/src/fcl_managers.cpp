// The queries of one call of a collision manager of FCL are one group.
#include "replaces.hpp"

// A member function of a manager takes the manager, perhaps another object or manager, data, and the function to call for each pair.
#define OCB_SELF (const void *self, void *data, void *call)
#define OCB_OTHER (const void *self, void *other, void *data, void *call)

#define OCB_MANAGER(name, which)                                                                                                         \
  OCB_GROUPS(_ZNK3fcl##name##IdE7collideEPvPFbPNS_15CollisionObjectIdEES5_S2_E, which##_collide_self, OCB_SELF, (self, data, call))      \
  OCB_GROUPS(_ZNK3fcl##name##IdE8distanceEPvPFbPNS_15CollisionObjectIdEES5_S2_RdE, which##_distance_self, OCB_SELF, (self, data, call))  \
  OCB_GROUPS(_ZNK3fcl##name##IdE7collideEPNS_15CollisionObjectIdEEPvPFbS4_S4_S5_E, which##_collide_object, OCB_OTHER,                    \
             (self, other, data, call))                                                                                                     \
  OCB_GROUPS(_ZNK3fcl##name##IdE8distanceEPNS_15CollisionObjectIdEEPvPFbS4_S4_S5_RdE, which##_distance_object, OCB_OTHER,                \
             (self, other, data, call))                                                                                                     \
  OCB_GROUPS(_ZNK3fcl##name##IdE7collideEPNS_26BroadPhaseCollisionManagerIdEEPvPFbPNS_15CollisionObjectIdEES8_S5_E,                         \
             which##_collide_manager, OCB_OTHER, (self, other, data, call))                                                              \
  OCB_GROUPS(_ZNK3fcl##name##IdE8distanceEPNS_26BroadPhaseCollisionManagerIdEEPvPFbPNS_15CollisionObjectIdEES8_S5_RdE,                      \
             which##_distance_manager, OCB_OTHER, (self, other, data, call))

OCB_MANAGER(31DynamicAABBTreeCollisionManager, ocb_tree)
OCB_MANAGER(37DynamicAABBTreeCollisionManager_Array, ocb_array)
OCB_MANAGER(19SaPCollisionManager, ocb_sap)
OCB_MANAGER(20SSaPCollisionManager, ocb_ssap)
OCB_MANAGER(21NaiveCollisionManager, ocb_naive)
OCB_MANAGER(28IntervalTreeCollisionManager, ocb_interval)
