// SPDX-License-Identifier: MIT
// One pass of a frame and all that it may declare.
#pragma once

#include "shared/vulkan/barriers.h"

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

enum class Load { clear, keep };  // keep: an attachment's contents from an earlier pass

// How long an image's contents are needed. A transient has them from its first pass in a run to its last:
// images whose lives do not overlap share memory, and nothing may be read back once another pass has run.
enum class Life { kept, transient };

// What the viewport maps depth 0 and depth 1 of clip space to, and what a depth image holds where nothing was
// drawn. Depth is reversed: what lies exactly on the far plane gets the least depth above what was cleared;
// everything else is unchanged, being far larger.
struct StoredDepths {
    float farthest = 1e-37f, nearest = 1.0f, cleared = 0.0f;
};

struct ImageDeclaration {
    std::string name;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D extent{};  // 0 x 0: the list's
    std::uint32_t layers = 1, levels = 1;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    VkImageUsageFlags usage = 0;  // beside attachment, sampled and, of kept images, copied from
    Life life = Life::kept;
    bool array = false;         // shaders read it as an array, even of one layer
    bool drawn = true;          // false: no pass draws to it
    bool filtered = false;      // shaders filter it linearly
    bool with_picture = false;  // of a size of its own that grows with the list's
    StoredDepths depths = {};   // of a depth image
};

// One level of one layer, to draw to.
struct Slice {
    std::uint32_t level = 0, layer = 0;
    bool operator==(const Slice&) const = default;
};

// One pass, declared by chaining. A draw is recorded between begin and end of rendering, with viewport and
// scissor set to the extent of its attachments; a compute or copy pass outside of rendering.
class Pass {
public:
    // In the order of the shader's locations. `resolved`: an image of one sample that gets the mean of the
    // samples.
    Pass& color(ImageRef image, Load load, VkClearColorValue clear = {}, Slice slice = {},
                ImageRef resolved = {});
    // Read and written; cleared to what its StoredDepths says. `resolved`: an image of one sample that gets
    // the first of the samples.
    Pass& depth(ImageRef image, Load load, Slice slice = {}, ImageRef resolved = {});
    Pass& depthTest(ImageRef image, Slice slice = {});  // read by the test only
    // What a draw without attachments covers; otherwise the list's size.
    Pass& covers(VkExtent2D extent);
    // Read by texture instructions of these shaders: all levels and layers, or one part.
    Pass& samples(ImageRef image, VkPipelineStageFlags2 stages);
    Pass& samples(ImageRef image, VkPipelineStageFlags2 stages, const Part& part);
    // Any other use of access.h. `discards`: everything that the part held is overwritten.
    Pass& uses(ImageRef image, const Access& access, const Part& part, bool discards = false);
    Pass& uses(BufferRef buffer, const Access& access);

    // Called once before the pass is recorded for the first time, when all images have memory: makes what
    // holds views. Several are called in the order that they were given in.
    Pass& prepare(std::function<void()> make);
    // About how long a draw takes on this device, or a dispatch of rows, ms. One that takes longer than a
    // device may be kept busy for (DeviceProfile::longest_submit_ms) is drawn in bands of rows, each in a
    // submit of its own: its commands are recorded once a band. Not stated: never divided.
    Pass& takes(double ms);
    // Called every time the list runs, for each band. Leaves the scissor as it is.
    Pass& record(std::function<void(VkCommandBuffer)> commands);
    // Of a compute pass whose dispatch has so many rows of workgroups, which may come in bands as those of a
    // draw do: called for each with its rows.
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
