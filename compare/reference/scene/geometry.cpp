// SPDX-License-Identifier: MIT
#include "compare/reference/scene/geometry.h"

#include "shared/scene/embree.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace diptych::reference {

struct Geometry::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    ~Embree() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
};

namespace {

// Data of one ray query, passed through Embree to the filter.
struct RayQuery {
    // Must be first: Embree returns a pointer to it, which is cast to RayQuery.
    EmbreeContext context;
    const Geometry* geometry;
    const Ray* ray;
    const Geometry::Counts* counts;
    Hit hit;  // the last accepted
};

// Repeats Embree's candidate test in double, and rejects hits that `counts` refuses. Embree orders
// candidates in single precision; the last accepted one is the nearest.
void filter(const RTCFilterFunctionNArguments* arguments) {
    auto& query = *reinterpret_cast<RayQuery*>(arguments->context);
    const TriangleId id{RTCHitN_geomID(arguments->hit, 1, 0), RTCHitN_primID(arguments->hit, 1, 0)};
    const Ray& ray = *query.ray;
    const auto reject = [&] { arguments->valid[0] = 0; };
    if (id == ray.without) return reject();
    const std::optional<Hit> hit = query.geometry->onPlane(id, ray.origin, ray.direction);
    if (!hit || !(hit->t > ray.from) || !(hit->t < ray.to) || !(*query.counts)(*hit)) return reject();
    query.hit = *hit;
}

void check(RTCDevice device, const char* step) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error(fmt::format("reference: Embree: {}: error {}", step, static_cast<int>(error)));
}

RTCRay single(const Ray& ray) {
    RTCRay r{};
    r.org_x = static_cast<float>(ray.origin.x);
    r.org_y = static_cast<float>(ray.origin.y);
    r.org_z = static_cast<float>(ray.origin.z);
    r.dir_x = static_cast<float>(ray.direction.x);
    r.dir_y = static_cast<float>(ray.direction.y);
    r.dir_z = static_cast<float>(ray.direction.z);
    // Slightly longer at both ends: the filter compares the exact range in double.
    r.tnear = static_cast<float>(ray.from > 0 ? ray.from * (1 - 1e-5) : 0);
    r.tfar =
        std::isinf(ray.to) ? std::numeric_limits<float>::infinity() : static_cast<float>(ray.to * (1 + 1e-5));
    r.mask = ~0u;
    return r;
}

}  // namespace

Geometry::Geometry(const Scene& scene, const Pose& pose, const glm::dvec3& eye, bool blended_normals)
    : scene_(scene),
      pose_(pose),
      eye_(eye),
      posed_(pose.instances.size()),
      embree_(std::make_unique<Embree>()) {
    embree_->device = rtcNewDevice(nullptr);
    if (!embree_->device) check(nullptr, "device");
    embree_->scene = rtcNewScene(embree_->device);
    rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST | embree_filter_flag);
    rtcSetSceneBuildQuality(embree_->scene, RTC_BUILD_QUALITY_HIGH);
    tbb::parallel_for(std::size_t{0}, pose.instances.size(), [&](std::size_t i) {
        const TriangleId first{static_cast<std::uint32_t>(i), 0};
        const Primitive& p = primitive(first);
        if (p.indices.empty()) return;
        if (pose.instances[i].deformed())
            posed_[i] = posedVertices(scene, pose, pose.instances[i], blended_normals);
        const RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), p.positions.size()));
        auto* indices = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(std::uint32_t), p.indices.size() / 3));
        if (vertices && indices) {
            for (std::size_t v = 0; v < p.positions.size(); ++v) {
                const glm::dvec3 world =
                    posed(first)
                        ? posed_[i].positions[v]
                        : glm::dvec3(pose.instances[i].world_from_object * glm::dvec4(p.positions[v], 1));
                for (int c = 0; c < 3; ++c) *vertices++ = static_cast<float>(world[c] - eye[c]);
            }
            std::copy(p.indices.begin(), p.indices.end() - static_cast<std::ptrdiff_t>(p.indices.size() % 3),
                      indices);
            rtcCommitGeometry(geometry);
            rtcAttachGeometryByID(embree_->scene, geometry, static_cast<unsigned>(i));
        }
        rtcReleaseGeometry(geometry);
    });
    rtcCommitScene(embree_->scene);
    check(embree_->device, "scene");
}

Geometry::~Geometry() = default;

const Instance& Geometry::instance(const TriangleId& id) const {
    return pose_.instances[id.instance];
}

const Primitive& Geometry::primitive(const TriangleId& id) const {
    const Instance& of = instance(id);
    return scene_.meshes[static_cast<std::size_t>(of.mesh)]
        .primitives[static_cast<std::size_t>(of.primitive)];
}

std::array<std::uint32_t, 3> Geometry::vertices(const TriangleId& id) const {
    const std::vector<std::uint32_t>& indices = primitive(id).indices;
    const std::size_t first = std::size_t{3} * id.triangle;
    return {indices[first], indices[first + 1], indices[first + 2]};
}

std::array<glm::dvec3, 3> Geometry::corners(const TriangleId& id) const {
    const std::array<std::uint32_t, 3> v = vertices(id);
    if (const PosedVertices* of = posed(id))
        return {of->positions[v[0]] - eye_, of->positions[v[1]] - eye_, of->positions[v[2]] - eye_};
    const Primitive& p = primitive(id);
    const glm::dmat4& world = instance(id).world_from_object;
    std::array<glm::dvec3, 3> result;
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = glm::dvec3(world * glm::dvec4(p.positions[v[i]], 1)) - eye_;
    return result;
}

const PosedVertices* Geometry::posed(const TriangleId& id) const {
    const PosedVertices& vertices = posed_[id.instance];
    return vertices.positions.empty() ? nullptr : &vertices;
}

namespace {

// Values of three vertices: the deformed ones if there are any, else the primitive's.
template <class To, class From>
std::optional<std::array<To, 3>> atCorners(const std::vector<To>* posed, const std::vector<From>& rest,
                                           const std::array<std::uint32_t, 3>& v) {
    if (posed && !posed->empty()) return {{(*posed)[v[0]], (*posed)[v[1]], (*posed)[v[2]]}};
    if (rest.empty()) return std::nullopt;
    return {{To(rest[v[0]]), To(rest[v[1]]), To(rest[v[2]])}};
}

}  // namespace

std::optional<std::array<glm::dvec2, 3>> Geometry::texcoords(const TriangleId& id, int set) const {
    const PosedVertices* of = posed(id);
    return atCorners(of ? &of->texcoords[set] : nullptr, primitive(id).texcoords[set], vertices(id));
}

std::optional<std::array<glm::dvec4, 3>> Geometry::colors(const TriangleId& id) const {
    const PosedVertices* of = posed(id);
    return atCorners(of ? &of->colors : nullptr, primitive(id).colors, vertices(id));
}

std::optional<Hit> Geometry::onPlane(const TriangleId& id, const glm::dvec3& origin,
                                     const glm::dvec3& direction) const {
    const std::array<glm::dvec3, 3> p = corners(id);
    const glm::dvec3 a = p[1] - p[0], b = p[2] - p[0], normal = glm::cross(a, b);
    const double twice = glm::length(normal), along = glm::dot(normal, direction);
    if (!(twice > 0) || along == 0) return std::nullopt;
    Hit hit;
    hit.id = id;
    hit.t = glm::dot(normal, p[0] - origin) / along;
    hit.position = origin + hit.t * direction;
    const glm::dvec3 within = hit.position - p[0];
    const double square = twice * twice;
    hit.barycentric = {glm::dot(glm::cross(within, b), normal) / square,
                       glm::dot(glm::cross(a, within), normal) / square};
    // Front faces are counter-clockwise, or clockwise if the transform mirrors.
    const bool mirrored = glm::determinant(glm::dmat3(instance(id).world_from_object)) < 0;
    hit.geometric_normal = normal * ((mirrored ? -1 : 1) / twice);
    hit.front = (along < 0) != mirrored;
    return hit;
}

std::optional<Hit> Geometry::nearest(const Ray& ray, const Counts& counts) const {
    RayQuery query{{}, this, &ray, &counts, {}};
    RTCRayHit request{};
    request.ray = single(ray);
    request.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embreeIntersect(embree_->scene, query.context, filter, request);
    if (request.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return query.hit;
}

bool Geometry::meets(const Ray& ray, const Counts& counts) const {
    RayQuery query{{}, this, &ray, &counts, {}};
    return embreeOccluded(embree_->scene, query.context, filter, single(ray));
}

}  // namespace diptych::reference
