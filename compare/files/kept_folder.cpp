// SPDX-License-Identifier: MIT
#include "compare/files/kept_folder.h"

#include "compare/files/our_files.h"
#include "compare/files/output.h"
#include "shared/image/atomic_file.h"
#include "shared/text/json.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <vector>

namespace diptych {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* keyFile = "key.json";

std::string pageOfJson(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json readJson(const fs::path& file) {
    try {
        Json json = orderedJsonIn(file);
        return json.is_object() ? json : Json();
    } catch (const std::runtime_error&) {  // none, or cut short
        return {};
    }
}

}  // namespace

KeptFolder::KeptFolder(const fs::path& out, const std::string& what, const Json& key)
    : folder_(besideOutput(out, what)) {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) throw std::runtime_error(writingFailed(folder_, error.value()));
    // What a link leads to is not ours to empty.
    lock_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (fs::is_symlink(fs::symlink_status(folder_)))
        throw std::runtime_error(folder_.string() +
                                 ": is a link, and only a folder of diptych's own is used; remove it");
    if (lock_ < 0) throw std::runtime_error(writingFailed(folder_, errno));
    // On a file system without locks nothing is locked.
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        throw std::runtime_error(fmt::format(
            "{}: another diptych is at work for the same -o; wait for it, or write to another place",
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

KeptFolder::~KeptFolder() {
    if (lock_ >= 0) ::close(lock_);
}

// The key is removed last: it marks the other files as ours.
void KeptFolder::clear() {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
        if (entry.path().filename() != keyFile) files.push_back(entry.path());
    std::error_code ignored;
    for (const fs::path& file : files) fs::remove_all(file, ignored);
    fs::remove(folder_ / keyFile, ignored);
}

Json KeptFolder::find(const std::string& name) const {
    return readJson(folder_ / (name + ".json"));
}

void KeptFolder::keep(const std::string& name, const Json& part) const {
    writeFile(folder_ / (name + ".json"), pageOfJson(part));
}

void KeptFolder::remove() {
    clear();
    ::rmdir(folder_.c_str());
}

}  // namespace diptych
