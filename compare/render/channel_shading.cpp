// SPDX-License-Identifier: MIT
#include "compare/render/channel_shading.h"

#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "deferred/channel_lighting.h"
#include "shared/contract/gbuffer.h"
#include "shared/contract/surface_channels.h"
#include "shared/frame/debug_modes.h"
#include "shared/material/gbuffer_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <utility>

namespace diptych {

namespace {

#define DIPTYCH_CHANNEL_INDEX(number, name) gpu::uint{number},
constexpr std::array channelBindings{SURFACE_CHANNELS(DIPTYCH_CHANNEL_INDEX)};
#undef DIPTYCH_CHANNEL_INDEX
constexpr std::size_t channelCount = channelBindings.size();

// Settings of the frame whose depth, light lists and shadows light the surfaces.
Settings litBy(Settings settings) {
    settings.path = Path::deferred;
    settings.gbuffer = GBufferEncoding::full;
    settings.layers = Layers::gbuffer;
    if (settings.assign == Assignment::per_object) settings.assign = Assignment::every;
    settings.msaa = 1;
    return settings;
}

const Image& channelOf(const Frame& frame, Channel mode) {
    if (const Image* const image = findChannel(frame, mode)) return *image;
    throw std::logic_error(fmt::format("{} has no {} to light", frame.name, debugMode(mode).name));
}

// Bits per coordinate to which lighting quantises the path's geometric normals. 0: none, or the channel
// already shows quantised normals.
float quantisedTo(const Frame& frame) {
    return shadesFragments(frame.settings.path)
               ? static_cast<float>(geometricNormalBits(frame.settings.gbuffer))
               : 0;
}

// RGBA32F texels of an image of 1 or 3 components. `fourth`: alpha of a pixel.
template <class Fourth>
std::vector<float> texelsOf(const Image& image, const Fourth& fourth) {
    std::vector<float> texels(image.pixels() * 4);
    const auto components = static_cast<std::size_t>(image.components);
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        std::copy_n(image.pixel(i), components, &texels[4 * i]);
        texels[4 * i + 3] = fourth(i);
    }
    return texels;
}

std::vector<float> texelsOf(const Frame& frame, Channel mode) {
    // A frame of a scene without the layer.
    if (layerOf(mode) != 0 && !frame.channels.contains(mode))
        return std::vector<float>(4 * channelOf(frame, Channel::albedo).pixels());
    const Image& image = channelOf(frame, mode);
    if (mode == Channel::lightmap) {
        const Image& has = channelOf(frame, Channel::lightmapped);
        return texelsOf(image, [&](std::size_t i) { return *has.pixel(i); });
    }
    const float bits = mode == Channel::geometric_normal ? quantisedTo(frame) : 0;
    return texelsOf(image, [&](std::size_t) { return bits; });
}

}  // namespace

struct SurfaceImages::State {
    Device& device;
    Size size;
    Uploader uploader;
    std::array<std::array<std::optional<GpuImage>, channelCount>, 2> images{};

    VkImageView view(std::size_t side, std::size_t channel) const {
        const std::optional<GpuImage>& own = images.at(side).at(channel);
        const std::optional<GpuImage>& other = images.at(1 - side).at(channel);
        if (!own && !other) throw std::logic_error("a channel of surfaces was never set");
        return own ? own->view() : other->view();
    }
};

SurfaceImages::SurfaceImages(Device& device, const Size& size)
    : state_(new State{device, size, Uploader(device)}) {}
SurfaceImages::SurfaceImages(SurfaceImages&&) noexcept = default;
SurfaceImages::~SurfaceImages() = default;

void SurfaceImages::set(std::size_t side, std::size_t channel, const Frame& frame) {
    const Channel mode = surfaceChannels()[channel];
    const std::vector<float> texels = texelsOf(frame, mode);
    if (texels.size() != 4 * static_cast<std::size_t>(state_->size.width) * state_->size.height)
        throw std::logic_error("a channel of surfaces has another size");
    std::optional<GpuImage>& target = state_->images.at(side).at(channel);
    target.emplace(state_->device,
                   GpuImageInfo{.name = std::string(debugMode(mode).name),
                                .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                .width = static_cast<std::uint32_t>(state_->size.width),
                                .height = static_cast<std::uint32_t>(state_->size.height),
                                .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    state_->uploader.level(*target, 0, std::as_bytes(std::span(texels)));
    state_->uploader.flush();
}

struct ChannelShading::State {
    State(Device& device, SharedResources& shared, const SceneView& view, const Settings& requested,
          const SurfaceImages::State& channels)
        : settings(litBy(requested)),
          images(channels),
          uploader(shared.uploader),
          frame(device, shared, view, settings),
          sets(std::make_shared<DescriptorSets>(device, shared.layouts.gbuffer, gbufferBindings(), 1)),
          nearest(shared.layouts.nearest.get()) {
        frame.view.inputs.placeholders.bindGBuffer(*sets, shared.layouts);
        frame.passes.run();
        first = frame.passes.size();
        lit = addChannelLighting(frame.passes, frame.view.inputs, frame.images.depth, sets);
        sets->image(0, gpu::BINDING_DEPTH, frame.passes.view(frame.images.depth), nearest,
                    VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
        last = frame.passes.size();
    }

    void bind(std::uint32_t sides) {
        for (std::size_t channel = 0; channel < channelCount; ++channel)
            sets->image(0, channelBindings.at(channel), images.view(sides >> channel & 1u, channel), nearest,
                        VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }

    void drawTerms(std::uint32_t sides) {
        PassList& passes = frame.passes;
        if (!terms) terms = addChannelTerms(passes, frame.view.inputs, frame.images.depth, sets);
        bind(sides);
        passes.run(last, passes.size());
    }

    const Settings settings;  // the view refers to it
    const SurfaceImages::State& images;
    Uploader& uploader;
    PreparedFrame frame;
    std::shared_ptr<DescriptorSets> sets;
    VkSampler nearest;
    std::size_t first = 0, last = 0;  // passes of lit
    ImageRef lit;
    std::optional<std::array<ImageRef, 6>> terms;  // created on first use
};

ChannelShading::ChannelShading(Device& device, SharedResources& shared, const SceneView& view,
                               const Settings& settings, const SurfaceImages& images)
    : state_(new State(device, shared, view, settings, *images.state_)) {}
ChannelShading::ChannelShading(ChannelShading&&) noexcept = default;
ChannelShading::~ChannelShading() = default;

Image ChannelShading::shade(std::uint32_t sides) {
    state_->bind(sides);
    PassList& passes = state_->frame.passes;
    passes.run(state_->first, state_->last);
    const PassList::ReadBack request{state_->lit, 3};
    return std::move(readImages(passes, std::span(&request, 1)).front());
}

ChannelTerms ChannelShading::terms(std::uint32_t sides) {
    PassList& passes = state_->frame.passes;
    state_->drawTerms(sides);
    std::vector<PassList::ReadBack> requests;
    for (const ImageRef term : *state_->terms) requests.push_back({term, 3});
    for (const std::size_t term : {0, 1}) requests.push_back({(*state_->terms)[term], 1, {}, 3});
    std::vector<Image> read = readImages(passes, requests);
    return {std::move(read[0]), std::move(read[1]), std::move(read[2]), std::move(read[3]),
            std::move(read[4]), std::move(read[5]), std::move(read[6]), std::move(read[7])};
}

LightChannels ChannelShading::light(std::uint32_t sides, std::size_t index) {
    PreparedView& view = state_->frame.view;
    std::vector<gpu::Light> alone = view.lights.lights;
    for (std::size_t i = 0; i < view.lights.sources.size(); ++i)
        if (view.lights.sources[i] != index) alone[i].intensity = gpu::vec3(0);
    view.buffers.replaceLights(state_->uploader, alone);
    state_->drawTerms(sides);
    view.buffers.replaceLights(state_->uploader, view.lights.lights);
    const std::array<PassList::ReadBack, 2> requests{{{(*state_->terms)[0], 3}, {(*state_->terms)[1], 3}}};
    std::vector<Image> read = readImages(state_->frame.passes, requests);
    return {std::move(read[0]), std::move(read[1])};
}

const std::vector<Light>& ChannelShading::lights() const {
    return state_->frame.view.scene.lights;
}

}  // namespace diptych
