// The names of the channels that pictures have in OpenEXR files.
#pragma once

#include <array>

namespace brume {

using ChannelNames = std::array<const char*, 3>;

constexpr const char* alpha_channel = "A";
constexpr const char* depth_channel = "Z";
constexpr ChannelNames colour_channels{"R", "G", "B"}, variance_channels{"Variance.R", "Variance.G", "Variance.B"};

}  // namespace brume
