// SPDX-License-Identifier: MIT
// What forward+ says that the G-buffer's bits may do to light, against the reference: it shades, in double
// and by code of its own, surfaces that were moved at random within what the bits allow, here by formulas of
// the test's own.
#include "compare/reference/reference.h"
#include "compare/render/reference_frame.h"
#include "compare/verdict/pair_reports.h"
#include "shared/scene/load.h"
#include "tests/image/scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace diptych::tests {
namespace {

struct FieldBits {
    int normal, roughness, metallic;
};
// shared/contract/gbuffer.h, "compact" and "standard".
FieldBits fieldBits(GBufferEncoding encoding) {
    return encoding == GBufferEncoding::compact ? FieldBits{12, 8, 6} : FieldBits{16, 12, 8};
}

double stepHalf(int bits) {
    return 0.5 / (std::exp2(bits) - 1);
}
bool hasOwnCode(double x) {
    return x <= 0 || x >= 1;
}

// Moves every channel of a captured surface by a random share of what its bits allow, -1 to 1; mostly all of
// it, for light is moved most there.
class Mover {
public:
    // `specular`: the G-buffer stores F0 and F90 of dielectrics.
    Mover(GBufferEncoding encoding, bool specular, unsigned seed)
        : bits_(fieldBits(encoding)), specular_(specular), random_(seed) {}

    void move(Frame& surfaces) {
        const auto at = [&](gpu::uint mode) -> Image& {
            return surfaces.channels.at(static_cast<int>(mode));
        };
        for (std::size_t i = 0; i < at(gpu::DEBUG_lit).pixels(); ++i) {
            if (*at(gpu::DEBUG_material_id).pixel(i) < 0) continue;
            float *albedo = at(gpu::DEBUG_albedo).pixel(i), *f0 = at(gpu::DEBUG_dielectric_f0).pixel(i);
            const double moved = linear(*at(gpu::DEBUG_metallic).pixel(i), bits_.metallic);
            for (int c = 0; c < 3; ++c) {
                albedo[c] = static_cast<float>(root(albedo[c]));
                if (specular_) f0[c] = static_cast<float>(root(f0[c]));
            }
            *at(gpu::DEBUG_metallic).pixel(i) = static_cast<float>(moved);
            float& f90 = *at(gpu::DEBUG_dielectric_f90).pixel(i);
            if (specular_) f90 = static_cast<float>(linear(f90, 8));
            float& roughness = *at(gpu::DEBUG_roughness).pixel(i);
            roughness = static_cast<float>(linear(roughness, bits_.roughness));
            float& occlusion = *at(gpu::DEBUG_occlusion).pixel(i);
            occlusion = static_cast<float>(linear(occlusion, 8));
            turn(at(gpu::DEBUG_normals).pixel(i));
        }
    }

private:
    double share() {
        const double u = uniform_(random_);
        return u < 0.4 ? -1 : u < 0.8 ? 1 : 2 * uniform_(random_) - 1;
    }
    double linear(double x, int bits) {
        const double by = share() * stepHalf(bits);
        return hasOwnCode(x) ? x : std::clamp(x + by, 0.0, 1.0);
    }
    double root(double x) {
        const double by = share() * stepHalf(8);
        if (hasOwnCode(x)) return x;
        const double r = std::clamp(std::sqrt(x) + by, 0.0, 1.0);
        return r * r;
    }
    // By up to 3 sqrt(2) h, what an octahedron's rounding may turn a normal by.
    void turn(float* n) {
        const double h = 0.5 / (std::exp2(bits_.normal - 1) - 1),
                     angle = share() * 3 * std::numbers::sqrt2 * h;
        const double phi = 2 * std::numbers::pi * uniform_(random_);
        const glm::dvec3 v = glm::normalize(glm::dvec3(n[0], n[1], n[2]));
        const glm::dvec3 other = std::abs(v.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
        const glm::dvec3 x = glm::normalize(glm::cross(v, other)), y = glm::cross(v, x);
        const glm::dvec3 turned =
            v * std::cos(angle) + (x * std::cos(phi) + y * std::sin(phi)) * std::sin(angle);
        for (int c = 0; c < 3; ++c) n[c] = static_cast<float>(turned[c]);
    }

    FieldBits bits_;
    bool specular_;
    std::mt19937 random_;
    std::uniform_real_distribution<double> uniform_;
};

// Leaves every third pixel, diagonally: the reference's time is in pixels.
void thinOut(Frame& frame) {
    Image& id = frame.channels.at(gpu::DEBUG_material_id);
    for (int y = 0; y < id.height; ++y)
        for (int x = 0; x < id.width; ++x)
            if ((x + 2 * y) % 3 != 0) id.at(x, y) = -1;
}

class EncodingBoundReference : public testing::TestWithParam<std::string> {};

// Every moved surface's light is within the bound, at every pixel; and the bound is no multiple of what is
// really there: of eight random moves the largest comes to a third of it at the median pixel,
// where it is more than float32's rounding.
TEST_P(EncodingBoundReference, HoldsAndIsTight) {
    UploadedScene& scene = uploaded(GetParam());
    for (const GBufferEncoding encoding : {GBufferEncoding::compact, GBufferEncoding::standard}) {
        const Settings settings = smallPicture(encoding);
        Frame forward = scene.bothPaths(settings)[1];
        thinOut(forward);
        SceneViews views(scene.scene);
        const SceneView& view = views.at(viewRequest(settings));
        Settings asReference = settings;
        asReference.path = Path::reference;
        RenderOptions options;
        options.channels = {litModes.begin(), litModes.end()};
        const Frame own = drawReferenceFrame(scene.scene, view, asReference, &forward, options);
        const Coverage covered = coverage(forward, forward);
        for (const auto& [mode, bound] : forward.encoding_bound) {
            ASSERT_EQ(bound.components, 1);
            ASSERT_EQ(bound.pixels(), covered.covered.size());
        }
        std::map<int, std::vector<double>> most, rounding;
        for (const int mode : litModes)
            most[mode] = rounding[mode] = std::vector<double>(covered.covered.size());
        std::map<int, std::size_t> beyond;
        double worst = 0;
        for (unsigned seed = 1; seed <= 8; ++seed) {
            Frame surfaces = forward;
            Mover(encoding, view.needs.dielectric_specular, seed).move(surfaces);
            const Frame moved = drawReferenceFrame(scene.scene, view, asReference, &surfaces, options);
            for (const auto& [mode, bound] : forward.encoding_bound) {
                const Image &a = own.channels.at(mode), &b = moved.channels.at(mode);
                const double floor = PixelError(Metric::relative, ChannelKind::color, a, covered).floor();
                for (std::size_t i = 0; i < a.pixels(); ++i) {
                    if (!covered.covered[i]) continue;
                    double apart = 0, size = floor;
                    for (int c = 0; c < 3; ++c) {
                        apart = std::max(apart, std::abs(double{a.pixel(i)[c]} - double{b.pixel(i)[c]}));
                        size = std::max({size, double{a.pixel(i)[c]}, double{b.pixel(i)[c]}});
                    }
                    // What the verdict grants float32's shading beside it.
                    const double allowed = double{*bound.pixel(i)} + 1e-4 * size;
                    rounding[mode][i] = 1e-4 * size;
                    beyond[mode] += apart > allowed;
                    worst = std::max(worst, apart / allowed);
                    most[mode][i] = std::max(most[mode][i], apart / allowed);
                }
            }
        }
        for (const auto& [mode, bound] : forward.encoding_bound) {
            EXPECT_EQ(beyond[mode], 0u) << nameOf(encoding) << " " << debugMode(mode).name << ", " << worst;
            std::vector<double> shares;
            for (std::size_t i = 0; i < covered.covered.size(); ++i)
                if (covered.covered[i] && double{*bound.pixel(i)} > 10 * rounding[mode][i])
                    shares.push_back(most[mode][i]);
            if (shares.size() < 100) continue;
            std::ranges::nth_element(shares, shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2));
            EXPECT_GT(shares[shares.size() / 2], 1.0 / 3) << nameOf(encoding) << " " << debugMode(mode).name;
        }
    }
}

// Area lights are not here: the paths' linearly transformed cosines are another function of roughness and
// normal than the reference's integral.
// The prefix deals them out with all that draws these scenes.
INSTANTIATE_TEST_SUITE_P(Builtin, EncodingBoundReference,
                         testing::Values("builtin:gallery", "builtin:normals", "builtin:dielectrics",
                                         "builtin:ortho", "builtin:lightmaps", "builtin:spots"),
                         [](const auto& scene) { return testName(scene.param.substr(8)); });

// Faults of an encoding that reads back more than its bits can lose, in both images that used to explain each
// other: what deferred shows, and what forward+ shades from the decoded surfaces.
struct DecodingFault {
    const char* name;
    std::function<void(Frame&)> plant;  // in surfaces as they were captured
};
void PrintTo(const DecodingFault& fault, std::ostream* out) {
    *out << fault.name;
}

float* pixelOf(Frame& frame, gpu::uint mode, std::size_t i) {
    return frame.channels.at(static_cast<int>(mode)).pixel(i);
}

// lit of both paths, whose decoded surfaces have a fault. The reference shades them for both, so that they
// agree as they would on a device.
ChannelDiff litWithFault(const Settings& settings, const std::function<void(Frame&)>& plant) {
    UploadedScene& scene = uploaded("builtin:gallery");
    std::vector<Frame> frames = scene.bothPaths(settings);
    Frame surfaces = frames[1];
    plant(surfaces);
    SceneViews views(scene.scene);
    Settings asReference = settings;
    asReference.path = Path::reference;
    RenderOptions options;
    options.channels = {litModes.begin(), litModes.end()};
    const Frame faulty =
        drawReferenceFrame(scene.scene, views.at(viewRequest(settings)), asReference, &surfaces, options);
    for (const int mode : litModes) {
        frames[0].channels[mode] = faulty.channels.at(mode);
        frames[1].through_gbuffer[mode] = faulty.channels.at(mode);
    }
    const Requirements needs = requirements(scene.scene, poseAt(scene.scene, 0));
    const DeviceInfo& info = device().info();
    Report report = makeReport(frames, {needs, needs}, {info.name, info.driver, info.type});
    for (ChannelDiff& channel : report.comparisons.at(0).channels)
        if (channel.mode->number == 0) return std::move(channel);
    throw std::logic_error("no lit");
}

void expectBeyondTheBits(const ChannelDiff& channel, const char* what = "") {
    EXPECT_EQ(channel.unexplained_pixels, 0u) << "deferred equals the decoded surfaces' light";
    EXPECT_EQ(channel.verdict, Verdict::fail) << what;
    EXPECT_NE(channel.reason.find("exceeds the G-buffer's quantization bound"), std::string::npos)
        << what << channel.reason;
    ASSERT_TRUE(channel.encoding_use.has_value());
    EXPECT_GT(channel.encoding_use->used, 1.5) << what;
}

class DecodingFaults : public testing::TestWithParam<DecodingFault> {};

TEST_P(DecodingFaults, AreBeyondTheBits) {
    expectBeyondTheBits(litWithFault(smallPicture(GBufferEncoding::standard), GetParam().plant));
}

void eachSurface(Frame& frame, const std::function<void(std::size_t)>& visit) {
    for (std::size_t i = 0; i < frame.channels.at(0).pixels(); ++i)
        if (*pixelOf(frame, gpu::DEBUG_material_id, i) >= 0) visit(i);
}

const DecodingFault decodingFaults[] = {
    {"NormalsOfTwelveBits",
     [](Frame& f) {
         eachSurface(f, [&](std::size_t i) {
             float* n = pixelOf(f, gpu::DEBUG_normals, i);
             for (int c = 0; c < 3; ++c) n[c] = std::floor(n[c] * 2047 + 0.5f) / 2047;
         });
     }},
    {"RoughnessOfEightBits",
     [](Frame& f) {
         eachSurface(f, [&](std::size_t i) {
             float& r = *pixelOf(f, gpu::DEBUG_roughness, i);
             r = std::floor(r * 255 + 0.5f) / 255;
         });
     }},
    {"AlbedoWithoutItsRoot",
     [](Frame& f) {
         eachSurface(f, [&](std::size_t i) {
             float* a = pixelOf(f, gpu::DEBUG_albedo, i);
             for (int c = 0; c < 3; ++c) a[c] = std::floor(a[c] * 255 + 0.5f) / 255;
         });
     }},
    {"MetallicOfFourBits",
     [](Frame& f) {
         eachSurface(f, [&](std::size_t i) {
             float& m = *pixelOf(f, gpu::DEBUG_metallic, i);
             m = m > 0 && m < 1 ? m - 0.5f / 15 : m;
         });
     }},
};
// With formats of fewer bits than float32 more is granted, and both paths stay within it; a fault that is as
// coarse as they are does not.
TEST(EncodingBoundFormats, HoldBothPathsAndStillFindFaults) {
    const auto each = [](const std::function<void(Frame&, std::size_t)>& spoil) {
        return [spoil](Frame& f) { eachSurface(f, [&](std::size_t i) { spoil(f, i); }); };
    };
    const DecodingFault coarse[] = {{"normals of five bits", each([](Frame& f, std::size_t i) {
                                         float* n = pixelOf(f, gpu::DEBUG_normals, i);
                                         for (int c = 0; c < 3; ++c) n[c] = std::floor(n[c] * 15 + 0.5f) / 15;
                                     })},
                                    {"roughness of four bits", each([](Frame& f, std::size_t i) {
                                         float& r = *pixelOf(f, gpu::DEBUG_roughness, i);
                                         r = std::floor(r * 15 + 0.5f) / 15;
                                     })},
                                    {"albedo without its root", each([](Frame& f, std::size_t i) {
                                         float* a = pixelOf(f, gpu::DEBUG_albedo, i);
                                         for (int c = 0; c < 3; ++c) a[c] = std::sqrt(a[c]);
                                     })}};
    for (const auto& [option, value] :
         {std::pair("lit-format", "fp16"), {"lit-format", "b10g11r11"}, {"shading-precision", "fp16"}}) {
        Settings settings = smallPicture(GBufferEncoding::standard);
        settings.set(option, value);
        for (const char* name : {"builtin:gallery", "builtin:spheres"}) {
            const std::vector<Frame> frames = uploaded(name).bothPaths(settings);
            const Requirements needs = requirements(uploaded(name).scene, poseAt(uploaded(name).scene, 0));
            const DeviceInfo& info = device().info();
            const Report report = makeReport(frames, {needs, needs}, {info.name, info.driver, info.type});
            for (const ChannelDiff& channel : report.comparisons.at(0).channels)
                if (channel.encoding_use) {
                    EXPECT_EQ(channel.verdict, Verdict::pass)
                        << name << " --" << option << " " << value << ": " << channel.mode->name << ": "
                        << channel.reason;
                }
        }
        for (const DecodingFault& fault : coarse)
            expectBeyondTheBits(litWithFault(settings, fault.plant),
                                fmt::format("--{} {}, {}: ", option, value, fault.name).c_str());
    }
}
INSTANTIATE_TEST_SUITE_P(Faults, DecodingFaults, testing::ValuesIn(decodingFaults),
                         [](const auto& fault) { return std::string(fault.param.name); });

}  // namespace
}  // namespace diptych::tests
