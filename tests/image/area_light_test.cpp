// SPDX-License-Identifier: MIT
// Area lights: both paths and every assignment agree, and the LTC table is close to the reference.
#include "shared/contract/debug_mode.h"
#include "shared/scene/lights/rig.h"
#include "shared/scene/load.h"
#include "shared/scene/motion/bounds.h"
#include "tests/image/scenes.h"

namespace diptych::tests {
namespace {

Frame drawAreas(Renderer& renderer, Path path, AreaLights how, Assignment assign) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = {161, 91};
    settings.path = path;
    settings.assign = assign;
    settings.area_lights = how;
    return renderer.draw(settings, untimed({Channel::lit, Channel::lit_diffuse, Channel::lit_specular}));
}

TEST(AreaLightImages, BothPathsAndEveryListAgree) {
    Scene scene = loadScene("builtin:areas");
    const Pose pose = poseAt(scene, 0);
    for (const Light& light : makeLights("area:30,point:9,spot:5", 7, boundsAtStart(scene, pose)))
        scene.lights.push_back(light);
    Renderer renderer(device(), scene, pipelines());
    for (const AreaLights how : {AreaLights::ltc, AreaLights::representative}) {
        const Frame every = drawAreas(renderer, Path::forward_plus, how, Assignment::every);
        EXPECT_EQ(every.counters.nonfinite_pixels, 0u);
        for (const Path path : {Path::forward_plus, Path::deferred})
            for (const Assignment assign : {Assignment::every, Assignment::clustered, Assignment::tiled}) {
                const Frame frame = drawAreas(renderer, path, how, assign);
                for (const Channel channel : {Channel::lit, Channel::lit_diffuse, Channel::lit_specular})
                    EXPECT_EQ(differingPixels(every, frame, channel), 0u)
                        << nameOf(how) << ", " << nameOf(path) << ", " << nameOf(assign) << ", "
                        << debugMode(channel).name;
            }
    }
}

double meanError(const Frame& referenceFrame, const Frame& frame, Channel channel) {
    const Image &a = referenceFrame.channels.at(channel), &b = frame.channels.at(channel);
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < a.data.size(); ++i) {
        sum += std::abs(double{b.data[i]} - double{a.data[i]});
        all += double{a.data[i]};
    }
    return sum / all;
}

// Lambert's integral is exact. The remaining diffuse error, 0.0016, comes from the layer's Fresnel term,
// evaluated for one direction per light. The specular error, 0.023, comes from the table and is largest on
// dielectrics at grazing angles, such as the floor. The limit of 0.03 allows for other devices' rounding.
// One representative point is far worse in both.
TEST(AreaLightImages, TheTableIsNearTheReference) {
    const Scene scene = loadScene("builtin:areas");
    Renderer renderer(device(), scene, pipelines());
    const Frame referenceFrame = drawAreas(renderer, Path::reference, AreaLights::ltc, Assignment::every);
    const Frame ltc = drawAreas(renderer, Path::deferred, AreaLights::ltc, Assignment::every);
    const Frame points = drawAreas(renderer, Path::deferred, AreaLights::representative, Assignment::every);
    EXPECT_LT(meanError(referenceFrame, ltc, Channel::lit_diffuse), 0.01);
    EXPECT_LT(meanError(referenceFrame, ltc, Channel::lit_specular), 0.03);
    EXPECT_GT(meanError(referenceFrame, points, Channel::lit_diffuse),
              10 * meanError(referenceFrame, ltc, Channel::lit_diffuse));
    EXPECT_GT(meanError(referenceFrame, points, Channel::lit_specular),
              10 * meanError(referenceFrame, ltc, Channel::lit_specular));
    RecordProperty("ltc_specular", std::to_string(meanError(referenceFrame, ltc, Channel::lit_specular)));
    RecordProperty("ltc_diffuse", std::to_string(meanError(referenceFrame, ltc, Channel::lit_diffuse)));
}

// Without area lights both settings give the same bits.
TEST(AreaLightImages, TheWayChangesNothingWithoutThem) {
    const Scene scene = loadScene("builtin:points");
    Renderer renderer(device(), scene, pipelines());
    const Frame a = drawAreas(renderer, Path::deferred, AreaLights::ltc, Assignment::every);
    const Frame b = drawAreas(renderer, Path::deferred, AreaLights::representative, Assignment::every);
    EXPECT_EQ(differingPixels(a, b, Channel::lit), 0u);
}

}  // namespace
}  // namespace diptych::tests
