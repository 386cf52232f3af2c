// SPDX-License-Identifier: MIT
// Checks the project's conventions on its own files: one pi, a licence line, one JSON reader, one user of
// libpng, no machine-specific paths, short shader lines, shader code for every channel. Each check has a
// negative control.
#include "tests/support/sources.h"

#include <fnmatch.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

namespace diptych {
namespace {

// Regular expressions are slow: only where a part of them stands.
bool hasAny(std::string_view text, std::initializer_list<std::string_view> parts) {
    return std::ranges::any_of(parts, [&](std::string_view part) { return text.find(part) != text.npos; });
}

// pi, 2 pi, pi/2, pi/4 and 1/pi as digits, and the macro M_PI, which is not standard C++. Tests may
// contain values computed by hand.
Faults otherPis(const Files& files) {
    Faults faults;
    for (const auto& [path, text] : files)
        if (isCode(path) && path != "shared/contract/constants.h" && !path.starts_with("tests/") &&
            hasAny(text, {"3.1415", "6.2831", "1.5707", "0.7853", "0.3183", "M_PI"}))
            faults.push_back(path);
    return faults;
}

TEST(Conventions, ThereIsOnePi) {
    EXPECT_EQ(joined(otherPis(sources())), "");
}

TEST(Conventions, APlantedPiIsFound) {
    for (const char* pi : {"3.14159f", "3.1415628", "6.28318530718", "M_PI_2", "0.31830988"}) {
        EXPECT_EQ(otherPis({{"shaders/lib/planted.glsl", std::string("const float p = ") + pi + ";"}}).size(),
                  1u)
            << pi;
    }
    EXPECT_TRUE(
        otherPis({{"shared/scene/a.cpp", "std::numbers::pi"}, {"shared/contract/constants.h", "3.14159"}})
            .empty());
}

Faults withoutLicence(const Files& files) {
    Faults faults;
    for (const auto& [path, text] : files) {
        const bool wanted = isCode(path) ||
                            endsIn(path, {"CMakeLists.txt", ".cmake", ".css", ".js", ".yml"}) ||
                            path == "diptych" || path == ".ci/run";
        const std::size_t second = text.find('\n', text.find('\n') + 1);
        if (wanted && text.substr(0, second).find("SPDX-License-Identifier: MIT") == std::string::npos)
            faults.push_back(path);
    }
    return faults;
}

TEST(Conventions, EverySourceStartsWithItsLicence) {
    EXPECT_EQ(joined(withoutLicence(sources())), "");
}

TEST(Conventions, AMissingLicenceIsFound) {
    EXPECT_EQ(withoutLicence(
                  {{"compare/a.cpp", "int a;\n"}, {"diptych", "#!/bin/sh\nset -e\n"}, {"README.md", "#"}}),
              (Faults{"compare/a.cpp", "diptych"}));
    EXPECT_TRUE(withoutLicence({{"diptych", "#!/bin/sh\n# SPDX-License-Identifier: MIT\n"}}).empty());
}

// One place reads files with libpng, with one set of limits. Tests may write PNG files with it.
Faults otherUsersOfLibpng(const Files& files) {
    static const std::regex include(
        "(^|\n)[ \t]*#[ \t]*include[ \t]*[<\"](libpng[0-9]*/)?png(conf)?\\.h[>\"]");
    static const std::regex link("\\bPNG::PNG\\b|\\bPNG_LIBRAR(Y|IES)\\b");
    Faults faults;
    for (const auto& [path, text] : files) {
        if (path.starts_with("tests/") || path.starts_with("shared/image/png")) continue;
        if (isCode(path) && std::regex_search(text, include)) faults.push_back(path + " includes png.h");
        if (path.ends_with("CMakeLists.txt") && path != "shared/CMakeLists.txt" &&
            std::regex_search(text, link))
            faults.push_back(path + " links libpng");
    }
    return faults;
}

// Only the device profile decides by the device's type. Elsewhere only what a Frame declares about the
// device may matter.
Faults askersForTheKindOfDevice(const Files& files) {
    static const std::regex asks("== *\"cpu\"|DEVICE_TYPE_CPU|\\bisCpu\\b|llvmpipe");
    Faults faults;
    for (const auto& [path, text] : files)
        if (endsIn(path, {".cpp", ".h"}) && !path.starts_with("tests/") &&
            !path.starts_with("shared/vulkan/instance/device_profile.") &&
            path != "shared/vulkan/instance/physical_device.cpp" && path != "shared/frame/frame.h" &&
            hasAny(text, {"\"cpu\"", "_CPU", "isCpu", "llvmpipe"}) && std::regex_search(text, asks))
            faults.push_back(path);
    return faults;
}

TEST(Conventions, OnlyTheProfileAsksForTheKindOfDevice) {
    EXPECT_EQ(joined(askersForTheKindOfDevice(sources())), "");
}

TEST(Conventions, APlantedQuestionForTheKindOfDeviceIsFound) {
    EXPECT_EQ(askersForTheKindOfDevice({{"compare/render/planted.cpp", "if (info.type == \"cpu\") return;"}}),
              Faults{"compare/render/planted.cpp"});
}

// A channel is a Channel; numbers stand in JSON, in shaders and on the command line. Only channel.h casts.
Faults channelCasts(const Files& files) {
    static const std::regex casts(
        "\\bDEBUG_[a-z]\\w*|static_cast<Channel>|\\bChannel\\{\\w|"
        "static_cast<[\\w:]+>\\((?:Channel::\\w+|mode|(?:\\w+(?:\\.|->))*channel)\\)");
    Faults faults;
    for (const auto& [path, text] : files)
        if (endsIn(path, {".cpp", ".h"}) && !path.starts_with("shared/contract/") &&
            !path.starts_with("tests/unit/architecture/") && path != "shared/frame/channel.h")
            for (std::sregex_iterator it(text.begin(), text.end(), casts), end; it != end; ++it)
                faults.push_back(path + ": " + it->str());
    return faults;
}

TEST(Conventions, OnlyOneFileTurnsChannelsIntoNumbers) {
    EXPECT_EQ(joined(channelCasts(sources())), "");
}

TEST(Conventions, APlantedChannelNumberIsFound) {
    const auto plant = [](const std::string& line) {
        return channelCasts({{"compare/render/planted.cpp", line}}).size();
    };
    EXPECT_EQ(plant("const int a = static_cast<int>(Channel::lit);"), 1u);
    EXPECT_EQ(plant("const int a = static_cast<int>(row.mode->channel);"), 1u);
    EXPECT_EQ(plant("const auto a = static_cast<gpu::uint>(mode);"), 1u);
    EXPECT_EQ(plant("const Channel a{4}, b = Channel{number};"), 1u);
    EXPECT_EQ(plant("const auto a = static_cast<Channel>(4);"), 1u);
    EXPECT_EQ(plant("const int a = gpu::DEBUG_lit;"), 1u);
    EXPECT_EQ(plant("const int a = channelNumber(mode.channel) + static_cast<int>(modes);"), 0u);
}

// One place queries Vulkan about a device. Exceptions: the viewer's window surface, and instances, which
// list their devices and layers. Matching the functions' names also finds wrappers.
Faults askersOfVulkan(const Files& files) {
    static const std::regex asks("\\bvkGetPhysicalDevice(\\w+)|\\bvkEnumerateDeviceExtensionProperties");
    Faults faults;
    for (const auto& [path, text] : files) {
        if (!endsIn(path, {".cpp", ".h"}) || path.starts_with("tests/") ||
            path == "shared/vulkan/instance/device_support.cpp" ||
            !hasAny(text, {"vkGetPhysicalDevice", "vkEnumerateDevice"}))
            continue;
        for (std::sregex_iterator it(text.begin(), text.end(), asks), end; it != end; ++it)
            if (!path.starts_with("compare/viewer/") || !(*it)[1].str().starts_with("Surface"))
                faults.push_back(path + " calls " + it->str());
    }
    return faults;
}

TEST(Conventions, OnlyDeviceSupportAsksVulkanWhatADeviceHas) {
    EXPECT_EQ(joined(askersOfVulkan(sources())), "");
}

TEST(Conventions, APlantedQuestionToVulkanIsFound) {
    const auto plant = [](const std::string& path, const std::string& line) {
        return askersOfVulkan({{path, line}}).size();
    };
    EXPECT_EQ(plant("shared/draw/planted.cpp", "vkGetPhysicalDeviceFormatProperties(d, f, &p);"), 1u);
    EXPECT_EQ(plant("shared/vulkan/planted.h", "vkEnumerateDeviceExtensionProperties(d, 0, &n, 0);"), 1u);
    EXPECT_EQ(plant("compare/viewer/planted.cpp", "vkGetPhysicalDeviceFeatures2(d, &f);"), 1u);
    EXPECT_EQ(plant("compare/viewer/planted.cpp", "vkGetPhysicalDeviceSurfaceSupportKHR(d, 0, s, &b);"), 0u);
    EXPECT_EQ(plant("shared/vulkan/instance/device_support.cpp", "vkGetPhysicalDeviceFeatures2(d, &f);"), 0u);
}

// Everything printed passes the filter of compare/run/print.h. The progress line and the cache's note,
// which are in lower layers, apply it themselves.
Faults otherPrinters(const Files& files) {
    static const std::regex prints(
        "fmt::print\\((?!\\w+\\.stream)|std::(cout|cerr|clog)|\\b(printf|puts|putchar|perror)\\(|"
        "\\bf(printf|puts|putc|write)\\([^;]*\\b(stdout|stderr)\\b");
    Faults faults;
    for (const auto& [path, text] : files)
        if (endsIn(path, {".cpp", ".h"}) && !path.starts_with("tests/") &&
            !path.starts_with("shaders/tool/") && !path.starts_with("shared/light/fit/") &&
            !path.starts_with("compare/library/example/") && !path.starts_with("compare/run/print.") &&
            path != "compare/run/progress.cpp" && path != "shared/vulkan/instance/user_cache.cpp" &&
            hasAny(text, {"fmt::print(", "std::cout", "std::cerr", "std::clog", "printf(", "puts(",
                          "putchar(", "perror(", "stdout", "stderr"}) &&
            std::regex_search(text, prints))
            faults.push_back(path);
    return faults;
}

TEST(Conventions, OnePlacePrints) {
    EXPECT_EQ(joined(otherPrinters(sources())), "");
}

TEST(Conventions, APlantedPrinterIsFound) {
    for (const char* line :
         {"fmt::print(\"{}\", name);", "fmt::print(stderr, \"{}\", name);", "std::cerr << name;",
          "std::fprintf(stderr, \"%s\", name);", "printf(\"%s\", n);", "std::fputs(name, stderr);",
          "std::fwrite(at, 1, size, stdout);", "puts(name);"})
        EXPECT_EQ(otherPrinters({{"compare/cli/planted.cpp", line}}).size(), 1u) << line;
    for (const char* line :
         {"fmt::print(out.stream(), \"PF\");", "std::fwrite(at, 1, size, file.stream());", "printText(text);",
          "std::snprintf(at, size, \"%d\", number);", "fingerprints(inputs)"})
        EXPECT_TRUE(otherPrinters({{"compare/cli/planted.cpp", line}}).empty()) << line;
}

// Limits on depth, size and type only work if nobody bypasses the common readers.
Faults readersOfTheirOwn(const Files& files) {
    Faults faults;
    for (const auto& [path, text] : files) {
        const bool product = path.starts_with("compare/") || path.starts_with("shared/") ||
                             path.starts_with("forward_plus/") || path.starts_with("deferred/");
        // Files under /proc and /sys report no size, so free_memory.cpp reads them itself.
        if (!product || !isCode(path) || path == "shared/text/json.cpp" ||
            path == "shared/image/free_memory.cpp")
            continue;
        for (const char* reader : {"son::parse(", "son::accept(", "ifstream", "istream_iterator"})
            if (text.find(reader) != text.npos) faults.push_back(path + " has " + reader);
    }
    return faults;
}

TEST(Conventions, JsonAndFilesAreReadInOnePlaceEach) {
    EXPECT_EQ(joined(readersOfTheirOwn(sources())), "");
}

TEST(Conventions, APlantedReaderIsFound) {
    for (const char* line : {"const auto a = nlohmann::json::parse(text);",
                             "nlohmann::ordered_json::parse(stream, nullptr, false)", "Json::parse(text)",
                             "std::ifstream stream(file);", "json::accept(text)"})
        for (const char* path : {"compare/cli/planted.cpp", "shared/scene/planted.h"})
            EXPECT_EQ(readersOfTheirOwn({{path, line}}).size(), 1u) << line;
    EXPECT_TRUE(readersOfTheirOwn({{"shared/text/json.cpp", "Json::parse(text)"},
                                   {"tests/unit/planted.cpp", "std::ifstream stream(file);"},
                                   {"compare/a.cpp", "parseJson(text); Json::parse_event_t e; ofstream o;"}})
                    .empty());
}

// JSON output contains no raw control characters. Pages with JSON in scripts have their own filter.
Faults writersOfRawJson(const Files& files) {
    static const std::regex writes("\\.dump\\([^)]");
    static const std::vector<std::string> pages{"compare/report/card.cpp", "compare/report/document.cpp",
                                                "compare/report/frames.cpp", "compare/report/index.cpp"};
    Faults faults;
    for (const auto& [path, text] : files)
        if (endsIn(path, {".cpp", ".h"}) && !path.starts_with("tests/") &&
            path != "shared/text/json_text.h" && std::ranges::count(pages, path) == 0 &&
            std::regex_search(text, writes))
            faults.push_back(path);
    return faults;
}

TEST(Conventions, JsonIsWrittenInOnePlace) {
    EXPECT_EQ(joined(writersOfRawJson(sources())), "");
}

TEST(Conventions, APlantedWriterOfJsonIsFound) {
    EXPECT_EQ(writersOfRawJson({{"compare/cli/planted.cpp", "writeFile(out, json.dump(2));"}}).size(), 1u);
    EXPECT_TRUE(writersOfRawJson({{"shared/text/json_text.h", "json.dump(indent)"},
                                  {"compare/a.cpp", "if (a.dump() == b.dump()) jsonText(a);"}})
                    .empty());
}

TEST(Conventions, LibpngIsUsedInOnePlace) {
    EXPECT_EQ(joined(otherUsersOfLibpng(sources())), "");
}

TEST(Conventions, APlantedUseOfLibpngIsFound) {
    const auto plant = [](const std::string& path, const std::string& line) {
        return otherUsersOfLibpng({{path, "// SPDX-License-Identifier: MIT\n" + line + "\n"}}).size();
    };
    for (const char* line :
         {"#include <png.h>", "  # include \"png.h\"", "#include <libpng16/png.h>", "#include <pngconf.h>"})
        EXPECT_EQ(plant("shared/scene/planted.cpp", line), 1u) << line;
    EXPECT_EQ(plant("shared/image/radiance.cpp", "#include <png.h>"), 1u);
    EXPECT_EQ(plant("compare/CMakeLists.txt", "  LINKS fmt::fmt PNG::PNG)"), 1u);
    EXPECT_EQ(plant("shared/image/png_planted.cpp", "#include <png.h>"), 0u);
    EXPECT_EQ(plant("tests/unit/planted.cpp", "#include <png.h>"), 0u);
    EXPECT_EQ(plant("compare/planted.cpp", "#include \"shared/image/png.h\""), 0u);
    EXPECT_EQ(plant("CMakeLists.txt", "find_package(PNG REQUIRED)"), 0u);
}

// Comparisons of Path values outside path_rows, which says what a path can do.
Faults comparedPaths(const Files& files) {
    static const std::regex compared("[!=]= *Path::\\w|\\bPath::\\w+ *[!=]=");
    Faults faults;
    for (const auto& [path, text] : files)
        if (isCode(path) && !path.starts_with("tests/") && path != "shared/frame/setting_values.h")
            if (std::smatch match; std::regex_search(text, match, compared))
                faults.push_back(path + ": " + match.str());
    return faults;
}

TEST(Conventions, OnlyItsRowSaysWhatAPathCanDo) {
    EXPECT_EQ(joined(comparedPaths(sources())), "");
}

TEST(Conventions, APlantedComparisonOfPathsIsFound) {
    const auto plant = [](const char* path, const char* text) {
        return comparedPaths({{path, text}}).size();
    };
    EXPECT_EQ(plant("compare/planted.cpp", "if (s.path == Path::deferred) return;"), 1u);
    EXPECT_EQ(plant("shared/planted.h", "return Path::reference != path;"), 1u);
    EXPECT_EQ(plant("compare/planted.cpp", "settings.path = Path::deferred;"), 0u);
    EXPECT_EQ(plant("tests/unit/planted.cpp", "if (s.path == Path::deferred) return;"), 0u);
}

// Absolute paths of the machine where a file was written.
Faults pathsOfAMachine(const Files& files) {
    static const std::regex absolute("/(home|work|root|Users)/[A-Za-z0-9_.]");
    Faults faults;
    for (const auto& [path, text] : files)
        if (isCode(path) || endsIn(path, {".md", ".txt", ".json", "diptych", "run"}))
            if (std::smatch match; std::regex_search(text, match, absolute))
                faults.push_back(path + ": " + match.str());
    return faults;
}

TEST(Conventions, NoFileNamesAFolderOfOneMachine) {
    EXPECT_EQ(joined(pathsOfAMachine(sources())), "");
}

TEST(Conventions, APlantedFolderIsFound) {
    EXPECT_EQ(pathsOfAMachine({{"README.md", std::string("see /home") + "/jo/scene.glb"}}).size(), 1u);
    EXPECT_TRUE(pathsOfAMachine({{"README.md", "see https://example.org/homework/a"}}).empty());
}

// clang-format limits C++ to 110 columns, but does not handle GLSL.
Faults longShaderLines(const Files& files) {
    Faults faults;
    for (const auto& [path, text] : files) {
        if (!endsIn(path, {".glsl", ".vert", ".frag", ".comp"})) continue;
        std::istringstream lines(text);
        int number = 0;
        for (std::string line; std::getline(lines, line);) {
            ++number;
            if (line.size() > 110) faults.push_back(path + ":" + std::to_string(number));
        }
    }
    return faults;
}

TEST(Conventions, ShadersKeepToTheColumnsOfTheRest) {
    EXPECT_EQ(joined(longShaderLines(sources())), "");
}

TEST(Conventions, APlantedLongLineOfAShaderIsFound) {
    const std::string fits = "// " + std::string(107, 'x') + "\n";
    EXPECT_EQ(longShaderLines({{"shaders/lib/planted.glsl", fits + "//  " + std::string(107, 'x') + "\n"}}),
              Faults{"shaders/lib/planted.glsl:2"});
    EXPECT_TRUE(longShaderLines({{"shaders/lib/planted.glsl", fits}, {"README.md", fits + fits}}).empty());
}

// Lines of tests/longer.txt (FOLDER.SUITE.TEST with * and ?) that match no TEST of the folder.
Faults linesWithoutTest(const std::string& list, const Files& files) {
    static const std::regex test("TEST(?:_F|_P)?\\(\\s*(\\w+),\\s*(\\w+)\\)");
    std::set<std::string> names;
    for (const auto& [path, text] : files)
        if (path.starts_with("tests/") && path.ends_with(".cpp"))
            for (std::sregex_iterator at(text.begin(), text.end(), test), end; at != end; ++at)
                names.insert(path.substr(6, path.find('/', 6) - 6) + "." + (*at)[1].str() + "." +
                             (*at)[2].str());
    Faults faults;
    std::istringstream lines(list);
    for (std::string line; std::getline(lines, line);) {
        std::string pattern = line.substr(0, line.find(' '));
        if (pattern.empty() || pattern == "#") continue;
        // The source lacks the prefix of an instantiated suite and the row after the test's name.
        pattern = std::regex_replace(pattern, std::regex("Asset/\\*$"), "Asset*.*");
        if (const std::size_t row = pattern.find('/'); row != pattern.npos) pattern.resize(row);
        if (std::ranges::none_of(names, [&](const std::string& name) {
                return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
            }))
            faults.push_back(line);
    }
    return faults;
}

TEST(Conventions, TestsThatWaitAreThere) {
    EXPECT_EQ(joined(linesWithoutTest(sources().at("tests/longer.txt"), sources())), "");
    const Files files{{"tests/image/a_test.cpp", "TEST_P(Way, Is) {}\nTEST(Other, Is) {}"}};
    EXPECT_TRUE(
        linesWithoutTest("# a line\n\nimage.*Way.*  7  why\nimage.Other.Is/row*  1\n", files).empty());
    EXPECT_EQ(linesWithoutTest("unit.Way.*  7\nimage.Oter.*  1\n", files),
              (Faults{"unit.Way.*  7", "image.Oter.*  1"}));
}

}  // namespace
}  // namespace diptych
