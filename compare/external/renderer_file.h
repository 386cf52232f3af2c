// SPDX-License-Identifier: MIT
// Describes an external renderer, read from a JSON file: its command and its known conventions.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::external {

// Transfer curve and primaries of a renderer's pixels; ours are linear Rec.709.
enum class Transfer { linear, srgb };
enum class Primaries { rec709, display_p3, rec2020 };

// Corrections for a renderer that interprets its inputs differently. "Sent" corrections change the job,
// "read" corrections change its image. Neutral by default.
struct InputCorrections {
    // Sent: factors on the intensity of lights by type, and on the environment's radiance.
    double point_factor = 1, spot_factor = 1, directional_factor = 1, area_factor = 1, environment_factor = 1;
    double environment_rotation = 0;    // sent: additional degrees, as in --env-rotation
    bool environment_mirrored = false;  // sent: flips the environment image left to right
    double fov_offset = 0;              // sent: additional degrees, vertical
    // Sent: shift of the projection centre, pixels right and down. Affects the matrix only.
    double shift_x = 0, shift_y = 0;
    bool upside_down = false, mirrored = false;  // read: reverses rows, columns
    Transfer transfer = Transfer::linear;        // read: curve to decode
    Primaries primaries = Primaries::rec709;     // read: primaries to convert
};

// One sentence per correction, for reports: "light_factor 2: ...".
std::vector<std::string> describe(const InputCorrections& corrections);

// Allowed keys of "granted".
std::vector<std::string_view> correctionNames();

struct ExternalRenderer {
    std::string name;                  // NAME of --renderer NAME=FILE.json
    std::filesystem::path file;        // as given
    std::filesystem::path folder;      // absolute folder of the file; the command's working directory
    std::vector<std::string> command;  // argument list, not empty
    double timeout = 60;               // s, per image
    bool posed = false;                // always send a posed copy of the scene
    InputCorrections corrections;
};

// Parses "NAME=FILE.json". A name has letters, digits, "-", "_" and dots, and is not reserved by reports.
// Throws std::runtime_error, one line: "--renderer three: give NAME=FILE.json", "three.json: timeout:
// ...".
ExternalRenderer readRenderer(const std::string& text);
// Reads a file for `diptych calibrate`. The name is the file's stem.
ExternalRenderer readRendererFile(const std::filesystem::path& file);

}  // namespace diptych::external
