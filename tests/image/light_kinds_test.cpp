// SPDX-License-Identifier: MIT
// Every kind of light in every assignment, in both paths and in the reference: its closed form up to its
// range, and its shadow.
#include "tests/support/light_kinds.h"
#include "tests/image/square.h"
#include "tests/support/light_formulas.h"

#include <numbers>

namespace diptych::tests {
namespace {

class LightOf : public testing::TestWithParam<LightKind> {
protected:
    // A white Lambertian square 2 m below a light of the kind. All others, which need the same pipelines, end
    // far above it or shine from below.
    static Scene lit(float range) {
        Scene scene = square();
        scene.materials[0].metallic = scene.materials[0].specular = 0;
        for (const LightKind kind : everyLightKind()) {
            const bool tested = kind == GetParam();
            Light light;
            light.kind = kind;
            light.intensity = tested ? 10 : 1;
            light.position = {0, 0, tested ? 2 : 100};
            if (kind == LightKind::directional)
                light.direction = {0, 0, tested ? -1 : 1};
            else
                light.range = tested ? range : 1;
            scene.lights.push_back(light);
        }
        return scene;
    }

    // `seen`: of the light's irradiance.
    static void expectIn(Renderer& renderer, const Scene& scene, const Settings& settings, double seen = 1) {
        SCOPED_TRACE(std::string(nameOf(settings.path)) + ", " + std::string(nameOf(settings.assign)));
        const Frame frame = renderer.draw(settings, untimed({Channel::lit}));
        // Area lights err by 2e-5 of a sky of their radiance (AreaShapes).
        const float tolerance = isArea(GetParam()) ? 2e-4f : 5 * float32;
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) {
                Light light = scene.lights[indexOf(GetParam())];
                light.position -= glm::dvec3(x - 1.5, 1.5 - y, 0) * 0.5;
                const double expected = seen * irradianceFrom(light, {0, 0, 1}) / std::numbers::pi;
                expectColor(colorAt(frame, Channel::lit, x, y), glm::vec3(static_cast<float>(expected)),
                            expected > 0 ? tolerance : 0, frame.name);
            }
    }

    static Settings fourPixels(Path path) {
        Settings settings = smallImage(GBufferEncoding::full);
        settings.size = {4, 4};
        settings.path = path;
        settings.area_lights = AreaLights::ltc;
        return settings;
    }
};

TEST_P(LightOf, IsItsClosedFormUpToItsRange) {
    for (const float range : {std::numeric_limits<float>::infinity(), 4.0f, 1.9f}) {
        SCOPED_TRACE(range);
        const Scene scene = lit(range);
        Renderer renderer(device(), scene, pipelines());
        expectIn(renderer, scene, fourPixels(Path::reference));
        for (const Path path : {Path::deferred, Path::forward_plus})
            for (const Assignment assign :
                 {Assignment::every, Assignment::tiled, Assignment::clustered, Assignment::per_object}) {
                Settings settings = fourPixels(path);
                settings.assign = assign;
                if (assign == Assignment::per_object) settings.pixel_lights = 1 << 20;
                if (assign != Assignment::per_object || path == Path::forward_plus)
                    expectIn(renderer, scene, settings);
            }
    }
}

// Area lights cast none.
TEST_P(LightOf, HasItsShadow) {
    Scene scene = lit(4);
    scene.meshes[0].primitives.push_back(rectangle({-1.5, -1.5, 1.5}, {3, 0, 0}, {0, 3, 0}));
    Renderer renderer(device(), scene, pipelines());
    for (const Path path : {Path::reference, Path::deferred, Path::forward_plus}) {
        Settings settings = with(fourPixels(path), "shadows pcf shadow-lights 1 shadow-size 512");
        expectIn(renderer, scene, settings, isArea(GetParam()) ? 1 : 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, LightOf, testing::ValuesIn(everyLightKind()), lightKindName);

}  // namespace
}  // namespace diptych::tests
