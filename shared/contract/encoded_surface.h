// SPDX-License-Identifier: MIT
// The surfaces that forward+ shades in place of its own to say what a G-buffer's encoding may do to light:
// DrawConstants::surface, read with FEATURE_encoded_surface.
#ifndef DIPTYCH_CONTRACT_ENCODED_SURFACE_H
#define DIPTYCH_CONTRACT_ENCODED_SURFACE_H

#include "types.h"

CONTRACT_BEGIN

// What the G-buffer gives back: encoded and decoded.
CONTRACT_CONST(uint, SURFACE_DECODED, 0);
// The others are moved by what the encoding's bits allow and never encoded. Everything that light is
// multiplied with (colours, F0, F90, occlusion, emission) is raised in all of them.
CONTRACT_CONST(uint, SURFACE_RAISED, 1);
// From here on four: with the normal at each corner of a square around the cone that the bits allow.
CONTRACT_CONST(uint, SURFACE_NORMAL, 2);
// From here on two: with the roughness at each end of what the bits allow.
CONTRACT_CONST(uint, SURFACE_ROUGHNESS, 6);
CONTRACT_CONST(uint, SURFACE_END, 8);
// Added to one of the moved surfaces: it is held against pictures that are shaded in floats of 16 bits, and
// so its normals are turned by what these round, too. It is itself shaded in float32, because 16 bits would
// hide what is less than their step.
CONTRACT_CONST(uint, SURFACE_OF_HALF, 16);

CONTRACT_END

#endif
