// SPDX-License-Identifier: MIT
#include "compare/tradeoff/sweep_state.h"

#include "compare/files/our_files.h"
#include "compare/files/output.h"
#include "compare/reference/key.h"
#include "shared/image/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace diptych::tradeoff {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* keyFile = "key.json";

std::string pageOfJson(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// The file's JSON; null if there is no file or it is incomplete.
Json readJson(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const Json json = Json::parse(stream, nullptr, false);
    return json.is_object() ? json : Json();
}

std::string nameOf(const Settings& settings) {
    return fingerprint(toJson(settings, -1));
}
std::string pictureOf(const Settings& settings) {
    return nameOf(settings) + ".png";
}
std::string errorsOf(const Settings& settings) {
    return nameOf(settings) + ".flip.png";
}

}  // namespace

std::string fingerprint(std::string_view bytes) {
    reference::Key key;
    key.add(std::as_bytes(std::span(bytes)));
    return fmt::format("{:016x}", key.value());
}

std::string fingerprint(const ReferenceFrames& references) {
    reference::Key key;
    for (const Frame& frame : references.frames)
        for (const auto& [mode, image] : frame.channels) key.addAll(image.data);
    return fmt::format("{:016x}", key.value());
}

fs::path SweepState::folderOf(const fs::path& out) {
    return besideOutput(out, "sweep");
}

SweepState::SweepState(const fs::path& out, const Json& key) : folder_(folderOf(out)) {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) throw std::runtime_error(writingFailed(folder_, error.value()));
    lock_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ < 0) throw std::runtime_error(writingFailed(folder_, errno));
    // On a file system without locks nothing is locked.
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        throw std::runtime_error(
            fmt::format("{}: another diptych sweeps to the same -o; wait for it, or write to another place",
                        folder_.string()));
    const Json there = readJson(folder_ / keyFile);
    if (there == key) return;
    const bool holdsOthers =
        std::any_of(fs::directory_iterator(folder_), fs::directory_iterator(),
                    [](const auto& e) { return !isTemporaryOf(keyFile, e.path().filename().string()); });
    if (holdsOthers && !isOurManifest(folder_ / keyFile))
        throw std::runtime_error(folder_.string() +
                                 ": is there and was not written by diptych; move it away");
    renewed_ = holdsOthers;
    clear();
    writeFile(folder_ / keyFile, pageOfJson(key));
}

SweepState::~SweepState() {
    if (lock_ >= 0) ::close(lock_);
}

// The key is removed last: it marks the other files as ours.
void SweepState::clear() {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
        if (entry.path().filename() != keyFile) files.push_back(entry.path());
    std::error_code ignored;
    for (const fs::path& file : files) fs::remove(file, ignored);
    fs::remove(folder_ / keyFile, ignored);
}

std::optional<TradeoffRow> SweepState::find(const Settings& settings) const {
    const Json json = readJson(folder_ / (nameOf(settings) + ".json"));
    if (json.is_null()) return {};
    try {
        TradeoffRow row = tradeoffRowFrom(json);
        const bool whole = row.settings == settings && row.picture == pictureOf(settings) &&
                           row.errors_map == errorsOf(settings) && fs::exists(folder_ / row.picture) &&
                           fs::exists(folder_ / row.errors_map);
        return whole ? std::optional(std::move(row)) : std::nullopt;
    } catch (const std::exception&) {  // not what was written: the row is measured again
        return {};
    }
}

void SweepState::keep(MeasuredRow& measured) {
    TradeoffRow& row = measured.row;
    row.picture = pictureOf(row.settings);
    row.errors_map = errorsOf(row.settings);
    writePng(folder_ / row.picture, measured.picture);
    writePng(folder_ / row.errors_map, measured.errors);
    renew(row);
}

void SweepState::renew(const TradeoffRow& row) {
    writeFile(folder_ / (nameOf(row.settings) + ".json"), pageOfJson(jsonOf(row)));
}

void SweepState::remove() {
    clear();
    ::rmdir(folder_.c_str());
}

}  // namespace diptych::tradeoff
