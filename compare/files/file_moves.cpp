// SPDX-License-Identifier: MIT
#include "compare/files/file_moves.h"

#include "compare/files/our_files.h"
#include "shared/image/atomic_file.h"
#include "shared/text/json.h"

#include <sys/stat.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace diptych {
namespace {

namespace fs = std::filesystem;

constexpr const char* begunName = ".diptych.put";  // the folder whose files are being moved out
constexpr const char* listName = ".plan.json";     // inside it: the list of moves
constexpr const char* oldName = ".old";            // inside it: replaced files, until all moves are done

bool isThere(const fs::path& path) {
    return fs::exists(fs::symlink_status(path));
}

// Moves files, and can move them back.
class UndoableMoves {
public:
    void make(const fs::path& from, const fs::path& to) {
        makeFolder(to.parent_path());
        made_.emplace_back(from, to);
        if (std::rename(from.c_str(), to.c_str()) == 0) return;
        const int error = errno;
        made_.pop_back();
        throw std::runtime_error(writingFailed(to, error));
    }

    // Moves `from` to `to` and keeps the old `to` as `kept`. Where the file system has hard links, `to`
    // exists at every moment.
    void replace(const fs::path& from, const fs::path& to, const fs::path& kept) {
        makeFolder(kept.parent_path());
        if (::link(to.c_str(), kept.c_str()) != 0) {
            make(to, kept);
            return make(from, to);
        }
        made_.emplace_back(to, kept);
        if (std::rename(from.c_str(), to.c_str()) != 0) throw std::runtime_error(writingFailed(to, errno));
    }

    bool undo() noexcept {
        bool all = true;
        for (; !made_.empty(); made_.pop_back())
            all = std::rename(made_.back().second.c_str(), made_.back().first.c_str()) == 0 && all;
        for (; !folders_.empty(); folders_.pop_back()) ::rmdir(folders_.back().c_str());
        return all;
    }

private:
    void makeFolder(const fs::path& folder) {
        folders_.push_back(folder);
        if (::mkdir(folder.c_str(), 0777) == 0) return;
        const int error = errno;
        folders_.pop_back();
        if (error == EEXIST) return;
        if (error != ENOENT) throw std::runtime_error(writingFailed(folder, error));
        makeFolder(folder.parent_path());
        makeFolder(folder);
    }

    std::vector<std::pair<fs::path, fs::path>> made_;
    std::vector<fs::path> folders_;
};

std::vector<std::string> removedBy(const FileMoves& moves) {
    std::vector<std::string> names;
    for (const std::string& name : moves.earlier)
        if (std::ranges::count(moves.files, name) == 0) names.push_back(name);
    return names;
}

// Removes folders that are now empty, such as "1" after "1/lit.png" was removed.
void removeEmptied(const fs::path& folder, const FileMoves& moves) {
    for (const std::string& name : removedBy(moves))
        for (const fs::path& inner : foldersOf(name)) ::rmdir((folder / inner).c_str());
}

std::vector<std::string> namesIn(const nlohmann::json& json, const char* key) {
    std::vector<std::string> names;
    if (json.contains(key) && json[key].is_array())
        for (const auto& name : json[key])
            if (name.is_string() && isOurName(name.get<std::string>())) names.push_back(name);
    return names;
}

FileMoves readMoves(const fs::path& file) {
    nlohmann::json json;
    try {
        json = jsonIn(file);
    } catch (const std::runtime_error&) {  // said below
    }
    if (!json.is_object() || !json.contains("files"))
        throw std::runtime_error(
            file.string() + ": left by a program that was killed, and cannot be read; remove its folder");
    return {namesIn(json, "files"), namesIn(json, "earlier")};
}

// Cleans up when everything new is in place. The list of moves is removed last: if the program is killed in
// between, finishMoves() can repeat the clean-up.
void removeBegun(const fs::path& begun) {
    std::error_code ignored;
    std::vector<fs::path> folders;  // of replaced files, and those that files were moved out of
    for (fs::directory_iterator entry(begun, ignored), end; !ignored && entry != end;
         entry.increment(ignored))
        if (entry->is_directory(ignored)) folders.push_back(entry->path());
    for (const fs::path& folder : folders) fs::remove_all(folder, ignored);
    fs::remove(begun / listName, ignored);
    ::rmdir(begun.c_str());
}

}  // namespace

void moveFiles(const fs::path& folder, Temporary& made, const FileMoves& moves) {
    writeFile(made.path() / listName,
              nlohmann::json{{"files", moves.files}, {"earlier", moves.earlier}}.dump());
    const fs::path begun = folder / begunName;
    const fs::path temporary = made.path();
    if (std::rename(temporary.c_str(), begun.c_str()) != 0)
        throw std::runtime_error(writingFailed(folder, errno));
    UndoableMoves done;
    try {
        for (const std::string& name : moves.files) {
            if (isThere(folder / name))
                done.replace(begun / name, folder / name, begun / oldName / name);
            else
                done.make(begun / name, folder / name);
        }
        for (const std::string& name : removedBy(moves))
            if (fs::is_regular_file(fs::symlink_status(folder / name)))
                done.make(folder / name, begun / oldName / name);
    } catch (...) {
        // If undoing fails as well, the list of moves stays, and the next program finishes the moves.
        if (done.undo()) std::rename(begun.c_str(), temporary.c_str());
        throw;
    }
    removeEmptied(folder, moves);
    removeBegun(begun);
}

bool isMoveBegun(const fs::path& folder) {
    return isThere(folder / begunName);
}

void finishMoves(const fs::path& folder) {
    const fs::path begun = folder / begunName;
    if (!isThere(begun) || ::rmdir(begun.c_str()) == 0) return;
    const FileMoves moves = readMoves(begun / listName);
    UndoableMoves done;
    for (const std::string& name : moves.files)
        if (isThere(begun / name)) done.make(begun / name, folder / name);
    std::error_code error;
    for (const std::string& name : removedBy(moves))
        if (fs::is_regular_file(fs::symlink_status(folder / name))) fs::remove(folder / name, error);
    removeEmptied(folder, moves);
    removeBegun(begun);
}

}  // namespace diptych
