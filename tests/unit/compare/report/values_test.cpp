// SPDX-License-Identifier: MIT
// The page's value files decode to the Frames' numbers: exactly, or as precisely as the file states.
#include "compare/report/values.h"
#include "compare/report/document.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"

#include <Imath/half.h>
#include <gtest/gtest.h>
#include <zlib.h>
#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <cstring>
#include <random>

namespace diptych {
namespace {

using Json = nlohmann::json;

struct Decoded {
    Json head;
    std::vector<std::vector<double>> planes;
};

// Two letters encode 13 bits, the lowest bits first; up to 6 bits at the end take one letter.
std::string fromBase91(const std::string& text) {
    const auto digit = [](char c) { return static_cast<unsigned>(c - '#') - (c > '\\'); };
    std::vector<bool> bits;
    for (std::size_t i = 0; i < text.size(); i += 2) {
        const bool pair = i + 1 < text.size();
        const unsigned word = pair ? digit(text[i]) * 91 + digit(text[i + 1]) : digit(text[i]);
        for (int k = 0; k < (pair ? 13 : 6); ++k) bits.push_back((word >> k & 1) != 0);
    }
    std::string bytes(bits.size() / 8, '\0');
    for (std::size_t i = 0; i < 8 * bytes.size(); ++i)
        if (bits[i]) bytes[i / 8] = static_cast<char>(bytes[i / 8] | 1 << i % 8);
    return bytes;
}

// Written from the description in values.h, independently of the page's script and its writer.
Decoded decoded(const std::string& script) {
    const std::string start = "diptychValues(\"a.values.js\",";
    EXPECT_EQ(script.find(start), 0u) << script.substr(0, 80);
    Decoded result{Json::parse(script.substr(start.size(), script.rfind(')') - start.size())), {}};
    const Json& head = result.head;
    const std::size_t pixels = head["width"].get<std::size_t>() * head["height"].get<std::size_t>(),
                      components = head["components"], images = head["images"],
                      planes = components * images + head["errors"].get<bool>(),
                      bytes = head["bits"].get<std::size_t>() / 8;
    EXPECT_EQ(head["data"].size(), planes);
    std::vector<std::vector<unsigned char>> raw;  // one byte more than each plane has
    for (const Json& text : head["data"]) {
        raw.emplace_back(pixels * bytes + 1);
        if (text == "") continue;
        const std::string packed = fromBase91(text);
        uLongf size = static_cast<uLongf>(raw.back().size());
        EXPECT_EQ(uncompress(raw.back().data(), &size, reinterpret_cast<const Bytef*>(packed.data()),
                             static_cast<uLong>(packed.size())),
                  Z_OK);
        EXPECT_EQ(size, pixels * bytes) << "no byte more than the plane has";
    }
    std::vector<std::vector<std::uint32_t>> words(planes, std::vector<std::uint32_t>(pixels));
    const std::uint32_t mask = bytes == 2 ? 0xffffu : ~0u;
    for (std::size_t plane = 0; plane < planes; ++plane)
        for (std::size_t i = 0; i < pixels; ++i) {
            std::uint32_t word = 0;
            for (std::size_t byte = 0; byte < bytes; ++byte)
                word += std::uint32_t{raw[plane][byte * pixels + i]} << (8 * byte);
            const bool first = i % head["width"].get<std::size_t>() == 0 || plane >= components;
            words[plane][i] = (word + (first ? 0 : words[plane][i - 1])) & mask;
        }
    for (std::size_t plane = components; plane < components * images; ++plane)
        for (std::size_t i = 0; i < pixels; ++i)
            words[plane][i] = (words[plane][i] + words[plane - components][i]) & mask;
    for (std::size_t plane = 0; plane < planes; ++plane) {
        const bool errors = plane == components * images;
        std::vector<double>& numbers = result.planes.emplace_back();
        for (const std::uint32_t word : words[plane]) {
            const float value = bytes == 4 ? std::bit_cast<float>(word)
                                           : imath_half_to_float(static_cast<std::uint16_t>(word));
            numbers.push_back(errors ? double{value} * head["errorUnit"].get<double>()
                                     : std::ldexp(double{value}, -head["exponent"].get<int>()));
        }
    }
    return result;
}

Image noiseUpTo(int width, int height, int components, double largest, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> exponent(-30, 0);
    Image image(width, height, components);
    for (float& v : image.data)
        v = static_cast<float>((random() % 2 ? 1 : -1) * largest * std::exp2(exponent(random)));
    return image;
}

std::string scriptOf(const ChannelValues& values) {
    std::string script;
    valuesScript("a.values.js", values, [&](std::string_view text) { script += text; });
    return script;
}

Decoded through(const Image& a, const Image& b, const Image& errors) {
    return decoded(scriptOf({&a, &b, &errors}));
}

TEST(ReportValues, SmallImagesAreExact) {
    Image a = noiseUpTo(31, 17, 3, 3e38, 1);
    const Image b = noiseUpTo(31, 17, 3, 1e-38, 2), errors = noiseUpTo(31, 17, 1, 2, 3);
    a.data[5] = -0.0f;
    a.data[6] = std::numeric_limits<float>::infinity();
    a.data[7] = std::numeric_limits<float>::quiet_NaN();
    const Decoded back = through(a, b, errors);
    EXPECT_EQ(back.head["bits"], 32);
    EXPECT_EQ(back.head["exact"], true);
    for (std::size_t i = 0; i < a.pixels(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const auto same = [&](double got, float wanted) {
                EXPECT_EQ(std::bit_cast<std::uint32_t>(static_cast<float>(got)),
                          std::bit_cast<std::uint32_t>(wanted));
            };
            same(back.planes[c][i], a.pixel(i)[c]);
            same(back.planes[3 + c][i], b.pixel(i)[c]);
        }
        EXPECT_EQ(back.planes[6][i], double{errors.data[i]});
    }
}

// Values that float16 can represent stay exact at half the size.
TEST(ReportValues, WhatElevenBitsHoldIsExactInSixteen) {
    Image a(400, 300, 1, 3), b(400, 300, 1, -1), errors(400, 300, 1);
    a.data[7] = 0.5f;
    b.data[9] = 0x1p20f;
    errors.data[3] = 0.1f;
    const Decoded back = through(a, b, errors);
    EXPECT_EQ(back.head["bits"], 16);
    EXPECT_EQ(back.head["exact"], true);
    for (std::size_t i = 0; i < a.pixels(); ++i) {
        ASSERT_EQ(back.planes[0][i], double{a.data[i]});
        ASSERT_EQ(back.planes[1][i], double{b.data[i]});
    }
    EXPECT_EQ(back.planes[2][3], double{0.1f}) << "the largest error is the unit";
}

// Half a step of 11 bits, down to 2^-29 of the largest value, at any scale.
TEST(ReportValues, LargeImagesKeepElevenBits) {
    for (const double largest : {1e30, 3e-30}) {
        const Image a = noiseUpTo(300, 200, 3, largest, 4), b = noiseUpTo(300, 200, 3, largest, 5);
        Image errors = noiseUpTo(300, 200, 1, 1e-4, 6);
        for (float& e : errors.data) e = std::abs(e);
        errors.data[11] = HUGE_VALF;
        const Decoded back = through(a, b, errors);
        EXPECT_EQ(back.head["bits"], 16);
        EXPECT_EQ(back.head["exact"], false);
        for (std::size_t i = 0; i < a.pixels(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                for (const auto& [got, wanted] : {std::pair{back.planes[c][i], double{a.pixel(i)[c]}},
                                                  std::pair{back.planes[3 + c][i], double{b.pixel(i)[c]}}})
                    ASSERT_LE(std::abs(got - wanted),
                              std::max(std::abs(wanted) * 0x1p-11, largest * 0x1p-39));
        EXPECT_TRUE(std::isinf(back.planes[6][11]));
        for (std::size_t i = 12; i < a.pixels(); ++i)
            ASSERT_LE(std::abs(back.planes[6][i] - double{errors.data[i]}),
                      std::max(double{errors.data[i]} * 0x1p-11, 1e-4 * 0x1p-24));
    }
}

TEST(ReportValues, OneFrameAloneHasItsOwn) {
    const Image a = noiseUpTo(5, 4, 2, 1, 7);
    const Decoded back = decoded(scriptOf({&a, nullptr, nullptr}));
    EXPECT_EQ(back.head["images"], 1);
    ASSERT_EQ(back.planes.size(), 2u);
    EXPECT_EQ(back.planes[1][19], double{a.data[39]});
}

// Its largest value takes 2^14 to 2^15 of float16.
TEST(ReportValues, OneFrameAloneIsScaledByItsLargestValue) {
    const Image a(2, 1, 1, 0x1.8p-30f);
    const Decoded back = decoded(scriptOf({&a, nullptr, nullptr}));
    EXPECT_EQ(back.head["bits"], 16);
    EXPECT_EQ(back.head["exponent"], 44);
    EXPECT_EQ(back.head["errorUnit"], 1.0);
    EXPECT_EQ(back.head["errors"], false);
    EXPECT_EQ(back.planes[0], (std::vector<double>{0x1.8p-30, 0x1.8p-30}));
}

// A report without images: the layout only needs the size.
TEST(ReportValues, ImagesBeyondTheLimitHaveNoneAndThePageSaysSo) {
    for (const int width : {4096, 4097}) {
        Report report;
        report.frames.resize(2);
        for (Frame& frame : report.frames) frame.settings.size = {width, 4096};
        Comparison& one = report.comparisons.emplace_back();
        one.test = 1;
        one.channels.emplace_back().mode = &debugMode(Channel::roughness);
        one.channels.back().verdict = Verdict::forward_only;
        const ReportLayout layout = layoutOf(report, {});
        EXPECT_EQ(layout.images[0][0].values, width == 4096 ? "roughness.values.js" : "");
        const std::string page = reportHtml(report, layout, textsOf(report, layout));
        EXPECT_EQ(page.find("have values only in the EXR files") != std::string::npos, width == 4097);
    }
}

TEST(ReportValues, EachChannelHasAFileThatTheReportLists) {
    const std::filesystem::path out = folder() / "report";
    const Json json = Json::parse(writeReport(reportOf(bothFrames()), out, {}));
    std::vector<std::string> names = json["files"];
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count_if(
                  names, [](const std::string& name) { return name.ends_with(".values.js"); })),
              channelsOfOneSample());
    EXPECT_EQ(namesIn(out), names);
    // Value files are replaced and removed like images.
    ReportOptions single;
    single.single_file = true;
    writeReport(reportOf(bothFrames()), out, single);
    for (const std::string& name : namesIn(out)) EXPECT_FALSE(name.ends_with(".js")) << name;
}

}  // namespace
}  // namespace diptych
