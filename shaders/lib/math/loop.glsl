// SPDX-License-Identifier: MIT
// The loop over a range that differs between pixels:
//
//     uvec2 range = uvec2(begin, end);
//     EACH(range) {
//         ... range.x ...
//         NEXT(range);
//     }
//
// On lavapipe a loop with its test only at the top runs one body too many. With its test only at the
// bottom it keeps adding to finished pixels while others of the same eight run. The cause: values are
// masked only where control flow merges. So the loop has both exits.
#ifndef LOOP_GLSL
#define LOOP_GLSL

#define EACH(range) while (range.x < range.y)
#define NEXT(range) \
    if (++range.x >= range.y) break

#endif
