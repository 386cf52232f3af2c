// SPDX-License-Identifier: MIT
#include "compare/experiment/two_devices.h"

#include "compare/frames/frame_properties.h"
#include "compare/render/channel_shading.h"
#include "compare/verdict/texel_ranges.h"
#include "shared/contract/debug_mode.h"
#include "shared/image/pixels.h"
#include "shared/scene/motion/posed.h"

#include <glm/geometric.hpp>

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace diptych::experiment {
namespace {

// The distance from a point to a triangle (Ericson 2005, "Real-Time Collision Detection", 5.1.5).
double distanceTo(const std::array<glm::dvec3, 3>& t, const glm::dvec3& p) {
    const glm::dvec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return glm::length(ap);
    const glm::dvec3 bp = p - t[1], cp = p - t[2];
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp), d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d3 >= 0 && d4 <= d3) return glm::length(bp);
    if (d6 >= 0 && d5 <= d6) return glm::length(cp);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return glm::length(ap - ab * (d1 / (d1 - d3)));
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return glm::length(ap - ac * (d2 / (d2 - d6)));
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
        return glm::length(bp - (t[2] - t[1]) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
    return glm::length(ap - ab * (vb / (va + vb + vc)) - ac * (vc / (va + vb + vc)));
}

// The deformed triangles of each material, built at first use.
class SceneSurfaces {
public:
    SceneSurfaces(const Scene& scene, const SceneView& view)
        : scene_(scene), pose_(view.pose), eye_(view.view.eye()) {}

    bool at(int material, const float* position, double near, bool several) {
        std::call_once(made_, [this] { make(); });
        const glm::dvec3 p = eye_ + glm::dvec3(position[0], position[1], position[2]);
        std::size_t count = 0;
        for (std::size_t m = 0; m < triangles_.size(); ++m)
            if (static_cast<int>(m) == material || (material < 0 && blends(scene_.materials[m])))
                for (const auto& triangle : triangles_[m]) count += distanceTo(triangle, p) <= near;
        return count > (several ? 1 : 0);
    }

private:
    void make() {
        triangles_.resize(scene_.materials.size());
        for (const Instance& instance : pose_.instances) {
            const Primitive& primitive = primitiveOf(scene_, instance);
            const std::vector<glm::dvec3> positions = posedPositions(scene_, pose_, instance);
            for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3)
                triangles_[static_cast<std::size_t>(primitive.material)].push_back(
                    {positions[primitive.indices[i]], positions[primitive.indices[i + 1]],
                     positions[primitive.indices[i + 2]]});
        }
    }

    const Scene& scene_;
    const Pose pose_;
    const glm::dvec3 eye_;
    std::once_flag made_;
    std::vector<std::vector<std::array<glm::dvec3, 3>>> triangles_;
};

}  // namespace

AcrossDevices acrossDevices(const Scene& scene, const SceneView& view,
                            const std::array<DevicePrecision, 2>& devices, const Frame& here) {
    AcrossDevices across;
    across.devices = devices;
    if (!scene.textures.empty()) across.texels = texelRanges(scene, here, devices);
    across.surface_at = [surfaces = std::make_shared<SceneSurfaces>(scene, view)](
                            int material, const float* position, double near, bool several) {
        return surfaces->at(material, position, near, several);
    };
    return across;
}

std::map<Channel, Image> relit(Device& device, Renderer& renderer, const Frame& there) {
    SurfaceImages surfaces(device, there.settings.size);
    for (std::size_t c = 0; c < surfaceChannels().size(); ++c) surfaces.set(0, c, there);
    Settings settings = there.settings;
    settings.transparency = Transparency::off;
    settings.assign = Assignment::every;
    ChannelShading shading = renderer.shadeChannels(settings, surfaces);
    std::map<Channel, Image> images;
    images[Channel::lit] = shading.shade(0);
    ChannelTerms terms = shading.terms(0);
    images[Channel::lit_diffuse] = std::move(terms.diffuse);
    images[Channel::lit_specular] = std::move(terms.specular);
    images[Channel::lit_ambient] = std::move(terms.ambient);
    images[Channel::lit_environment] = std::move(terms.environment);
    images[Channel::shadow_visibility] = std::move(terms.shadow_visibility);
    images[Channel::local_visibility] = std::move(terms.local_visibility);
    for (auto& [mode, image] : images) keepInFile(image.data);
    return images;
}

}  // namespace diptych::experiment
