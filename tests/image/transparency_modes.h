// SPDX-License-Identifier: MIT
// All transparency modes, and Settings of an image with one.
#pragma once

#include "tests/image/changed_view.h"

namespace diptych::tests {

inline constexpr Transparency allModes[] = {Transparency::sorted,    Transparency::unsorted,
                                            Transparency::triangles, Transparency::weighted,
                                            Transparency::moments,   Transparency::list};

inline Settings imageSettings(Transparency transparency, Path path = Path::forward_plus) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = {96, 54};
    settings.path = path;
    settings.transparency = transparency;
    return settings;
}

inline void nothing(PreparedView&) {}

}  // namespace diptych::tests
