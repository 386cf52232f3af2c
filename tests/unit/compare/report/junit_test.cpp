// SPDX-License-Identifier: MIT
// junit.xml, checked against its readers' rules:
//   junit-10.xsd of Jenkins' xUnit plugin: nesting, allowed and required attributes, format of times
//   GitLab and Jenkins: counts match the cases; case names are unique within a suite; attachments are
//   lines [[ATTACHMENT|file]] in a case's system-out, and the files exist
#include "compare/report/json.h"
#include "compare/report/layout.h"
#include "compare/report/report.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>

namespace diptych {
namespace {

namespace fs = std::filesystem;

struct Element {
    std::string name, text;
    std::map<std::string, std::string> attributes;
    std::vector<Element> children;

    std::vector<const Element*> all(const std::string& kind) const {
        std::vector<const Element*> found;
        for (const Element& child : children)
            if (child.name == kind) found.push_back(&child);
        return found;
    }
    int number(const std::string& attribute) const { return std::stoi(attributes.at(attribute)); }
};

std::string unescaped(std::string text) {
    for (const auto& [code, letter] :
         {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}, {"&amp;", "&"}})
        for (std::size_t i = text.find(code); i != std::string::npos; i = text.find(code, i + 1))
            text.replace(i, std::string(code).size(), letter);
    return text;
}

// The element that begins at `at`; moves `at` behind it. The text has passed markupFault().
Element element(const std::string& xml, std::size_t& at) {
    Element result;
    const std::size_t end = xml.find('>', at);
    const std::string tag = xml.substr(at + 1, end - at - 1);
    result.name = tag.substr(0, tag.find_first_of(" /"));
    static const std::regex attribute(" ([a-z]+)=\"([^\"]*)\"");
    for (std::sregex_iterator i(tag.begin(), tag.end(), attribute), none; i != none; ++i)
        EXPECT_TRUE(result.attributes.emplace((*i)[1], unescaped((*i)[2])).second) << "twice: " << tag;
    at = end + 1;
    if (tag.ends_with('/')) return result;
    while (xml.compare(at, 2, "</") != 0)
        if (xml[at] == '<')
            result.children.push_back(element(xml, at));
        else
            result.text += xml[at++];
    at = xml.find('>', at) + 1;
    result.text = unescaped(result.text);
    return result;
}

Element rootOf(const std::string& xml) {
    EXPECT_EQ(markupFault(xml), "");
    std::size_t at = xml.find("<testsuites");
    return element(xml, at);
}

struct ElementRule {
    std::set<std::string> children, needed, allowed;
    bool text = false;
};
const std::map<std::string, ElementRule> elementRules{
    {"testsuites", {{"testsuite"}, {}, {"name", "time", "tests", "failures", "errors"}}},
    {"testsuite",
     {{"testsuite", "properties", "testcase", "system-out", "system-err"},
      {"name", "tests", "failures", "errors"},
      {"name", "tests", "failures", "errors", "group", "time", "skipped", "timestamp", "hostname", "id",
       "package", "file", "log", "url"}}},
    {"testcase",
     {{"skipped", "error", "failure", "system-out", "system-err"},
      {"name"},
      {"name", "time", "classname", "group"}}},
    {"properties", {{"property"}, {}, {}}},
    {"property", {{}, {"name", "value"}, {"name", "value"}}},
    {"failure", {{}, {}, {"type", "message"}, true}},
    {"skipped", {{}, {}, {"type", "message"}, true}},
    {"system-out", {{}, {}, {}, true}}};

void findFaults(const Element& element, std::vector<std::string>& faults) {
    const auto rule = elementRules.find(element.name);
    if (rule == elementRules.end()) return faults.push_back(element.name + ": no such element");
    for (const std::string& needed : rule->second.needed)
        if (!element.attributes.contains(needed)) faults.push_back(element.name + " lacks " + needed);
    for (const auto& [name, value] : element.attributes) {
        if (!rule->second.allowed.contains(name)) faults.push_back(element.name + " has " + name);
        if (name == "time" && !std::regex_match(value, std::regex("[0-9]*(\\.[0-9]*)?")))
            faults.push_back("time " + value);
    }
    if (!rule->second.text && element.text.find_first_not_of(" \n") != std::string::npos)
        faults.push_back(element.name + " says " + element.text);
    for (const Element& child : element.children) {
        if (!rule->second.children.contains(child.name))
            faults.push_back(child.name + " stands in " + element.name);
        findFaults(child, faults);
    }
}
std::vector<std::string> faultsOf(const Element& root) {
    std::vector<std::string> faults;
    findFaults(root, faults);
    int tests = 0, failures = 0;
    for (const Element* suite : root.all("testsuite")) {
        int failed = 0, skipped = 0;
        std::set<std::string> names;
        for (const Element* test : suite->all("testcase")) {
            failed += !test->all("failure").empty();
            skipped += !test->all("skipped").empty();
            if (!names.insert(test->attributes.at("name")).second) faults.push_back("a name stands twice");
        }
        const int cases = static_cast<int>(suite->all("testcase").size());
        if (suite->number("tests") != cases || suite->number("failures") != failed ||
            suite->number("skipped") != skipped)
            faults.push_back("a suite's counts are not its cases'");
        tests += cases;
        failures += failed;
    }
    if (root.number("tests") != tests || root.number("failures") != failures)
        faults.push_back("the whole's counts are not its suites'");
    return faults;
}

// Two comparisons. In the second, roughness fails and a Frame is unreliable. Names need escapes.
Report failingOfTwo() {
    std::vector<Frame> frames = bothFrames("a<b>&\"'\x01.glb");
    for (Frame& frame : bothFrames("two ]]> .glb")) frames.push_back(std::move(frame));
    for (Frame& frame : frames) frame.made_in_ms = 1500;
    frames[3].channels[Channel::roughness].at(1, 2) = 0.75f;
    frames[2].counters.unreproduced_pixels = 2;
    frames[0].notes = {"a <note>"};
    return reportOf(std::move(frames));
}

TEST(ReportJunit, KeepsTheRules) {
    const Element root = rootOf(junitOf(failingOfTwo()));
    EXPECT_EQ(faultsOf(root), std::vector<std::string>{});
    ASSERT_EQ(root.all("testsuite").size(), 2u);
    EXPECT_EQ(root.attributes.at("failures"), "2");
    EXPECT_EQ(root.attributes.at("time"), "6.000");
    for (const Element* suite : root.all("testsuite")) {
        EXPECT_EQ(suite->attributes.at("time"), "3.000");
        const auto cases = suite->all("testcase");
        double sum = 0;
        for (const Element* test : cases) sum += std::stod(test->attributes.at("time"));
        EXPECT_NEAR(sum, 3, 0.0005 * static_cast<double>(cases.size()) + 1e-9)
            << "each case's is rounded to a millisecond";
        std::map<std::string, std::string> properties;
        for (const Element* property : suite->all("properties").at(0)->all("property"))
            properties[property->attributes.at("name")] = property->attributes.at("value");
        EXPECT_EQ(properties.at("size"), "4x3");
        EXPECT_EQ(properties.at("device"), "a CPU");
        EXPECT_TRUE(properties.at("command").starts_with("diptych compare --size 4x3 "));
    }
}

TEST(ReportJunit, TheRulesFindFaults) {
    const std::string good =
        "<testsuites tests=\"1\" failures=\"0\"><testsuite name=\"a\" tests=\"1\" failures=\"0\" "
        "errors=\"0\" "
        "skipped=\"0\"><testcase name=\"b\" time=\"1.5\"/></testsuite></testsuites>";
    EXPECT_EQ(faultsOf(rootOf(good)), std::vector<std::string>{});
    for (const auto& [from, to] :
         {std::pair{"time=\"1.5\"", "time=\"1.5 s\""},
          {"time=\"1.5\"", "skipped=\"0\""},
          {"<testcase name=\"b\" time=\"1.5\"/>", "<testcase/>"},
          {" tests=\"1\" failures=\"0\" errors", " tests=\"2\" failures=\"0\" errors"},
          {"<testsuites tests=\"1\" failures=\"0\">", "<testsuites tests=\"1\" failures=\"1\">"},
          {"</testsuite></testsuites>", "</testsuite>text</testsuites>"},
          {"</testsuite>", "<properties/><failure/></testsuite>"}}) {
        std::string bad = good;
        bad.replace(bad.find(from), std::string(from).size(), to);
        if (bad.find("<testcase/>") != std::string::npos)
            bad.replace(bad.find("<testcase/>"), 11, "<testcase name=\"b\"><x/></testcase>");
        EXPECT_NE(faultsOf(rootOf(bad)), std::vector<std::string>{}) << bad;
    }
}

// A channel's deciding metric and limit are in its case, whether it passes or not.
TEST(ReportJunit, EveryEvaluatedChannelSaysWhatWasMeasured) {
    const Element root = rootOf(junitOf(failingOfTwo()));
    int passing = 0, failing = 0;
    for (const Element* suite : root.all("testsuite"))
        for (const Element* test : suite->all("testcase")) {
            if (!test->all("skipped").empty() || test->attributes.at("name") == "frames") continue;
            const std::vector<const Element*> failures = test->all("failure");
            ASSERT_FALSE(test->all("system-out").empty()) << test->attributes.at("name");
            const std::string text =
                failures.empty() ? test->all("system-out").front()->text : failures.front()->text;
            EXPECT_NE(text.find(", limit "), std::string::npos) << test->attributes.at("name") << text;
            ++(failures.empty() ? passing : failing);
        }
    EXPECT_GT(passing, 0);
    EXPECT_GT(failing, 0);
}

// If a difference is too small for 8 bits, both sides share an image.
TEST(ReportJunit, ASharedImageIsAttachedOnce) {
    const Report report = failingOfTwo();
    ReportLayout layout = layoutOf(report, {});
    for (std::vector<ChannelImages>& images : layout.images)
        for (ChannelImages& of : images) of.baseline = of.test = "same.png";
    const std::string junit = reportJunit(report, layout, "out");
    const std::size_t first = junit.find("out/same.png");
    ASSERT_NE(first, std::string::npos);
    EXPECT_EQ(junit.find("out/same.png", first + 1), std::string::npos);
}

// Paths are relative, like the folder given: servers resolve them from the job's working directory.
TEST(ReportJunit, FailingChannelsAttachTheirImages) {
    const fs::path here = folder(), before = fs::current_path();
    fs::current_path(here);
    writeReport(failingOfTwo(), "out/report", {});
    const Element root = rootOf(contentsOf("out/report/junit.xml"));
    std::vector<std::string> attached;
    for (const Element* suite : root.all("testsuite"))
        for (const Element* test : suite->all("testcase"))
            for (const Element* out : test->all("system-out")) {
                static const std::regex line("\\[\\[ATTACHMENT\\|([^\\]]+)\\]\\]\n");
                for (std::sregex_iterator i(out->text.begin(), out->text.end(), line), none; i != none; ++i) {
                    EXPECT_EQ(test->attributes.at("name"), "roughness");
                    attached.push_back((*i)[1]);
                    EXPECT_TRUE(fs::exists(attached.back())) << attached.back();
                }
            }
    fs::current_path(before);
    EXPECT_EQ(attached, (std::vector<std::string>{"out/report/two-ac240a/roughness.difference.png",
                                                  "out/report/two-ac240a/roughness.deferred.png",
                                                  "out/report/two-ac240a/roughness.forward_plus.png"}))
        << "the difference first: some servers show one";
}

}  // namespace
}  // namespace diptych
