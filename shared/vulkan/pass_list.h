// SPDX-License-Identifier: MIT
// A frame as a list of passes that run in written order. What a pass declares (attachments, images read)
// gives its barriers, its labels, its times and the memory the frame takes.
#pragma once

#include "shared/vulkan/resources.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace diptych {

struct ImageRef {
    std::size_t index = ~std::size_t{0};
    bool valid() const { return index != ~std::size_t{0}; }
};

enum class Load { clear, keep };  // keep: an attachment's contents from an earlier pass

// One pass, declared by chaining. `record` is called every time the list runs: for a draw between begin and
// end of rendering, with viewport and scissor set to the list's size; for a compute pass outside of
// rendering, and what it writes to buffers is visible to every later pass.
class Pass {
public:
    // In the order of the shader's locations.
    Pass& color(ImageRef image, Load load, VkClearColorValue clear = {});
    Pass& depth(ImageRef image, Load load, float clear = 0.0f);  // read and written
    Pass& depthTest(ImageRef image);                             // read by the test only
    Pass& samples(ImageRef image);                               // read in a fragment or compute shader
    Pass& record(std::function<void(VkCommandBuffer)> commands);

private:
    friend class PassList;
    struct Attachment {
        ImageRef image;
        Load load = Load::clear;
        VkClearValue clear{};
    };
    std::string name_;
    std::vector<Attachment> colors_;
    Attachment depth_;
    bool depth_writes_ = false;
    bool computes_ = false;
    std::vector<ImageRef> sampled_;
    std::function<void(VkCommandBuffer)> record_;
};

struct PassMs {
    std::string name;
    double ms = 0;
};

class PassList {
public:
    PassList(Device& device, std::uint32_t width, std::uint32_t height);
    PassList(const PassList&) = delete;
    PassList& operator=(const PassList&) = delete;

    // An image of the list's size that passes can draw to, test, sample and read back.
    ImageRef image(const std::string& name, VkFormat format);
    VkImageView view(ImageRef image) const;
    VkFormat format(ImageRef image) const { return resources_.at(image.index).image.info().format; }

    Pass& draw(const std::string& name);
    Pass& compute(const std::string& name);

    // How many passes there are so far: where those that come next begin.
    std::size_t size() const { return passes_.size(); }

    // Runs passes [first, last) in one submit. Returns milliseconds: time stamps on a GPU; on a CPU device,
    // whose time stamps are wrong, the clock from submit to fence. Images keep what earlier runs left.
    double run(std::size_t first, std::size_t last);
    double run() { return run(0, size()); }

    // The same, each pass in a submit of its own on a CPU device (between time stamps on a GPU).
    std::vector<PassMs> profile(std::size_t first, std::size_t last);

    // Images as the last run left them, row 0 on top: the first `components` float32 of every texel, side by
    // side. Copied in one submit, as far as staging memory of 256 MiB allows, and unpacked on all cores.
    struct ReadBack {
        ImageRef image;
        int components = 1;
    };
    std::vector<std::vector<float>> readBack(std::span<const ReadBack> requests);

    std::vector<std::string> names() const;
    std::uint64_t imageBytes() const;
    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }

private:
    struct Resource {
        GpuImage image;
        ImageState state;
    };
    void transition(std::vector<VkImageMemoryBarrier2>& barriers, ImageRef image, const ImageState& to,
                    bool discard);
    void runPass(const Pass& pass, VkCommandBuffer commands);
    std::vector<double> runWithTimestamps(std::size_t first, std::size_t last);
    void copyToHost(std::span<const ReadBack> requests, std::span<std::vector<float>> results);

    Device& device_;
    std::uint32_t width_, height_;
    std::vector<Resource> resources_;
    std::vector<std::unique_ptr<Pass>> passes_;
};

}  // namespace diptych
