// SPDX-License-Identifier: MIT
#include "shared/draw/frame_inputs.h"

#include "shared/contract/gbuffer.h"
#include "shared/contract/material.h"
#include "shared/contract/multiscatter.h"
#include "shared/draw/culling.h"

#include <bit>

namespace diptych {
namespace {

gpu::uint multiscatterOf(Multiscatter multiscatter) {
    switch (multiscatter) {
        case Multiscatter::off:
        case Multiscatter::walk:  // reference only
            return gpu::MULTISCATTER_OFF;
        case Multiscatter::energy:
            return gpu::MULTISCATTER_ENERGY;
        case Multiscatter::fdez:
            return gpu::MULTISCATTER_FDEZ;
    }
    return gpu::MULTISCATTER_OFF;
}

// Float parameters as specialization constants, which are integers.
gpu::uint bitsOf(float value) {
    return std::bit_cast<gpu::uint>(value);
}

void addSpecularAa(Variant& variant, const Settings& settings) {
    if (!settings.spec_aa) return;
    const bool mapped = settings.spec_aa_normals == SpecularNormals::mapped;
    const gpu::uint slope = settings.spec_aa_kernel == SpecularKernel::slope ? gpu::SPECULAR_AA_SLOPE : 0;
    variant
        .set(gpu::FEATURE_specular_aa, (mapped ? gpu::SPECULAR_AA_MAPPED : gpu::SPECULAR_AA_GEOMETRY) | slope)
        .set(gpu::FEATURE_specular_aa_variance, bitsOf(settings.spec_aa_variance));
}

}  // namespace

void addGeometryPasses(PassList& passes, const FrameInputs& inputs) {
    if (inputs.culling != nullptr) inputs.culling->addPasses(passes);
    inputs.posing.addPasses(passes, inputs.pipelines);
}

Pass& readGeometry(PassList& passes, Pass& pass, const FrameInputs& inputs) {
    if (inputs.culling != nullptr) inputs.culling->read(passes, pass);
    return inputs.posing.read(passes, pass);
}

bool readsSpecularAlbedo(const GpuLights& lights, const Settings& settings) {
    const bool split = lights.environment && settings.ibl == Ibl::split;
    return split || lights.ambient != glm::vec3(0) || multiscatterOf(settings.multiscatter) != 0;
}

Variant sceneVariant(const Requirements& needs, const GpuLights& lights, const View& view,
                     const GBufferLayout& gbuffer, const Settings& settings) {
    Variant variant;
    gpu::uint area = 0;
    for (std::size_t kind = 0; kind < lights.areas.size(); ++kind)
        if (lights.areas[kind] > 0) area |= 1u << kind;
    if (area != 0 && settings.area_lights == AreaLights::representative) area |= gpu::AREA_POINTS;
    variant.set(gpu::FEATURE_emission, needs.emission)
        .set(gpu::FEATURE_dielectric_specular, needs.dielectric_specular)
        .set(gpu::FEATURE_directional_lights, lights.directional > 0)
        .set(gpu::FEATURE_point_lights, lights.point > 0)
        .set(gpu::FEATURE_spot_lights, lights.spot > 0)
        .set(gpu::FEATURE_area_lights, area)
        .set(gpu::FEATURE_lightmap, needs.lightmap)
        .set(gpu::FEATURE_layers, needs.surface_layers)
        .set(gpu::FEATURE_ambient, lights.ambient != glm::vec3(0))
        .set(gpu::FEATURE_multiscatter, multiscatterOf(settings.multiscatter))
        .set(gpu::FEATURE_fitted_albedo,
             readsSpecularAlbedo(lights, settings) && settings.specular_albedo == SpecularAlbedo::fit)
        .set(gpu::FEATURE_samples, settings.msaa > 1 ? static_cast<gpu::uint>(settings.msaa) : 0)
        .set(gpu::FEATURE_tonemapped_resolve, settings.resolve == Resolve::tonemapped)
        .set(gpu::FEATURE_orthographic, view.camera.orthographic)
        .set(gpu::FEATURE_half_shading, settings.shading_precision == ShadingPrecision::fp16)
        .set(gpu::FEATURE_base_by_component, settings.base_layer == BaseLayer::component)
        .set(gpu::FEATURE_smooth_cones, lights.falloff.smooth_cones)
        .set(gpu::FEATURE_squared_window, lights.falloff.squared_window);
    addSpecularAa(variant, settings);
    gbuffer.specialise(variant);
    return variant;
}

ImageRef sampledImage(PassList& passes, const FrameInputs& inputs, const std::string& name, VkFormat format) {
    return passes.image({.name = name, .format = format, .samples = inputs.samples});
}

ImageRef sceneDepth(PassList& passes, const FrameInputs& inputs, const char* name) {
    return passes.image(inputs.depth.image(name, inputs.samples));
}

DescriptorSets blendedSet(const FrameInputs& inputs) {
    DescriptorSets sets(inputs.device, inputs.layouts.gbuffer, gbufferBindings(), 1);
    inputs.placeholders.bindGBuffer(sets, inputs.layouts);
    return sets;
}

DescriptorSets gbufferSet(const PassList& passes, const FrameInputs& inputs, const FrameImages& images) {
    DescriptorSets sets = blendedSet(inputs);
    for (std::uint32_t i = 0; i < images.gbuffer.size(); ++i) {
        // Missing attachments are never read. Albedo has the right format and keeps their bindings valid.
        // In forward+, whose shaders declare none of them, any image works.
        const ImageRef albedo = images.gbuffer[gpu::GBUFFER_ALBEDO];
        const ImageRef image = images.gbuffer[i].valid() ? images.gbuffer[i] : albedo;
        sets.image(0, i, image.valid() ? passes.view(image) : inputs.placeholders.texel(),
                   inputs.layouts.nearest, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
    sets.image(0, gpu::BINDING_DEPTH, passes.view(images.depth), inputs.layouts.nearest,
               VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
    return sets;
}

double lightsAtPixel(const FrameInputs& inputs) {
    const gpu::LightGrid& grid = inputs.lists.grid();
    const std::uint64_t local =
        inputs.lists.any() ? std::uint64_t{grid.capacity} * grid.width / grid.lists : inputs.lights.local();
    return static_cast<double>(local + inputs.lights.directional);
}

}  // namespace diptych
