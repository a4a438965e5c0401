#pragma once

#include <string>
#include <vector>

// brume bench. Returns the exit code; throws UsageError and brume::Error.
int bench_command(const std::vector<std::string>& arguments);
