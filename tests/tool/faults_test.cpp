// SPDX-License-Identifier: MIT
// Any failure during writing gives exit code 2 and one line; the earlier report stays complete and nothing
// else is left. A full run makes every call fail in turn, until the tool ends without reaching the next
// one; otherwise only some of the calls are tested.
#include "tests/tool/faults.h"
#include "tests/support/campaign.h"

#include <cstddef>

namespace diptych {
namespace {

#ifndef DIPTYCH_FAULTS
TEST(Faults, NeedABuildWithoutSanitizers) {
    GTEST_SKIP() << "the sanitizers' runtime replaces the same calls";
}
#else

const std::string ofTriangle = " builtin:triangle -q --size 16x9 --runs 0 --channels ";

Ran runWriter(const Folder& folder, const std::string& arguments) {
    return runShell(folder, "'" DIPTYCH_WRITER "' " + arguments, folder.path());
}

// An earlier report and the report that replaces it.
class Reports {
public:
    // `theirs`: the folder also contains a foreign file.
    explicit Reports(const Folder& folder, bool theirs = false) : folder_(folder) {
        EXPECT_EQ(runWriter(folder, "old saved").code, 0);
        EXPECT_EQ(runWriter(folder, "new fresh").code, 0);
        if (theirs)
            for (const char* report : {"saved", "fresh"})
                folder.write(std::string(report) + "/mine.txt", "keep");
        old_ = contentsBelow(folder / "saved");
        new_ = contentsBelow(folder / "fresh");
        // JSON and page contain the time of writing, JUnit the folder's name.
        for (const char* told : {"report.json", "index.html", "junit.xml"}) new_[told] = "";
        EXPECT_NE(old_.size(), new_.size());
        reset();
    }
    void reset() const { replaceBy(report(), folder_ / "saved"); }
    fs::path report() const { return folder_ / "r"; }

    bool isOld(const Contents& there) const { return there == old_; }

    testing::AssertionResult isNew(Contents there) const {
        for (const char* told : {"report.json", "index.html", "junit.xml"}) {
            if (there[told].empty() || there[told] == old_.at(told))
                return testing::AssertionFailure() << told << " is not the new one";
            there[told] = "";
        }
        if (there == new_) return testing::AssertionSuccess();
        std::string names;
        for (const auto& [name, text] : there)
            if (!new_.contains(name) || new_.at(name) != text) names += " " + name;
        return testing::AssertionFailure()
               << there.size() << " of " << new_.size() << " files, other:" << names;
    }

private:
    const Folder& folder_;
    Contents old_, new_;
};

// Makes one call after another fail, until none is left. Returns how many ended in exit code 2, as
// Rows::atMost() expects it. `step`: only every step-th call.
int sweep(const Folder& folder, const Reports& reports, const Fault& fault, int step = 1) {
    const Rows rows(faultStride);
    int failed = 0;
    for (int row = 0, at = 1; at < manyCalls; row = rows.after(row), at = 1 + row * step) {
        const Faulted ran = runFaulted(folder, "new r", fault, at, DIPTYCH_WRITER);
        const std::string where = "call " + std::to_string(at) + ", " + ran.seen;
        const std::vector<std::string> left = leftoversIn(folder.path());
        EXPECT_TRUE(left.empty()) << where << left.front();
        const Contents there = contentsBelow(reports.report());
        if (ran.code == 0) {
            // Either nothing was affected, or the program recovered from the fault.
            EXPECT_TRUE(reports.isNew(there)) << where;
            reports.reset();
        } else {
            EXPECT_TRUE(ran.failedOver("r")) << where;
            EXPECT_TRUE(reports.isOld(there)) << where;
            ++failed;
        }
        if (ran.seen.empty() || testing::Test::HasFailure()) return rows.atMost(failed);
    }
    ADD_FAILURE() << "no end";
    return rows.atMost(failed);
}

// At least this many files are each opened, flushed, closed and renamed. Writes always go to a temporary
// file, so testing every 13th write is enough.
constexpr int reportFiles = 14;

TEST(Faults, AnyCallThatFailsOnceLeavesTheEarlierReport) {
    const Folder folder;
    const Reports reports(folder);
    EXPECT_GE(sweep(folder, reports, {"create,close,move", std::to_string(EIO)}), 4 * reportFiles);
    EXPECT_GE(sweep(folder, reports, {"write", std::to_string(EIO)}, 13), 10);
}

TEST(Faults, ADiskThatIsFullFromAnyMomentOnLeavesTheEarlierReport) {
    const Folder folder;
    const Reports reports(folder);
    const Fault full{"create,write,close", std::to_string(ENOSPC), true};
    EXPECT_GE(sweep(folder, reports, full, 13), 10);
    const Faulted ran = runFaulted(folder, "new r", full, 40, DIPTYCH_WRITER);
    EXPECT_TRUE(ran.failedOver("No space left on device; make room, or write to another place with -o"))
        << ran.err;
}

// In a folder with foreign files the new ones are moved one by one, and moved back on failure.
TEST(Faults, AnyCallThatFailsBesideFilesOfOthersLeavesAllAsItWas) {
    const Folder folder;
    const Reports reports(folder, true);
    EXPECT_GE(sweep(folder, reports, {"move", std::to_string(EROFS)}), 2 * reportFiles);
    EXPECT_GE(sweep(folder, reports, {"create", std::to_string(EROFS)}, 3), 10);
}

// If the folder contains only our files, the old report is complete at once. With foreign files, the next
// run completes the replacement.
void killAtEvery(const std::string& calls, int step, bool theirs, int min) {
    const Folder folder;
    const Reports reports(folder, theirs);
    const Rows rows(faultStride);
    int killed = 0;
    for (int row = 0, at = 1;; row = rows.after(row), at = 1 + row * step) {
        ASSERT_LT(at, manyCalls);
        const Faulted ran = runFaulted(folder, "new r", {calls, "kill"}, at, DIPTYCH_WRITER);
        const std::string where = "call " + std::to_string(at) + ", " + ran.seen;
        if (ran.seen.empty()) break;
        ++killed;
        EXPECT_NE(ran.code, 0) << where;
        if (theirs) {
            ASSERT_EQ(runWriter(folder, "check r").code, 0) << where;
        }
        Contents there = contentsBelow(reports.report());
        std::erase_if(there, [](const auto& entry) { return isLeftover(entry.first); });
        if (reports.isOld(there)) continue;
        ASSERT_TRUE(reports.isNew(there)) << where;
        reports.reset();
    }
    EXPECT_GE(rows.atMost(killed), min);
    EXPECT_TRUE(leftoversIn(folder.path()).empty()) << "the last run sweeps what the killed ones left";
}

TEST(Faults, AKillAtAnyMomentLeavesAWholeReport) {
    killAtEvery("create,close,move,lock", 3, false, reportFiles);
    killAtEvery("remove", 1, false, 10);
    killAtEvery("write", 29, false, 5);
}

TEST(Faults, AKillBesideFilesOfOthersIsMadeGoodByTheNextRun) {
    killAtEvery("move", 1, true, 2 * reportFiles);
    killAtEvery("remove", 1, true, 10);
    killAtEvery("create", 3, true, 10);
}

// The tool itself, including device and main().
TEST(Faults, TheToolSaysItInOneLine) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, "compare -o r" + ofTriangle + "albedo").code, 0);
    const Contents old = contentsBelow(folder / "r");
    const Rows rows(faultStride);
    for (int row = 0, at = 1;; row = rows.after(row), at = 1 + 5 * row) {
        ASSERT_LT(at, manyCalls);
        const Faulted ran = runFaulted(folder, "compare -o r" + ofTriangle + "normals",
                                       {"create,close", std::to_string(ENOSPC)}, at);
        if (ran.seen.empty()) break;
        EXPECT_TRUE(ran.failedOver("No space left on device")) << at << " " << ran.seen;
        EXPECT_EQ(contentsBelow(folder / "r"), old) << at << " " << ran.seen;
        EXPECT_TRUE(leftoversIn(folder.path()).empty()) << at << " " << ran.seen;
    }
}

void killAmongSeveral(bool theirs) {
    const Folder folder;
    const std::string two =
        "render -o r builtin:triangle builtin:triangle -q --size 16x9 --runs 0 --channels ";
    ASSERT_EQ(runTool(folder, two + "albedo").code, 0);
    fs::rename(folder / "r", folder / "saved");
    if (theirs) folder.write("saved/1/mine.txt", "keep");
    const Contents old = contentsBelow(folder / "saved");
    replaceBy(folder / "r", folder / "saved");
    const Rows rows(3 * faultStride);
    int earlier = 0, later = 0;
    // Writes into temporary files have been tested above.
    for (const char* calls : {"move", "remove"})
        for (int row = 0, at = 1;; row = rows.after(row), at = 1 + row) {
            ASSERT_LT(at, manyCalls);
            const Faulted ran = runFaulted(folder, two + "normals", {calls, "kill"}, at);
            if (ran.seen.empty()) break;
            if (theirs) {
                EXPECT_TRUE(runTool(folder, "render -o r no-such.glb no-such.glb").failedOver("no-such.glb"));
            }
            Contents there = contentsBelow(folder / "r");
            std::erase_if(there, [](const auto& entry) { return isLeftover(entry.first); });
            const bool first = there["1/forward_plus.exr"] == old.at("1/forward_plus.exr");
            EXPECT_EQ(there["2/forward_plus.exr"] == old.at("2/forward_plus.exr"), first) << at << ran.seen;
            EXPECT_EQ(there.size(), old.size()) << at << ran.seen;
            ++(first ? earlier : later);
            if (!first) replaceBy(folder / "r", folder / "saved");
        }
    EXPECT_GE(rows.atMost(earlier), 8);
    EXPECT_GE(rows.atMost(later), 3);
    EXPECT_TRUE(leftoversIn(folder.path()).empty()) << leftoversIn(folder.path()).front();
}

TEST(Faults, SeveralFramesAreReplacedTogether) {
    killAmongSeveral(false);
}

TEST(Faults, SeveralFramesBesideFilesOfOthersAreReplacedTogether) {
    killAmongSeveral(true);
}

TEST(Faults, ASingleFileIsOldOrNew) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, "render -o saved.exr" + ofTriangle + "albedo").code, 0);
    const std::string old = contentsOf(folder / "saved.exr");
    const Rows rows(faultStride);
    for (const Fault& fault :
         {Fault{"create,close,move", std::to_string(EIO)}, Fault{"create,close,move,remove", "kill"}}) {
        int hit = 0;
        for (int row = 0, at = 1;; row = rows.after(row), at = 1 + row) {
            ASSERT_LT(at, manyCalls);
            fs::copy_file(folder / "saved.exr", folder / "a.exr", fs::copy_options::overwrite_existing);
            const Faulted ran = runFaulted(folder, "render -o a.exr" + ofTriangle + "normals", fault, at);
            if (ran.seen.empty()) break;
            ++hit;
            EXPECT_EQ(contentsOf(folder / "a.exr"), old) << at << " " << ran.seen;
            if (fault.what != "kill") {
                EXPECT_TRUE(ran.failedOver("a.exr")) << at << " " << ran.seen;
            }
        }
        EXPECT_GE(rows.atMost(hit), 4);
        EXPECT_NE(contentsOf(folder / "a.exr"), old);
        EXPECT_TRUE(leftoversIn(folder.path()).empty());
    }
}

// During replacement a baseline has up to three names: the file, FILE.old and the new temporary file.
TEST(Faults, ABaselineIsNeverLost) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, "render --path deferred -o base.exr" + ofTriangle + "albedo").code, 0);
    const std::string old = contentsOf(folder / "base.exr");
    const Rows rows(3 * faultStride);
    int hit = 0;
    for (const char* calls : {"create", "move", "remove"})
        for (int row = 0, at = 1;; row = rows.after(row), at = 1 + row) {
            ASSERT_LT(at, manyCalls);
            fs::remove(folder / "base.exr.old");
            fs::remove_all(folder / "r");
            folder.write("base.exr", old);
            const Faulted ran = runFaulted(
                folder, "compare -o r --baseline base.exr --update-baseline" + ofTriangle + "albedo,normals",
                {calls, "kill"}, at);
            if (ran.seen.empty()) break;
            ++hit;
            const std::string now = contentsOf(folder / "base.exr");
            EXPECT_TRUE(now == old || contentsOf(folder / "base.exr.old") == old) << at << " " << ran.seen;
            EXPECT_TRUE(now.starts_with("\x76\x2f\x31\x01")) << at << " " << ran.seen;
        }
    EXPECT_GE(rows.atMost(hit), 10);
    EXPECT_TRUE(leftoversIn(folder.path()).empty());
}

#endif

}  // namespace
}  // namespace diptych
