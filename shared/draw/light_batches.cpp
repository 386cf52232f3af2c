// SPDX-License-Identifier: MIT
#include "shared/draw/light_batches.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace diptych {

namespace {

// Layers with partial sums of their own, in the order of PartialSumImages.
struct LayerSum {
    gpu::uint layer;
    const char* name;
};
constexpr std::array layer_sums{LayerSum{gpu::LAYER_CLEARCOAT, "partial clear coat sum"},
                                LayerSum{gpu::LAYER_SHEEN, "partial sheen sum"},
                                LayerSum{gpu::LAYER_DIFFUSE_TRANSMISSION, "partial transmitted sum"}};
static_assert(2 + layer_sums.size() == std::tuple_size_v<PartialSumImages>);

#define DIPTYCH_COST(number, name, cost) cost,
constexpr double area_costs[] = {AREA_KINDS(DIPTYCH_COST)};
#undef DIPTYCH_COST

}  // namespace

void LightBatch::read(Pass& pass, VkPipelineStageFlags2 stages) const {
    if (sums)
        for (const ImageRef image : images)
            if (image.valid()) pass.samples(image, stages);
}

std::shared_ptr<DescriptorSets> partialSumSet(PassList& passes, Pass& pass, const FrameInputs& inputs,
                                              const PartialSumImages& images) {
    auto sums =
        std::make_shared<DescriptorSets>(inputs.device, inputs.layouts.partial_sums, partialSumBindings(), 1);
    pass.prepare([&passes, sums, images, sampler = inputs.layouts.nearest.get()] {
        for (gpu::uint i = 0; i < images.size(); ++i)
            sums->image(0, i, passes.view(images[i].valid() ? images[i] : images[0]), sampler,
                        VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    });
    return sums;
}

std::vector<VkFormat> partialSumFormats(gpu::uint layers) {
    return std::vector<VkFormat>(
        2 + std::ranges::count_if(layer_sums,
                                  [layers](const LayerSum& sum) { return (layers & sum.layer) != 0; }),
        litFormat);
}

double shadingMs(const PassList& passes, const FrameInputs& inputs, const LightBatch& batch) {
    const DeviceCosts& costs = inputs.device.profile().costs;
    const GpuLights& all = inputs.lights;
    double points = all.point + all.spot;
    for (std::size_t kind = 0; kind < all.areas.size(); ++kind) points += area_costs[kind] * all.areas[kind];
    const double each = points / std::max(1.0, static_cast<double>(all.local()));
    double lights = lightsAtPixel(inputs);
    if (batch.kind != gpu::BATCH_WHOLE)
        lights = std::min(lights, static_cast<double>(batch.end - batch.first) *
                                      std::max(1u, inputs.variant.get(gpu::FEATURE_list_width)));
    const double pixels = static_cast<double>(passes.width()) * passes.height();
    return pixels * (costs.surface + costs.light * lights * std::max(1.0, each)) * 1e-6;
}

gpu::uint entriesPerDraw(const DeviceProfile& profile, const GpuLights& lights, gpu::uint layers,
                         gpu::uint list_width) {
    // As the loops of shaders/lib/shading/shade.glsl and lights/area.glsl nest.
    const gpu::uint reflectors = 1 + ((layers & gpu::LAYER_CLEARCOAT) != 0 ? 1 : 0) +
                                 ((layers & gpu::LAYER_DIFFUSE_TRANSMISSION) != 0 ? 1 : 0),
                    over_reflectors = reflectors > 1 ? reflectors : 0,
                    over_entry = list_width > 1 ? list_width : 0;
    gpu::uint max = 1 + over_entry + list_width * over_reflectors;
    // Both form factors of a reflector, of a tube each with two rims of up to two arcs.
    constexpr gpu::uint factors = 2 * (1 + 2 * (1 + 2));
    if (lights.area() > 0) max = std::max(max, list_width * (1 + over_reflectors + reflectors * factors));
    return std::max(profile.light_iterations / max, 1u);
}

LightBatch addEarlierBatches(PassList& passes, const FrameInputs& inputs, const AddBatch& add, SumsBy drawn,
                             gpu::uint layers) {
    const gpu::uint entries = inputs.longest_list, max = inputs.entries_per_draw;
    if (entries <= max) return {};
    LightBatch batch{gpu::BATCH_FIRST, 0, max};
    while (batch.first + max < entries) {
        const bool stored = drawn == SumsBy::storage;
        constexpr const char* name = "shade earlier lights";
        const auto sum = [&](const char* of) {
            return passes.image({.name = of,
                                 .format = litFormat,
                                 .usage = stored ? VkImageUsageFlags{VK_IMAGE_USAGE_STORAGE_BIT} : 0,
                                 .life = Life::transient});
        };
        PartialSumImages images{sum("partial diffuse sum"), sum("partial specular sum")};
        for (std::size_t i = 0; i < layer_sums.size(); ++i)
            if (!stored && (layers & layer_sums[i].layer) != 0) images[2 + i] = sum(layer_sums[i].name);
        Pass& pass = stored ? passes.compute(name) : passes.draw(name);
        if (!stored)
            for (const ImageRef image : images)
                if (image.valid()) pass.color(image, Load::clear);
        add(pass, batch, images);
        std::shared_ptr<DescriptorSets> sums = partialSumSet(passes, pass, inputs, images);
        batch = {gpu::BATCH_LATER, batch.end, std::min(batch.end + max, entries), images, std::move(sums)};
    }
    return batch;
}

}  // namespace diptych
