#pragma once

#include <string>
#include <vector>

// brume phase. Returns the exit code; throws UsageError and brume::Error.
int phase_command(const std::vector<std::string>& arguments);
