// SPDX-License-Identifier: MIT
// The hand-drawn diagram tests/architecture/overview.svg: its folders exist, and each arrow is an include
// in the drawn direction. Each check has a negative control.
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

struct DiagramBox {
    std::vector<std::string> folders;
    double x = 0, y = 0, width = 0, height = 0;  // rectangle, px

    // True on the border, within the length of an arrow's tip.
    bool touches(double px, double py) const {
        constexpr double tip = 10;  // px
        const bool inside = px > x + tip && px < x + width - tip && py > y + tip && py < y + height - tip;
        return !inside && px >= x - tip && px <= x + width + tip && py >= y - tip && py <= y + height + tip;
    }
};

struct DiagramArrow {
    std::string from, to;
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // first and last point of the path, px
    std::string words;
};

struct Diagram {
    std::vector<DiagramBox> boxes;
    std::vector<DiagramArrow> arrows;

    const DiagramBox* boxOf(const std::string& folder) const {
        for (const DiagramBox& box : boxes)
            if (std::ranges::count(box.folders, folder) > 0) return &box;
        return nullptr;
    }
};

// Reads the groups of the file: <g class="box" data-folder="A B"> with a rect, and <g class="arrow"
// data-from="A" data-to="B"> with a path (absolute M and L) and a text.
Diagram readDiagram(const std::string& svg) {
    static const std::regex box(
        "<g class=\"box\" data-folder=\"([^\"]*)\">\\s*<rect class=\"\\w+\" x=\"(\\d+)\" y=\"(\\d+)\" "
        "width=\"(\\d+)\" height=\"(\\d+)\"/>");
    static const std::regex arrow(
        "<g class=\"arrow\" data-from=\"([^\"]*)\" data-to=\"([^\"]*)\">\\s*<path d=\"M(\\d+) (\\d+)"
        "(?: L\\d+ \\d+)* L(\\d+) (\\d+)\"/><text[^>]*>([^<]*)</text>");
    Diagram diagram;
    for (std::sregex_iterator it(svg.begin(), svg.end(), box), end; it != end; ++it) {
        DiagramBox& found = diagram.boxes.emplace_back();
        std::istringstream folders((*it)[1].str());
        for (std::string folder; folders >> folder;) found.folders.push_back(folder);
        found.x = std::stod((*it)[2].str());
        found.y = std::stod((*it)[3].str());
        found.width = std::stod((*it)[4].str());
        found.height = std::stod((*it)[5].str());
    }
    for (std::sregex_iterator it(svg.begin(), svg.end(), arrow), end; it != end; ++it)
        diagram.arrows.push_back({(*it)[1].str(), (*it)[2].str(), std::stod((*it)[3].str()),
                                  std::stod((*it)[4].str()), std::stod((*it)[5].str()),
                                  std::stod((*it)[6].str()), (*it)[7].str()});
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
    const auto groups = [&](const std::string& start) {
        std::size_t count = 0;
        for (std::size_t at = svg.find(start); at != std::string::npos; at = svg.find(start, at + 1)) ++count;
        return count;
    };
    if (groups("<g class=\"box\"") != diagram.boxes.size() ||
        groups("<g class=\"arrow\"") != diagram.arrows.size())
        faults.push_back("a box or an arrow cannot be read");
    for (const DiagramBox& box : diagram.boxes)
        for (const std::string& folder : box.folders)
            if (!isFolder(files, folder)) faults.push_back(folder + " is not a folder");
    for (const DiagramArrow& arrow : diagram.arrows) {
        const std::string name = arrow.from + " -> " + arrow.to;
        const DiagramBox *from = diagram.boxOf(arrow.from), *to = diagram.boxOf(arrow.to);
        if (!from || !to) {
            faults.push_back(name + " is not between two boxes");
            continue;
        }
        if (!from->touches(arrow.x0, arrow.y0) || !to->touches(arrow.x1, arrow.y1))
            faults.push_back(name + " is drawn between other boxes");
        if (!folderIncludes(files, arrow.from, arrow.to)) faults.push_back(name + " is no include");
        if (arrow.words.empty()) faults.push_back(name + " has no words");
    }
    return faults;
}

TEST(Architecture, TheDrawnDiagramIsOfTheCode) {
    const std::string& svg = sources().at(diagramFile);
    EXPECT_EQ(joined(diagramFaults(sources(), svg)), "");
    EXPECT_GE(readDiagram(svg).boxes.size(), 10u);
    EXPECT_GE(readDiagram(svg).arrows.size(), 10u);
}

TEST(Architecture, APlantedFaultOfTheDrawnDiagramIsFound) {
    const Files files{{"deferred/a.cpp", "#include \"shared/draw/b.h\"\n"}, {"shared/draw/b.h", ""}};
    const auto box = [](const std::string& folders, int y) {
        return "<g class=\"box\" data-folder=\"" + folders + "\">\n  <rect class=\"path\" x=\"0\" y=\"" +
               std::to_string(y) + "\" width=\"100\" height=\"40\"/>\n</g>\n";
    };
    const auto arrow = [](const std::string& from, const std::string& to, const std::string& path,
                          const std::string& words) {
        return "<g class=\"arrow\" data-from=\"" + from + "\" data-to=\"" + to + "\">\n  <path d=\"" + path +
               "\"/><text x=\"0\">" + words + "</text>\n</g>\n";
    };
    const std::string boxes = box("deferred", 0) + box("shared/draw", 100);
    const std::string down = "M50 40 L50 70 L50 100", up = "M50 100 L50 40";
    EXPECT_EQ(joined(diagramFaults(files, boxes + arrow("deferred", "shared/draw", down, "draws with"))), "");
    EXPECT_EQ(diagramFaults(files, boxes + box("shared/gone", 200)), Faults{"shared/gone is not a folder"});
    EXPECT_EQ(diagramFaults(files, boxes + arrow("shared/draw", "deferred", up, "is drawn by")),
              Faults{"shared/draw -> deferred is no include"});
    EXPECT_EQ(diagramFaults(files, boxes + arrow("deferred", "shared/draw", up, "draws with")),
              Faults{"deferred -> shared/draw is drawn between other boxes"});
    EXPECT_EQ(diagramFaults(files, boxes + arrow("deferred", "shared/draw", down, "")),
              Faults{"deferred -> shared/draw has no words"});
    EXPECT_EQ(diagramFaults(files, boxes + arrow("deferred", "shared/light", down, "draws with")),
              Faults{"deferred -> shared/light is not between two boxes"});
    EXPECT_EQ(diagramFaults(files, boxes + arrow("deferred", "shared/draw", "M50 40 V100", "draws with")),
              Faults{"a box or an arrow cannot be read"});
}

}  // namespace
}  // namespace diptych
