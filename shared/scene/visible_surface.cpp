// SPDX-License-Identifier: MIT
#include "shared/scene/visible_surface.h"

#include "shared/scene/embree.h"
#include "shared/scene/motion/posed.h"
#include "shared/text/fail.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <utility>
#include <vector>

namespace diptych {
namespace {

// The instance of a triangle, and whether both sides are drawn.
struct Owner {
    std::uint32_t instance : 31;
    std::uint32_t double_sided : 1;
};

// The finalizer of splitmix64 (Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number
// Generators"): triangles are kept by index, so the subset is deterministic.
double uniformOf(std::uint64_t i) {
    i += 0x9e3779b97f4a7c15u;
    i = (i ^ (i >> 30)) * 0xbf58476d1ce4e5b9u;
    i = (i ^ (i >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((i ^ (i >> 31)) >> 11) * 0x1p-53;
}

struct SeenContext {
    EmbreeContext context;  // must be first: Embree returns a pointer to it
    const std::vector<Owner>* owners;
};

// Corners are stored so that Embree's geometric normal points to the front side.
void passBackFaces(const RTCFilterFunctionNArguments* a) {
    const auto& context = *reinterpret_cast<const SeenContext*>(a->context);
    const float towards = RTCHitN_Ng_x(a->hit, 1, 0) * RTCRayN_dir_x(a->ray, 1, 0) +
                          RTCHitN_Ng_y(a->hit, 1, 0) * RTCRayN_dir_y(a->ray, 1, 0) +
                          RTCHitN_Ng_z(a->hit, 1, 0) * RTCRayN_dir_z(a->ray, 1, 0);
    if (!(towards < 0) && !(*context.owners)[RTCHitN_primID(a->hit, 1, 0)].double_sided) a->valid[0] = 0;
}

}  // namespace

struct VisibleSurface::Traced {
    // Maps world space (m) to Embree's float32 space: the bounding sphere becomes the unit sphere, so
    // distant and huge scenes stay in range.
    glm::dvec3 centre{0};
    double radius = 1;
    std::vector<glm::vec3> corners;  // three per triangle
    std::vector<Owner> owners;       // per triangle
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    Traced() = default;
    Traced(const Traced&) = delete;
    Traced& operator=(const Traced&) = delete;
    ~Traced() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }

    void add(const std::array<glm::dvec3, 3>& world, Owner owner) {
        std::array<glm::vec3, 3> scaled;
        for (std::size_t i = 0; i < 3; ++i) {
            scaled[i] = glm::vec3((world[i] - centre) / radius);
            // The bounds contain every vertex, but an enlarged triangle may extend a little further.
            if (!(glm::dot(scaled[i], scaled[i]) < 1e6f)) return;
        }
        const glm::vec3 normal = glm::cross(scaled[1] - scaled[0], scaled[2] - scaled[0]);
        if (!(glm::dot(normal, normal) > 0)) return;
        corners.insert(corners.end(), scaled.begin(), scaled.end());
        owners.push_back(owner);
    }

    // Built by one thread, so that coincident surfaces are hit in a deterministic order.
    void build() {
        device = rtcNewDevice("threads=1");
        if (!device) fail("Embree failed to start");
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST | embree_filter_flag);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        corners.emplace_back(0);  // padding: Embree reads 16 bytes at the last corner
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, corners.data(), 0,
                                   sizeof(glm::vec3), 3 * owners.size());
        auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), owners.size()));
        if (indices) {
            for (std::uint32_t i = 0; i < 3 * owners.size(); ++i) indices[i] = i;
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene, geometry);
        }
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene);
        if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::bad_alloc();
    }
};

VisibleSurface::VisibleSurface(const Scene& scene, const Pose& pose, const Bounds& bounds,
                               std::uint64_t limit)
    : traced_(std::make_unique<Traced>()) {
    if (bounds.empty()) return;
    traced_->centre = bounds.centre();
    if (bounds.radius() > 0) traced_->radius = bounds.radius();
    std::uint64_t triangles = 0;
    for (const Instance& instance : pose.instances)
        triangles += primitiveOf(scene, instance).indices.size() / 3;
    // Cook, Halstead, Planck and Ryu 2007, "Stochastic Simplification of Aggregate Detail": the remaining
    // elements are enlarged so that the total area stays the same.
    const double kept = std::min(1.0, static_cast<double>(limit) / static_cast<double>(triangles));
    const double enlarged = std::sqrt(1 / kept);
    std::uint64_t number = 0;
    for (std::size_t k = 0; k < pose.instances.size(); ++k) {
        const Instance& instance = pose.instances[k];
        const Primitive& primitive = primitiveOf(scene, instance);
        const glm::dmat4& worldFromObject = instance.world_from_object;
        const bool mirrored = glm::determinant(glm::dmat3(worldFromObject)) < 0;
        const Owner owner{static_cast<std::uint32_t>(k) & 0x7fffffffu,
                          scene.materials[static_cast<std::size_t>(primitive.material)].double_sided};
        const std::vector<glm::dvec3> posed =
            instance.deformed() ? posedPositions(scene, pose, instance) : std::vector<glm::dvec3>();
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            if (kept < 1 && uniformOf(number++) >= kept) continue;
            std::array<glm::dvec3, 3> world;
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint32_t v = primitive.indices[i + c];
                world[c] = posed.empty()
                               ? glm::dvec3(worldFromObject * glm::dvec4(primitive.positions[v], 1.0))
                               : posed[v];
            }
            if (mirrored) std::swap(world[1], world[2]);
            if (kept < 1) {
                const glm::dvec3 middle = (world[0] + world[1] + world[2]) / 3.0;
                for (glm::dvec3& p : world) p = middle + (p - middle) * enlarged;
            }
            traced_->add(world, owner);
        }
    }
    if (!traced_->owners.empty()) traced_->build();
}

VisibleSurface::~VisibleSurface() = default;

std::optional<VisibleSurface::Seen> VisibleSurface::nearest(const glm::dvec3& origin,
                                                            const glm::dvec3& direction) const {
    if (!traced_->scene) return std::nullopt;
    const glm::dvec3 from = (origin - traced_->centre) / traced_->radius;
    // Embree needs a finite origin within its range and a non-zero direction.
    if (!(glm::dot(from, from) < 1e12) || !(glm::dot(direction, direction) > 0)) return std::nullopt;
    SeenContext query{{}, &traced_->owners};
    RTCRayHit request{};
    const glm::vec3 o(from), d(direction);
    request.ray = {o.x, o.y, o.z, 0, d.x, d.y, d.z, 0, std::numeric_limits<float>::infinity(), ~0u, 0, 0};
    request.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embreeIntersect(traced_->scene, query.context, passBackFaces, request);
    if (request.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const glm::dvec3 normal =
        glm::normalize(glm::dvec3(request.hit.Ng_x, request.hit.Ng_y, request.hit.Ng_z));
    const bool front = glm::dot(normal, direction) < 0;
    return Seen{double{request.ray.tfar} * traced_->radius, front ? normal : -normal,
                traced_->owners[request.hit.primID].instance, front};
}

}  // namespace diptych
