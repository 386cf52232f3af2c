// SPDX-License-Identifier: MIT
// A frame as a list of passes that run in written order. What a pass declares (attachments, and every other
// use of an image or a buffer) gives its barriers, its labels, its times and the memory the frame takes.
#pragma once

#include "shared/vulkan/barriers.h"
#include "shared/vulkan/resources.h"

#include <functional>
#include <memory>
#include <set>
#include <span>
#include <string>
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

struct ImageDeclaration {
    std::string name;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D extent{};  // 0 x 0: the list's
    std::uint32_t layers = 1, levels = 1;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    VkImageUsageFlags usage = 0;  // beside attachment, sampled and, of kept images, copied from
    Life life = Life::kept;
};

// One level of one layer, to draw to.
struct Slice {
    std::uint32_t level = 0, layer = 0;
};

// One pass, declared by chaining. A draw is recorded between begin and end of rendering, with viewport and
// scissor set to the extent of its attachments; a compute or copy pass outside of rendering.
class Pass {
public:
    // In the order of the shader's locations. `resolved`: an image of one sample that gets the mean of the
    // samples.
    Pass& color(ImageRef image, Load load, VkClearColorValue clear = {}, Slice slice = {},
                ImageRef resolved = {});
    Pass& depth(ImageRef image, Load load, float clear = 0.0f, Slice slice = {});  // read and written
    Pass& depthTest(ImageRef image, Slice slice = {});                             // read by the test only
    // Read by texture instructions of these shaders: all levels and layers, or one part.
    Pass& samples(ImageRef image, VkPipelineStageFlags2 stages);
    Pass& samples(ImageRef image, VkPipelineStageFlags2 stages, const Part& part);
    // Any other use of access.h. `discards`: everything that the part held is overwritten.
    Pass& uses(ImageRef image, const Access& access, const Part& part, bool discards = false);
    Pass& uses(BufferRef buffer, const Access& access);

    // Called once before the pass is recorded for the first time, when all images have memory: makes what
    // holds views.
    Pass& prepare(std::function<void()> make);
    // Called every time the list runs.
    Pass& record(std::function<void(VkCommandBuffer)> commands);

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
    std::vector<ImageUse> images_;
    std::vector<std::pair<BufferRef, Access>> buffers_;
    std::function<void()> prepare_;
    std::function<void(VkCommandBuffer)> record_;
};

struct PassMs {
    std::string name;
    double ms = 0;
};

// A barrier as it was recorded, by name, for tests and people.
struct RecordedBarrier {
    std::string pass, resource;  // it stands before the pass
    Part part;
    Access from, to;
    bool operator==(const RecordedBarrier&) const = default;
};

// One use that a pass declares, its attachments among them.
struct DeclaredUse {
    std::string pass, resource;
    Access access;
};

class PassList {
public:
    // `width`, `height`: of images that do not say otherwise.
    PassList(Device& device, std::uint32_t width, std::uint32_t height);
    ~PassList();
    PassList(const PassList&) = delete;
    PassList& operator=(const PassList&) = delete;

    ImageRef image(const ImageDeclaration& declaration);
    // An image of the list's size that passes can draw to, test, sample and read back.
    ImageRef image(const std::string& name, VkFormat format) {
        return image({.name = name, .format = format});
    }
    // Somebody else's buffer, which must outlive the list and has been filled by earlier submits; declared
    // again, the same buffer is the same resource.
    BufferRef buffer(const std::string& name, const GpuBuffer& buffer);

    // All levels and layers; one of them to be drawn to. A transient has views from Pass::prepare() on.
    VkImageView view(ImageRef image) const;
    VkFormat format(ImageRef image) const;

    Pass& draw(const std::string& name);
    Pass& compute(const std::string& name);
    Pass& copy(const std::string& name);  // transfer commands

    // How many passes there are so far: where those that come next begin.
    std::size_t size() const { return passes_.size(); }

    // Runs passes [first, last) in one submit. Returns milliseconds: time stamps on a GPU; on a CPU device,
    // whose time stamps are wrong, the clock from submit to fence. Kept images hold what earlier runs left.
    double run(std::size_t first, std::size_t last);
    double run() { return run(0, size()); }

    // The same, passes of one name that follow each other together in a submit of their own on a CPU device
    // (between time stamps on a GPU).
    std::vector<PassMs> profile(std::size_t first, std::size_t last);

    // Images as the last run left them, row 0 on top: the first `components` float32 of every texel, side by
    // side. Copied in one submit, as far as staging memory of 64 MiB allows, and unpacked on all cores. Of
    // transients only those that the last pass that ran had.
    struct ReadBack {
        ImageRef image;
        int components = 1;
    };
    std::vector<std::vector<float>> readBack(std::span<const ReadBack> requests);
    // The same into memory of the caller's, width x height x components each.
    void readBack(std::span<const ReadBack> requests, std::span<const std::span<float>> into);

    // One name for passes of the same name that follow each other.
    std::vector<std::string> names() const;
    // Texels of all images, as if none shared memory; and what sharing saves of that, once the list has run
    // or been allocated.
    std::uint64_t imageBytes() const;
    std::uint64_t sharedBytes() const { return shared_bytes_; }
    // Gives every image memory; run() does so itself. Transients of one call share memory with each other.
    void allocate();
    // Those of the last run() or profile(), in order.
    const std::vector<RecordedBarrier>& barriers() const { return recorded_; }
    // Every declaration, pass by pass; and the barriers of `runs` runs of the whole list, one after the
    // other, from undefined contents on, as if the declarations of these numbers were not there. Records
    // nothing.
    std::vector<DeclaredUse> declarations() const;
    std::vector<RecordedBarrier> plannedBarriers(int runs, const std::set<std::size_t>& without = {}) const;
    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }

private:
    struct Resource;
    struct Span {  // passes [first, last) of one name
        std::size_t first, last;
    };
    Resource& resource(ImageRef image) const;
    std::vector<Use> usesOf(const Pass& pass) const;
    VkImageView attachmentView(ImageRef image, const Slice& slice);
    void barriersBefore(const Pass& pass, const std::vector<Use>& uses, VkCommandBuffer commands);
    void beginLives(BarrierTracker& tracker, std::size_t pass) const;
    void runPass(std::size_t index, VkCommandBuffer commands);
    void renderPass(const Pass& pass, VkCommandBuffer commands);
    void prepare(std::size_t first, std::size_t last);
    std::vector<Span> spans(std::size_t first, std::size_t last) const;
    std::vector<double> runWithTimestamps(const std::vector<Span>& spans);
    void copyToHost(std::span<const ReadBack> requests, std::span<const std::span<float>> into);

    Device& device_;
    std::uint32_t width_, height_;
    BarrierTracker tracker_;
    std::vector<std::unique_ptr<Resource>> resources_;  // images and buffers, by their number in tracker_
    std::vector<std::unique_ptr<Pass>> passes_;
    std::vector<bool> prepared_;      // by pass
    std::vector<Allocation> blocks_;  // memory of transients
    std::uint64_t shared_bytes_ = 0;
    std::size_t last_run_ = ~std::size_t{0};  // the pass that ran last
    std::vector<RecordedBarrier> recorded_;
};

}  // namespace diptych
