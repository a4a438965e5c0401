// Shapes that shine, of every kind, and a square that they light.
#pragma once

#include <vector>

#include "render/scenes.h"

namespace brume {

// Black, of radiance 1.
ShapeDescription emitter(decltype(ShapeDescription::kind) kind, const Transform& place, bool two_sided = false);

// A grey square at z = 0, seen from z = -0.5, with emitters behind the camera.
SceneDescription lit_square(const char* integrator, std::vector<ShapeDescription> emitters);

// Every kind of emitter, alone or with others, in view of the square or around it.
struct Emitters {
  const char* name;
  std::vector<ShapeDescription> shapes;
};
std::vector<Emitters> emitter_cases();
// Such with holes, that shine on both sides: rays that pass one side of them can meet the other.
std::vector<Emitters> cut_out_emitter_cases();

}  // namespace brume
