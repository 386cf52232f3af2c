// SPDX-License-Identifier: MIT
#include "shared/image/picture_file.h"

#include "shared/image/exr.h"
#include "shared/image/file_bytes.h"
#include "shared/image/pfm.h"
#include "shared/image/png.h"
#include "shared/image/radiance.h"
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

PictureFile pictureOfPfm(std::span<const std::byte> bytes, const std::string& name, std::uint64_t most) {
    PfmPicture pfm = readPfm(bytes, name, most);
    PictureFile file = ofOneLayer("PFM", "float", std::move(pfm.image));
    if (pfm.behind > 0)
        file.notes.push_back(fmt::format("{} bytes behind its pixels are not read", pfm.behind));
    return file;
}

}  // namespace

PictureFile readPicture(std::span<const std::byte> bytes, const std::string& name, std::string_view part,
                        std::uint64_t most) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\x76\x2f\x31\x01")) return readExr(bytes, name, most, part);
    const bool png = text.starts_with("\x89PNG\r\n\x1a\n"), hdr = text.starts_with("#?"),
               pfm = text.starts_with("PF") || text.starts_with("Pf");
    if (!png && !hdr && !pfm)
        throw std::runtime_error(
            name +
            ": is no picture that is read: by their first bytes OpenEXR, PNG, Radiance HDR and PFM are");
    if (!part.empty()) throw std::runtime_error(name + ": has no parts, which are an OpenEXR file's");
    if (png) return pictureOfPng(bytes, name, most);
    if (hdr) return ofOneLayer("Radiance HDR", "RGBE", readHdr(bytes, name, most));
    return pictureOfPfm(bytes, name, most);
}

PictureFile readPicture(const std::filesystem::path& file, std::string_view part) {
    return readPicture(std::as_bytes(std::span<const unsigned char>(bytesOf(file))), file.string(), part);
}

}  // namespace diptych
