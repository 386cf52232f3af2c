// SPDX-License-Identifier: MIT
#include "shared/image/exr.h"

#include "shared/image/atomic_file.h"
#include "shared/image/exr_header.h"
#include "shared/image/file_bytes.h"
#include "shared/text/named.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <new>
#include <stdexcept>
#include <thread>

namespace diptych {
namespace {

// zlib's level, the fastest: the library's own 4 takes a fifth longer for files as large within 1 %.
constexpr int zipLevel = 1;

void useAllCores() {
    static const bool once = [] {
        Imf::setGlobalThreadCount(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
        return true;
    }();
    static_cast<void>(once);
}

// Imf::OutputFile's destructor writes the offset table and swallows what goes wrong there; the stream of an
// AtomicFile remembers it until the commit.
class Stream : public Imf::OStream {
public:
    Stream(std::FILE* stream, const std::string& name) : OStream(name.c_str()), stream_(stream) {}
    void write(const char* bytes, int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (std::fwrite(bytes, 1, size, stream_) != size) throw std::runtime_error("cannot be written");
    }
    std::uint64_t tellp() override { return static_cast<std::uint64_t>(::ftello(stream_)); }
    void seekp(std::uint64_t position) override {
        if (::fseeko(stream_, static_cast<off_t>(position), SEEK_SET) != 0)
            throw std::runtime_error("cannot be written");
    }

private:
    std::FILE* stream_;
};

Imf::Slice slice(float* component, int components, int width) {
    const std::size_t x = sizeof(float) * static_cast<std::size_t>(components);
    return {Imf::FLOAT, reinterpret_cast<char*>(component), x, x * static_cast<std::size_t>(width)};
}

// The file from memory, its beginning replaced.
class MemoryStream : public Imf::IStream {
public:
    MemoryStream(std::span<const std::byte> beginning, std::span<const std::byte> file)
        : IStream("EXR"), beginning_(beginning), file_(file) {}

    // Like a file's: false where nothing comes after what was read.
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

// R, G, B, A and X, Y, Z in this order, other names after them by the alphabet.
std::pair<std::size_t, std::string> componentRank(const std::string& component) {
    constexpr std::string_view letters = "RGBAXYZ";
    const std::size_t at = component.size() == 1 ? letters.find(component[0]) : std::string_view::npos;
    return {std::min(at, letters.size()), component};
}

// By the part of their names before the last dot.
std::vector<ExrLayer> emptyLayers(const ExrHeader& header) {
    std::map<std::string, std::vector<std::string>> layers;
    for (const std::string& name : header.channels) {
        const std::size_t dot = name.rfind('.');
        layers[dot == std::string::npos ? "" : name.substr(0, dot)].push_back(name);
    }
    std::vector<ExrLayer> result;
    for (auto& [name, names] : layers) {
        const std::size_t prefix = name.empty() ? 0 : name.size() + 1;
        std::ranges::sort(names, {}, [&](const std::string& n) { return componentRank(n.substr(prefix)); });
        const int components = static_cast<int>(names.size());
        result.push_back({name, names,
                          Image(static_cast<int>(header.data.width()), static_cast<int>(header.data.height()),
                                components)});
    }
    return result;
}

// The part of `stored` that the display window shows, 0 where nothing is stored.
Image displayed(const Image& stored, const ExrWindow& data, const ExrWindow& display) {
    Image whole(static_cast<int>(display.width()), static_cast<int>(display.height()), stored.components);
    const std::int32_t left = std::max(data.min_x, display.min_x),
                       right = std::min(data.max_x, display.max_x);
    if (left > right) return whole;
    for (std::int32_t y = std::max(data.min_y, display.min_y); y <= std::min(data.max_y, display.max_y);
         ++y) {
        const float* row = stored.data.data() + stored.offset(left - data.min_x, y - data.min_y);
        std::copy_n(row,
                    static_cast<std::size_t>(right - left + 1) * static_cast<std::size_t>(stored.components),
                    whole.data.data() + whole.offset(left - display.min_x, y - display.min_y));
    }
    return whole;
}

std::vector<ExrLayer> readLayers(std::span<const std::byte> file, std::uint64_t most) {
    const ExrHeader header = readExrHeader(file, most);
    MemoryStream stream(header.bytes, file);
    // A thread for every MiB: small pictures are done before another one has woken.
    const std::uint64_t useful = header.stored_bytes >> 20;
    Imf::InputFile in(stream,
                      static_cast<int>(std::min<std::uint64_t>(useful, std::thread::hardware_concurrency())));
    const Imath::Box2i window = in.header().dataWindow();
    if (ExrWindow{window.min.x, window.min.y, window.max.x, window.max.y} != header.data)
        throw std::runtime_error("its data window can be read in two ways");

    std::vector<ExrLayer> layers = emptyLayers(header);
    Imf::FrameBuffer buffer;
    for (ExrLayer& layer : layers)
        for (int c = 0; c < layer.image.components; ++c) {
            const std::size_t pixel = sizeof(float) * static_cast<std::size_t>(layer.image.components);
            buffer.insert(layer.channels[static_cast<std::size_t>(c)],
                          Imf::Slice::Make(Imf::FLOAT, layer.image.data.data() + c, window, pixel,
                                           pixel * static_cast<std::size_t>(layer.image.width)));
        }
    in.setFrameBuffer(buffer);
    in.readPixels(window.min.y, window.max.y);
    if (header.data != header.display)
        for (ExrLayer& layer : layers) layer.image = displayed(layer.image, header.data, header.display);
    return layers;
}

}  // namespace

void writeExr(const std::filesystem::path& file, const std::vector<ExrLayerView>& layers,
              const std::vector<ExrAttribute>& attributes) {
    useAllCores();
    if (layers.empty()) throw std::runtime_error(file.string() + ": an EXR needs a layer");
    const int width = layers[0].image->width, height = layers[0].image->height;
    Imf::Header header(width, height);
    header.compression() = Imf::ZIP_COMPRESSION;
    header.zipCompressionLevel() = zipLevel;
    for (const ExrAttribute& attribute : attributes)
        header.insert(attribute.name, Imf::StringAttribute(attribute.value));
    Imf::FrameBuffer buffer;
    for (const auto& [channels, image] : layers) {
        if (image->width != width || image->height != height ||
            image->components != static_cast<int>(channels.size()))
            throw std::runtime_error(fmt::format(
                "{}: layer {} is {}x{}x{}, not {}x{}x{}", file.string(), channels.empty() ? "" : channels[0],
                image->width, image->height, image->components, width, height, channels.size()));
        for (int c = 0; c < image->components; ++c) {
            const std::string& name = channels[static_cast<std::size_t>(c)];
            if (header.channels().findChannel(name))
                throw std::runtime_error(fmt::format("{}: two channels are called {}", file.string(), name));
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            // A slice is the same type for reading and writing; writing does not touch the pixels.
            buffer.insert(name, slice(const_cast<float*>(image->data.data()) + c, image->components, width));
        }
    }
    AtomicFile out(file);
    try {
        Stream stream(out.stream(), file.string());
        Imf::OutputFile exr(stream, header);
        exr.setFrameBuffer(buffer);
        exr.writePixels(height);
    } catch (const std::exception& error) {
        throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
    }
    out.commit();
}

std::vector<ExrLayer> readExr(std::span<const std::byte> bytes, const std::string& name, std::uint64_t most) {
    useAllCores();
    return named(name, [&] { return readLayers(bytes, most); });
}

std::vector<ExrLayer> readExr(const std::filesystem::path& file) {
    return readExr(std::as_bytes(std::span<const unsigned char>(bytesOf(file))), file.string());
}

}  // namespace diptych
