// SPDX-License-Identifier: MIT
#include "compare/reference/reference.h"

#include "compare/reference/channels.h"
#include "compare/reference/checkpoint.h"
#include "compare/reference/image_key.h"
#include "compare/reference/pixel_renderer.h"
#include "compare/reference/time_estimate.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/supported_channels.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <initializer_list>
#include <numeric>
#include <utility>
#include <vector>

namespace diptych::reference {
namespace {

// Side of the square tiles that are rendered and saved as units, in pixels.
constexpr int tileSide = 16;

// The other images of a ReferenceImage, in the order in which tiles store them.
std::array<Image*, 7> besides(ReferenceImage& image) {
    return {&image.rounding,     &image.shadow_edge, &image.local_shadow_edge, &image.environment_costs,
            &image.surroundings, &image.blended,     &image.unblended};
}

glm::dvec4 beyondEverywhere(const Shading& s) {
    const auto size = [](const glm::dvec3& light) { return Reflected{light}.size(); };
    const glm::dvec4 light(size(s.reflected.diffuse + s.reflected.transmitted), size(s.reflected.specular),
                           size(s.clearcoat), size(s.sheen));
    return glm::max(s.rounding - everywhereRounded * light, glm::dvec4(0));
}

bool isOfShadows(Channel mode) {
    return mode == Channel::shadow_visibility || mode == Channel::local_visibility;
}

class Drawing {
public:
    explicit Drawing(const Request& request)
        : request_(request),
          across_((request.view.width + tileSide - 1) / tileSide),
          down_((request.view.height + tileSide - 1) / tileSide) {
        for (const DebugMode& mode : debugModes()) {
            if (!isSupportedByReference(mode)) continue;
            if (!request.shadow_edges && isOfShadows(mode.channel)) continue;
            const bool copied = request.mode == ReferenceMode::surface && !isShaded(mode.channel);
            Image& image = image_.channels[mode.channel];
            if (copied && request.surfaces->contains(mode.channel)) {
                image = request.surfaces->at(mode.channel);
                continue;
            }
            image = Image(request.view.width, request.view.height, mode.width);
            if (copied) continue;  // of a layer that no surface has: 0
            drawn_.emplace_back(&mode, &image);
            floats_ += mode.width;
        }
        if (request.decoded)
            for (const Channel mode : litModes) {
                image_.decoded[mode] = Image(request.view.width, request.view.height, 3);
                floats_ += 3;
            }
        image_.uncertainty = Image(request.view.width, request.view.height, 1);
        ++floats_;
        if (std::ranges::any_of(request.lights, [](const Light& light) { return !isArea(light.kind); }))
            image_.rounding = Image(request.view.width, request.view.height, 4);
        const auto cast = [&](const auto& which) {
            return request.shadow_edges && std::ranges::any_of(request.casters, [&](std::size_t i) {
                       return which(request.lights[i]);
                   });
        };
        if (cast([](const Light& light) { return light.kind == LightKind::directional; }))
            image_.shadow_edge = Image(request.view.width, request.view.height, 3);
        if (cast(isLocal)) image_.local_shadow_edge = Image(request.view.width, request.view.height, 2);
        if (request.environment_costs && request.scene.environment)
            image_.environment_costs = Image(request.view.width, request.view.height, 9);
        if (request.surroundings) image_.surroundings = Image(request.view.width, request.view.height, 2);
        if (request.blended && blendsSomewhere(request)) {
            image_.blended = Image(request.view.width, request.view.height, 3);
            image_.unblended = Image(request.view.width, request.view.height, 3);
        }
        for (const Image* image : besides(image_)) floats_ += image->components;
    }

    ReferenceImage operator()() {
        const std::size_t pixels = std::size_t{tileSide} * tileSide;
        Checkpoint* const checkpoint =
            request_.keep ? &request_.keep(keyOf(request_), 1 + pixels * static_cast<std::size_t>(floats_))
                          : nullptr;
        const auto tiles = static_cast<std::uint64_t>(across_) * static_cast<std::uint64_t>(down_);
        std::vector<bool> there(tiles, false);
        if (checkpoint)
            for (const Checkpoint::Record& record : checkpoint->takeEarlier())
                if (record.index < tiles) {
                    put(record.index, record.values);
                    there[record.index] = true;
                    image_.resumed_fraction += 1.0 / static_cast<double>(tiles);
                    image_.resumed_seconds +=
                        double{record.values.front()} / tbb::info::default_concurrency();
                }
        // The order of tiles is scattered over the image, so that the finished part predicts the remaining
        // time.
        std::vector<std::uint64_t> order;
        std::uint64_t step =
            std::max<std::uint64_t>(1, static_cast<std::uint64_t>(0.618 * static_cast<double>(tiles)));
        while (std::gcd(step, tiles) != 1) ++step;
        for (std::uint64_t i = 0, tile = 0; i < tiles; ++i, tile = (tile + step) % tiles)
            if (!there[tile]) order.push_back(tile);

        if (!order.empty()) {
            const PixelRenderer renderer(request_);
            if (request_.expected)
                if (const auto seconds = expectedSeconds(request_.view.width, request_.view.height,
                                                         [&](int x, int y) { renderer.render(x, y); }))
                    request_.expected(*seconds * (1 - image_.resumed_fraction));
            std::atomic<std::size_t> done{0};
            tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t i) {
                const std::vector<float> values = renderTile(renderer, order[i]);
                put(order[i], values);
                if (checkpoint) checkpoint->keep(order[i], values);
                if (request_.tile) tell(order[i]);
                if (request_.progress)
                    request_.progress(static_cast<double>(++done) / static_cast<double>(order.size()));
            });
        }
        for (Image* const image : {&image_.uncertainty, &image_.rounding})
            if (std::ranges::all_of(image->data, [](float u) { return u == 0; })) *image = {};
        return std::move(image_);
    }

private:
    template <class Visit>
    void eachPixel(std::uint64_t tile, Visit&& visit) const {
        const int x0 = static_cast<int>(tile % static_cast<std::uint64_t>(across_)) * tileSide;
        const int y0 = static_cast<int>(tile / static_cast<std::uint64_t>(across_)) * tileSide;
        for (int y = y0; y < std::min(y0 + tileSide, request_.view.height); ++y)
            for (int x = x0; x < std::min(x0 + tileSide, request_.view.width); ++x) visit(x, y);
    }

    void tell(std::uint64_t tile) const {
        const int x = static_cast<int>(tile % static_cast<std::uint64_t>(across_)) * tileSide;
        const int y = static_cast<int>(tile / static_cast<std::uint64_t>(across_)) * tileSide;
        request_.tile(image_, x, y, std::min(tileSide, request_.view.width - x),
                      std::min(tileSide, request_.view.height - y));
    }

    // The seconds that the tile took, then its pixels' values.
    std::vector<float> renderTile(const PixelRenderer& renderer, std::uint64_t tile) const {
        const auto start = std::chrono::steady_clock::now();
        std::vector<float> values{0};
        eachPixel(tile, [&](int x, int y) {
            const Pixel pixel = renderer.render(x, y);
            const auto takeChannel = [&](Channel mode, int width, const Pixel& of) {
                const glm::dvec3 value = channelValue(mode, of);
                for (int c = 0; c < width; ++c) values.push_back(static_cast<float>(value[c]));
            };
            for (const auto& [mode, image] : drawn_) takeChannel(mode->channel, mode->width, pixel);
            if (request_.decoded) {
                const Pixel decoded = renderer.withDecoded(x, y, pixel);
                for (const auto& [mode, image] : image_.decoded) takeChannel(mode, image.components, decoded);
            }
            values.push_back(static_cast<float>(pixel.shading.uncertainty + pixel.blended.uncertainty));
            const auto take = [&](const Image& image, std::initializer_list<double> numbers) {
                if (image.empty()) return;
                for (const double number : numbers) values.push_back(static_cast<float>(number));
            };
            const glm::dvec4 rounding = beyondEverywhere(pixel.shading);
            take(image_.rounding, {rounding.x, rounding.y, rounding.z, rounding.w});
            take(image_.shadow_edge, {pixel.edge_distance, pixel.sun_radiance, pixel.sun_irradiance});
            take(image_.local_shadow_edge, {pixel.local_edge, pixel.local_radiance});
            EnvironmentCosts c = pixel.shading.costs;
            c += pixel.blended.costs;
            take(image_.environment_costs, {c.diffuse[0], c.diffuse[1], c.diffuse[2], c.split[0], c.split[1],
                                            c.split[2], c.sampled, c.wider, c.lobe});
            take(image_.surroundings, {pixel.shading.surroundings.all, pixel.shading.surroundings.hidden});
            const glm::dvec3& t = pixel.transmitted;
            take(image_.blended,
                 {pixel.hidden, pixel.bent, pixel.bent > 0 ? std::max({t.x, t.y, t.z}) : 0.0});
            take(image_.unblended, {pixel.unblended.x, pixel.unblended.y, pixel.unblended.z});
        });
        values.front() = std::chrono::duration<float>(std::chrono::steady_clock::now() - start).count();
        return values;
    }

    void put(std::uint64_t tile, const std::vector<float>& values) {
        const float* next = values.data() + 1;  // after the seconds
        eachPixel(tile, [&](int x, int y) {
            for (const auto& [mode, image] : drawn_)
                for (int c = 0; c < mode->width; ++c) image->at(x, y, c) = *next++;
            for (auto& [mode, image] : image_.decoded)
                for (int c = 0; c < image.components; ++c) image.at(x, y, c) = *next++;
            image_.uncertainty.at(x, y) = *next++;
            for (Image* const image : besides(image_))
                for (int c = 0; c < image->components; ++c) image->at(x, y, c) = *next++;
        });
    }

    const Request& request_;
    const int across_, down_;
    int floats_ = 0;                                          // floats per pixel; a tile has one more
    std::vector<std::pair<const DebugMode*, Image*>> drawn_;  // images in image_
    ReferenceImage image_;
};

}  // namespace

std::vector<Channel> surfaceChannels(std::uint32_t layers) {
    std::vector<Channel> modes;
    for (const DebugMode& mode : debugModes())
        if (!isShaded(mode.channel) && isSupportedByReference(mode) && mayShow(mode.channel, layers))
            modes.push_back(mode.channel);
    return modes;
}

PixelLight drawPixel(const Request& request, int x, int y) {
    const PixelRenderer renderer(request);
    const Pixel pixel = renderer.render(x, y);
    PixelLight result;
    const std::size_t index = static_cast<std::size_t>(y) * static_cast<std::size_t>(request.view.width) +
                              static_cast<std::size_t>(x);
    for (const DebugMode& mode : debugModes()) {
        if (!isSupportedByReference(mode)) continue;
        glm::dvec3& value = result.channels[mode.channel] = channelValue(mode.channel, pixel);
        if (request.mode == ReferenceMode::scene || isShaded(mode.channel)) continue;
        // Not shaded: copied from the capture, or 0 of a layer that no surface has.
        if (!request.surfaces->contains(mode.channel)) continue;
        const Image& image = request.surfaces->at(mode.channel);
        for (int c = 0; c < mode.width; ++c) value[c] = double{image.pixel(index)[c]};
    }
    result.uncertainty = pixel.shading.uncertainty + pixel.blended.uncertainty;
    result.unblended = request.blended && blendsSomewhere(request) ? pixel.unblended : pixel.lit;
    renderer.takeTerms(x, y, result);
    return result;
}

ReferenceImage draw(const Request& request) {
    return Drawing(request)();
}

}  // namespace diptych::reference
