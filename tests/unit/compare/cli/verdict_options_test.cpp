// SPDX-License-Identifier: MIT
// The command printed in a report has every option that affects the verdict, as given.
#include "compare/cli/verdict_options.h"
#include "compare/cli/command_compare.h"
#include "compare/cli/command_diff.h"
#include "tests/support/command_lines.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace diptych {
namespace {

using VerdictWordList = std::vector<std::string>;

template <class Line>
VerdictWordList wordsAgain(VerdictWordList command, const VerdictWordList& said) {
    command.insert(command.end(), said.begin(), said.end());
    return cli::verdictOptions(parsedAs<Line>(command));
}

TEST(VerdictWords, OfDiffAreThoseThatWereGiven) {
    for (const VerdictWordList& said : {
             VerdictWordList{"--tolerances", "t.json"},
             {"--metric", "mae", "--tolerance", "0.25", "--warn", "0.125"},
             {"--tolerance", "0.25", "--failing", "0.5"},
             {"--map", "albedo=a.R,a.G,a.B", "--map", "depth=d.Z"},
             {"--blur", "1.5", "--shift", "2"},
             {"--ppd", "30", "--start-exposure=-3", "--stop-exposure", "4", "--exposures", "5"},
             {"--mask", "m.png", "--ids", "1,3", "--ignore-edges", "2", "--crop", "1,2,30x40"},
             {"--strict"},
             {"--allow-empty"},
         })
        EXPECT_EQ(wordsAgain<cli::DiffLine>({"diff", "a.exr", "b.exr"}, said), said);
}

TEST(VerdictWords, OfCompareAreThoseThatWereGiven) {
    for (const VerdictWordList& said : {
             VerdictWordList{"--tolerances", "t.json", "--baseline", "b.exr"},
             {"--mask", "m.png", "--ids", "1,3", "--ignore-edges", "2", "--crop", "1,2,30x40"},
             {"--allow-noise", "--strict"},
             {"--deferred", "shadows=evsm,ambient=1,0,0", "--forward-plus", "shadows=pcf,ambient=0,0,0"},
             {"--allow-empty"},
         })
        EXPECT_EQ(wordsAgain<cli::CompareLine>({"compare", "builtin:points"}, said), said);
}

TEST(VerdictWords, DefaultsNeedNone) {
    EXPECT_EQ(wordsAgain<cli::CompareLine>({"compare"}, {}), VerdictWordList{});
    EXPECT_EQ(wordsAgain<cli::DiffLine>({"diff", "a.exr", "b.exr"}, {}), VerdictWordList{});
    EXPECT_EQ(wordsAgain<cli::DiffLine>({"diff", "a.exr", "b.exr"}, {"--ignore-edges", "0", "--blur", "0"}),
              VerdictWordList{});
}

TEST(VerdictWords, CompareIsTold) {
    const auto told = [](VerdictWordList words) {
        words.insert(words.begin(), "compare");
        return cli::compareOptions(parsedAs<cli::CompareLine>(words));
    };
    const CompareOptions defaults = told({});
    EXPECT_FALSE(defaults.allow_noise || defaults.strict || defaults.allow_empty);
    EXPECT_EQ(defaults.baseline, Path::deferred);
    EXPECT_TRUE(defaults.required.empty());
    EXPECT_TRUE(told({"--allow-noise"}).allow_noise);
    EXPECT_TRUE(told({"--strict"}).strict);
    EXPECT_TRUE(told({"--allow-empty"}).allow_empty);
    EXPECT_EQ(told({"--baseline", "forward_plus"}).baseline, Path::forward_plus);
    EXPECT_EQ(told({"--channels", "lit,depth"}).required, (std::vector{Channel::lit, Channel::depth}));
    EXPECT_EQ(told({"--ignore-edges", "3"}).selection.ignore_edges, 3);
    EXPECT_EQ(told({"--strict"}).words, VerdictWordList{"--strict"});
}

}  // namespace
}  // namespace diptych
