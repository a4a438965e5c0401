#pragma once

#include <string>
#include <vector>

// brume make. Returns the exit code; throws UsageError and brume::Error.
int make_command(const std::vector<std::string>& arguments);
