// What files hold, as lines to be shown. Each throws InputError.
#pragma once

#include <string>

#include "brume/scene.h"

namespace brume {

FileDescription describe_volume(const std::string& path);
std::string describe_picture(const std::string& path);

}  // namespace brume
