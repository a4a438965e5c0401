// The program brume: reads its arguments, calls libbrume, shows what comes back.
#include <cstdio>
#include <exception>

#include "brume/brume.h"
#include "command_line.h"
#include "info_command.h"
#include "render_command.h"

namespace {

int run(std::vector<std::string> arguments) {
  const std::string command = arguments.empty() ? "" : arguments.front();
  if (command != "info" && command != "render") return render_command(arguments);
  arguments.erase(arguments.begin());
  return command == "info" ? info_command(arguments) : render_command(arguments);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const UsageError& e) {
    std::fprintf(stderr, "brume: %s\n", e.what());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
  }
  return 1;
}
