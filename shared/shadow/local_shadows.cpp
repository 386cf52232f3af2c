// SPDX-License-Identifier: MIT
#include "shared/shadow/local_shadows.h"

#include "shared/contract/bindings.h"
#include "shared/draw/record.h"
#include "shared/scene/lights/shadow_casters.h"
#include "shared/shadow/scene_bounds.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <iterator>
#include <utility>

namespace diptych {

namespace {

// Culls casters beyond the light's range. The clip planes would keep them, because depths there are nearly
// 0.
void cullBeyond(DrawList& casters, const LocalAtlas& atlas, const AtlasTile& tile, const glm::dvec3& eye) {
    const AtlasLight& light = atlas.lights[tile.light];
    const glm::dvec3 along = faceAxes(light, tile.face)[2];
    casters.culled += static_cast<std::uint32_t>(std::erase_if(casters.items, [&](const DrawItem& item) {
        const auto corners =
            cornersOf(item.range, glm::dmat4(glm::mat4(casters.draws[item.draw].world_from_object)));
        return std::ranges::all_of(corners, [&](const glm::dvec3& corner) {
            return glm::dot(along, corner + eye - light.position) > light.far;
        });
    }));
}

// Lights with a shadow in buffer order: points, then spots.
std::vector<Light> castingLocals(const GpuLights& lights, std::span<const Light> sources) {
    std::vector<Light> casting;
    for (gpu::uint i = 0; i < lights.casting_points; ++i)
        casting.push_back(sources[lights.sources[lights.directional + i]]);
    for (gpu::uint i = 0; i < lights.casting_spots; ++i)
        casting.push_back(sources[lights.sources[lights.directional + lights.point + i]]);
    return casting;
}

std::vector<std::string> notesOf(const LocalAtlas& atlas, std::size_t draws, std::span<const Light> sources,
                                 int brightest) {
    const LocalCasting casting = localCasting(sources, brightest);
    std::vector<std::string> notes;
    if (!casting.lights.empty()) {
        std::string drawn = "no tile is drawn";
        if (!atlas.tiles.empty()) {
            const auto [min, max] = std::ranges::minmax_element(atlas.tiles, {}, &AtlasTile::size);
            drawn = fmt::format("{} of {}{} texels, {}, in an atlas of {}x{}, {:.1f} MiB",
                                counted(atlas.tiles.size(), "tile"),
                                min->size < max->size ? fmt::format("{} to ", min->size) : "", max->size,
                                counted(draws, "draw"), atlas.side, atlas.side,
                                static_cast<double>(atlas.side) * atlas.side * sizeof(float) / (1 << 20));
        }
        notes.push_back(
            fmt::format("shadows of {}: {}", counted(casting.lights.size(), "local light"), drawn));
        if (atlas.unseen > 0)
            notes.back() +=
                fmt::format("; {} without a tile: no visible receiver", counted(atlas.unseen, "face"));
        if (atlas.empty > 0)
            notes.back() += fmt::format("; {} without a tile: no caster", counted(atlas.empty, "face"));
    }
    if (casting.unshadowed > 0)
        notes.push_back(fmt::format("{} {} no shadow (--shadow-lights N enables the N brightest)",
                                    counted(casting.unshadowed, "point or spot light"),
                                    casting.unshadowed == 1 ? "casts" : "cast"));
    if (casting.over_capacity > 0)
        notes.back() += fmt::format("; {} of them should cast one, but the atlas is full ({} tiles)",
                                    casting.over_capacity, gpu::MAX_LOCAL_TILES);
    return notes;
}

}  // namespace

LocalShadows::LocalShadows(Device& device, Uploader& uploader, const ShadowedView& scene,
                           DescriptorSets& frame, const Settings& settings)
    : frame_(frame),
      request_{settings.shadow_size, settings.shadow_kernel, double{settings.shadow_bias}},
      nearest_(makeNearestSampler(device)) {
    layOut(scene);
    std::vector<glm::vec4> texels(1);
    if (any()) {
        const GpuLights& lights = scene.lights;
        const gpu::LocalCasters head{lights.directional + lights.casting_points,
                                     lights.directional + lights.point + lights.casting_spots,
                                     lights.directional + lights.point - lights.casting_points,
                                     lights.count()};
        std::memcpy(texels.data(), &head, sizeof head);
        std::ranges::copy(gpuTexels(atlas_, request_), std::back_inserter(texels));
        kinds_ = (lights.casting_points > 0 ? gpu::LOCAL_SHADOWS_POINTS : 0) |
                 (lights.casting_spots > 0 ? gpu::LOCAL_SHADOWS_SPOTS : 0);
    }
    const std::size_t draws = listCasters(device, uploader, scene, settings.shadow_casters);
    if (settings.shadows != Shadows::off)
        notes_ = notesOf(atlas_, draws, scene.sources, settings.shadow_lights);
    texels_ = makeBuffer<glm::vec4>(device, uploader, "local shadow lights", texels,
                                    VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    uploader.flush();
    texels_view_ = makeTexelView(device, "local shadow lights", texels_, VK_FORMAT_R32G32B32A32_SFLOAT);
    frame_.texels(0, gpu::BINDING_LOCAL_SHADOW_LIGHTS, texels_view_);
}

void LocalShadows::layOut(const ShadowedView& scene) {
    const std::vector<Light> lights = castingLocals(scene.lights, scene.sources);
    if (lights.empty() || scene.seen.items.empty()) return;
    std::vector<std::array<glm::dvec3, 8>> seen, casting;
    for (const DrawItem& item : scene.seen.items)
        seen.push_back(
            cornersOf(item.range, glm::dmat4(glm::mat4(scene.seen.draws[item.draw].world_from_object))));
    for (const Instance& instance : scene.pose.instances) {
        const PlacedPrimitive placed = scene.geometry.placed(scene.pose, instance);
        if (placed.range.index_count == 0 || scene.materials.blends(placed.range.material)) continue;
        casting.push_back(cornersOf(placed.range, placed.world_from_object));
        for (glm::dvec3& corner : casting.back()) corner -= scene.view.eye();
    }
    atlas_ = layOutAtlas(lights, boundsOf(scene.pose, scene.geometry), seen, casting, scene.view, request_);
}

std::size_t LocalShadows::listCasters(Device& device, Uploader& uploader, const ShadowedView& scene,
                                      ShadowCasters which) {
    const glm::dvec3 eye = scene.view.eye();
    std::size_t draws = 0;
    for (const AtlasTile& tile : atlas_.tiles) {
        Map map{makeCasterList(scene.pose, scene.geometry, scene.materials,
                               {.clip_from_world = atlas_.clipFromWorld(tile, eye),
                                .eye = eye,
                                .all = which == ShadowCasters::all}),
                {}};
        if (which == ShadowCasters::needed) cullBeyond(map.casters, atlas_, tile, eye);
        draws += map.casters.items.size();
        map.draws = makeBuffer<gpu::Draw>(device, uploader, "casters", map.casters.draws,
                                          VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
        maps_.push_back(std::move(map));
    }
    return draws;
}

void LocalShadows::specialise(Variant& variant) const {
    if (any())
        variant.set(gpu::FEATURE_local_shadows, kinds_)
            .set(gpu::FEATURE_shadow_kernel, static_cast<gpu::uint>(request_.kernel));
}

void LocalShadows::addPasses(PassList& passes, const FrameInputs& inputs) {
    if (!draws()) return;
    const auto side = static_cast<std::uint32_t>(atlas_.side);
    image_ = passes.image({.name = "local shadow maps",
                           .format = depthFormat,
                           .extent = {side, side},
                           .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT,  // tests fill texels outside tiles
                           .array = true});
    std::vector<std::function<void(VkCommandBuffer)>> draws;
    for (const Map& map : maps_) draws.push_back(recordCasters(inputs, map.casters, map.draws.handle()));
    inputs.posing.read(passes, passes.draw("local shadow maps"))
        .depth(image_, Load::clear)
        .record([this, draws = std::move(draws)](VkCommandBuffer commands) {
            for (std::size_t i = 0; i < draws.size(); ++i) {
                const AtlasTile& tile = atlas_.tiles[i];
                const auto size = static_cast<float>(tile.size);
                const VkViewport viewport{
                    static_cast<float>(tile.corner.x), static_cast<float>(tile.corner.y), size, size, 0, 1};
                const auto texels = static_cast<std::uint32_t>(tile.size);
                const VkRect2D scissor{{tile.corner.x, tile.corner.y}, {texels, texels}};
                vkCmdSetViewport(commands, 0, 1, &viewport);
                vkCmdSetScissor(commands, 0, 1, &scissor);
                draws[i](commands);
            }
        });
    frame_.image(0, gpu::BINDING_LOCAL_SHADOW_MAP, passes.view(image_), nearest_,
                 VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
}

void LocalShadows::read(Pass& pass, VkPipelineStageFlags2 stages) const {
    if (draws()) pass.samples(image_, stages);
}

std::uint64_t LocalShadows::bytes() const {
    std::uint64_t sum = texels_.size();
    for (const Map& map : maps_) sum += map.draws.size();
    return sum;
}

double LocalShadows::filterRadius() const {
    double radius = 0;
    for (const AtlasTile& tile : atlas_.tiles) radius = std::max(radius, marginOf(request_) / tile.texels);
    return radius;
}

}  // namespace diptych
