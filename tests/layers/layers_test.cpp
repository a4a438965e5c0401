// Guards the layering: which folder may include which, and where other libraries' headers may appear, as the table of
// docs/architecture.md says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "layers/include_rules.h"

namespace brume {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

const Rooms& rooms() {
  static const Rooms from_page = read_rooms(text_of(fs::path(BRUME_ROOT) / "docs/architecture.md"));
  return from_page;
}

bool is_source(const fs::path& file) {
  const std::string suffix = file.extension().string();
  return suffix == ".h" || suffix == ".cpp" || suffix == ".inl" || suffix == ".glsl" || suffix == ".comp";
}

TEST(Layers, EveryIncludeIsAllowedByTheTable) {
  int files = 0;
  for (const char* top : {"include", "src", "apps", "tests", "bench"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(BRUME_ROOT) / top)) {
      if (!entry.is_regular_file() || !is_source(entry.path())) continue;
      ++files;
      const std::string path = fs::relative(entry.path(), BRUME_ROOT).generic_string();
      EXPECT_THAT(include_faults(rooms(), path, text_of(entry.path())), IsEmpty());
    }
  EXPECT_GT(files, 40) << "the sources were not found below " << BRUME_ROOT;
}

TEST(Layers, EveryFolderOfSrcHasItsRow) {
  for (const auto& entry : fs::directory_iterator(fs::path(BRUME_ROOT) / "src")) {
    if (!entry.is_directory()) continue;
    EXPECT_TRUE(rooms().contains("src/" + entry.path().filename().string())) << entry.path();
  }
}

// Data flows one way: following the table's arrows never leads back to where one began.
TEST(Layers, TableHasNoCycle) {
  std::map<std::string, int> depth;  // longest way down from a room; -1 while it is being found
  const std::function<int(const std::string&)> depth_of = [&](const std::string& folder) {
    if (const auto known = depth.find(folder); known != depth.end()) {
      EXPECT_GE(known->second, 0) << folder << " leads back to itself";
      return known->second;
    }
    EXPECT_TRUE(rooms().contains(folder)) << folder << " is included by the table but has no row";
    if (!rooms().contains(folder)) return 0;
    depth[folder] = -1;
    int deepest = 0;
    for (const std::string& below : rooms().at(folder).rooms) deepest = std::max(deepest, 1 + depth_of(below));
    return depth[folder] = deepest;
  };
  for (const auto& [folder, room] : rooms()) depth_of(folder);
}

// The twins: what the check is there to find, planted one by one.
struct Planted {
  const char *path, *text;
};

class PlantedFault : public testing::TestWithParam<Planted> {};

TEST_P(PlantedFault, IsFound) {
  const auto [path, text] = GetParam();
  EXPECT_THAT(include_faults(rooms(), path, std::string("// A file.\n") + text + "\n"),
              ElementsAre(HasSubstr(std::string(path) + ":2:")));
}

constexpr Planted planted[] = {
    {"src/base/x.h", "#include \"scene/description.h\""},        // upwards
    {"src/scene/x.cpp", "#include \"volume/volume_grid.h\""},    // sideways
    {"src/render/x.cpp", "#include \"scene/description.h\""},    // past the compiled scene
    {"src/volume/x.cpp", "  #  include \"render/backend.h\""},   // spaced
    {"src/volume/x.cpp", "#include \"../render/backend.h\""},    // by a relative path
    {"apps/brume/x.cpp", "#include \"base/file.h\""},            // past the public interface
    {"include/brume/x.h", "#include \"base/spectrum.h\""},       // the public interface stands alone
    {"include/brume/x.h", "#include <fmt/format.h>"},            // ... without other libraries
    {"src/kernel/phase/x.inl", "#include \"kernel/scalar.h\""},  // kernel files include nothing
    {"src/kernel/x.inl", "#include <cmath>"},                    // ... not even the standard library
    {"src/scene/x.cpp", "#include <openvdb/openvdb.h>"},         // other libraries have their folders
    {"src/compile/x.cpp", "#include <nanovdb/NanoVDB.h>"},
    {"tests/render/x.cpp", "#include <openvdb/openvdb.h>"},
    {"src/render/x.cpp", "#include <unistd.h>"},
    {"src/render/x.cpp", "#include <embree3/rtcore.h>"},
    {"src/render/x.cpp", "#include \"embree3/rtcore.h\""},  // ... in quotes too
    {"tests/render/x.cpp", "#include \"embree3/rtcore.h\""},
    {"src/render/x.cpp", "#include <hwy/highway.h>"},  // Highway without foreach_target
    {"src/volume/x.cpp", "#include <unknown_library.h>"},
    {"src/render/x.cpp", "#include SOME_FILE"},  // cannot be judged
};
INSTANTIATE_TEST_SUITE_P(Layers, PlantedFault, testing::ValuesIn(planted));

TEST(Layers, FolderWithoutRowIsFound) {
  EXPECT_THAT(include_faults(rooms(), "src/attic/x.h", ""), ElementsAre(HasSubstr("not in the table")));
}

TEST(Layers, AllowedIncludesPass) {
  EXPECT_THAT(include_faults(rooms(), "src/volume/x.cpp",
                             "#include \"volume/x.h\"\n#include <nanovdb/NanoVDB.h>\n#include <vector>\n"
                             "#include \"base/file.h\"\n"),
              IsEmpty());
  EXPECT_THAT(
      include_faults(rooms(), "src/render/x.cpp", "#include <hwy/foreach_target.h>\n#include <hwy/highway.h>\n"),
      IsEmpty());
  EXPECT_THAT(include_faults(rooms(), "src/base/x.cpp", "#include <unistd.h>\n"), IsEmpty());
  EXPECT_THAT(include_faults(rooms(), "tests/layers/x.cpp", "#include <gtest/gtest.h>\n#include \"layers/x.h\"\n"),
              IsEmpty());
}

}  // namespace
}  // namespace brume
