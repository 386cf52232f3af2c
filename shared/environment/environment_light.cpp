// SPDX-License-Identifier: MIT
#include "shared/environment/environment_light.h"

#include "shared/contract/bindings.h"
#include "shared/contract/features.h"
#include "shared/environment/map_cache.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <stdexcept>

namespace diptych {

namespace {

constexpr VkFormat mapFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

GpuImage uploaded(Device& device, Uploader& uploader, const std::string& name, int width, int height,
                  std::span<const glm::vec4> texels) {
    GpuImage image(device, {.name = name,
                            .format = mapFormat,
                            .width = static_cast<std::uint32_t>(width),
                            .height = static_cast<std::uint32_t>(height),
                            .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    uploader.level(image, 0, std::as_bytes(texels));
    return image;
}

EnvironmentRequest environmentRequest(const Settings& settings) {
    EnvironmentRequest request{{settings.ibl_samples, settings.ibl_bias}, settings.ibl == Ibl::split};
    if (!request.prefilter) request.quality = {};  // not used without prefiltering
    return request;
}

}  // namespace

const EnvironmentImages& EnvironmentStore::at(Uploader& uploader, const Environment& environment,
                                              const Environment& background,
                                              const EnvironmentRequest& request) {
    const bool without_sun = &environment != &background;
    for (const auto& images : made_)
        if (images->request == request && images->without_sun == without_sun) return *images;
    const Image& radiance = background.radiance;
    const auto max = static_cast<int>(device_.limits().maxImageDimension2D);
    if (radiance.width > max || radiance.height > max)
        throw std::runtime_error(fmt::format("environment {}: has {} x {} pixels; {} supports up to {} x {}",
                                             background.name, radiance.width, radiance.height,
                                             device_.info().name, max, max));
    const auto start = std::chrono::steady_clock::now();
    bool wasCached = false;
    const EnvironmentMaps maps = environmentMaps(environment, request, folder_, &wasCached);
    const EnvironmentAtlas atlas = layOut(maps);
    const double ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    auto images = std::make_unique<EnvironmentImages>();
    images->request = request;
    images->without_sun = without_sun;
    images->harmonics = maps.harmonics;
    images->window = minWindow(maps.harmonics);
    images->diffuse = atlas.diffuse;
    images->levels = atlas.levels;
    images->maps = uploaded(device_, uploader, "environment maps", atlas.width, atlas.height, atlas.texels);
    std::vector<glm::vec4> sky(radiance.pixels());
    for (std::size_t i = 0; i < sky.size(); ++i) {
        const float* p = radiance.pixel(i);
        sky[i] = {p[0], p[1], p[2], 0};
    }
    images->sky = uploaded(device_, uploader, "sky", radiance.width, radiance.height, sky);
    const TruncationError raw = truncationError(maps, 0), windowed = truncationError(maps, images->window);
    images->note = fmt::format(
        "environment: {} maps of up to {} texels per side, {} in {:.0f} ms; error of spherical harmonics in "
        "% of the peak irradiance: mean {:.2g}, largest {:.2g}; windowed ({:.2g}): {:.2g} and {:.2g}",
        maps.levels.size(), maps.levels.front().side, wasCached ? "read" : "made", ms, 100 * raw.mean,
        100 * raw.worst, images->window, 100 * windowed.mean, 100 * windowed.worst);
    made_.push_back(std::move(images));
    return *made_.back();
}

std::uint64_t EnvironmentStore::bytes() const {
    std::uint64_t sum = 0;
    for (const auto& images : made_) sum += images->maps.bytes() + images->sky.bytes();
    return sum;
}

// Rotating the environment by `degrees` reads it at directions rotated back by `degrees`.
glm::mat3 environmentFromWorld(double degrees) {
    // Multiples of 90 degrees are exact.
    const double quarters = degrees / 90, turn = glm::radians(degrees);
    double c = std::cos(turn), s = std::sin(turn);
    if (quarters == std::round(quarters)) c = std::round(c), s = std::round(s);
    return {glm::vec3(c, 0, s), glm::vec3(0, 1, 0), glm::vec3(-s, 0, c)};
}

EnvironmentLight::EnvironmentLight(Device& device, Uploader& uploader, EnvironmentStore& store,
                                   const Source& source, DescriptorSets& frame, const Settings& settings)
    : nearest_(makeNearestSampler(device)) {
    if (!isLit(source.environment, settings)) return;
    const EnvironmentImages& images =
        store.at(uploader, *source.environment, *source.background, environmentRequest(settings));
    feature_ = gpu::ENVIRONMENT_LIT;
    if (settings.ibl_diffuse == IblDiffuse::map) feature_ |= gpu::ENVIRONMENT_DIFFUSE_MAP;
    if (settings.ibl == Ibl::sampled) feature_ |= gpu::ENVIRONMENT_SAMPLED;
    notes_.push_back(images.note);
    image_bytes_ = images.maps.bytes() + images.sky.bytes();
    const glm::mat3 turned = environmentFromWorld(double{settings.env_rotation});
    const bool windowed = settings.ibl_diffuse == IblDiffuse::sh_windowed;
    const auto irradiance = rotatedPolynomial(
        irradiancePolynomial(images.harmonics, windowed ? images.window : 0), glm::dmat3(turned));
    std::vector<glm::vec4> texels{
        {turned[0].x, turned[0].z, settings.ibl_intensity, static_cast<float>(images.levels.size())}};
    for (std::size_t i = 0; i < 7; ++i) {
        const auto axis = static_cast<int>(i % 3);
        texels.emplace_back(glm::vec3(irradiance[i]), i < 6 ? irradiance[7 + i / 3][axis] : 0);
    }
    texels.emplace_back(glm::vec3(images.diffuse), settings.ibl_bias);
    texels.insert(texels.end(), images.levels.begin(), images.levels.end());
    texels[gpu::ENVIRONMENT_TEXEL_LEVELS].w = static_cast<float>(settings.ibl_samples);
    texels_ = makeBuffer<glm::vec4>(device, uploader, "environment", texels,
                                    VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    uploader.flush();
    texels_view_ = makeTexelView(device, "environment", texels_, mapFormat);
    frame.texels(0, gpu::BINDING_ENVIRONMENT, texels_view_);
    for (const auto& [binding, image] :
         {std::pair{gpu::BINDING_ENVIRONMENT_MAPS, &images.maps}, {gpu::BINDING_SKY, &images.sky}})
        frame.image(0, binding, image->view(), nearest_, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

}  // namespace diptych
