// SPDX-License-Identifier: MIT
// Error of each step from an environment to reflected light: bench_environment_errors [SAMPLES [BIAS]]
// FILE...
// Prints one table per environment, in percent, also for the two procedural ones.
#include "tests/bench/environment_errors.h"

#include "shared/scene/image/environment.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

using namespace diptych;
using namespace diptych::environment_errors;

namespace {

void print(const std::string& name, const Environment& environment, const FilterQuality& quality) {
    const std::vector<double>& angles = sphereAngles;
    const AllDirections sky(environment);
    const EnvironmentMaps maps = makeEnvironmentMaps(environment, {quality, true});
    fmt::print("\n{} ({} x {}, {} samples, bias {})\n\n", name, environment.radiance.width,
               environment.radiance.height, quality.samples, quality.bias);
    fmt::print(
        "| roughness | split | at n.v 0.94, 0.79, 0.61, 0.35 | prefilter | worst | table | all "
        "|\n|---|---|---|---|---|---|---|\n");
    for (const double roughness : {0.15, 0.25, 0.5, 0.75, 1.0}) {
        std::vector<SpecularErrors> by_angle;
        const SpecularErrors e = specularErrors(sky, maps, roughness, angles, 64, &by_angle);
        fmt::print("| {} | {:.3g} | {:.3g}, {:.3g}, {:.3g}, {:.3g} | {:.2g} | {:.2g} | {:.1g} | {:.3g} |\n",
                   roughness, 100 * e.split, 100 * by_angle[0].split, 100 * by_angle[1].split,
                   100 * by_angle[2].split, 100 * by_angle[3].split, 100 * e.prefilter,
                   100 * e.worst_filtered, 100 * e.table, 100 * e.all);
    }
    const IrradianceErrors i = irradianceErrors(sky, maps, 256);
    fmt::print("\nirradiance: ");
    for (const auto& [kind, error] :
         {std::pair{"sh", i.harmonics}, {"sh-windowed", i.windowed}, {"map", i.map}})
        fmt::print("{} {:.2g} (worst {:.2g} of the peak); ", kind, 100 * error.rms, 100 * error.worst);
    fmt::print("\n");
    std::fflush(stdout);
}

}  // namespace

int main(int count, char** text) {
    FilterQuality quality;
    std::vector<std::string> files;
    for (int i = 1, numbers = 0; i < count; ++i) {
        char* end = nullptr;
        const double number = std::strtod(text[i], &end);
        if (*end != 0)
            files.emplace_back(text[i]);
        else if (numbers++ == 0)
            quality.samples = static_cast<int>(number);
        else
            quality.bias = static_cast<float>(number);
    }
    print("smooth sky", smoothSky(256), quality);
    print("lamp of 5 degrees", lampSky(256), quality);
    for (const std::string& file : files) {
        std::vector<std::string> notes;
        print(std::filesystem::path(file).filename().string(), readEnvironment(file, notes), quality);
    }
    return 0;
}
