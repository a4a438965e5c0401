#include "info_command.h"

#include <cstdio>

#include "brume/brume.h"
#include "command_line.h"

int info_command(const std::vector<std::string>& arguments) {
  std::string file;
  bool help = false;
  CLI::App app;
  app.set_help_flag();
  app.add_flag("-h,--help", help);
  app.add_option("FILE", file);
  parse(app, arguments);
  if (help) {
    std::puts(
        "Usage: brume info FILE\n\n"
        "Shows what a scene (.pbrt), a volume (.vdb, .nvdb, .vol) or a picture (.exr, .pfm) holds.");
    return 0;
  }
  if (file.empty()) throw UsageError("brume info needs the name of a file");
  std::fputs(brume::describe_file(file).c_str(), stdout);
  return 0;
}
