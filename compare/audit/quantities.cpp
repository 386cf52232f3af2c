// SPDX-License-Identifier: MIT
#include "compare/audit/quantities.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <iterator>

namespace diptych::audit {

std::string Preconditions::operator()(const Subject& subject) const {
    if (subject.bounds.empty()) return "the scene has nothing to draw";
    for (const Lacks lacks : all_)
        if (std::string reason = lacks(subject); !reason.empty()) return reason;
    return {};
}

std::string lacksPerspective(const Subject& subject) {
    return subject.view.camera.orthographic ? "the camera is orthographic" : "";
}
std::string lacksSurface(const Subject& subject) {
    return subject.has_surface ? "" : "no surface is in view";
}
std::string lacksLocalLight(const Subject& subject) {
    return std::ranges::any_of(subject.original.scene.lights, isLocal)
               ? ""
               : "the scene has no point, spot or area light";
}
std::string lacksSun(const Subject& subject) {
    return std::ranges::all_of(subject.original.scene.lights, isLocal) ? "the scene has no directional light"
                                                                       : "";
}

double originalOne(const Subject&) {
    return 1;
}

bool isPrecise(const Settings& settings) {
    const bool packs = hasGBuffer(settings.path) && settings.gbuffer != GBufferEncoding::full;
    return !packs && settings.depth_format == DepthFormat::d32f && settings.lit_format == LitFormat::fp32 &&
           settings.shading_precision == ShadingPrecision::fp32;
}

std::span<const Quantity> quantities() {
    static const std::vector<Quantity> all = [] {
        std::vector<Quantity> made;
        for (const auto& group : {transformQuantities, lightQuantities, shadingQuantities, amountQuantities})
            std::ranges::move(group(), std::back_inserter(made));
        return made;
    }();
    return all;
}

std::vector<double> ladder(double first, double last, double step, std::initializer_list<double> others) {
    std::vector<double> rungs(others);
    for (int i = 0;; ++i) {
        const double rung = first * std::pow(step, i);  // not repeated products, whose errors accumulate
        if (rung > last * 1.001) break;
        rungs.push_back(std::stod(fmt::format("{:.3g}", rung)));
    }
    std::ranges::sort(rungs);
    return rungs;
}

double localDistance(const Subject& subject, const glm::dvec3& from) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Light& light : subject.original.scene.lights)
        if (isLocal(light)) nearest = std::min(nearest, glm::distance(light.position, from));
    return nearest;
}

}  // namespace diptych::audit
