// SPDX-License-Identifier: MIT
#include "compare/checks/visual_checks.h"

#include "compare/checks/check_features.h"
#include "compare/checks/material_pixels.h"
#include "shared/contract/debug_mode.h"
#include "shared/scene/motion/bounds.h"
#include "shared/scene/scene_view.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace diptych {
namespace {

// ---- projection --------------------------------------------------------------------------------------

Bounds boundsOf(const Primitive& primitive) {
    Bounds bounds;
    for (const glm::vec3& p : primitive.positions) {
        bounds.min = glm::min(bounds.min, glm::dvec3(p));
        bounds.max = glm::max(bounds.max, glm::dvec3(p));
    }
    return bounds;
}

// Projects bounds of instances, clipped at the near and far planes, to pixels.
class Projection {
public:
    explicit Projection(const View& view)
        : clip_from_world_(view.clipFromWorld()),
          eye_(view.eye()),
          width_(view.width),
          height_(view.height) {}

    // Pixel box, and bounds relative to the camera, world axes, m.
    struct ProjectedBounds {
        PixelBox box;
        Bounds bounds;
    };
    ProjectedBounds project(const glm::dmat4& worldFromObject, const Bounds& bounds) const {
        ProjectedBounds projected;
        if (bounds.empty()) return projected;
        glm::dmat4 viewedFromObject = worldFromObject;
        viewedFromObject[3] -= glm::dvec4(eye_, 0);
        std::array<glm::dvec4, 8> corners;
        for (unsigned i = 0; i < 8; ++i) {
            const glm::dvec4 p = viewedFromObject * glm::dvec4(i & 1 ? bounds.max.x : bounds.min.x,
                                                               i & 2 ? bounds.max.y : bounds.min.y,
                                                               i & 4 ? bounds.max.z : bounds.min.z, 1);
            projected.bounds.min = glm::min(projected.bounds.min, glm::dvec3(p));
            projected.bounds.max = glm::max(projected.bounds.max, glm::dvec3(p));
            corners[i] = clip_from_world_ * p;
        }
        // Expand by 1e-3 of the largest coordinate: positions are reconstructed from float32 depth.
        const glm::dvec3 farthest = glm::max(glm::abs(projected.bounds.min), glm::abs(projected.bounds.max));
        const double slack = 1e-3 * std::max({farthest.x, farthest.y, farthest.z});
        projected.bounds.min -= slack;
        projected.bounds.max += slack;
        // The near and far planes are parallel, so all corners of the clipped box lie on its edges.
        Extent extent;
        for (unsigned i = 0; i < 8; ++i)
            for (const unsigned axis : {1u, 2u, 4u})
                if (!(i & axis)) addEdge(corners[i], corners[i | axis], extent);
        // Shrink by 1e-6 pixel, so that rounding adds no row. No pixel centre is lost.
        const glm::dvec2 low = glm::floor(extent.low + 1e-6), high = glm::ceil(extent.high - 1e-6);
        projected.box = {pixel(low.x, width_), pixel(low.y, height_), pixel(high.x, width_),
                         pixel(high.y, height_)};
        return projected;
    }

private:
    struct Extent {
        glm::dvec2 low{std::numeric_limits<double>::infinity()},
            high{-std::numeric_limits<double>::infinity()};
    };

    static int pixel(double x, int size) {
        return std::isnan(x) ? 0 : static_cast<int>(std::clamp(x, 0.0, static_cast<double>(size)));
    }

    // Reversed depth: z >= 0 up to the far plane, z <= w from the near plane on.
    void addEdge(const glm::dvec4& a, const glm::dvec4& b, Extent& extent) const {
        double from = 0, to = 1;
        for (const auto& [atA, atB] : {std::pair{a.z, b.z}, {a.w - a.z, b.w - b.z}}) {
            if (!(atA >= 0) && !(atB >= 0)) return;
            const double crossing = atA / (atA - atB);
            if (!(atA >= 0)) from = std::max(from, crossing);
            if (!(atB >= 0)) to = std::min(to, crossing);
        }
        if (from > to) return;
        for (const double t : {from, to}) {
            const glm::dvec4 p = glm::mix(a, b, t);
            if (!(p.w > 0)) continue;  // rounding, or NaN: w is at least the near distance, or 1
            const glm::dvec2 at = (glm::dvec2(p) / p.w * 0.5 + 0.5) * glm::dvec2(width_, height_);
            extent.low = glm::min(extent.low, at);
            extent.high = glm::max(extent.high, at);
        }
    }

    glm::dmat4 clip_from_world_;  // world axes, origin at the camera
    glm::dvec3 eye_;
    int width_, height_;
};

// ---- names -------------------------------------------------------------------------------------------

// Names come from the file and may be long.
constexpr std::size_t longestName = 60;

std::string quoted(const std::string& name) {
    return fmt::format("\"{}\"", oneLine(name, longestName));
}
std::string numbered(const char* what, int index, const std::string& name) {
    if (name.empty()) return fmt::format("{} {}", what, index);
    return fmt::format("{} {} {}", what, index, quoted(name));
}
std::string nameOr(const std::string& name, const char* what, int index) {
    return name.empty() ? fmt::format("{} {}", what, index) : oneLine(name, longestName);
}

// Materials and meshes have the file's indices. Nodes have not: the Scene keeps only rendered ones.
void name(const Scene& scene, const Instance& instance, VisualCheck& check) {
    const Node& node = scene.nodes[static_cast<std::size_t>(instance.node)];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    const int index = mesh.primitives[static_cast<std::size_t>(instance.primitive)].material;
    const Material& material = scene.materials[static_cast<std::size_t>(index)];
    check.where =
        numbered("material", index, material.name) + ", " + numbered("mesh", instance.mesh, mesh.name);
    if (!node.name.empty()) check.where += ", node " + quoted(node.name);
    check.name = nameOr(node.name.empty() ? mesh.name : node.name, "mesh", instance.mesh);
    if (mesh.primitives.size() > 1) check.name += " \u00b7 " + nameOr(material.name, "material", index);
}

// ---- choosing ----------------------------------------------------------------------------------------

struct Candidate {
    std::uint64_t pixels;
    std::size_t instance;
    PixelBox box;
    // Larger ones first, then scene order.
    bool operator<(const Candidate& other) const {
        return pixels != other.pixels ? pixels > other.pixels : instance < other.instance;
    }
};

// Keeps the best maxChecks candidates.
struct Chosen {
    std::uint64_t found = 0;
    std::vector<Candidate> best;  // heap, worst on top

    void add(const Candidate& candidate) {
        ++found;
        if (best.size() == maxChecks) {
            if (!(candidate < best.front())) return;
            std::ranges::pop_heap(best, std::less<>());
            best.pop_back();
        }
        best.push_back(candidate);
        std::ranges::push_heap(best, std::less<>());
    }
};

// Properties of a primitive without its instances, computed once.
struct PrimitiveChecks {
    bool known = false;
    CheckFeatures features = 0;
    Bounds bounds;
};

class Chooser {
public:
    Chooser(const Scene& scene, const Pose& pose, const View& view, const Image* materials,
            const Image* positions)
        : scene_(scene), pose_(pose), projection_(view) {
        if (materials) pixels_.emplace(*materials, positions);
        for (const Mesh& mesh : scene.meshes) primitives_.emplace_back(mesh.primitives.size());
    }

    std::vector<FeatureChecks> choose() {
        for (std::size_t i = 0; i < pose_.instances.size(); ++i) consider(i);
        std::vector<FeatureChecks> result;
        CheckSentences sentences(scene_, materialsOf(scene_, pose_));
        for (std::size_t f = 0; f < checkFeatureCount; ++f) {
            Chosen& chosen = chosen_[f];
            if (chosen.found == 0) continue;
            std::ranges::sort(chosen.best, std::less<>());
            FeatureChecks& checks = result.emplace_back(FeatureChecks{checkHeadings[f], chosen.found, {}});
            for (const Candidate& c : chosen.best) {
                const Instance& instance = pose_.instances[c.instance];
                VisualCheck& check = checks.checks.emplace_back();
                check.what = sentences.of(instance, static_cast<CheckFeature>(f));
                name(scene_, instance, check);
                check.box = c.box;
                check.pixels = c.pixels;
            }
        }
        return result;
    }

private:
    void consider(std::size_t index) {
        const Instance& instance = pose_.instances[index];
        const auto mesh = static_cast<std::size_t>(instance.mesh),
                   primitive_index = static_cast<std::size_t>(instance.primitive);
        const Primitive& primitive = scene_.meshes[mesh].primitives[primitive_index];
        if (primitive.indices.empty()) return;
        PrimitiveChecks& known = primitives_[mesh][primitive_index];
        if (!known.known)
            known = {true, featuresOf(scene_, materialsOf(scene_, pose_), primitive), boundsOf(primitive)};
        const CheckFeatures features = featuresOf(scene_, instance, known.features);
        if (features == 0) return;
        const Projection::ProjectedBounds projected = project(instance, known.bounds);
        Candidate candidate{0, index, projected.box};
        if (projected.box.empty() || !isVisible(primitive.material, projected, candidate)) return;
        for (std::size_t f = 0; f < checkFeatureCount; ++f)
            if (features & bitOf(static_cast<CheckFeature>(f))) chosen_[f].add(candidate);
    }

    // `rest`: bounds of the primitive, object space.
    Projection::ProjectedBounds project(const Instance& instance, const Bounds& rest) const {
        if (instance.box < 0) return projection_.project(instance.world_from_object, rest);
        const PosedBox& box = pose_.boxes[static_cast<std::size_t>(instance.box)];
        Bounds posed;
        posed.min = box.origin + box.min;
        posed.max = box.origin + box.max;
        return projection_.project(glm::dmat4(1), posed);
    }

    bool isVisible(int material, const Projection::ProjectedBounds& projected, Candidate& candidate) const {
        const PixelBox& box = projected.box;
        if (!pixels_) {
            candidate.pixels =
                static_cast<std::uint64_t>(box.x1 - box.x0) * static_cast<std::uint64_t>(box.y1 - box.y0);
            return true;
        }
        const MaterialPixels::Visible visible = pixels_->within(material, box, projected.bounds);
        candidate.pixels = visible.pixels;
        candidate.box = visible.box;
        return visible.pixels > 0;
    }

    const Scene& scene_;
    const Pose& pose_;
    Projection projection_;
    std::optional<MaterialPixels> pixels_;
    std::vector<std::vector<PrimitiveChecks>> primitives_;  // per mesh
    std::array<Chosen, checkFeatureCount> chosen_;
};

}  // namespace

std::vector<FeatureChecks> visualChecksOf(const Scene& scene, const Pose& pose, const View& view,
                                          const Image* materials, const Image* positions) {
    return Chooser(scene, pose, view, materials, positions).choose();
}

std::vector<FeatureChecks> visualChecksOf(const Scene& scene, const SceneView& view, const Frame& frame) {
    return visualChecksOf(scene, view.pose, view.view, findChannel(frame, Channel::material_id),
                          findChannel(frame, Channel::position));
}

}  // namespace diptych
