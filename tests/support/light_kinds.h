// SPDX-License-Identifier: MIT
// Every kind of light, for suites that try each: the reader's (LightsJsonOf), the reference's
// (ReferenceLight, ReferenceDrawOf) and the shaders' area lights (AreaShapes, AreaPoints). A new kind gets
// all their cases.
#pragma once

#include "shared/scene/lights/lights_json.h"

#include <string>
#include <vector>

namespace diptych {

inline const std::vector<LightKind>& everyLightKind() {
    static const std::vector<LightKind> all = [] {
        std::vector kinds{LightKind::directional, LightKind::point, LightKind::spot};
        kinds.insert(kinds.end(), areaKinds.begin(), areaKinds.end());
        return kinds;
    }();
    return all;
}

// The name of a kind, for INSTANTIATE_TEST_SUITE_P.
constexpr auto lightKindName = [](const auto& info) { return std::string(nameOf(info.param)); };

}  // namespace diptych
