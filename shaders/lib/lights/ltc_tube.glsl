// SPDX-License-Identifier: MIT
// A closed cylinder under a linearly transformed cosine. All visible parts have one radiance, so only the
// outline counts: two straight lines along the side, and the outermost part of the rim at each end. That
// is the far part if the end's face is visible, else the near part.
#ifndef LTC_TUBE_GLSL
#define LTC_TUBE_GLSL

#include "shaders/lib/lights/ltc.glsl"

// Relative to the surface, in the frame z = n.
struct Tube {
    vec3 centre, half_axis;  // half_axis: from the centre to the top
    vec3 top, bottom;        // centres of its ends
    vec3 towards, across;    // length radius, across the axis: to the surface; cross(axis, towards)
    vec2 tangent;       // (cos, sin) of the angle from `towards` to either line
    bool beside;        // the surface is outside the infinite cylinder: there are lines
    bool top_shows, bottom_shows;
};

// `axis`: unit, from the bottom to the top.
Tube tubeOf(const vec3 centre, const vec3 axis, const float half_length, const float radius) {
    float along = -dot(centre, axis);
    vec3 from_axis = -centre - axis * along;
    float distance = lengthOf(from_axis);
    vec3 other = abs(axis.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 x = distance > 1e-6 * radius ? from_axis / distance : normalized(crossProduct(axis, other));
    Tube t;
    t.centre = centre;
    t.half_axis = axis * half_length;
    t.top = centre + t.half_axis;
    t.bottom = centre - t.half_axis;
    t.towards = x * radius;
    t.across = crossProduct(axis, t.towards);
    t.beside = distance > radius;
    float cosine = t.beside ? radius / distance : 1.0;
    t.tangent = vec2(cosine, sqrt(max(1.0 - cosine * cosine, 0.0)));
    t.top_shows = along > half_length;
    t.bottom_shows = -along > half_length;
    return t;
}

vec2 onRim(const Cone cone, const vec3 direction) {
    vec2 t = vec2(dot(direction, cone.x) * max(cone.half_y, 1e-6 * cone.half_x),
                  dot(direction, cone.y) * cone.half_x);
    return t * inversesqrt(max(dot(t, t), 1e-37));
}

// The rim from one direction to another, counter-clockwise; without lines, all of it or none.
void addRim(inout Outline o, const Cone cone, const vec3 from, const vec3 to, const bool shows,
            const bool beside) {
    Horizon h = horizonOf(cone);
    vec2 p = onRim(cone, from), q = onRim(cone, to);
    float cosine = dot(p, q), sine = p.x * q.y - p.y * q.x;
    // Between two nearly equal ends lies none of the near rim and all of the far rim.
    bool beyond = cosine > 0.9 ? shows : sine < 0.0;
    float angle = angleOf(cosine, abs(sine));
    float rim = 0.5 * (beyond ? 2.0 * PI - angle : angle);  // half of it
    vec2 middle = turned(p, vec2(cos(rim), sin(rim)));
    if (!beside) p = -h.middle, q = p, middle = h.middle, rim = shows ? PI : 0.0;

    // Angles from its middle; the part above the horizon may meet it on both sides.
    vec2 rises = turned(h.middle, vec2(h.half_angle.x, -h.half_angle.y)),
         sets = turned(h.middle, h.half_angle);
    float sky = angleOf(h.half_angle.x, h.half_angle.y);
    bool whole = h.half_angle.x <= -1.0;
    float turn = middle.x * h.middle.y - middle.y * h.middle.x;
    float centre = angleOf(dot(middle, h.middle), abs(turn)) * (turn < 0.0 ? -1.0 : 1.0);
    for (int i = 0; i < 2; ++i) {
        bool cut_first = !whole && centre - sky > -rim, cut_last = !whole && centre + sky < rim;
        float span = (cut_last ? centre + sky : rim) - (cut_first ? centre - sky : -rim);
        if (span > 0.0 && !(whole && i > 0)) {
            o.sum += fromCone(cone, arcFactor(cone, cut_first ? rises : p, cut_last ? sets : q, span > PI));
            if (cut_first) o.returns = onCone(cone, rises);
            if (cut_last) o.leaves = onCone(cone, sets);
        }
        centre += centre > 0.0 ? -2.0 * PI : 2.0 * PI;
    }
}

vec3 tubeFactor(const Ltc m, const Tube t) {
    vec3 top = toCosine(m, t.top), bottom = toCosine(m, t.bottom);
    vec3 x = toCosine(m, t.towards), y = toCosine(m, t.across);
    vec3 left = x * t.tangent.x - y * t.tangent.y, right = x * t.tangent.x + y * t.tangent.y;
    Outline o = noOutline();
    bool on_top = true;
    do {
        vec3 end = on_top ? top : bottom, from = on_top ? left : right, to = on_top ? right : left;
        addRim(o, coneOf(end, x, y), end + from, end + to, on_top ? t.top_shows : t.bottom_shows, t.beside);
        on_top = !on_top;
    } while (!on_top);
    if (t.beside) {
        addEdge(o, top + right, bottom + right);
        addEdge(o, bottom + left, top + left);
    }
    // From afar it is treated as a point, like a parallelogram: the side's middle plane, and an end.
    vec3 c = toCosine(m, t.centre), half_axis = toCosine(m, t.half_axis);
    float c2 = dot(c, c), reach = lengthOf(half_axis) + lengthOf(x) + lengthOf(y);
    float area = 4.0 * abs(dot(c, crossProduct(half_axis, y))) + PI * abs(dot(c, crossProduct(x, y)));
    vec3 afar = c * (area * INVERSE_PI / (c2 * c2));
    return c.z > reach && c2 > 16384.0 * reach * reach ? afar : closed(o);
}

#endif
