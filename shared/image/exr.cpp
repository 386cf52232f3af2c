// SPDX-License-Identifier: MIT
#include "shared/image/exr.h"

#include "shared/image/atomic_file.h"

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

// R, G, B, A and X, Y, Z in this order, other names after them by the alphabet.
std::pair<std::size_t, std::string> componentRank(const std::string& component) {
    constexpr std::string_view letters = "RGBAXYZ";
    const std::size_t at = component.size() == 1 ? letters.find(component[0]) : std::string_view::npos;
    return {std::min(at, letters.size()), component};
}

std::vector<ExrLayer> readLayers(const std::filesystem::path& file) {
    Imf::InputFile in(file.c_str());
    const Imath::Box2i display = in.header().displayWindow(), window = in.header().dataWindow();
    const auto side = [](int low, int high) { return static_cast<std::int64_t>(high) - low + 1; };
    const std::int64_t width = side(display.min.x, display.max.x),
                       height = side(display.min.y, display.max.y),
                       storedWidth = side(window.min.x, window.max.x),
                       storedHeight = side(window.min.y, window.max.y);

    std::map<std::string, std::vector<std::string>> layers;
    double channels = 0;
    for (auto c = in.header().channels().begin(); c != in.header().channels().end(); ++c) {
        if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
            throw std::runtime_error(fmt::format("channel {} is subsampled, which is not read", c.name()));
        const std::string name = c.name();
        const std::size_t dot = name.rfind('.');
        layers[dot == std::string::npos ? "" : name.substr(0, dot)].push_back(name);
        ++channels;
    }
    // Deflate shrinks at most 1032:1; what claims to be far larger than that is broken, not compressed.
    const double claimed = static_cast<double>(std::max(width, storedWidth)) *
                           static_cast<double>(std::max(height, storedHeight)) * channels * sizeof(float);
    if (claimed > 2000.0 * static_cast<double>(std::filesystem::file_size(file)) + 0x1p26)
        throw std::runtime_error(fmt::format("claims {}x{} pixels but is too short for them", width, height));

    std::vector<ExrLayer> result;
    for (auto& [name, names] : layers) {
        const std::size_t prefix = name.empty() ? 0 : name.size() + 1;
        std::ranges::sort(names, {}, [&](const std::string& n) { return componentRank(n.substr(prefix)); });
        const int components = static_cast<int>(names.size());
        result.push_back(
            {name, names, Image(static_cast<int>(storedWidth), static_cast<int>(storedHeight), components)});
    }
    Imf::FrameBuffer buffer;
    for (ExrLayer& layer : result)
        for (int c = 0; c < layer.image.components; ++c) {
            Imf::Slice s = slice(layer.image.data.data() + c, layer.image.components, layer.image.width);
            s.base -= static_cast<std::ptrdiff_t>(s.xStride) * window.min.x +
                      static_cast<std::ptrdiff_t>(s.yStride) * window.min.y;
            buffer.insert(layer.channels[static_cast<std::size_t>(c)], s);
        }
    in.setFrameBuffer(buffer);
    in.readPixels(window.min.y, window.max.y);
    if (window == display) return result;

    for (ExrLayer& layer : result) {
        Image whole(static_cast<int>(width), static_cast<int>(height), layer.image.components);
        for (int y = std::max(window.min.y, display.min.y); y <= std::min(window.max.y, display.max.y); ++y)
            for (int x = std::max(window.min.x, display.min.x); x <= std::min(window.max.x, display.max.x);
                 ++x)
                for (int c = 0; c < whole.components; ++c)
                    whole.at(x - display.min.x, y - display.min.y, c) =
                        layer.image.at(x - window.min.x, y - window.min.y, c);
        layer.image = std::move(whole);
    }
    return result;
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

std::vector<ExrLayer> readExr(const std::filesystem::path& file) {
    useAllCores();
    try {
        return readLayers(file);
    } catch (const std::bad_alloc&) {
        throw std::runtime_error(file.string() + ": too large for this machine's memory");
    } catch (const std::exception& error) {
        throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
    }
}

}  // namespace diptych
