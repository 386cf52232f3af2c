// SPDX-License-Identifier: MIT
#include "shared/scene/image/environment.h"

#include "shared/image/image_file.h"
#include "shared/scene/image/radiance_layer.h"
#include "shared/text/counted.h"
#include "shared/text/fail.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych {

void limitRadiance(Image& radiance, const std::string& where, std::vector<std::string>& notes) {
    static constexpr float largest = 65504;  // largest finite half
    std::size_t above = 0;
    for (std::size_t i = 0; i < radiance.pixels(); ++i) {
        float* const p = radiance.pixel(i);
        above += std::any_of(p, p + 3, [](float v) { return v > largest; });
        std::transform(p, p + 3, p, [](float v) { return std::min(v, largest); });
    }
    if (above > 0)
        notes.push_back(fmt::format("{}: {} {} above 65504; 65504 is used", where, counted(above, "pixel"),
                                    above == 1 ? "has a component" : "have components"));
}

Environment readEnvironment(const std::filesystem::path& file, std::vector<std::string>& notes) {
    const ImageFile image = readImage(file);
    const std::string name = file.string();
    if (image.display_referred)
        fail(
            fmt::format("{}: is a {} with display colours, but an environment needs radiance; give an "
                        "OpenEXR or Radiance HDR file",
                        name, image.format));
    const std::string where = "environment " + oneLine(name);
    Environment environment{name, named(name, [&] { return radianceOf(image, where, notes); })};
    limitRadiance(environment.radiance, where, notes);
    if (image.width != 2 * image.height)
        notes.push_back(fmt::format("{}: {} x {} pixels, not twice as wide as high; mapped to all directions",
                                    where, image.width, image.height));
    return environment;
}

}  // namespace diptych
