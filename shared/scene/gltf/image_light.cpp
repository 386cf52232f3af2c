// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/image_light.h"

#include "shared/scene/gltf/accessor.h"
#include "shared/scene/gltf/limits.h"
#include "shared/scene/gltf/model.h"
#include "shared/scene/gltf/resources.h"
#include "shared/scene/gltf/value.h"
#include "shared/scene/image/cube_map.h"
#include "shared/scene/image/decode.h"
#include "shared/scene/image/environment.h"
#include "shared/scene/lights/json_fields.h"
#include "shared/text/fail.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

namespace diptych::gltf {

namespace {

using Json = nlohmann::json;

constexpr const char* imageLightExtension = "EXT_lights_image_based";

// As for other lights' intensity: its product with any texel is finite.
constexpr double maxImageIntensity = 1e12;
// Six faces and their lat-long image take 700 MiB, as much as an image of 8192 x 4096.
constexpr int largestFace = 2048;

ImageLight lightOf(const Json& json, std::size_t images, const std::string& who) {
    const JsonFields fields(json, who);
    ImageLight light{.who = who};
    light.intensity = fields.number("intensity", 1, 0, maxImageIntensity);
    if (fields.find("rotation")) {
        std::array<double, 4> r{};
        fields.numbers("rotation", r);
        const glm::dquat q(r[3], r[0], r[1], r[2]);
        const double length = glm::length(q);
        if (!(length > 0) || !std::isfinite(length)) fields.fail("rotation", "has no direction");
        light.rotation = q / length;
    }
    const Json* mips = fields.find("specularImages");
    if (!mips || !mips->is_array() || mips->empty() || !mips->front().is_array() ||
        mips->front().size() != light.images.size())
        fields.fail("specularImages", "is not an array of mip levels with 6 images each");
    for (std::size_t face = 0; face < light.images.size(); ++face)
        light.images[face] = indexBelow(mips->front()[face], images,
                                        fmt::format("{}: specularImages: image of face {}", who, face));
    return light;
}

// Errors do not name the light.
Image faceOf(const Model& model, const Resources& resources, int index, std::vector<std::string>& notes) {
    const tinygltf::Image& image = model.images[static_cast<std::size_t>(index)];
    const std::string who = fmt::format("image {}", index);
    std::vector<unsigned char> file;
    std::span<const unsigned char> bytes;
    if (image.bufferView >= 0) bytes = viewBytes(model, image.bufferView);
    try {
        if (image.bufferView < 0 && !image.uri.empty()) {
            std::vector<std::string> found;
            file = resources.read(image.uri, MAX_ENCODED_IMAGE_BYTES, found);
            bytes = file;
            for (const std::string& note : found) notes.push_back(fmt::format("{}: {}", who, note));
        }
        if (bytes.empty()) fail("has no uri or bufferView, or is empty");
        const ImageHeader header = imageHeader(bytes);
        if (header.width != header.height || header.width > largestFace)
            fail(fmt::format("has {} x {} pixels; cube faces must be square, up to {} per side", header.width,
                             header.height, largestFace));
        return decodedRgbd(decodeImage(bytes));
    } catch (const std::runtime_error& e) {
        fail(who, e.what());
    }
}

}  // namespace

ImageLights takeImageLights(Json& document) {
    ImageLights result;
    const Json root = takeExtension(document, imageLightExtension);
    const std::size_t scenes = arrayAt(document, "/scenes").size(),
                      count = arrayAt(document, "/images").size();
    for (std::size_t scene = 0; scene < scenes; ++scene) {
        const Json use = takeExtension(document["scenes"][scene], imageLightExtension);
        const std::string fault = faultOf([&] {
            if (use.is_null()) return;
            const std::string who = fmt::format("scene {}: {}", scene, imageLightExtension);
            if (!use.is_object() || !use.contains("light")) fail(who, "names no light");
            const Json& lights = arrayAt(root, "/lights");
            const int light = indexBelow(use["light"], lights.size(), who + ": light");
            result.scenes.emplace(scene, lightOf(lights[static_cast<std::size_t>(light)], count,
                                                 fmt::format("{}: light {}", imageLightExtension, light)));
        });
        if (!fault.empty()) result.notes.push_back(fault + ": left out");
    }
    return result;
}

std::optional<Environment> readImageLight(const ImageLights& lights, std::size_t index, const Model& model,
                                          const Resources& resources, std::vector<std::string>& notes) {
    const auto found = lights.scenes.find(index);
    if (found == lights.scenes.end()) return {};
    const ImageLight& light = found->second;
    try {
        CubeMap cube;
        for (std::size_t face = 0; face < cube.faces.size(); ++face) {
            cube.faces[face] = faceOf(model, resources, light.images[face], notes);
            if (face > 0 && cube.faces[face].width != cube.faces[0].width)
                fail(fmt::format("image {}", light.images[face]),
                     fmt::format("has {} pixels per side, but the first face {}", cube.faces[face].width,
                                 cube.faces[0].width));
        }
        cube.side = cube.faces[0].width;
        for (Image& face : cube.faces)
            for (float& value : face.data) value = static_cast<float>(double{value} * light.intensity);
        // The rotation applies to the environment, so lookups rotate inversely.
        Environment environment{light.who, latLongOf(cube, glm::mat3_cast(glm::conjugate(light.rotation)))};
        limitRadiance(environment.radiance, light.who, notes);
        return environment;
    } catch (const std::runtime_error& e) {
        notes.push_back(fmt::format("{}: {}: left out", light.who, e.what()));
        return {};
    }
}

}  // namespace diptych::gltf
