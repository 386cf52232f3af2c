// SPDX-License-Identifier: MIT
#include "shared/frame/settings.h"
#include "tests/fuzz/fuzz.h"

using namespace diptych;

FUZZ_TARGET(settings)(const std::uint8_t* data, std::size_t size) {
    fuzz::readOrSayWhy([&] {
        const Settings settings = settingsFromJson(std::string(fuzz::textAt(data, size)));
        fuzz::require(settingsFromJson(toJson(settings)) == settings, "what is written reads back the same");
        if (const auto problem = settings.problem()) fuzz::require(!problem->empty(), "a problem has words");
    });
    return 0;
}
