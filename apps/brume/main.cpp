// The program brume: reads its arguments, calls libbrume, shows what comes back.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <map>

#include "bench_command.h"
#include "brume/brume.h"
#include "command_line.h"
#include "compare_command.h"
#include "info_command.h"
#include "make_command.h"
#include "phase_command.h"
#include "render_command.h"

namespace {

int run(std::vector<std::string> arguments) {
  const std::string command = arguments.empty() ? "" : arguments.front();
  using Command = int (*)(const std::vector<std::string>&);
  const std::map<std::string, Command> commands = {{"bench", bench_command}, {"compare", compare_command},
                                                   {"info", info_command},   {"make", make_command},
                                                   {"phase", phase_command}, {"render", render_command}};
  const auto named = commands.find(command);
  if (named == commands.end()) return render_command(arguments);
  arguments.erase(arguments.begin());
  return named->second(arguments);
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // where a file may grow no more, writing fails with a message, as on a full disk
  try {
    const int exit_code = run({argv + 1, argv + argc});
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return exit_code;
    std::fprintf(stderr, "error: the standard output cannot be written: %s\n", std::strerror(errno));
  } catch (const brume::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
  }
  return 1;
}
