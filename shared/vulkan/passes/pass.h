// SPDX-License-Identifier: MIT
// One pass of a frame and its declarations.
#pragma once

#include "shared/vulkan/passes/barriers.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

struct ImageRef {
    std::size_t index = ~std::size_t{0};
    bool valid() const { return index != ~std::size_t{0}; }
};
struct BufferRef {
    std::size_t index = ~std::size_t{0};
    bool valid() const { return index != ~std::size_t{0}; }
};

enum class Load { clear, keep };  // keep: contents from an earlier pass

// How long an image's contents are needed. kept: until the next run. transient: from its first to its last
// pass in a run. Transients with disjoint lifetimes share memory; they can be read back only before a
// later pass has run.
enum class Life { kept, transient };

// Viewport depths of clip-space depth 0 and 1, and the cleared value of a depth image. Depth is reversed.
// farthest is just above the cleared value, to distinguish geometry on the far plane; it changes no other
// depth.
struct StoredDepths {
    float farthest = 1e-37f, nearest = 1.0f, cleared = 0.0f;
};

struct ImageDeclaration {
    std::string name;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D extent{};  // 0 x 0: the list's size
    std::uint32_t layers = 1, levels = 1;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    VkImageUsageFlags usage = 0;  // in addition to attachment, sampled and, for kept images, transfer
                                  // source
    Life life = Life::kept;
    bool array = false;        // shaders read it as an array, even with one layer
    bool drawn = true;         // false: never an attachment
    bool filtered = false;     // shaders filter it linearly
    bool with_image = false;   // its own size depends on the list's
    StoredDepths depths = {};  // for depth images
};

// One level of one layer, as an attachment.
struct Slice {
    std::uint32_t level = 0, layer = 0;
    bool operator==(const Slice&) const = default;
};

// A pass, declared by chaining. Draws are recorded inside rendering, with viewport and scissor set to the
// attachments' extent; compute and copy passes outside.
class Pass {
public:
    // Call in order of the shader's output locations. `resolved`: single-sample image for the mean of the
    // samples.
    Pass& color(ImageRef image, Load load, VkClearColorValue clear = {}, Slice slice = {},
                ImageRef resolved = {});
    // Depth test with writes; cleared to the value in its StoredDepths. `resolved`: single-sample image
    // for the first sample.
    Pass& depth(ImageRef image, Load load, Slice slice = {}, ImageRef resolved = {});
    Pass& depthTest(ImageRef image, Slice slice = {});  // depth test without writes
    // Area of a draw without attachments; otherwise the list's size.
    Pass& covers(VkExtent2D extent);
    // Sampled by these shader stages: all levels and layers, or one part.
    Pass& samples(ImageRef image, VkPipelineStageFlags2 stages);
    Pass& samples(ImageRef image, VkPipelineStageFlags2 stages, const Part& part);
    // Any other use of access.h. `discards`: the part is fully overwritten.
    Pass& uses(ImageRef image, const Access& access, const Part& part, bool discards = false);
    Pass& uses(BufferRef buffer, const Access& access);

    // Called once before the pass is first recorded, when all images have memory, for example to write
    // descriptors. Several callbacks run in the order of their declaration.
    Pass& prepare(std::function<void()> make);
    // Estimated time of the draw or dispatch, ms. If it exceeds DeviceProfile::longest_submit_ms, the pass
    // is split into bands of rows with a submit each, and its commands are recorded once per band. Without
    // an estimate it is never split.
    Pass& takes(double ms);
    // Called on every run, for each band. Must not change the scissor.
    Pass& record(std::function<void(VkCommandBuffer)> commands);
    // For a compute pass whose dispatch has this many rows of workgroups, which may be split into bands:
    // called for each band with its rows.
    struct Rows {
        std::uint32_t first, count;
    };
    Pass& recordRows(std::uint32_t rows, std::function<void(VkCommandBuffer, const Rows&)> commands);

private:
    friend class PassList;
    enum class Kind { draw, compute, copy };
    struct Attachment {
        ImageRef image;
        Load load = Load::clear;
        VkClearValue clear{};
        Slice slice{};
        ImageRef resolved{};
    };
    struct ImageUse {
        ImageRef image;
        Access access;
        Part part;
        bool whole = false;  // all levels and layers
        bool discards = false;
    };
    std::string name_;
    Kind kind_ = Kind::draw;
    std::vector<Attachment> colors_;
    Attachment depth_;
    bool depth_writes_ = false;
    VkExtent2D covered_{};
    std::vector<ImageUse> images_;
    std::vector<std::pair<BufferRef, Access>> buffers_;
    std::function<void()> prepare_;
    double ms_ = 0;
    std::function<void(VkCommandBuffer)> record_;
    std::uint32_t rows_ = 1;  // of record_rows_
    std::function<void(VkCommandBuffer, const Rows&)> record_rows_;
};

}  // namespace diptych
