// SPDX-License-Identifier: MIT
#include "shared/image/claims.h"
#include "shared/image/exr.h"
#include "shared/image/exr_header.h"
#include "shared/image/exr_threads.h"
#include "shared/image/file_bytes.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

namespace diptych {

void exr::useAllCores() {
    static const bool once = [] {
        Imf::setGlobalThreadCount(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
        return true;
    }();
    static_cast<void>(once);
}

namespace {

// The file in memory, with its beginning replaced.
class MemoryStream : public Imf::IStream {
public:
    MemoryStream(std::span<const std::byte> beginning, std::span<const std::byte> file)
        : IStream("EXR"), beginning_(beginning), file_(file) {}

    // As for a file stream: false at the end of the file.
    bool read(char* to, int count) override {
        const auto size = static_cast<std::size_t>(std::max(count, 0));
        if (size > file_.size() - std::min(at_, file_.size())) throw std::runtime_error("is cut short");
        const std::size_t replaced = at_ < beginning_.size() ? std::min(size, beginning_.size() - at_) : 0;
        std::copy_n(reinterpret_cast<const char*>(beginning_.data()) + at_, replaced, to);
        std::copy_n(reinterpret_cast<const char*>(file_.data()) + at_ + replaced, size - replaced,
                    to + replaced);
        at_ += size;
        return at_ < file_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override { at_ = position; }

private:
    std::span<const std::byte> beginning_, file_;
    std::uint64_t at_ = 0;
};

// ---- layers ------------------------------------------------------------------------------------------

// Rank of a component in the order R, G, B, A, X, Y, Z, U, V, ignoring case; others come last.
std::size_t componentRank(std::string component) {
    std::ranges::transform(component, component.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    constexpr std::array<std::string_view, 4> words{"red", "green", "blue", "alpha"};
    constexpr std::string_view letters = "rgbaxyzuv";
    const auto word = std::ranges::find(words, component);
    if (word != words.end()) return static_cast<std::size_t>(word - words.begin());
    return component.size() == 1 ? std::min(letters.find(component[0]), letters.size()) : letters.size();
}

// A layer, and name and type of its channels in the file.
struct Layer {
    ImageLayer image;
    std::vector<ExrChannel> stored{};
    // Values of the uint channels, by channel.
    std::vector<std::vector<std::uint32_t>> numbers{};
};

// The layer's name, prefixed by the part's name unless it already is.
std::string fullName(const std::string& part, const std::string& layer) {
    if (part.empty() || layer == part || layer.starts_with(part + ".")) return layer;
    return layer.empty() ? part : part + "." + layer;
}

std::string sampleOf(const std::vector<ExrChannel>& channels) {
    constexpr std::array<const char*, 3> names{"uint", "half", "float"};
    const ExrSample first = channels[0].sample;
    const bool mixed = std::ranges::any_of(channels, [&](const ExrChannel& c) { return c.sample != first; });
    return mixed ? "mixed" : names.at(static_cast<std::size_t>(first));
}

// Groups channels by their names before the last dot, sorted; does not read pixels. A leading dot makes no
// layer: ".R" is R unless R exists.
std::vector<Layer> layersOf(const ExrPart& part) {
    std::map<std::string, std::vector<ExrChannel>> byName;
    for (const ExrChannel& channel : part.channels) {
        const std::size_t dot = channel.name.rfind('.');
        byName[dot == std::string::npos ? "" : channel.name.substr(0, dot)].push_back(channel);
    }
    const auto isThere = [&](const std::string& name) {
        return std::ranges::count(part.channels, name, &ExrChannel::name) > 0;
    };
    std::vector<Layer> layers;
    for (auto& [name, channels] : byName) {
        const auto component = [&](const ExrChannel& channel) {
            const std::size_t dot = channel.name.rfind('.');
            const std::string behind = channel.name.substr(dot + 1);
            return dot == 0 && isThere(behind) ? channel.name : behind;
        };
        std::ranges::stable_sort(channels, {},
                                 [&](const ExrChannel& c) { return componentRank(component(c)); });
        Layer layer{{fullName(part.name, name), {}, sampleOf(channels), {}}, channels};
        for (const ExrChannel& channel : channels)
            layer.image.channels.push_back(
                layer.image.name.empty() ? component(channel) : layer.image.name + "." + component(channel));
        layers.push_back(std::move(layer));
    }
    return layers;
}

// ---- pixels ------------------------------------------------------------------------------------------

// Crops or pads `stored` to the display window; missing pixels are 0.
template <class Values>
Values displayed(const Values& stored, std::size_t components, const ExrWindow& data,
                 const ExrWindow& display) {
    const auto offset = [&](const ExrWindow& in, std::int64_t x, std::int64_t y) {
        return static_cast<std::size_t>((y - in.min_y) * in.width() + x - in.min_x) * components;
    };
    Values whole(static_cast<std::size_t>(display.width() * display.height()) * components);
    const std::int32_t left = std::max(data.min_x, display.min_x),
                       right = std::min(data.max_x, display.max_x);
    if (left > right) return whole;
    for (std::int32_t y = std::max(data.min_y, display.min_y); y <= std::min(data.max_y, display.max_y); ++y)
        std::copy_n(stored.data() + offset(data, left, y),
                    static_cast<std::size_t>(right - left + 1) * components,
                    whole.data() + offset(display, left, y));
    return whole;
}

// Allocates the pixels of `window`, and returns the slices of the data window in them.
Imf::FrameBuffer makeRoom(std::vector<Layer>& layers, const ExrWindow& data, const ExrWindow& window) {
    const Imath::Box2i origin(Imath::V2i(data.min_x, data.min_y), Imath::V2i(data.max_x, data.max_y));
    const int x = data.min_x - window.min_x, y = data.min_y - window.min_y;
    Imf::FrameBuffer buffer;
    const auto insert = [&](const std::string& name, Imf::PixelType type, void* first,
                            std::size_t components) {
        constexpr std::size_t number = sizeof(float);
        static_assert(sizeof(float) == sizeof(std::uint32_t));
        buffer.insert(name, Imf::Slice::Make(type, first, origin, number * components,
                                             number * components * static_cast<std::size_t>(window.width())));
    };
    for (Layer& layer : layers) {
        const std::size_t components = layer.stored.size();
        Image& image = layer.image.image;
        image = Image(static_cast<int>(window.width()), static_cast<int>(window.height()),
                      static_cast<int>(components));
        layer.numbers.resize(components);
        for (std::size_t c = 0; c < components; ++c) {
            const std::string& name = layer.stored[c].name;
            if (layer.stored[c].sample == ExrSample::uint) {
                layer.numbers[c].resize(image.pixels());
                insert(name, Imf::UINT, layer.numbers[c].data() + image.offset(x, y) / components, 1);
            } else {
                insert(name, Imf::FLOAT, image.data.data() + image.offset(x, y, static_cast<int>(c)),
                       components);
            }
        }
    }
    return buffer;
}

// Converts the integers to float32; keeps them if rounding changed any.
void convertNumbers(Layer& layer) {
    Image& image = layer.image.image;
    bool rounded = false;
    for (std::size_t c = 0; c < layer.numbers.size(); ++c) {
        std::vector<std::uint32_t>& numbers = layer.numbers[c];
        bool exact = true;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const auto value = static_cast<float>(numbers[i]);
            image.pixel(i)[c] = value;
            exact = exact && static_cast<std::uint64_t>(value) == numbers[i];
        }
        if (exact) std::vector<std::uint32_t>().swap(numbers);
        rounded = rounded || !exact;
    }
    if (rounded) layer.image.exact = std::move(layer.numbers);
}

void crop(Layer& layer, const ExrWindow& data, const ExrWindow& display) {
    Image& image = layer.image.image;
    image.data = displayed(image.data, layer.stored.size(), data, display);
    image.width = static_cast<int>(display.width());
    image.height = static_cast<int>(display.height());
    for (std::vector<std::uint32_t>& numbers : layer.numbers)
        if (!numbers.empty()) numbers = displayed(numbers, 1, data, display);
}

std::vector<Layer> readPart(Imf::MultiPartInputFile& file, const ExrPart& part, const ExrWindow& display) {
    Imf::InputPart in(file, part.index);
    const Imath::Box2i window = in.header().dataWindow();
    if (ExrWindow{window.min.x, window.min.y, window.max.x, window.max.y} != part.data)
        throw std::runtime_error("its data window is ambiguous");
    // If the display window contains the data window, pixels are read in place. Otherwise they are read
    // and then cropped.
    const bool direct = display.holds(part.data);
    std::vector<Layer> layers = layersOf(part);
    in.setFrameBuffer(makeRoom(layers, part.data, direct ? display : part.data));
    in.readPixels(window.min.y, window.max.y);
    for (Layer& layer : layers) {
        if (!direct) crop(layer, part.data, display);
        convertNumbers(layer);
    }
    return layers;
}

// Two parts can give the same full name.
void checkNames(const std::vector<ImageLayer>& layers) {
    std::set<std::string_view> names;
    for (const ImageLayer& layer : layers)
        for (const std::string& name : layer.channels)
            if (!names.insert(name).second)
                throw std::runtime_error("channel " + oneLine(name) + ": appears in two parts");
}

ImageFile readParts(std::span<const std::byte> file, std::uint64_t max, std::string_view asked) {
    ExrHeader header = readExrHeader(file, max, asked);
    MemoryStream stream(header.bytes, file);
    // One thread per MiB: small images are read before another thread has started.
    std::uint64_t useful = 0, chunk = 0;
    for (const ExrPart& part : header.parts) {
        useful = std::max(useful, part.stored_bytes >> 20);
        chunk = std::max(chunk, part.chunk_bytes);
    }
    const std::uint64_t threads = std::min<std::uint64_t>(useful, std::thread::hardware_concurrency());
    // OpenEXR has two buffers a thread, each with its decompressor's.
    const Claim claim =
        claimMemory(3 * std::max<std::uint64_t>(2 * threads, 1) * chunk, file.size(), "decoding its blocks");
    Imf::MultiPartInputFile in(stream, static_cast<int>(threads));
    ImageFile image{static_cast<int>(header.display.width()),
                    static_cast<int>(header.display.height()),
                    "OpenEXR",
                    false,
                    {},
                    std::move(header.attributes),
                    std::move(header.notes)};
    for (const ExrPart& part : header.parts) {
        if (part.data != header.display) {
            auto& notes = header.display.holds(part.data) ? image.notes.lines : image.notes.in_part;
            notes.push_back(fmt::format(
                "{}its data window is {}x{} at {},{}, its display window {}x{} at {},{}; missing pixels are "
                "0",
                part.name.empty() ? "" : "part \"" + oneLine(part.name, 60) + "\": ", part.data.width(),
                part.data.height(), part.data.min_x, part.data.min_y, header.display.width(),
                header.display.height(), header.display.min_x, header.display.min_y));
        }
        const auto read = [&] { return readPart(in, part, header.display); };
        std::vector<Layer> layers =
            part.name.empty() ? read() : named("part \"" + oneLine(part.name, 60) + "\"", read);
        for (Layer& layer : layers) {
            layer.image.to_rec709 = part.to_rec709;
            image.layers.push_back(std::move(layer.image));
        }
        in.flushPartCache();  // frees its buffers
    }
    checkNames(image.layers);
    return image;
}

}  // namespace

ImageFile readExr(std::span<const std::byte> bytes, const std::string& name, std::uint64_t max,
                  std::string_view part) {
    exr::useAllCores();
    return named(name, [&] { return readParts(bytes, max, part); });
}

ImageFile readExr(const std::filesystem::path& file) {
    return readExr(std::as_bytes(std::span<const unsigned char>(bytesOf(file))), file.string());
}

}  // namespace diptych
