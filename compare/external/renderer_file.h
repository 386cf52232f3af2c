// SPDX-License-Identifier: MIT
// Another renderer, as a JSON file names it: its command, and the conventions that it is granted.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::external {

// Curve and primaries of the pixels that a renderer writes; ours are linear and of Rec.709.
enum class Transfer { linear, srgb };
enum class Primaries { rec709, display_p3, rec2020 };

// How a renderer means what it is told, where that is not what the job says: what is told to it, or read from
// it, is changed by as much. Neutral by default.
struct Granted {
    // Told: lights of a kind are so many times as bright as they are; and the environment's radiance.
    double point_factor = 1, spot_factor = 1, directional_factor = 1, area_factor = 1, environment_factor = 1;
    double environment_rotation = 0;    // told: turned by so many degrees more, as --env-rotation
    bool environment_mirrored = false;  // told: the picture of the environment, left for right
    double fov_offset = 0;              // told: so many degrees more, vertically
    // Told: the projection's centre, moved by so many pixels to the right and down. Of the matrix alone.
    double shift_x = 0, shift_y = 0;
    bool upside_down = false, mirrored = false;  // read: row by row, column by column from the other side
    Transfer transfer = Transfer::linear;        // read: what the pixels are decoded from
    Primaries primaries = Primaries::rec709;     // read: what they are converted from
};

// What is granted, a sentence each, as reports say it: "light_factor 2: ...".
std::vector<std::string> inWords(const Granted& granted);

// The names that "granted" of a file may have.
std::vector<std::string_view> grantNames();

struct Renderer {
    std::string name;                  // NAME of --renderer NAME=FILE.json
    std::filesystem::path file;        // as the user wrote it
    std::filesystem::path folder;      // that the file is in, absolute: where the command runs
    std::vector<std::string> command;  // argument list, not empty
    double timeout = 60;               // s, for one picture
    bool posed = false;                // it is always handed a copy of the scene, with all in its place
    Granted granted;
};

// Of "NAME=FILE.json". A name has letters, digits, "-", "_" and dots, and is none that a report gives.
// Throws std::runtime_error, one line: "--renderer three: is NAME=FILE.json", "three.json: timeout: ...".
Renderer readRenderer(const std::string& words);
// The same of a file alone, as `diptych calibrate` takes it; its name is the file's without its ending.
Renderer readRendererFile(const std::filesystem::path& file);

}  // namespace diptych::external
