#pragma once

#include <string>
#include <vector>

// brume compare A B [REF]. Returns the exit code, 0 for whatever could be compared; throws UsageError and brume::Error.
int compare_command(const std::vector<std::string>& arguments);
