// Boundaries of media that let the count of media leak.
#pragma once

#include <optional>

#include "render/media_along_ray.h"

namespace brume {

// A place where how often a medium is there depends on the direction in which that is counted: shapes that bound it are
// not closed. Looked for at places near the boundaries of the world and of one instance of each object, and in
// directions that are taken at random, but always the same; none where none was found.
std::optional<kernel::vec3> find_open_boundary(const CompiledScene& scene, const MediaAlongRay& media);

}  // namespace brume
