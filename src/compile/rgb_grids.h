// Media whose coefficients differ from place to place in each channel, as sums of media that have one grid each.
#pragma once

#include "scene/description.h"

namespace brume {

bool has_rgb_grids(const SceneDescription& scene);

// The same scene, in which a grid for each channel of absorption, and one for each of scattering, stands for every rgb
// grid: media that overlap add up, so nothing else need know of colours that vary. Channels that are the same
// everywhere share a grid, and those that are 0 have none. The first part has the medium's name, the others names that
// no scene can give; shapes that bound the medium are there once for each part, all but the first without a surface.
SceneDescription with_rgb_grids_as_sums(const SceneDescription& scene);

}  // namespace brume
