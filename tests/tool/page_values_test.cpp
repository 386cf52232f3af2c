// SPDX-License-Identifier: MIT
// The page's values of the pixel under the cursor equal those in the Frames.
#include "tests/tool/page_builder.h"

#include <fmt/format.h>

#include <sstream>

namespace diptych {
namespace {

TEST(PageValues, TheValuesUnderTheCursorAreThoseOfTheFrames) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    std::vector<Frame> frames = rampFrames();
    frames[1].channels[Channel::albedo].at(3, 2, 1) = std::numeric_limits<float>::infinity();
    const Visit seen = visit(folder, written(folder, reportOf(frames)), R"(
      const read = async (id, x, y, width = 96, height = 54) => {
        const card = $(id); card.open = true;
        const panel = card.querySelector('.panel'), out = card.querySelector('.readout');
        pointer('pointermove', panel, (x + .5) / width, (y + .5) / height);
        await until(() => out.children.length > 1);
        return [...out.children].map(row => row.textContent);
      };
      const scripts = () => $$('script[src]').map(script => script.getAttribute('src'));
      tell({ before: scripts(), lit: await read('#c0-lit', 5, 3),
        roughness: await read('#c0-roughness', 40, 20),
             albedo: await read('#c0-albedo', 3, 2), id: await read('#c0-material_id', 0, 0),
             only: await read('#c0-texcoords', 95, 53), after: scripts() });)");
    EXPECT_EQ(seen.console, "");
    ASSERT_TRUE(seen.told.is_object()) << seen.told;
    using nlohmann::json;
    EXPECT_EQ(seen.told["before"], json::array()) << "nothing is loaded before somebody points";
    const Image& lit = frames[0].channels.at(Channel::lit);
    const std::string triple = fmt::format("{} {} {}", lit.at(5, 3, 0), lit.at(5, 3, 1), lit.at(5, 3, 2));
    EXPECT_EQ(seen.told["lit"],
              (json{"5, 3 exact", "deferred " + triple, "forward_plus " + triple, "difference 0"}));
    EXPECT_EQ(seen.told["roughness"],
              (json{"40, 20 exact", "deferred 0.5", "forward_plus 0.75", "difference 0.25"}));
    EXPECT_EQ(seen.told["albedo"], (json{"3, 2 exact", "deferred 0.5 0.5 0.5",
                                         "forward_plus 0.5 Infinity 0.5", "difference Infinity"}));
    EXPECT_EQ(seen.told["id"], (json{"0, 0 exact", "deferred 3", "forward_plus 3", "difference 0"}));
    EXPECT_EQ(seen.told["only"], (json{"95, 53 exact", "forward_plus 0.5 0.5"}));
    EXPECT_EQ(seen.told["after"].size(), 5u) << "each channel's own file";
}

// Larger images are quantized, and the page says so; the difference keeps its digits.
TEST(PageValues, LargerImagesAreQuantisedAndSaySo) {
    SKIP_WITHOUT_BROWSER();
    const Folder folder;
    std::vector<Frame> frames = rampFrames(256, 192);
    for (Frame& frame : frames) {
        Image& position = frame.channels.at(Channel::position);
        for (std::size_t i = 0; i < position.data.size(); ++i)
            position.data[i] = 1e6f + 16 * static_cast<float>(i % 977);  // beyond float16's own range
    }
    frames[1].channels.at(Channel::position).at(200, 100, 2) += 0.25f;
    const Visit seen = visit(folder, written(folder, reportOf(frames)), R"(
      const card = $('#c0-position'), out = card.querySelector('.readout');
      location.hash = '#c0-position@200,100';
      await until(() => out.children.length > 1);
      tell([...out.children].map(row => row.textContent));)");
    EXPECT_EQ(seen.console, "");
    ASSERT_TRUE(seen.told.is_array() && seen.told.size() == 4) << seen.told;
    EXPECT_EQ(seen.told[0], "200, 100 quantised: float16, 11 bits");
    const Image& position = frames[0].channels.at(Channel::position);
    for (const int row : {1, 2}) {
        std::istringstream words(seen.told[row].get<std::string>());
        std::string name;
        words >> name;
        for (int c = 0; c < 3; ++c) {
            double value = 0;
            words >> value;
            // half a step of 11 bits, and half a unit of the fourth digit
            const double exact = position.at(200, 100, c);
            EXPECT_NEAR(value, exact, exact / 4096 + 500) << seen.told;
        }
    }
    const Image errors = errorImage(ErrorKind::relative, ChannelKind::vector, position,
                                    frames[1].channels.at(Channel::position), everyPixel(position.pixels()));
    const std::string difference = seen.told[3];
    ASSERT_TRUE(difference.starts_with("difference ")) << difference;
    EXPECT_NEAR(std::stod(difference.substr(11)), errors.at(200, 100), errors.at(200, 100) * 6e-4);
}

}  // namespace
}  // namespace diptych
