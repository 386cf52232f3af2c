// SPDX-License-Identifier: MIT
// External renderers: their jobs, their images, and their failures.
#include "shared/image/exr.h"
#include "shared/vulkan/instance/driver_probe.h"
#include "tests/tool/fake_renderer.h"
#include "tests/tool/running.h"
#include "tests/tool/schema.h"

#include <sys/stat.h>

#include <csignal>

namespace diptych {
namespace {

using Json = nlohmann::json;
using namespace std::chrono_literals;

const std::string compare_points = "compare builtin:points --size 32x18 --runs 0 --channels lit -q ";
const fs::path external_room = fs::path(DIPTYCH_SOURCE_DIR) / "compare" / "external";

Json reportOf(const Folder& folder, const std::string& name = "diptych-report") {
    return Json::parse(contentsOf(folder / name / "report.json"));
}

// The comparison with a renderer; null if there is none.
Json comparisonWith(const Json& report, const std::string& name) {
    for (const Json& comparison : report["comparisons"])
        if (comparison["test"] == name) return comparison;
    return nullptr;
}

// Diptych itself as the renderer, through the template. The job is sufficient to reproduce the image from
// a scene, lights and a camera written as glTF and JSON.
TEST(External, WhatAJobSaysIsEnoughToDrawTheImageAgain) {
    for (const std::string scene :
         {"builtin:points", "builtin:spots --camera 'eye=1,2,6 target=0,1,0 fov=50 far=40'"}) {
        const Folder folder;
        const Ran ran = runShell(
            folder,
            "DIPTYCH='" DIPTYCH_PROGRAM "' '" DIPTYCH_PROGRAM "' compare " + scene +
                " --size 96x54 --runs 0 --channels lit -q --baseline forward_plus --renderer again='" +
                (external_room / "adapters" / "template.json").string() + "'",
            folder.path());
        EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
        const Json again = comparisonWith(reportOf(folder), "again");
        ASSERT_FALSE(again.is_null());
        EXPECT_EQ(again["channels"][0]["max"], 0) << scene;
    }
}

TEST(External, JobsAreAsTheSchemaSays) {
    if (!hasValidator()) GTEST_SKIP() << "NO python3-jsonschema: written jobs are not held to the schema";
    const Folder folder;
    writeRenderer(folder, "fake", {"keep", (folder / "kept").string()}, {{"scene", "copy"}});
    EXPECT_EQ(validate(folder, external_room / "renderer.schema.json", folder / "fake.json").code, 0);
    Image sky(8, 4, 3, 0.5f);
    writeExr(folder / "sky.exr", {{{"R", "G", "B"}, &sky}});
    for (const std::string sentence :
         {"builtin:points --env sky.exr --env-rotation 30 --time 0.5", "builtin:areas", "builtin:suns",
          "builtin:ortho", "builtin:motion --camera 'eye=0,2,9 target=0,1,0 fov=40'",
          "builtin:spots --msaa 4"}) {
        runTool(folder, "compare " + sentence +
                            " --size 32x18 --runs 0 --channels lit -q --renderer f=fake.json" + any_image);
        const Ran ran = validate(folder, external_room / "job.schema.json", folder / "kept/job.json");
        EXPECT_EQ(ran.code, 0) << sentence << ran.err;
    }
    // Negative control: a missing member is detected.
    Json job = Json::parse(contentsOf(folder / "kept/job.json"));
    job["lights"][0].erase("unit");
    folder.write("kept/job.json", job.dump());
    EXPECT_NE(validate(folder, external_room / "job.schema.json", folder / "kept/job.json").code, 0);
}

TEST(External, AJobIsAFileAndTheLastArgumentAndNamesWholePaths) {
    const Folder folder;
    const std::string odd = "a 'b' \"c\" $(touch oops) \t d";
    fs::create_directories(folder / odd);
    // Folder for the renderer's file, the temporary files, the scene, and the files that the renderer
    // keeps.
    writeRenderer(folder, "fake", {"keep", (folder / odd / "kept").string(), odd});
    fs::rename(folder / "fake.json", folder / odd / "fake.json");
    folder.write(odd + "/tri.gltf", triangleGltf);
    ::setenv("TMPDIR", (folder / odd).c_str(), 1);
    Running tool(folder, {"compare", (folder / odd / "tri.gltf").string(), "--size", "32x18", "--runs", "0",
                          "-q", "--channels", "lit", "--tolerances", "any.json", "--renderer",
                          "f=" + (folder / odd / "fake.json").string()});
    ASSERT_TRUE(soon([&] { return tool.ended(); }));
    ::unsetenv("TMPDIR");
    ASSERT_TRUE(fs::exists(folder / odd / "kept" / "handed.json")) << tool.err();
    const Json handed = Json::parse(contentsOf(folder / odd / "kept" / "handed.json"));
    EXPECT_EQ(handed["argv"][0], "keep");
    EXPECT_EQ(handed["argv"][2], odd) << "no shell has read it";
    EXPECT_EQ(handed["argv"].size(), 5u);
    EXPECT_EQ(handed["folder"], (folder / odd).string()) << "it runs where its file is";
    const Json job = Json::parse(contentsOf(folder / odd / "kept" / "job.json"));
    EXPECT_EQ(Json::parse(handed["argv"][4].get<std::string>()), job) << "the file and the argument are one";
    EXPECT_EQ(job["scene"]["file"], (folder / odd / "tri.gltf").string());
    EXPECT_EQ(job["scene"]["copy"], false);
    EXPECT_TRUE(job["output"]["file"].get<std::string>().starts_with((folder / odd).string()));
    EXPECT_FALSE(fs::exists(folder / odd / "oops"));
    EXPECT_FALSE(fs::exists(folder / "oops"));
    for (const auto& entry : fs::directory_iterator(folder / odd))
        EXPECT_FALSE(entry.path().filename().string().starts_with(".diptych-job")) << "is removed";
}

TEST(External, AJobHasTheEnvironmentOfTheSettingsTimesItsCorrections) {
    const Folder folder;
    const Image sky(8, 4, 3, 0.5f);
    writeExr(folder / "sky.exr", {{{"R", "G", "B"}, &sky}});
    writeRenderer(folder, "fake", {"keep", (folder / "kept").string()},
                  {{"granted", {{"environment_factor", 3.0}, {"environment_rotation", 40.0}}}});
    runTool(folder, compare_points +
                        "--env sky.exr --ibl-intensity 2 --env-rotation 30 --renderer f=fake.json" +
                        any_image);
    const Json job = Json::parse(contentsOf(folder / "kept/job.json"));
    EXPECT_EQ(job["environment"]["intensity"], 6);
    EXPECT_EQ(job["environment"]["rotation_degrees"], 70);
}

TEST(External, AnyFailureIsAnErrorAndNeverAComparison) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, "render builtin:points --size 32x18 --runs 0 -q -o before.exr").code, 0);
    fs::last_write_time(folder / "before.exr", fs::file_time_type::clock::now() - 24h);
    const std::string before = (folder / "before.exr").string();
    struct Case {
        std::vector<std::string> mode;
        std::string says;
    };
    const std::vector<Case> cases{{{"exit"}, "exited with 3: no licence for <this> machine"},
                                  {{"crash"}, "was ended by signal 11"},
                                  {{"none"}, "wrote no picture"},
                                  {{"wide"}, "its picture is 33x18, but 32x18 was requested"},
                                  {{"nan"}, "lit is NaN or infinite at 1 pixel, the first at 3,2"},
                                  {{"link", before}, "its picture is not a regular file"},
                                  {{"old", before}, "its picture is older than its job"}};
    std::string renderers;
    for (const auto& [mode, says] : cases) {
        writeRenderer(folder, mode[0], mode);
        renderers += " --renderer " + mode[0] + "=" + mode[0] + ".json";
    }
    const Ran ran = runTool(folder, compare_points + renderers);
    EXPECT_TRUE(ran.failedOver("exited with 3: no licence for <this> machine; and 6 more"));
    const Json report = reportOf(folder);
    ASSERT_EQ(report["errors"].size(), cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const std::string& name = cases[i].mode[0];
        EXPECT_EQ(report["errors"][i]["renderer"], name);
        const std::string text = report["errors"][i]["message"];
        EXPECT_NE(text.find(name + " (" + name + ".json): " + cases[i].says), text.npos) << text;
        EXPECT_TRUE(comparisonWith(report, name).is_null()) << name;
    }
    EXPECT_EQ(report["verdict"], "fail");
    EXPECT_EQ(comparisonWith(report, "forward_plus")["verdict"], "pass") << "the paths are compared";
    EXPECT_NE(report["errors"][0]["output"].get<std::string>().find("drawing\nno licence"),
              std::string::npos);
    for (const std::string file : {"index.html", "junit.xml"})
        EXPECT_NE(contentsOf(folder / "diptych-report" / file).find("no licence for &lt;this&gt; machine"),
                  std::string::npos)
            << file;
    folder.write("absent.json", R"({ "command": ["./nobody's program"] })");
    EXPECT_TRUE(runTool(folder, compare_points + "--renderer a=absent.json").failedOver("cannot be started"));
}

// A correct image is one more Frame: a control of all failures above.
TEST(External, AFrameIsComparedReportedAndWritten) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, "render builtin:points --size 32x18 --runs 0 --channels lit -q -o p.exr").code,
              0);
    writeRenderer(folder, "fake", {"copy", (folder / "p.exr").string()});
    Ran ran = runTool(folder, compare_points + "--baseline forward_plus --renderer fake=fake.json");
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    Json report = reportOf(folder);
    const Json fake = comparisonWith(report, "fake");
    EXPECT_EQ(fake["baseline"], "forward_plus");
    EXPECT_EQ(fake["channels"][0]["max"], 0);
    EXPECT_TRUE(fs::exists(folder / "diptych-report/fake.exr"));
    EXPECT_NE(contentsOf(folder / "diptych-report/junit.xml").find("fake against forward_plus"),
              std::string::npos);

    writeRenderer(folder, "fake", {"picture"});
    ran = runTool(folder, compare_points + "--renderer fake=fake.json");
    EXPECT_EQ(ran.code, 1) << "a difference";
    EXPECT_EQ(runTool(folder, compare_points + "--renderer fake=fake.json" + any_image).code, 0);
    // Several renderers, scenes and cameras.
    ran = runTool(
        folder,
        "compare builtin:points builtin:spots --camera 0 --camera 'eye=0,3,9 target=0,1,0' --size 32x18 "
        "--runs 0 --channels lit -q --renderer a=fake.json --renderer b=fake.json --baseline reference" +
            any_image);
    EXPECT_EQ(ran.code, 0) << ran.err;
    report = reportOf(folder);
    EXPECT_EQ(report["comparisons"].size(), 4u * 5u);
    EXPECT_EQ(comparisonWith(report, "b")["baseline"], "reference");
    EXPECT_TRUE(runTool(folder, compare_points + "--renderer a=fake.json --renderer a=fake.json")
                    .failedOver("two renderers have this name"));
}

// Pixels without a surface in our image are not compared, nor do filters spread their colour to
// neighbours.
TEST(External, TheBackgroundIsNotCompared) {
    const Folder folder;
    const std::string ours = "builtin:triangle --size 32x18 --runs 0 -q ";
    ASSERT_EQ(runTool(folder, "render " + ours + "--channels lit,material_id -o p.exr").code, 0);
    const ImageFile file = readExr(folder / "p.exr");
    Image lit = std::ranges::find(file.layers, "", &ImageLayer::name)->image;
    const Image& ids = std::ranges::find(file.layers, "material_id", &ImageLayer::name)->image;
    std::size_t behind = 0;
    for (std::size_t i = 0; i < lit.pixels(); ++i)
        if (ids.pixel(i)[0] < 0) {
            ++behind;
            std::fill_n(lit.pixel(i), 3, 7.0f);
        }
    ASSERT_GT(behind, 0u);
    writeExr(folder / "theirs.exr", {{{"R", "G", "B"}, &lit}});
    writeRenderer(folder, "fake", {"copy", (folder / "theirs.exr").string()});
    EXPECT_EQ(
        runTool(folder, "compare " + ours + "--channels lit --baseline forward_plus --renderer f=fake.json")
            .code,
        0);
    const Json fake = comparisonWith(reportOf(folder), "f");
    EXPECT_EQ(fake["channels"][0]["flip"], 0);
    EXPECT_NE(reportOf(folder)["frames"].back()["notes"].dump().find("f is not black at " +
                                                                     std::to_string(behind) + " pixel"),
              std::string::npos);
}

TEST(External, JsonStandsAloneOnStdoutAndChatterIsCutShort) {
    const Folder folder;
    writeRenderer(folder, "fake", {"chatter"});
    const Ran ran = runTool(folder, compare_points + "--json --renderer fake=fake.json" + any_image);
    const Json report = Json::parse(ran.out);
    const Json& notes = report["frames"].back()["notes"];
    EXPECT_NE(std::ranges::find(notes, Json("fake says: line 19999 of very many")), notes.end()) << notes;
    EXPECT_LT(notes.dump().size(), 4000u);
}

// Whether a process exists and is no zombie.
bool isRunning(pid_t process) {
    const std::string status = contentsOf("/proc/" + std::to_string(process) + "/stat");
    const std::size_t at = status.rfind(") ");
    return at != std::string::npos && status[at + 2] != 'Z';
}

pid_t processIn(const fs::path& file) {
    return soon([&] { return fs::exists(file); }) ? std::stoi(contentsOf(file)) : 0;
}

TEST(External, ATimeoutEndsAllThatItStarted) {
    for (const char* mode : {"flee", "stop"}) {
        const Folder folder;
        writeRenderer(folder, "fake", {mode, (folder / "pid").string()}, {{"timeout", 3}});
        const Ran ran = runTool(folder, compare_points + "--renderer fake=fake.json");
        EXPECT_TRUE(ran.failedOver("was killed after its timeout of 3 s"));
        const pid_t child = processIn(folder / "pid");
        ASSERT_GT(child, 0);
        EXPECT_TRUE(soon([&] { return !isRunning(child); })) << mode;
    }
}

// A renderer that exits normally leaves no process behind either.
TEST(External, ItsEndEndsAllThatItStarted) {
    const Folder folder;
    folder.write("leave.py", fake_renderer +
                                 "\nsubprocess.Popen(['setsid', '-f', 'sh', '-c', 'echo $$ > pid; "
                                 "exec sleep 600']);\nwhile not os.path.exists('pid'): pass\n");
    folder.write("fake.json",
                 Json{{"command", {"python3", (folder / "leave.py").string(), "picture"}}}.dump());
    EXPECT_EQ(runTool(folder, compare_points + "--renderer fake=fake.json").code, 1) << "another picture";
    const pid_t child = processIn(folder / "pid");
    ASSERT_GT(child, 0);
    EXPECT_FALSE(isRunning(child));
}

std::vector<std::string> jobsIn(const fs::path& folder) {
    std::vector<std::string> jobs;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename().string().starts_with(".diptych-job"))
            jobs.push_back(entry.path().filename().string());
    return jobs;
}

// However this program ends; after SIGKILL the next run, with another renderer, removes the job.
TEST(External, AnyEndEndsAllThatItStarted) {
    const Folder folder;
    writeRenderer(folder, "fails", {"exit"});
    fs::create_directory(folder / "tmp");
    const EnvironmentVariables there({{"TMPDIR", (folder / "tmp").string()}});
    const mode_t before = ::umask(0);
    for (const auto& [mode, signal] : {std::pair{"flee", SIGTERM},
                                       {"flee", SIGQUIT},
                                       {"stop", SIGTERM},
                                       {"stop", SIGKILL},
                                       {"flee", SIGKILL}}) {
        writeRenderer(folder, "flee", {mode, (folder / "pid").string()});
        fs::remove(folder / "pid");
        Running tool(folder, {"compare", "builtin:points", "--size", "32x18", "--runs", "0", "-q",
                              "--channels", "lit", "--renderer", "fake=flee.json"});
        const pid_t child = processIn(folder / "pid");
        ASSERT_GT(child, 0) << tool.err();
        ASSERT_TRUE(isRunning(child));
        ASSERT_EQ(jobsIn(folder / "tmp").size(), 1u);
        EXPECT_EQ(fs::status(folder / "tmp" / jobsIn(folder / "tmp").front()).permissions(),
                  fs::perms::owner_all);
        ::kill(tool.process(), signal);
        ASSERT_TRUE(soon([&] { return tool.ended(); }));
        EXPECT_TRUE(WIFSIGNALED(tool.wait()) && WTERMSIG(tool.wait()) == signal) << tool.wait();
        EXPECT_TRUE(soon([&] { return !isRunning(child); })) << signal;
        EXPECT_EQ(jobsIn(folder / "tmp").size(), signal == SIGKILL ? 1u : 0u) << signal;
        for (const std::string& job : jobsIn(folder / "tmp"))
            if (mode == std::string("stop")) fs::remove_all(folder / "tmp" / job);
    }
    ::umask(before);
    EXPECT_TRUE(runTool(folder, compare_points + "--renderer other=fails.json").failedOver("no licence"));
    EXPECT_EQ(jobsIn(folder / "tmp"), std::vector<std::string>());
}

TEST(External, GrantsChangeWhatIsToldAndReadAndAreReported) {
    const Folder folder;
    const auto jobWith = [&](const Json& granted) {
        writeRenderer(folder, "fake", {"keep", (folder / "kept").string()}, {{"granted", granted}});
        EXPECT_EQ(runTool(folder, compare_points + "--renderer fake=fake.json" + any_image).code, 0);
        return Json::parse(contentsOf(folder / "kept/job.json"));
    };
    const Json plain = jobWith(Json::object());
    const Json told = jobWith({{"light_factor", 3.0}, {"fov_offset", 1.0}, {"shift_x", 0.5}});
    EXPECT_NEAR(told["lights"][0]["intensity"].get<double>(),
                3 * plain["lights"][0]["intensity"].get<double>(), 1e-5);
    EXPECT_NEAR(told["camera"]["fov_degrees"].get<double>(), plain["camera"]["fov_degrees"].get<double>() + 1,
                1e-9);
    // Shifts the image by half a pixel to the right: clip-space x increases by -w times this.
    EXPECT_NEAR(told["camera"]["clip_from_view"][8].get<double>(), -2 * 0.5 / 32, 1e-12);
    const Json report = reportOf(folder);
    EXPECT_EQ(report["frames"].back()["origin"]["granted"].size(), 3u);
    EXPECT_NE(contentsOf(folder / "diptych-report/index.html").find("light_factor 3"), std::string::npos);

    // Input corrections: an upside-down image, and one in display colours.
    Image image(32, 18, 3);
    for (int y = 0; y < 18; ++y)
        for (int x = 0; x < 32; ++x)
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = 0.01f * static_cast<float>(y) + 0.001f * static_cast<float>(x);
    writeExr(folder / "theirs.exr", {{{"R", "G", "B"}, &image}});
    const auto readWith = [&](const Json& granted) {
        writeRenderer(folder, "fake", {"copy", (folder / "theirs.exr").string()}, {{"granted", granted}});
        EXPECT_EQ(runTool(folder, compare_points + "--renderer fake=fake.json" + any_image).code, 0);
        ImageFile file = readExr(folder / "diptych-report/fake.exr");
        return std::ranges::find(file.layers, "", &ImageLayer::name)->image;
    };
    // In the middle of the image, where the scene's floor is visible.
    EXPECT_FLOAT_EQ(readWith(Json::object()).at(16, 12), image.at(16, 12));
    EXPECT_FLOAT_EQ(readWith({{"upside_down", true}}).at(16, 12), image.at(16, 5));
    EXPECT_FLOAT_EQ(readWith({{"mirrored", true}}).at(16, 12), image.at(15, 12));
    EXPECT_NEAR(readWith({{"transfer", "srgb"}}).at(16, 12), std::pow((0.136 + 0.055) / 1.055, 2.4), 1e-6);
}

TEST(External, ARendererHasARowOfATradeoff) {
    const Folder folder;
    const std::string ours = "builtin:points --size 32x18 -q ";
    ASSERT_EQ(runTool(folder, "render " + ours + "--runs 0 --channels lit -o p.exr").code, 0);
    writeRenderer(folder, "same", {"copy", (folder / "p.exr").string()});
    writeRenderer(folder, "other", {"picture"});
    writeRenderer(folder, "fails", {"exit"});
    const Ran ran =
        runTool(folder, "tradeoff " + ours +
                            "--runs 2 --json --grid '{\"settings\":{\"path\":[\"forward_plus\"]}}' "
                            "--renderer same=same.json --renderer other=other.json "
                            "--renderer fails=fails.json");
    EXPECT_EQ(ran.code, 2) << "one has failed";
    EXPECT_NE(ran.err.find("no licence"), std::string::npos) << ran.err;
    const Json sweep = Json::parse(ran.out);
    ASSERT_EQ(sweep["rows"].size(), 3u);
    EXPECT_EQ(sweep["rows"][0]["renderer"], nullptr);
    EXPECT_EQ(sweep["rows"][1]["renderer"], "same");
    EXPECT_EQ(sweep["rows"][1]["errors"], sweep["rows"][0]["errors"]) << "one picture, one error";
    EXPECT_GT(sweep["rows"][2]["errors"]["flip"], sweep["rows"][1]["errors"]["flip"]);
    EXPECT_GT(sweep["rows"][1]["ms"]["median"], 0);
    ASSERT_FALSE(sweep["notes"].empty());
    EXPECT_TRUE(
        sweep["notes"].back().get<std::string>().starts_with("no row: builtin:points: renderer fails "));
    for (const Json& front : sweep["fronts"])
        EXPECT_EQ(front["rows"], Json({1})) << "a command's time is no frame's";
    EXPECT_TRUE(fs::exists(folder / "diptych-tradeoff/row-003.png"));
    const std::string page = contentsOf(folder / "diptych-tradeoff/index.html");
    EXPECT_NE(page.find("same, external renderer"), page.npos);
    int warned = 0;
    for (std::size_t at = 0; (at = page.find("its time is its whole command", at)) != page.npos; ++at)
        ++warned;
    EXPECT_EQ(warned, 2) << "both external rows";
    EXPECT_NE(page.find("from start to end: it is left out of the fronts"), page.npos);
}

TEST(External, FilesAreReadStrictly) {
    const Folder folder;
    const std::vector<std::pair<std::string, std::string>> cases{
        {R"({})", "command: must be the program and its arguments"},
        {R"({"command": "sh -c x"})", "command: must be the program and its arguments"},
        {R"({"command": ["x", 3]})", "command: must be the program and its arguments"},
        {R"({"command": ["x"], "timeot": 3})", "timeot: is not a known field of a renderer"},
        {R"({"command": ["x"], "timeout": 0})", "timeout: must be above 0 s"},
        {R"({"command": ["x"], "schema": 2})", "schema: must be 1"},
        {R"({"command": ["x"], "granted": {"light_faktor": 2}})",
         "light_faktor: is not a known field of granted"},
        {R"({"command": ["x"], "granted": {"transfer": "gamma"}})", "\"gamma\" is not one of linear, srgb"},
        {R"({"command")", "is not JSON"}};
    for (const auto& [text, says] : cases) {
        folder.write("r.json", text);
        EXPECT_TRUE(runTool(folder, compare_points + "--renderer r=r.json").failedOver(says)) << text;
    }
    for (const std::string name : {"deferred", "baseline", "", "a/b", ".hidden"}) {
        const Ran ran = runTool(folder, compare_points + "--renderer '" + name + "=r.json'");
        EXPECT_EQ(ran.code, 2) << name;
        EXPECT_EQ(std::ranges::count(ran.err, '\n'), 1) << ran.err;
    }
}

}  // namespace
}  // namespace diptych
