/* SPDX-License-Identifier: MIT OR Apache-2.0 */
//
// From a class to the C functions of plugin.h. Included by plugin.hpp; authors need not read it.
#ifndef OPENCOLLBENCH_DETAIL_CALLS_HPP
#define OPENCOLLBENCH_DETAIL_CALLS_HPP

#include "../plugin.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>

namespace ocb {
namespace detail {

#define OCB_HAS(member)                                                                                                     \
    template <class A, class = void> struct has_##member : std::false_type {};                                              \
    template <class A> struct has_##member<A, std::void_t<decltype(&A::member)>> : std::true_type {};
OCB_HAS(collide)
OCB_HAS(distance)
OCB_HAS(contacts)
OCB_HAS(set)
OCB_HAS(scene)
OCB_HAS(inside)
OCB_HAS(answers)
#undef OCB_HAS

// The C functions of the class A.
template <class A> struct Calls {
    using Object = std::decay_t<decltype(std::declval<A &>().load(std::declval<const Mesh &>()))>;

    // What an ocb_instance is here.
    struct Instance {
        A algorithm;
        std::string error{};

        explicit Instance(const ocb_host &host) : algorithm(make(host)) {}
        static A make(const ocb_host &host) {
            if constexpr (std::is_constructible_v<A, const ocb_host &>) return A(host);
            else return A();
        }
    };

    static Instance &of(ocb_instance *instance) { return *reinterpret_cast<Instance *>(instance); }
    static Placed<Object> placed(ocb_object *object, const double *pose) {
        return {*reinterpret_cast<Object *>(object), {pose}};
    }

    template <class Call> static ocb_status guarded(std::string &error, Call call) noexcept {
        try {
            try {
                call();
                return OCB_OK;
            } catch (const GaveUp &) {
                return OCB_GAVE_UP;
            } catch (const Unsupported &why) {
                error = why.what();
                return OCB_UNSUPPORTED;
            } catch (const std::exception &why) {
                error = why.what();
            } catch (...) {
                error = "an exception that is no std::exception";
            }
        } catch (...) {
            // Not even the words could be kept.
        }
        return OCB_ERROR;
    }

    // Of the latest `create`, which has no instance to keep it.
    static std::string &creation_error() {
        static std::string error;
        return error;
    }

    static ocb_status create(const ocb_host *host, ocb_instance **instance) {
        return guarded(creation_error(), [&] { *instance = reinterpret_cast<ocb_instance *>(new Instance(*host)); });
    }
    static void destroy(ocb_instance *instance) { delete &of(instance); }
    static const char *error_message(ocb_instance *instance) {
        return (instance ? of(instance).error : creation_error()).c_str();
    }

    static ocb_status load_mesh(ocb_instance *instance, const double *positions, uint32_t vertex_count,
                                const uint32_t *triangles, uint32_t triangle_count, ocb_object **object) {
        return guarded(of(instance).error, [&] {
            const Mesh mesh{positions, triangles, vertex_count, triangle_count};
            *object = reinterpret_cast<ocb_object *>(new Object(of(instance).algorithm.load(mesh)));
        });
    }
    static void free_mesh(ocb_instance *, ocb_object *object) { delete reinterpret_cast<Object *>(object); }

    // For solid bodies whose surfaces do not meet: is one of them inside the other?
    static bool inside(ocb_instance *instance, Placed<Object> a, Placed<Object> b, uint32_t flags, Work &work) {
        if constexpr (has_inside<A>::value) return flags & OCB_REQUEST_SOLID && of(instance).algorithm.inside(a, b, work);
        else return false;
    }

    static ocb_status collide(ocb_instance *instance, ocb_object *object_a, const double *pose_a, ocb_object *object_b,
                              const double *pose_b, const ocb_collide_request *request, ocb_collide_result *result) {
        return guarded(of(instance).error, [&] {
            Work work(request->counts, about().counts);
            const Placed<Object> a = placed(object_a, pose_a), b = placed(object_b, pose_b);
            const Collision found = of(instance).algorithm.collide(a, b, work);
            result->hit = found.hit || inside(instance, a, b, request->flags, work);
            if (found.hit) result->triangle_a = found.triangles[0], result->triangle_b = found.triangles[1];
        });
    }

    static ocb_status distance(ocb_instance *instance, ocb_object *object_a, const double *pose_a, ocb_object *object_b,
                               const double *pose_b, const ocb_distance_request *request, ocb_distance_result *result) {
        return guarded(of(instance).error, [&] {
            Work work(request->counts, about().counts);
            const Placed<Object> a = placed(object_a, pose_a), b = placed(object_b, pose_b);
            Distance found = of(instance).algorithm.distance(a, b, work);
            if (found.distance > 0 && inside(instance, a, b, request->flags, work)) found = {};
            result->distance = found.distance;
            if (found.points) {
                result->flags |= OCB_DISTANCE_HAS_POINTS;
                std::copy((*found.points)[0].begin(), (*found.points)[0].end(), result->point_a);
                std::copy((*found.points)[1].begin(), (*found.points)[1].end(), result->point_b);
            }
            if (found.triangles) {
                result->flags |= OCB_DISTANCE_HAS_TRIANGLES;
                result->triangle_a = (*found.triangles)[0], result->triangle_b = (*found.triangles)[1];
            }
        });
    }

    static ocb_status contacts(ocb_instance *instance, ocb_object *object_a, const double *pose_a, ocb_object *object_b,
                               const double *pose_b, const ocb_contacts_request *request, ocb_contacts_result *result) {
        return guarded(of(instance).error, [&] {
            Work work(request->counts, about().counts);
            Contacts found(request->contacts, request->capacity);
            of(instance).algorithm.contacts(placed(object_a, pose_a), placed(object_b, pose_b), found, work);
            result->total = found.count();
        });
    }

    static ocb_status set(ocb_instance *instance, const char *name, double value) {
        return guarded(of(instance).error, [&] { of(instance).algorithm.set(name, value); });
    }

    static const About &about() {
        static const About about = A::about();
        return about;
    }

    static const ocb_parameters *parameters() {
        if constexpr (has_set<A>::value) {
            static const std::vector<const ocb_parameter *> pointers = [] {
                std::vector<const ocb_parameter *> all;
                for (const ocb_parameter &parameter : about().parameters) all.push_back(&parameter);
                return all;
            }();
            static const ocb_parameters table = {sizeof table, uint32_t(pointers.size()), pointers.data(), set};
            return &table;
        }
        return nullptr;
    }

    // With what is set in `instance`, or at all.
    static bool answers([[maybe_unused]] ocb_instance *instance, [[maybe_unused]] Query query) {
        if constexpr (has_answers<A>::value) return !instance || of(instance).algorithm.answers(query);
        else return true;
    }

    static const void *get_extension(ocb_instance *instance, const char *id) {
        const auto is = [&](const char *other) { return std::strcmp(id, other) == 0; };
        if constexpr (has_distance<A>::value) {
            static const ocb_distance table = {sizeof table, distance};
            if (is(OCB_EXT_DISTANCE) && answers(instance, Query::distance)) return &table;
        }
        if constexpr (has_contacts<A>::value) {
            static const ocb_contacts table = {sizeof table, contacts};
            if (is(OCB_EXT_CONTACTS) && answers(instance, Query::contacts)) return &table;
        }
        if constexpr (has_scene<A>::value) {
            static const ocb_scene table = {sizeof table};
            if (A::scene && is(OCB_EXT_SCENE)) return &table;
        }
        return is(OCB_EXT_PARAMETERS) ? parameters() : nullptr;
    }

    static const ocb_algorithm *describe() {
        static const ocb_algorithm algorithm = [] {
            const About &about = Calls::about();
            ocb_algorithm described{};
            described.struct_size = sizeof described;
            described.capabilities = about.capabilities;
            if (has_inside<A>::value) described.capabilities |= OCB_CAPABILITY_SOLID;
            if (about.counts) described.capabilities |= OCB_CAPABILITY_COUNTS;
            described.id = about.id, described.name = about.name, described.version = about.version;
            described.authors = about.authors, described.license = about.license;
            described.url = about.url, described.paper = about.paper;
            described.create = create, described.destroy = destroy;
            described.load_mesh = load_mesh, described.free_mesh = free_mesh;
            if constexpr (has_collide<A>::value) described.collide = collide;
            described.get_extension = get_extension;
            described.error_message = error_message;
            return described;
        }();
        return &algorithm;
    }
};

template <class... Algorithms> const ocb_plugin *plugin(uint32_t host_abi_major) noexcept {
    if (host_abi_major != OCB_ABI_MAJOR) return nullptr;
    static const ocb_algorithm *const algorithms[] = {Calls<Algorithms>::describe()...};
    static const ocb_plugin described = {OCB_ABI_MAJOR, OCB_ABI_MINOR, sizeof described, sizeof...(Algorithms), algorithms};
    return &described;
}

} // namespace detail
} // namespace ocb

#endif
