// The program brume: reads its arguments, calls libbrume, shows what comes back.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
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

const char* const help_text =
    R"(Brume renders clouds, smoke, fog, fire and liquids, and surfaces among them.

  brume smoke.vdb                   a volume, framed and lit, to smoke.png
  brume scene.pbrt -o picture.exr   a scene
  brume --example                   the built-in example, a cloud

Commands, each with its own --help:
  brume [render] FILE   render a .pbrt, .vdb, .nvdb or .vol file
  brume info FILE       what a scene, a volume or a picture holds
  brume make KIND       make a cloud, smoke, fog or fire
  brume phase [NAME]    list the phase functions, or show one
  brume compare A B     how far two pictures are apart
  brume bench           how fast this machine is

Of render's options; brume render --help shows all:
  -o, --output FILE     .png, .exr or .pfm; may be repeated
  --spp N               samples per pixel
  --time SECONDS        as many samples as fit in this time
  --resolution WxH      in pixels
  --quick               a draft
  --write-scene FILE    save the scene, to be edited)";

// The command that a word which is no file may have been meant to be, or "".
std::string nearest_command(const std::string& word, const std::vector<std::string>& commands) {
  std::error_code error;
  if (word.empty() || word[0] == '-' || word.find('.') != std::string::npos || std::filesystem::exists(word, error))
    return {};
  return nearest_name(word, commands);
}

int run(std::vector<std::string> arguments) {
  const std::string command = arguments.empty() ? "" : arguments.front();
  if (command == "--help" || command == "-h" || command == "help") return std::puts(help_text), 0;
  using Command = int (*)(const std::vector<std::string>&);
  const std::map<std::string, Command> commands = {{"bench", bench_command}, {"compare", compare_command},
                                                   {"info", info_command},   {"make", make_command},
                                                   {"phase", phase_command}, {"render", render_command}};
  const auto named = commands.find(command);
  if (named == commands.end()) {
    std::vector<std::string> names;
    for (const auto& [name, function] : commands) names.push_back(name);
    if (const std::string nearest = nearest_command(command, names); !nearest.empty())
      throw UsageError("unknown command " + command + ", did you mean " + nearest + "?");
    return render_command(arguments);
  }
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
