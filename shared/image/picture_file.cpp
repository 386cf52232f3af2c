// SPDX-License-Identifier: MIT
#include "shared/image/picture_file.h"

#include "shared/image/exr.h"
#include "shared/image/file_bytes.h"
#include "shared/image/jpeg_decoder.h"
#include "shared/image/pfm.h"
#include "shared/image/png.h"
#include "shared/image/radiance.h"
#include "shared/image/tiff.h"
#include "shared/text/named.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace diptych {
namespace {

PictureFile ofOneLayer(std::string format, std::string sample, Image image) {
    static const std::vector<std::vector<std::string>> names{
        {}, {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
    PictureFile file{image.width, image.height, std::move(format), false, {}};
    const auto components = static_cast<std::size_t>(image.components);
    file.layers.push_back({"", names.at(components), std::move(sample), std::move(image)});
    return file;
}

PictureFile pictureOfPng(std::span<const std::byte> bytes, const std::string& name, std::uint64_t most) {
    PngPicture png = readPngPicture(bytes, name, most);
    PictureFile file = ofOneLayer("PNG", png.bits == 16 ? "16 bit" : "8 bit", std::move(png.image));
    file.display_referred = !png.linear;
    file.notes = std::move(png.notes);
    return file;
}

PictureFile pictureOfTiff(std::span<const std::byte> bytes, const std::string& name, std::uint64_t most) {
    TiffPicture tiff = readTiff(bytes, name, most);
    PictureFile file = ofOneLayer("TIFF", tiff.sample, std::move(tiff.image));
    file.display_referred = !tiff.linear;
    file.notes = std::move(tiff.notes);
    return file;
}

// The values of a JPEG without colour conversion: value / 255. It has no alpha.
PictureFile pictureOfJpeg(std::span<const std::byte> bytes, const std::string& name, std::uint64_t most) {
    return named(name, [&] {
        const std::span encoded(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
        const JpegSize size = readJpegSize(encoded);
        const int components = size.grey ? 1 : 3;
        // Beside the floats there are the decoded bytes, RGBA.
        checkImageSize(size.width, size.height, std::int64_t{sizeof(float)} * components + 4, most);
        if (size.width * size.height / jpeg_pixels_per_byte > static_cast<std::int64_t>(bytes.size()))
            failToHold(size.width, size.height, bytes.size());
        Image image(static_cast<int>(size.width), static_cast<int>(size.height), components);
        std::vector<unsigned char> rgba(4 * image.pixels());
        readJpegRgba(encoded, size, rgba.data());
        for (std::size_t i = 0; i < image.pixels(); ++i)
            for (int c = 0; c < components; ++c)
                image.pixel(i)[c] = static_cast<float>(rgba[4 * i + static_cast<std::size_t>(c)]) / 255.0f;
        PictureFile file = ofOneLayer("JPEG", "8 bit", std::move(image));
        file.display_referred = true;
        return file;
    });
}

PictureFile pictureOfPfm(std::span<const std::byte> bytes, const std::string& name, std::uint64_t most) {
    PfmPicture pfm = readPfm(bytes, name, most);
    PictureFile file = ofOneLayer("PFM", "float", std::move(pfm.image));
    if (pfm.behind > 0)
        file.notes.push_back(fmt::format("{} bytes behind its pixels are not read", pfm.behind));
    if (pfm.scale != 1)
        file.notes.push_back(
            fmt::format("its values were multiplied by the {} that its header says", pfm.scale));
    return file;
}

}  // namespace

PictureFile readPicture(std::span<const std::byte> bytes, const std::string& name, std::string_view part,
                        std::uint64_t most) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\x76\x2f\x31\x01")) return readExr(bytes, name, most, part);
    const bool png = text.starts_with("\x89PNG\r\n\x1a\n"), hdr = text.starts_with("#?"),
               pfm = text.starts_with("PF") || text.starts_with("Pf"), tiff = isTiff(bytes),
               jpeg = text.starts_with("\xff\xd8\xff");
    if (!png && !hdr && !pfm && !tiff && !jpeg)
        throw std::runtime_error(
            name +
            ": is no picture that is read: by their first bytes OpenEXR, PNG, JPEG, TIFF, Radiance HDR and "
            "PFM are");
    if (!part.empty()) throw std::runtime_error(name + ": has no parts, which are an OpenEXR file's");
    if (png) return pictureOfPng(bytes, name, most);
    if (tiff) return pictureOfTiff(bytes, name, most);
    if (jpeg) return pictureOfJpeg(bytes, name, most);
    if (hdr) return ofOneLayer("Radiance HDR", "RGBE", readHdr(bytes, name, most));
    return pictureOfPfm(bytes, name, most);
}

PictureFile readPicture(const std::filesystem::path& file, std::string_view part) {
    return readPicture(std::as_bytes(std::span<const unsigned char>(bytesOf(file))), file.string(), part);
}

}  // namespace diptych
