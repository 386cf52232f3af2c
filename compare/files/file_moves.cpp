// SPDX-License-Identifier: MIT
#include "compare/files/file_moves.h"

#include "compare/files/diptych_files.h"
#include "shared/image/atomic_file.h"
#include "shared/text/json.h"
#include "shared/text/open_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace diptych {
namespace {

namespace fs = std::filesystem;

constexpr const char* begunName = ".diptych.put";  // folder of files being moved out
constexpr const char* listName = ".plan.json";     // inside it: list of moves
constexpr const char* oldName = ".old";            // inside it: replaced files, until all moves are done

// Twice the list of a report with 100,000 files of 200 bytes per name.
constexpr std::size_t maxOfList = std::size_t{64} << 20;

// Moves files, and can undo the moves.
class UndoableMoves {
public:
    void make(const OpenFolder& from, const OpenFolder& to, const std::string& name) {
        makeFolders(to, name);
        made_.push_back({&from, &to, name});
        const int error = from.move(name, to, name);
        if (error == 0) return;
        made_.pop_back();
        throw std::runtime_error(writingFailed(to.path() / name, error));
    }

    // Moves `from` to `to`, and the replaced file to `kept`. If the file system has hard links, `to`
    // exists at all times.
    void replace(const OpenFolder& from, const OpenFolder& to, const OpenFolder& kept,
                 const std::string& name) {
        makeFolders(kept, name);
        if (to.link(name, kept, name) != 0) {
            make(to, kept, name);
            return make(from, to, name);
        }
        made_.push_back({&to, &kept, name});
        if (const int error = from.move(name, to, name); error != 0)
            throw std::runtime_error(writingFailed(to.path() / name, error));
    }

    bool undo() noexcept {
        bool all = true;
        for (; !made_.empty(); made_.pop_back()) {
            const auto& [from, to, name] = made_.back();
            all = to->move(name, *from, name) == 0 && all;
        }
        for (; !folders_.empty(); folders_.pop_back())
            folders_.back().first->removeFolder(folders_.back().second);
        return all;
    }

private:
    struct Move {
        const OpenFolder *from, *to;
        std::string name;
    };

    void makeFolders(const OpenFolder& directory, const std::string& file) {
        std::vector<fs::path> folders = foldersOf(file);
        std::ranges::reverse(folders);
        for (const fs::path& folder : folders) {
            folders_.emplace_back(&directory, folder);
            const int error = directory.makeFolder(folder);
            if (error == 0) continue;
            folders_.pop_back();
            if (error != EEXIST) throw std::runtime_error(writingFailed(directory.path() / folder, error));
            directory.in(folder);  // throws for a link or a file
        }
    }

    std::vector<Move> made_;
    std::vector<std::pair<const OpenFolder*, fs::path>> folders_;
};

std::vector<std::string> removedBy(const FileMoves& moves) {
    std::vector<std::string> names;
    for (const std::string& name : moves.earlier)
        if (std::ranges::count(moves.files, name) == 0) names.push_back(name);
    return names;
}

// Removes folders that became empty, such as "1" after "1/lit.png".
void removeEmptied(const OpenFolder& directory, const FileMoves& moves) {
    for (const std::string& name : removedBy(moves))
        for (const fs::path& inner : foldersOf(name)) directory.removeFolder(inner);
}

std::vector<std::string> namesIn(const nlohmann::json& json, const char* key) {
    std::vector<std::string> names;
    if (json.contains(key) && json[key].is_array())
        for (const auto& name : json[key])
            if (name.is_string() && isDiptychFileName(name.get<std::string>())) names.push_back(name);
    return names;
}

FileMoves readMoves(const OpenFolder& begun) {
    const nlohmann::json json = [&] {
        try {
            return parseJson(begun.read(listName, maxOfList));
        } catch (const std::runtime_error&) {
            return nlohmann::json();
        }
    }();
    if (!json.is_object() || !json.contains("files"))
        throw std::runtime_error((begun.path() / listName).string() +
                                 ": left by an interrupted run and unreadable; remove its folder");
    return {namesIn(json, "files"), namesIn(json, "earlier")};
}

// Cleans up after all moves. Removes the list last, so that finishMoves() can repeat the clean-up after a
// kill.
void removeBegun(const OpenFolder& directory, const OpenFolder& begun) {
    // Replaced files, and emptied source folders.
    for (const std::string& name : begun.names())
        if (!begun.hasFile(name)) begun.removeAll(name);
    begun.removeFile(listName);
    directory.removeFolder(begunName);
}

}  // namespace

void moveFiles(const fs::path& folder, Temporary& made, const FileMoves& moves) {
    writeFile(made.path() / listName,
              nlohmann::json{{"files", moves.files}, {"earlier", moves.earlier}}.dump());
    const OpenFolder directory = OpenFolder::at(folder);
    const OpenFolder& begun = made.contents();
    const std::string temporary = made.path().filename();
    if (const int error = begun.makeFolder(oldName); error != 0)
        throw std::runtime_error(writingFailed(folder, error));
    const OpenFolder old = begun.in(oldName);
    // From now on the list decides.
    if (!made.rename(begunName)) throw std::runtime_error(writingFailed(folder, errno));
    UndoableMoves done;
    try {
        for (const std::string& name : moves.files) {
            if (directory.has(name))
                done.replace(begun, directory, old, name);
            else
                done.make(begun, directory, name);
        }
        for (const std::string& name : removedBy(moves))
            if (directory.hasFile(name)) done.make(directory, old, name);
    } catch (...) {
        // If undo fails too, the list remains, and the next program finishes the moves.
        if (done.undo() && directory.move(begunName, directory, temporary) == 0) {
            begun.removeContents();
            directory.removeFolder(temporary);
        }
        throw;
    }
    removeEmptied(directory, moves);
    removeBegun(directory, begun);
}

bool isMoveBegun(const fs::path& folder) {
    return fs::exists(fs::symlink_status(folder / begunName));
}

void finishMoves(const fs::path& folder) {
    if (!isMoveBegun(folder)) return;
    const OpenFolder directory = OpenFolder::at(folder), begun = directory.in(begunName);
    // Another user's list would remove files.
    if (const std::string fault = begun.fault(); !fault.empty())
        throw std::runtime_error(fmt::format("{}: {}", begun.path().string(), fault));
    if (directory.removeFolder(begunName) == 0) return;
    const FileMoves moves = readMoves(begun);
    UndoableMoves done;
    for (const std::string& name : moves.files)
        if (begun.has(name)) done.make(begun, directory, name);
    for (const std::string& name : removedBy(moves)) directory.removeFile(name);
    removeEmptied(directory, moves);
    removeBegun(directory, begun);
}

}  // namespace diptych
