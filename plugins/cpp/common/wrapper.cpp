// SPDX-License-Identifier: MIT OR Apache-2.0
//
// The C interface of every wrapper. No exception leaves these functions.
#include "wrapper.hpp"

#include <cstring>

namespace {

using namespace ocb;

std::string last_error;

template <class Call> ocb_status guarded(Call call) {
    try {
        call();
        return OCB_OK;
    } catch (const Unsupported &why) {
        last_error = why.what();
        return OCB_UNSUPPORTED;
    } catch (const std::exception &error) {
        last_error = error.what();
    } catch (...) {
        last_error = "an exception that is no std::exception";
    }
    return OCB_ERROR;
}

Algorithm &of(ocb_instance *instance) { return *reinterpret_cast<Algorithm *>(instance); }
Object &of(ocb_object *object) { return *reinterpret_cast<Object *>(object); }

ocb_status create(const ocb_host *, ocb_instance **instance) {
    return guarded([&] { *instance = reinterpret_cast<ocb_instance *>(make().release()); });
}

void destroy(ocb_instance *instance) { delete &of(instance); }

ocb_status load_mesh(ocb_instance *instance, const double *positions, uint32_t vertices, const uint32_t *corners,
                     uint32_t triangles, ocb_object **object) {
    return guarded([&] {
        const Mesh mesh{positions, corners, vertices, triangles};
        *object = reinterpret_cast<ocb_object *>(of(instance).load(mesh).release());
    });
}

void free_mesh(ocb_instance *, ocb_object *object) { delete &of(object); }

ocb_status collide(ocb_instance *instance, ocb_object *a, const double *pose_a, ocb_object *b, const double *pose_b,
                   const ocb_collide_request *, ocb_collide_result *result) {
    return guarded([&] {
        Pair pair;
        result->hit = of(instance).collide(of(a), {pose_a}, of(b), {pose_b}, pair);
        if (result->hit) result->triangle_a = pair.a, result->triangle_b = pair.b;
    });
}

ocb_status distance(ocb_instance *instance, ocb_object *a, const double *pose_a, ocb_object *b, const double *pose_b,
                    const ocb_distance_request *, ocb_distance_result *result) {
    return guarded([&] {
        const Distance found = of(instance).distance(of(a), {pose_a}, of(b), {pose_b});
        result->distance = found.value;
        if (found.has_points) {
            result->flags |= OCB_DISTANCE_HAS_POINTS;
            std::memcpy(result->point_a, found.a.data(), sizeof result->point_a);
            std::memcpy(result->point_b, found.b.data(), sizeof result->point_b);
        }
        if (found.triangles.a != OCB_NO_TRIANGLE) {
            result->flags |= OCB_DISTANCE_HAS_TRIANGLES;
            result->triangle_a = found.triangles.a, result->triangle_b = found.triangles.b;
        }
    });
}

ocb_status contacts(ocb_instance *instance, ocb_object *a, const double *pose_a, ocb_object *b, const double *pose_b,
                    const ocb_contacts_request *request, ocb_contacts_result *result) {
    return guarded([&] {
        Contacts found(request->contacts, request->capacity);
        of(instance).contacts(of(a), {pose_a}, of(b), {pose_b}, found);
        result->total = found.count();
    });
}

ocb_status set(ocb_instance *instance, const char *name, double value) {
    return guarded([&] { of(instance).set(name, value); });
}

const char *error_message(ocb_instance *) { return last_error.c_str(); }

const About &self() {
    static const About about = ocb::about();
    return about;
}

const ocb_parameters *parameters() {
    static const std::vector<const ocb_parameter *> pointers = [] {
        std::vector<const ocb_parameter *> all;
        for (const ocb_parameter &parameter : self().parameters) all.push_back(&parameter);
        return all;
    }();
    static const ocb_parameters table = {sizeof table, static_cast<uint32_t>(pointers.size()), pointers.data(), set};
    return pointers.empty() ? nullptr : &table;
}

const void *get_extension(ocb_instance *, const char *id) {
    static const ocb_distance distances = {sizeof distances, distance};
    static const ocb_contacts lists = {sizeof lists, contacts};
    const auto is = [&](const char *other) { return std::strcmp(id, other) == 0; };
    if (is(OCB_EXT_DISTANCE) && self().queries & DISTANCE) return &distances;
    if (is(OCB_EXT_CONTACTS) && self().queries & CONTACTS) return &lists;
    if (is(OCB_EXT_PARAMETERS)) return parameters();
    return nullptr;
}

ocb_algorithm describe() {
    const About &about = self();
    ocb_algorithm algorithm{};
    algorithm.struct_size = sizeof algorithm;
    algorithm.capabilities = about.capabilities;
    algorithm.id = about.id, algorithm.name = about.name, algorithm.version = about.version;
    algorithm.authors = about.authors, algorithm.license = about.license;
    algorithm.url = about.url, algorithm.paper = about.paper;
    algorithm.create = create, algorithm.destroy = destroy;
    algorithm.load_mesh = load_mesh, algorithm.free_mesh = free_mesh;
    algorithm.collide = collide;
    algorithm.get_extension = get_extension;
    algorithm.error_message = error_message;
    return algorithm;
}

} // namespace

extern "C" OCB_EXPORT const ocb_plugin *ocb_entry_v1(uint32_t host_abi_major) {
    static const ocb_algorithm algorithm = describe();
    static const ocb_algorithm *const algorithms[] = {&algorithm};
    static const ocb_plugin plugin = {OCB_ABI_MAJOR, OCB_ABI_MINOR, sizeof(ocb_plugin), 1, algorithms};
    return host_abi_major == OCB_ABI_MAJOR ? &plugin : nullptr;
}
