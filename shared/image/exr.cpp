// SPDX-License-Identifier: MIT
#include "shared/image/exr.h"

#include "shared/image/atomic_file.h"
#include "shared/image/exr_threads.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <stdexcept>

namespace diptych {
namespace {

// zlib's fastest level. The library's default, 4, takes a fifth longer for files of the same size within 1
// %.
constexpr int zipLevel = 1;

// Rows written at a time: whole ZIP blocks of 16 rows, enough for all cores.
constexpr int bandRows = 16 * 8;

// Imf::OutputFile's destructor writes the offset table and ignores errors; AtomicFile's stream remembers
// them until commit().
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

}  // namespace

void writeExr(const std::filesystem::path& file, const std::vector<ExrLayerView>& layers,
              const std::vector<ExrAttribute>& attributes) {
    exr::useAllCores();
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
            // Imf::Slice takes non-const pointers for reading and writing; writing does not change the
            // pixels.
            buffer.insert(name, slice(const_cast<float*>(image->data.data()) + c, image->components, width));
        }
    }
    AtomicFile out(file);
    try {
        Stream stream(out.stream(), file.string());
        Imf::OutputFile exr(stream, header);
        exr.setFrameBuffer(buffer);
        for (int row = 0; row < height; row += bandRows) {
            exr.writePixels(std::min(bandRows, height - row));
            for (const ExrLayerView& layer : layers) letGo(layer.image->data);
        }
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        if (std::ferror(out.stream())) out.commit();  // throws with the system's message
        throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
    }
    out.commit();
}

}  // namespace diptych
