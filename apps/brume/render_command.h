#pragma once

#include <string>
#include <vector>

// brume [render] SCENE|VOLUME [options]. Returns the exit code; throws UsageError and brume::Error.
int render_command(const std::vector<std::string>& arguments);
