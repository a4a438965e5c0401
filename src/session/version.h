#pragma once

#include <string>

namespace brume {

// "Brume 0.1.0": what pictures name as their software.
std::string software_name();

}  // namespace brume
