// SPDX-License-Identifier: MIT
#include "shared/scene/lights/lights_json.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/valid_light.h"

using namespace diptych;

FUZZ_TARGET(lights)(const std::uint8_t* data, std::size_t size) {
    fuzz::readOrSayWhy([&] {
        for (const Light& light : lightsFromJson(fuzz::textAt(data, size), "fuzz.json")) {
            fuzz::requireSound(light);
            fuzz::require(light.node == -1, "a light of a file is in world space");
        }
    });
    return 0;
}
