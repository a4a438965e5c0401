// Mutated scenes: each is either read or refused by InputError, and what is read can be written and read again. The
// sanitised builds see the rest.
#include <algorithm>
#include <filesystem>
#include <random>

#include "base/file.h"
#include "scene_test.h"

namespace brume {
namespace {

constexpr int mutants = 2000;

std::vector<std::string> texts_in(const std::string& folder) {
  std::vector<std::string> paths, texts;
  for (const auto& entry : std::filesystem::directory_iterator(test_folder(folder)))
    if (entry.path().extension() == ".pbrt") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());  // the folder's order is the file system's
  for (const std::string& path : paths) texts.push_back(read_file(path));
  return texts;
}

class Mutator {
 public:
  // Of a good scene three times out of four.
  std::string mutant() {
    std::string text = pick(below(4) > 0 ? good_ : bad_);
    for (std::size_t edits = 1 + below(3); edits > 0; --edits) edit(text);
    return text;
  }

 private:
  const std::string& pick(const std::vector<std::string>& texts) { return texts[below(texts.size())]; }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % std::max<std::size_t>(n, 1)); }

  void edit(std::string& text) {
    const std::size_t at = below(text.size()), length = 1 + below(20);
    switch (below(8)) {
      case 0:  // a bit
        if (!text.empty()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 1:
        text.erase(std::min(at, text.size()), length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      case 3:
        text.resize(at);
        break;
      case 4: {  // a piece of another scene
        const std::string& other = pick(below(2) > 0 ? good_ : bad_);
        text.insert(at, other.substr(below(other.size()), length));
        break;
      }
      case 5:
      case 6: {  // a digit
        const std::size_t digit = text.find_first_of("0123456789", at);
        if (digit != std::string::npos) text[digit] = "0123456789.-"[below(12)];
        break;
      }
      default: {  // what numbers and strings break at
        const char* const pieces[] = {"1e38", "-",  "99999999999", "\"", "[",      "]",
                                      "nan",  "\\", "0",           "\n", "1e-300", "\xff"};
        text.insert(at, pieces[below(std::size(pieces))]);
      }
    }
  }

  std::vector<std::string> good_ = texts_in("scenes"), bad_ = texts_in("errors");
  std::mt19937 random_{20240501};
};

TEST(Fuzz, MutantsAreReadOrRefused) {
  Mutator mutator;
  int read = 0, refused = 0;
  for (int i = 0; i < mutants; ++i) {
    const std::string text = mutator.mutant();
    std::vector<Diagnostic> warnings;
    SceneDescription scene;
    try {
      scene = read_scene_text(text, "mutant", test_folder("scenes"), warnings);
    } catch (const InputError& e) {
      ++refused;
      EXPECT_FALSE(e.diagnostics().empty());
      EXPECT_LE(e.diagnostics().size(), 21u);  // the last says that there may be more
      continue;
    }
    ++read;
    try {
      read_scene_text(write_scene(scene), "again", "", warnings);
    } catch (const InputError& e) {
      ADD_FAILURE() << "written again, mutant " << i << " is refused:\n" << e.what() << '\n' << text;
    }
  }
  // Mutants that are all refused, or all read, would test little.
  EXPECT_GT(read, mutants / 20);
  EXPECT_GT(refused, mutants / 2);
}

}  // namespace
}  // namespace brume
