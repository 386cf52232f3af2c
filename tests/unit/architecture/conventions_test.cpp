// SPDX-License-Identifier: MIT
// The project's conventions that neither the compiler nor a reader sees, checked on its own files.
#include "tests/support/sources.h"

#include <fnmatch.h>
#include <gtest/gtest.h>

#include <functional>
#include <regex>
#include <set>
#include <sstream>
#include <string_view>

namespace diptych {
namespace {

bool isCpp(std::string_view path) {
    return path.ends_with(".cpp") || path.ends_with(".h");
}
bool isProduct(std::string_view path) {
    return !path.starts_with("tests/");
}
// Whether the path is one of these files, or begins like one of these prefixes.
bool isUnder(std::string_view path, std::initializer_list<std::string_view> prefixes) {
    return std::ranges::any_of(prefixes, [&](std::string_view p) { return path.starts_with(p); });
}

// Text that only some files may have.
struct Convention {
    const char* name;
    std::vector<std::string_view> parts;  // every match has one; regular expressions are slow
    const char* pattern;
    std::function<bool(std::string_view path)> forbidden;
    const char* path;                                        // of the planted lines
    std::vector<const char*> faulty;                         // negative control: each line is a fault
    std::vector<std::pair<const char*, const char*>> sound;  // path and line
};

const std::vector<Convention>& conventions() {
    static const std::vector<Convention> all{
        // Tests may contain values computed by hand.
        {"one pi",
         {"3.1415", "6.2831", "1.5707", "0.7853", "0.3183", "M_PI"},
         "3\\.1415|6\\.2831|1\\.5707|0\\.7853|0\\.3183|M_PI",
         [](auto path) {
             return isCode(std::string(path)) && isProduct(path) && path != "shared/contract/constants.h";
         },
         "shaders/lib/planted.glsl",
         {"const float p = 3.14159f;", "3.1415628", "6.28318530718", "M_PI_2", "0.31830988"},
         {{"shared/scene/a.cpp", "std::numbers::pi"}, {"shared/contract/constants.h", "3.14159"}}},
        // Elsewhere only what a Frame declares about the device may matter.
        {"only the device profile decides by the device's type",
         {"\"cpu\"", "_CPU", "isCpu", "llvmpipe"},
         "== *\"cpu\"|DEVICE_TYPE_CPU|\\bisCpu\\b|llvmpipe",
         [](auto path) {
             return isCpp(path) && isProduct(path) &&
                    !isUnder(path, {"shared/vulkan/instance/device_profile.",
                                    "shared/vulkan/instance/physical_device.cpp", "shared/frame/frame.h"});
         },
         "compare/render/planted.cpp",
         {"if (info.type == \"cpu\") return;"},
         {}},
        // Numbers of channels stand in JSON, in shaders and on the command line.
        {"only channel.h turns channels into numbers",
         {"DEBUG_", "static_cast<", "Channel{"},
         "\\bDEBUG_[a-z]\\w*|static_cast<Channel>|\\bChannel\\{\\w|"
         "static_cast<[\\w:]+>\\((?:Channel::\\w+|mode|(?:\\w+(?:\\.|->))*channel)\\)",
         [](auto path) {
             return isCpp(path) && !isUnder(path, {"shared/contract/", "tests/unit/architecture/",
                                                   "shared/frame/channel.h"});
         },
         "compare/render/planted.cpp",
         {"const int a = static_cast<int>(Channel::lit);",
          "const int a = static_cast<int>(row.mode->channel);",
          "const auto a = static_cast<gpu::uint>(mode);", "const Channel a{4}, b = Channel{number};",
          "const auto a = static_cast<Channel>(4);", "const int a = gpu::DEBUG_lit;"},
         {{"compare/a.cpp", "const int a = channelIndex(mode.channel) + static_cast<int>(modes);"}}},
        // Instances list their devices and layers. Matching the functions' names also finds wrappers.
        {"one file asks Vulkan about a device",
         {"vkGetPhysicalDevice", "vkEnumerateDevice"},
         "\\bvkGetPhysicalDevice|\\bvkEnumerateDeviceExtensionProperties",
         [](auto path) {
             return isCpp(path) && isProduct(path) && !path.starts_with("compare/viewer/") &&
                    path != "shared/vulkan/instance/device_support.cpp";
         },
         "shared/draw/planted.cpp",
         {"vkGetPhysicalDeviceFormatProperties(d, f, &p);",
          "vkEnumerateDeviceExtensionProperties(d, 0, &n, 0);"},
         {{"shared/vulkan/instance/device_support.cpp", "vkGetPhysicalDeviceFeatures2(d, &f);"}}},
        {"the viewer asks Vulkan about its window's surface alone",
         {"vkGetPhysicalDevice", "vkEnumerateDevice"},
         "\\bvkGetPhysicalDevice(?!Surface)|\\bvkEnumerateDeviceExtensionProperties",
         [](auto path) { return isCpp(path) && path.starts_with("compare/viewer/"); },
         "compare/viewer/planted.cpp",
         {"vkGetPhysicalDeviceFeatures2(d, &f);"},
         {{"compare/viewer/a.cpp", "vkGetPhysicalDeviceSurfaceSupportKHR(d, 0, s, &b);"}}},
        // Everything printed passes the filter of print.h. The progress line and the cache's note, in lower
        // layers, apply it themselves.
        {"one file prints",
         {"fmt::print(", "std::cout", "std::cerr", "std::clog", "printf(", "puts(", "putchar(", "perror(",
          "stdout", "stderr"},
         "fmt::print\\((?!\\w+\\.stream)|std::(cout|cerr|clog)|\\b(printf|puts|putchar|perror)\\(|"
         "\\bf(printf|puts|putc|write)\\([^;]*\\b(stdout|stderr)\\b",
         [](auto path) {
             return isCpp(path) && isProduct(path) &&
                    !isUnder(path, {"shaders/tool/", "shared/light/fit/", "compare/library/example/",
                                    "compare/run/print.", "compare/run/progress.cpp",
                                    "shared/vulkan/instance/user_cache.cpp"});
         },
         "compare/cli/planted.cpp",
         {"fmt::print(\"{}\", name);", "fmt::print(stderr, \"{}\", name);", "std::cerr << name;",
          "std::fprintf(stderr, \"%s\", name);", "printf(\"%s\", n);", "std::fputs(name, stderr);",
          "std::fwrite(at, 1, size, stdout);", "puts(name);"},
         {{"compare/a.cpp", "fmt::print(out.stream(), \"PF\");"},
          {"compare/a.cpp", "std::fwrite(at, 1, size, file.stream());"},
          {"compare/a.cpp", "printText(text);"},
          {"compare/a.cpp", "std::snprintf(at, size, \"%d\", number);"},
          {"compare/a.cpp", "fingerprints(inputs)"}}},
        // Limits on depth, size and type only work if nobody bypasses the common readers. Files under /proc
        // and /sys report no size, so free_memory.cpp reads them itself.
        {"JSON and files are read in one file each",
         {"son::parse(", "son::accept(", "ifstream", "istream_iterator"},
         "son::parse\\(|son::accept\\(|ifstream|istream_iterator",
         [](auto path) {
             return isCpp(path) && isUnder(path, {"compare/", "shared/", "forward_plus/", "deferred/"}) &&
                    !isUnder(path, {"shared/text/json.cpp", "shared/image/free_memory.cpp"});
         },
         "shared/scene/planted.h",
         {"const auto a = nlohmann::json::parse(text);",
          "nlohmann::ordered_json::parse(stream, nullptr, false)", "Json::parse(text)",
          "std::ifstream stream(file);", "json::accept(text)"},
         {{"shared/text/json.cpp", "Json::parse(text)"},
          {"tests/unit/planted.cpp", "std::ifstream stream(file);"},
          {"compare/a.cpp", "parseJson(text); Json::parse_event_t e; ofstream o;"}}},
        // JSON has no raw control characters. Pages with JSON in scripts have their own filter.
        {"JSON is written in one file",
         {".dump("},
         "\\.dump\\([^)]",
         [](auto path) {
             return isCpp(path) && isProduct(path) &&
                    !isUnder(path, {"shared/text/json_text.h", "compare/report/card.cpp",
                                    "compare/report/document.cpp", "compare/report/frames.cpp",
                                    "compare/report/index.cpp"});
         },
         "compare/cli/planted.cpp",
         {"writeFile(out, json.dump(2));"},
         {{"shared/text/json_text.h", "json.dump(indent)"},
          {"compare/a.cpp", "if (a.dump() == b.dump()) jsonText(a);"}}},
        // One set of limits. Tests may write PNG files with it.
        {"one file includes libpng",
         {"png.h", "pngconf.h"},
         "(^|\n)[ \t]*#[ \t]*include[ \t]*[<\"](libpng[0-9]*/)?png(conf)?\\.h[>\"]",
         [](auto path) {
             return isCode(std::string(path)) && isProduct(path) && !path.starts_with("shared/image/png");
         },
         "shared/image/radiance.cpp",
         {"#include <png.h>", "int a;\n  # include \"png.h\"", "#include <libpng16/png.h>",
          "#include <pngconf.h>"},
         {{"shared/image/png_planted.cpp", "#include <png.h>"},
          {"tests/unit/planted.cpp", "#include <png.h>"},
          {"compare/planted.cpp", "#include \"shared/image/png.h\""}}},
        // setting_values.h says what a path can do.
        {"paths are compared in one file",
         {"Path::"},
         "[!=]= *Path::\\w|\\bPath::\\w+ *[!=]=",
         [](auto path) {
             return isCode(std::string(path)) && isProduct(path) && path != "shared/frame/setting_values.h";
         },
         "compare/planted.cpp",
         {"if (s.path == Path::deferred) return;", "return Path::reference != path;"},
         {{"compare/planted.cpp", "settings.path = Path::deferred;"},
          {"tests/unit/planted.cpp", "if (s.path == Path::deferred) return;"}}},
        {"no file names a folder of one machine",
         {"/home", "/work", "/root", "/Users"},
         "/(home|work|root|Users)/[A-Za-z0-9_.]",
         [](auto path) {
             const std::string file(path);
             return isCode(file) || endsIn(file, {".md", ".txt", ".json", "diptych", "run"});
         },
         "README.md",
         {"see /home"
          "/jo/scene.glb"},
         {{"README.md", "see https://example.org/homework/a"}}},
    };
    return all;
}

// The lines around each of the parts: a match has at most 200 characters before and after one.
std::vector<std::string> linesAround(const std::string& text, const std::vector<std::string_view>& parts) {
    std::vector<std::string> found;
    for (const std::string_view part : parts)
        for (std::size_t at = text.find(part), end; at != text.npos; at = text.find(part, end)) {
            const std::size_t start = at < 200 ? text.npos : text.rfind('\n', at - 200);
            end = std::min(text.find('\n', at + 200), text.size());
            found.push_back(text.substr(start + 1, end - start - 1));
        }
    return found;
}

Faults faultsOf(const Convention& convention, const Files& files) {
    const std::regex pattern(convention.pattern);
    Faults faults;
    for (const auto& [path, text] : files) {
        if (!convention.forbidden(path)) continue;
        std::smatch match;
        const std::vector<std::string> around = linesAround(text, convention.parts);
        if (std::ranges::any_of(around, [&](const auto& t) { return std::regex_search(t, match, pattern); }))
            faults.push_back(path + ": " + match.str());
    }
    return faults;
}

TEST(Conventions, Hold) {
    for (const Convention& convention : conventions())
        EXPECT_EQ(joined(faultsOf(convention, sources())), "") << convention.name;
}

TEST(Conventions, EachPlantedFaultIsFound) {
    for (const Convention& convention : conventions()) {
        EXPECT_FALSE(convention.faulty.empty()) << convention.name;
        for (const char* line : convention.faulty)
            EXPECT_EQ(faultsOf(convention, {{convention.path, line}}).size(), 1u) << line;
        for (const auto& [path, line] : convention.sound)
            EXPECT_EQ(faultsOf(convention, {{path, line}}), Faults{}) << line;
    }
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
    EXPECT_EQ(withoutLicence({{"compare/a.cpp", "int a;\n"},
                              {"README.md", "#"},
                              {".ci/run", "#!/bin/sh\n# SPDX-License-Identifier: MIT\n"},
                              {"diptych", "#!/bin/sh\nset -e\n"}}),
              (Faults{"compare/a.cpp", "diptych"}));
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
