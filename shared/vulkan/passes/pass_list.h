// SPDX-License-Identifier: MIT
// A frame as a list of passes that run in written order. Barriers, labels, timings and memory follow from
// the attachments and other uses that passes declare.
#pragma once

#include "shared/vulkan/device/frames_in_flight.h"
#include "shared/vulkan/device/resources.h"
#include "shared/vulkan/passes/pass.h"

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

// Workload of the passes of one name in a frame: counted by the device, and traffic from declarations.
struct PassCounts {
    std::string name;
    std::uint64_t vertices = 0;   // vertex shader invocations
    std::uint64_t triangles = 0;  // triangles that reach clipping
    std::uint64_t samples = 0;    // samples that pass the depth test, in drawing order
    std::uint64_t fragments = 0;  // these samples in pixels, for colour passes: about the number of shaded
                                  // fragments
    std::uint64_t outputs = 0;    // values written to colour attachments by samples
    std::uint64_t compute = 0;    // compute shader invocations
    // Bytes of declared attachments, images and buffers, each part once. Excludes textures, vertices and
    // other buffers that no pass of the frame writes, because they are not declared.
    std::uint64_t read = 0, written = 0;
};

// A recorded barrier by names, for tests and people.
struct RecordedBarrier {
    std::string pass, resource;  // pass: the one after the barrier
    Part part;
    Access from, to;
    std::size_t number;  // index of the pass in the list; no_pass: before a copy to the CPU
    bool operator==(const RecordedBarrier&) const = default;
    static constexpr std::size_t no_pass = ~std::size_t{0};
};

// One declared use, attachments included.
struct DeclaredUse {
    std::string pass, resource;
    Access access;
    Part part;
    std::size_t number;  // index of the pass in the list
};

class PassList {
public:
    // `width`, `height`: default size of images.
    PassList(Device& device, std::uint32_t width, std::uint32_t height);
    ~PassList();
    PassList(const PassList&) = delete;
    PassList& operator=(const PassList&) = delete;

    ImageRef image(const ImageDeclaration& declaration);
    // An image of the list's size that can be drawn to, tested, sampled and read back.
    ImageRef image(const std::string& name, VkFormat format) {
        return image({.name = name, .format = format});
    }
    // An external buffer, filled by earlier submits; must outlive the list. Declaring it again returns the
    // same resource.
    BufferRef buffer(const std::string& name, const GpuBuffer& buffer);

    // View of all levels and layers, or of one part, for shaders that write it. Transients have views from
    // Pass::prepare() on.
    VkImageView view(ImageRef image) const;
    VkImageView view(ImageRef image, const Part& part);
    VkFormat format(ImageRef image) const;
    VkImage handle(ImageRef image) const;

    Pass& draw(const std::string& name);
    Pass& compute(const std::string& name);
    Pass& copy(const std::string& name);  // transfer commands

    // Number of passes so far; the index of the next one.
    std::size_t size() const { return passes_.size(); }

    // Runs passes [first, last) and waits. Returns milliseconds: from time stamps on a GPU, or from submit
    // to fence on a CPU device, whose time stamps are wrong. Kept images have the contents of earlier
    // runs. Uses one submit, unless Pass::takes() requires bands.
    double run(std::size_t first, std::size_t last);
    double run() { return run(0, size()); }

    // The same per group of consecutive passes with one name; on a CPU device each group has its own
    // submit.
    std::vector<PassMs> profile(std::size_t first, std::size_t last);

    // Runs passes [first, last), counts their workload and waits; groups passes as profile() does. Throws
    // std::runtime_error if the device does not support pipeline statistics.
    std::vector<PassCounts> count(std::size_t first, std::size_t last);

    // CPU time to record the last run() or profile(), ms; not part of its result.
    double recordMs() const { return record_ms_; }

    // Submits the whole list without waiting, timing or bands.
    void enqueue(FramesInFlight& frames);

    // Contents of images after the last run, top row first: `components` floats of every texel of one
    // level and layer, interleaved. Copies in one submit per 64 MiB of staging memory and unpacks on all
    // cores. Transients must be alive at the last pass that ran.
    struct ReadBack {
        ImageRef image;
        int components = 1;
        Slice slice{};
        int first = 0;  // first component
    };
    std::vector<std::vector<float>> readBack(std::span<const ReadBack> requests);
    // The same into the caller's memory, of the same size.
    void readBack(std::span<const ReadBack> requests, std::span<const std::span<float>> into);

    // Hashes of buffers that compute passes of [first, last) write, after the last run, by name. Buffers
    // with the same name share a hash.
    std::map<std::string, std::size_t> kernelResults(std::size_t first, std::size_t last);

    // Names of groups of consecutive passes.
    std::vector<std::string> names() const;
    // Bytes per pixel of the image, over all samples, layers and mip levels; and the sum over all images
    // whose size depends on the list's, without memory sharing.
    std::uint64_t pixelBytes(ImageRef image) const;
    std::uint64_t pixelBytes() const;
    // Bytes of all images without memory sharing; and the bytes saved by it, after allocate() or a run.
    std::uint64_t imageBytes() const;
    std::uint64_t sharedBytes() const { return shared_bytes_; }
    // Allocates memory for all images; run() calls it. Transients of one call share memory.
    void allocate();
    // Barriers of the last run() or profile(), in order.
    const std::vector<RecordedBarrier>& barriers() const { return recorded_; }
    // All declarations, pass by pass; and the barriers of `runs` runs of the whole list from undefined
    // contents, without the declarations of these indices. Records no commands.
    std::vector<DeclaredUse> declarations() const;
    std::vector<RecordedBarrier> plannedBarriers(int runs, const std::set<std::size_t>& without = {}) const;
    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }

private:
    using Resource = PassResource;
    struct Span {  // passes [first, last) with one name
        std::size_t first, last;
    };
    // A pass, or a band of its rows, in a span.
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
    std::vector<std::unique_ptr<Resource>> resources_;  // images and buffers, by their index in tracker_
    std::vector<std::unique_ptr<Pass>> passes_;
    std::vector<bool> prepared_;      // by pass
    std::vector<Allocation> blocks_;  // memory of transients
    std::uint64_t shared_bytes_ = 0;
    double record_ms_ = 0;
    std::size_t last_run_ = ~std::size_t{0};  // index of the last pass that ran
    std::vector<RecordedBarrier> recorded_;
};

}  // namespace diptych
