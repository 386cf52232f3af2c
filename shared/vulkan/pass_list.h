// SPDX-License-Identifier: MIT
// A frame as a list of passes that run in written order. What a pass declares (attachments, and every other
// use of an image or a buffer) gives its barriers, its labels, its times and the memory the frame takes.
#pragma once

#include "shared/vulkan/frames_in_flight.h"
#include "shared/vulkan/pass.h"
#include "shared/vulkan/resources.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace diptych {

struct PassResource;

struct PassMs {
    std::string name;
    double ms = 0;
};

// What the passes of one name do in a frame: counted by the device, and moved by what they declare.
struct PassCounts {
    std::string name;
    std::uint64_t vertices = 0;   // shaded
    std::uint64_t triangles = 0;  // that reach clipping
    std::uint64_t samples = 0;    // that pass the depth test, in drawing order
    std::uint64_t fragments = 0;  // pixels' worth of these where colour is drawn: about what is shaded
    std::uint64_t outputs = 0;    // values that samples write to attachments, depth not among them
    std::uint64_t compute = 0;    // invocations of compute shaders
    // Of what is declared, each part once: attachments, images, buffers; bytes. Textures, vertices and other
    // buffers that no pass of the frame writes are not declared.
    std::uint64_t read = 0, written = 0;
};

// A barrier as it was recorded, by name, for tests and people.
struct RecordedBarrier {
    std::string pass, resource;  // it stands before the pass
    Part part;
    Access from, to;
    std::size_t number;  // of the pass in the list; no_pass: it stands before a copy to the host
    bool operator==(const RecordedBarrier&) const = default;
    static constexpr std::size_t no_pass = ~std::size_t{0};
};

// One use that a pass declares, its attachments among them.
struct DeclaredUse {
    std::string pass, resource;
    Access access;
    Part part;
    std::size_t number;  // of the pass in the list
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

    // All levels and layers; and a part of them, as shaders that write it bind it. A transient has views from
    // Pass::prepare() on.
    VkImageView view(ImageRef image) const;
    VkImageView view(ImageRef image, const Part& part);
    VkFormat format(ImageRef image) const;
    VkImage handle(ImageRef image) const;

    Pass& draw(const std::string& name);
    Pass& compute(const std::string& name);
    Pass& copy(const std::string& name);  // transfer commands

    // How many passes there are so far: where those that come next begin.
    std::size_t size() const { return passes_.size(); }

    // Runs passes [first, last), and waits. Returns milliseconds: time stamps on a GPU; on a CPU device,
    // whose time stamps are wrong, the clock from submit to fence. Kept images hold what earlier runs left.
    // In one submit, but for what Pass::takes() longer than the device may be kept busy for.
    double run(std::size_t first, std::size_t last);
    double run() { return run(0, size()); }

    // The same, passes of one name that follow each other together in a submit of their own on a CPU device
    // (between time stamps on a GPU).
    std::vector<PassMs> profile(std::size_t first, std::size_t last);

    // Runs passes [first, last), and waits: passes of one name that follow each other together, as profile()
    // has them. Throws std::runtime_error where the device has no pipeline statistics.
    std::vector<PassCounts> count(std::size_t first, std::size_t last);

    // How long the host took to record the commands of the last run() or profile(), ms. Not part of its time.
    double recordMs() const { return record_ms_; }

    // The whole list as one submit that is not waited for; nothing is timed, and nothing comes in bands.
    void enqueue(FramesInFlight& frames);

    // Images as the last run left them, row 0 on top: the first `components` floats of every texel of one
    // level and layer, side by side. Copied in one submit, as far as staging memory of 64 MiB allows, and
    // unpacked on all cores. Of transients only those alive at the last pass that ran.
    struct ReadBack {
        ImageRef image;
        int components = 1;
        Slice slice{};
        int first = 0;  // component
    };
    std::vector<std::vector<float>> readBack(std::span<const ReadBack> requests);
    // The same into memory of the caller's, as many floats each.
    void readBack(std::span<const ReadBack> requests, std::span<const std::span<float>> into);

    // Hashes every buffer that compute passes of [first, last) write, as the last run left it; by name.
    // Buffers of one name share a hash.
    std::map<std::string, std::size_t> kernelResults(std::size_t first, std::size_t last);

    // One name for passes of the same name that follow each other.
    std::vector<std::string> names() const;
    // What a pixel of the image takes, all its samples and layers, bytes; and what one takes in all images of
    // the list's size together, as if none shared memory.
    std::uint64_t pixelBytes(ImageRef image) const;
    std::uint64_t pixelBytes() const;
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
    using Resource = PassResource;
    struct Span {  // passes [first, last) of one name
        std::size_t first, last;
    };
    // A pass or a band of its rows, as part of a span.
    struct Piece {
        std::size_t pass, span;
        std::uint32_t band = 0, bands = 1;
        double ms = 0;
    };
    Resource& resource(ImageRef image) const;
    std::vector<Use> usesOf(const Pass& pass) const;
    VkExtent2D extentOf(const Pass& pass) const;
    VkImageView attachmentView(ImageRef image, const Slice& slice);
    void barriersBefore(std::size_t pass, const std::vector<Use>& uses, VkCommandBuffer commands);
    void beginLives(BarrierTracker& tracker, std::size_t pass) const;
    void prepare(std::size_t first, std::size_t last);
    std::vector<Span> spans(std::size_t first, std::size_t last) const;
    std::vector<Piece> pieces(const std::vector<Span>& spans) const;
    std::string describe(const std::vector<Piece>& pieces) const;
    static Pass::Rows rowsOf(std::uint32_t rows, const Piece& piece);
    void runPiece(const Piece& piece, VkCommandBuffer commands);
    void renderPass(const Pass& pass, const Piece& piece, VkCommandBuffer commands);
    std::vector<double> runSpans(const std::vector<Span>& spans);
    void submit(const std::vector<Piece>& pieces, std::vector<double>& ms);
    void addTraffic(const Pass& pass, PassCounts& counts) const;
    std::uint64_t samplesOf(const Pass& pass) const;
    void copyToHost(std::span<const ReadBack> requests, std::span<const std::span<float>> into);

    Device& device_;
    std::uint32_t width_, height_;
    BarrierTracker tracker_;
    std::vector<std::unique_ptr<Resource>> resources_;  // images and buffers, by their number in tracker_
    std::vector<std::unique_ptr<Pass>> passes_;
    std::vector<bool> prepared_;      // by pass
    std::vector<Allocation> blocks_;  // memory of transients
    std::uint64_t shared_bytes_ = 0;
    double record_ms_ = 0;
    std::size_t last_run_ = ~std::size_t{0};  // the pass that ran last
    std::vector<RecordedBarrier> recorded_;
};

}  // namespace diptych
