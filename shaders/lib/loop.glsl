// SPDX-License-Identifier: MIT
// The loop over what differs from pixel to pixel:
//
//     uvec2 range = uvec2(begin, end);
//     EACH(range) {
//         ... range.x ...
//         NEXT(range);
//     }
//
// On lavapipe a loop with its test at the top alone runs one body too many; with its test at the bottom
// alone it goes on adding to pixels that are done while others of the same eight are not, because values
// are masked only where control flow merges. So the loop has both exits.
#ifndef LOOP_GLSL
#define LOOP_GLSL

#define EACH(range) while (range.x < range.y)
#define NEXT(range) \
    if (++range.x >= range.y) break

#endif
