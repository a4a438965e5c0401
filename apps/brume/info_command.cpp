#include "info_command.h"

#include <cstdio>

#include "brume/brume.h"
#include "command_line.h"

int info_command(const std::vector<std::string>& arguments) {
  std::string file;
  bool help = false;
  CommandLine line;
  line.flag("-h,--help", help);
  line.option("FILE", file);
  line.parse(arguments);
  if (help) {
    std::puts(
        "Usage: brume info FILE     what a file holds\n\n"
        "  of a scene (.pbrt)             film, camera, integrator, media, shapes and lights\n"
        "  of a volume (.vdb, .nvdb, .vol)    each grid: type, place, densities, the memory that it takes\n"
        "                                 here, and how dense it is, as a help to choose \"scale\"\n"
        "  of a picture (.exr, .pfm)      size, windows, channels, and what it says of how it was made\n\n"
        "  brume info smoke.vdb");
    return 0;
  }
  if (file.empty()) throw UsageError("brume info needs the name of a file");
  const brume::FileDescription description = brume::describe_file(file);
  std::fputs(description.lines.c_str(), stdout);
  for (const std::string& fault : description.faults) std::fprintf(stderr, "%s\n", fault.c_str());
  return description.faults.empty() ? 0 : 1;
}
