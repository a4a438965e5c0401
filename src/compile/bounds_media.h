// Which shapes are boundaries of media.
#pragma once

#include "scene/description.h"

namespace brume {

// Whether the shape alone encloses its inside: a whole sphere, a whole cylinder with caps, or a mesh each of whose
// edges is passed as often one way as the other, corners at the same place counting as one.
bool is_closed(const ShapeDescription& shape);

// Whether a ray that crosses the shape comes into other media. An open surface that no light passes is never crossed:
// like pbrt's floors and lamps, which inherit the current interface, it bounds none. Nor does a cut-out: a ray that
// passes it is as far into media as before.
bool bounds_media(const ShapeDescription& shape);

}  // namespace brume
