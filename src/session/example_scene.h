#pragma once

#include "scene/description.h"

namespace brume {

// The built-in example: a procedural cloud over a wide ground, in a low sun.
SceneDescription example_scene();

}  // namespace brume
