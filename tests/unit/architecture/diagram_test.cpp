// SPDX-License-Identifier: MIT
// The hand-drawn diagram tests/architecture/overview.svg: its folders exist, and each arrow is an include
// in its direction. Each check has a negative control.
#include "tests/support/sources.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace diptych {
namespace {

constexpr const char* diagramFile = "tests/architecture/overview.svg";

struct DiagramArrow {
    std::string from, to;
};

struct Diagram {
    std::vector<std::string> folders;
    std::vector<DiagramArrow> arrows;
};

// Reads the groups of the file: <g class="box" data-folder="A B"> and <g class="arrow" data-from="A"
// data-to="B">. Readers see where they are drawn.
Diagram readDiagram(const std::string& svg) {
    static const std::regex box("<g class=\"box\" data-folder=\"([^\"]*)\">"),
        arrow("<g class=\"arrow\" data-from=\"([^\"]*)\" data-to=\"([^\"]*)\">");
    Diagram diagram;
    for (std::sregex_iterator it(svg.begin(), svg.end(), box), end; it != end; ++it) {
        std::istringstream folders((*it)[1].str());
        for (std::string folder; folders >> folder;) diagram.folders.push_back(folder);
    }
    for (std::sregex_iterator it(svg.begin(), svg.end(), arrow), end; it != end; ++it)
        diagram.arrows.push_back({(*it)[1].str(), (*it)[2].str()});
    return diagram;
}

bool isFolder(const Files& files, const std::string& folder) {
    const auto first = files.lower_bound(folder + "/");
    return first != files.end() && first->first.starts_with(folder + "/");
}

bool folderIncludes(const Files& files, const std::string& from, const std::string& to) {
    for (auto it = files.lower_bound(from + "/"); it != files.end() && it->first.starts_with(from + "/");
         ++it)
        if (isCode(it->first))
            for (const std::string& target : quotedIncludes(files, it->first))
                if (target.starts_with(to + "/")) return true;
    return false;
}

Faults diagramFaults(const Files& files, const std::string& svg) {
    const Diagram diagram = readDiagram(svg);
    Faults faults;
    for (const std::string& folder : diagram.folders)
        if (!isFolder(files, folder)) faults.push_back(folder + " is not a folder");
    for (const auto& [from, to] : diagram.arrows) {
        const std::string name = from + " -> " + to;
        if (std::ranges::count(diagram.folders, from) == 0 || std::ranges::count(diagram.folders, to) == 0)
            faults.push_back(name + " is not between two boxes");
        else if (!folderIncludes(files, from, to))
            faults.push_back(name + " is no include");
    }
    return faults;
}

TEST(Architecture, TheDrawnDiagramIsOfTheCode) {
    const std::string& svg = sources().at(diagramFile);
    EXPECT_EQ(joined(diagramFaults(sources(), svg)), "");
    EXPECT_GE(readDiagram(svg).folders.size(), 10u);
    EXPECT_GE(readDiagram(svg).arrows.size(), 10u);
}

TEST(Architecture, APlantedFaultOfTheDrawnDiagramIsFound) {
    const Files files{{"deferred/a.cpp", "#include \"shared/draw/b.h\"\n"}, {"shared/draw/b.h", ""}};
    const auto box = [](const std::string& folders) {
        return "<g class=\"box\" data-folder=\"" + folders + "\">\n";
    };
    const auto arrow = [](const std::string& from, const std::string& to) {
        return "<g class=\"arrow\" data-from=\"" + from + "\" data-to=\"" + to + "\">\n";
    };
    const std::string boxes = box("deferred") + box("shared/draw");
    EXPECT_EQ(joined(diagramFaults(files, boxes + arrow("deferred", "shared/draw"))), "");
    EXPECT_EQ(diagramFaults(files, boxes + box("shared/gone")), Faults{"shared/gone is not a folder"});
    EXPECT_EQ(diagramFaults(files, boxes + arrow("shared/draw", "deferred")),
              Faults{"shared/draw -> deferred is no include"});
    EXPECT_EQ(diagramFaults(files, boxes + arrow("deferred", "shared/light")),
              Faults{"deferred -> shared/light is not between two boxes"});
}

}  // namespace
}  // namespace diptych
