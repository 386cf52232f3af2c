// SPDX-License-Identifier: MIT
// File lists, checkpoint keys and move plans that the program writes and reads back.
#include "compare/files/checkpoint_folder.h"
#include "compare/files/diptych_files.h"
#include "compare/files/file_moves.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/scratch_folder.h"

using namespace diptych;

FUZZ_TARGET(ours)(const std::uint8_t* data, std::size_t size) {
    const fuzz::ScratchFolder folder;
    const std::string_view text = fuzz::textAt(data, size);
    folder.write("report.json", text);
    folder.write(".report.json.kept/key.json", text);
    folder.write("out/.diptych.put/.plan.json", text);
    fuzz::readOrSayWhy([&] {
        for (const std::string& name : listedIn(folder / "report.json"))
            fuzz::require(isDiptychFileName(name) && !name.starts_with('/') &&
                              ('/' + name + '/').find("/../") == std::string::npos,
                          "what is listed is one of our names, inside its folder");
    });
    fuzz::readOrSayWhy([&] {
        CheckpointFolder(folder / "report.json", "kept", {{"schema", 1}}).find("part");
    });
    fuzz::readOrSayWhy([&] { finishMoves(folder / "out"); });
    return 0;
}
