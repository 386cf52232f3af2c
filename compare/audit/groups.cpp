// SPDX-License-Identifier: MIT
#include "compare/audit/groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

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
    return subject.given.scene.environment ? "" : "the scene has no environment: add one with --env";
}

double originalOne(const Subject&) {
    return 1;
}

std::vector<double> ladder(double first, double last, double step) {
    std::vector<double> rungs;
    for (int i = 0;; ++i) {
        const double rung = first * std::pow(step, i);  // not repeated products, whose errors accumulate
        if (rung > last * 1.001) return rungs;
        rungs.push_back(std::stod(fmt::format("{:.3g}", rung)));
    }
}

}  // namespace diptych::audit
