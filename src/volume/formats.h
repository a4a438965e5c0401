// The readers of single formats, behind read_volume. All throw InputError.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "volume/read_volume.h"

namespace brume {

// `file` names the file in messages; `bytes` are its contents; `index` counts in list_...'s order.
std::vector<GridInfo> list_vdb(const std::string& file, std::string_view bytes);
VolumeGrid read_vdb(const std::string& file, std::string_view bytes, std::size_t index, GridReading reading);

std::vector<GridInfo> list_nvdb(const std::string& file, std::string_view bytes);
VolumeGrid read_nvdb(const std::string& file, std::string_view bytes, std::size_t index, GridReading reading);

std::vector<GridInfo> list_vol(const std::string& file, std::string_view bytes);
VolumeGrid read_vol(const std::string& file, std::string_view bytes, std::size_t index, GridReading reading);

}  // namespace brume
