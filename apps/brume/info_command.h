#pragma once

#include <string>
#include <vector>

// brume info FILE. Returns the exit code; throws UsageError and brume::Error.
int info_command(const std::vector<std::string>& arguments);
