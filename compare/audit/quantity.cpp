// SPDX-License-Identifier: MIT
#include "compare/audit/quantity.h"

#include "compare/audit/groups.h"
#include "shared/text/did_you_mean.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <iterator>
#include <utility>

namespace diptych::audit {

std::string lacksNothing(const Subject&) {
    return {};
}
std::string lacksSurface(const Subject& subject) {
    if (subject.view.camera.orthographic) return "the camera is orthographic";
    return subject.seen ? "" : "no surface is in view";
}
std::string lacksLocalLight(const Subject& subject) {
    const std::vector<Light>& lights = subject.given.scene.lights;
    const bool any =
        std::ranges::any_of(lights, [](const Light& light) { return light.kind != LightKind::directional; });
    return any ? "" : "the scene has no point, spot or area light";
}
std::string lacksSun(const Subject& subject) {
    const bool any = std::ranges::count(subject.given.scene.lights, LightKind::directional, &Light::kind) > 0;
    return any ? "" : "the scene has no directional light";
}
std::string lacksEnvironment(const Subject& subject) {
    return subject.given.scene.environment ? "" : "the scene has no environment: --env gives it one";
}

double usualOne(const Subject&) {
    return 1;
}

std::vector<double> ladder(double first, double last, double step) {
    std::vector<double> rungs;
    for (int i = 0;; ++i) {
        const double rung = first * std::pow(step, i);  // not a product of products, whose errors add up
        if (rung > last * 1.001) return rungs;
        rungs.push_back(std::stod(fmt::format("{:.3g}", rung)));
    }
}

bool isPrecise(const Settings& settings) {
    return settings.path != Path::deferred || settings.gbuffer == GBufferEncoding::full;
}

std::span<const Quantity> quantities() {
    static const std::vector<Quantity> all = [] {
        std::vector<Quantity> made;
        for (const auto& group : {placeQuantities, cameraQuantities, lightQuantities, materialQuantities,
                                  shadowQuantities, amountQuantities})
            std::ranges::move(group(), std::back_inserter(made));
        return made;
    }();
    return all;
}

std::vector<const Quantity*> quantitiesOf(std::span<const std::string> names, std::string_view option) {
    std::vector<std::string> known;
    for (const Quantity& quantity : quantities()) known.emplace_back(quantity.name);
    for (const std::string& name : names)
        if (std::ranges::count(known, name) == 0)
            throw std::runtime_error(
                fmt::format("{} {}: there is no such quantity{}", option, name, didYouMean(name, known)));
    std::vector<const Quantity*> found;
    for (const Quantity& quantity : quantities())
        if (names.empty() || std::ranges::count(names, quantity.name) > 0) found.push_back(&quantity);
    return found;
}

}  // namespace diptych::audit
