// SPDX-License-Identifier: MIT
// Deferred lighting by tiles: if the G-buffer stores layers, a variant without them shades the tiles that
// have none (shared/contract/lighting_tiles.h).
#pragma once

#include "shared/contract/lighting_tiles.h"
#include "shared/draw/record.h"

#include <array>
#include <vector>

namespace diptych {

// Contents of FrameImages::tiles: offsets in bytes, of a class's first element.
struct TileLayout {
    explicit TileLayout(const PassList& passes);

    glm::uvec2 size;       // tiles across, down
    gpu::uint tiles;       // in all
    gpu::uint dispatches;  // of a class

    VkDeviceSize draw(gpu::uint of) const { return of * sizeof(gpu::TileDraw); }
    VkDeviceSize dispatch(gpu::uint of) const {
        return draw(gpu::TILE_CLASSES) + VkDeviceSize{of} * dispatches * sizeof(gpu::TileDispatch);
    }
    VkDeviceSize list(gpu::uint of) const {
        return dispatch(gpu::TILE_CLASSES) + VkDeviceSize{of} * tiles * sizeof(gpu::uint);
    }
    VkDeviceSize classes() const { return list(gpu::TILE_CLASSES); }
    VkDeviceSize bytes() const { return classes() + VkDeviceSize{tiles} * sizeof(gpu::uint); }
};

// Adds the passes that classify and list the image's tiles, and sets images.tiles. Neither if the G-buffer
// stores no layers, or all surfaces that are drawn to it have some.
void addTiles(PassList& passes, const FrameInputs& inputs, FrameImages& images);

// The variants that shade the classes of tiles instead of `variant`, which shades any pixel.
std::array<Variant, gpu::TILE_CLASSES> tileVariants(const Variant& variant);

// Declares that the pass shades all tiles, by draws (inVertex) or dispatches (inCompute). `pipelines`: by
// class.
TiledLighting readTiles(PassList& passes, Pass& pass, const FrameImages& images, VkPipelineStageFlags2 stage,
                        const std::vector<Pipeline>& pipelines);

}  // namespace diptych
