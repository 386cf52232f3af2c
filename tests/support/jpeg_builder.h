// SPDX-License-Identifier: MIT
// JPEG files of one colour, written by libjpeg.
#pragma once

#include <cstdio>  // jpeglib.h needs it

#include <jpeglib.h>

#include <cstdlib>
#include <span>
#include <vector>

namespace diptych {

// A JPEG of 16 x 16 pixels of one colour, stored in the colour space `space`.
inline std::vector<unsigned char> jpeg(J_COLOR_SPACE in, J_COLOR_SPACE space,
                                       std::vector<unsigned char> color, bool progressive = false,
                                       bool adobe = true, std::span<const jpeg_scan_info> scans = {}) {
    jpeg_compress_struct c{};
    jpeg_error_mgr errors{};
    c.err = jpeg_std_error(&errors);
    jpeg_create_compress(&c);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&c, &data, &size);
    c.image_width = c.image_height = 16;
    c.input_components = static_cast<int>(color.size());
    c.in_color_space = in;
    jpeg_set_defaults(&c);
    jpeg_set_colorspace(&c, space);
    jpeg_set_quality(&c, 100, TRUE);
    if (progressive) jpeg_simple_progression(&c);
    if (!scans.empty()) {
        c.scan_info = scans.data();
        c.num_scans = static_cast<int>(scans.size());
    }
    c.write_Adobe_marker = adobe && (space == JCS_CMYK || space == JCS_YCCK || space == JCS_RGB);
    jpeg_start_compress(&c, TRUE);
    std::vector<unsigned char> row;
    for (int x = 0; x < 16; ++x) row.insert(row.end(), color.begin(), color.end());
    unsigned char* line = row.data();
    while (c.next_scanline < c.image_height) jpeg_write_scanlines(&c, &line, 1);
    jpeg_finish_compress(&c);
    jpeg_destroy_compress(&c);
    std::vector<unsigned char> file(data, data + size);
    std::free(data);
    return file;
}

}  // namespace diptych
