// What OpenEXR's own reader would not look at before it allocates.
#pragma once

#include <string_view>

namespace brume {

// Throws std::runtime_error unless the bytes begin with the header of a plain scanline picture, each attribute lies
// within the file, and the file is long enough to hold a picture of the size that dataWindow gives.
void check_exr_header(std::string_view bytes);

}  // namespace brume
