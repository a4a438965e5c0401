// The files that a scene is made of, or names: Include, Import, and spectra.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/gzip.h"
#include "scene/reader.h"

namespace brume {

namespace {

constexpr std::size_t max_include_depth = 64;
constexpr int max_inclusions = 10000;  // in all: files that include each other twice would never end
constexpr std::size_t max_repeated_text = std::size_t{64} << 20;  // bytes, of files that are included again

}  // namespace

void Reader::include() { push_file(); }

void Reader::import() {
  push_file();
  imports_.push_back({state_, coordinate_systems_, stack_.size(), tokens_.open_sources().size()});
}

// Brings back what Import keeps from its file: the file's blocks end with it, and what was set is as it was.
void Reader::end_import() {
  Imported& imported = imports_.back();
  for (; stack_.size() > imported.stack_size; stack_.pop_back())
    messages_.error(stack_.back().place, fmt::format("this {} has no end", stack_.back().begin));
  state_ = std::move(imported.state);
  coordinate_systems_ = std::move(imported.coordinate_systems);
  imports_.pop_back();
}

void Reader::push_file() {
  const Place place = tokens_.peek().place;
  const std::string name = string_argument("a file name");
  const Source& source = open_source(resolve(name), place);
  const auto open = tokens_.open_sources();
  if (std::find(open.begin(), open.end(), &source) != open.end())
    messages_.fail(place, fmt::format("\"{}\" includes itself", printable(name)));
  if (open.size() >= max_include_depth)
    messages_.fail(place, fmt::format("files are included more than {} deep", max_include_depth));
  if (++inclusions_ > max_inclusions)
    messages_.fail(place, fmt::format("more than {} files are included", max_inclusions));
  if (!included_.insert(&source).second) repeated_text_ += source.text.size();
  if (repeated_text_ > max_repeated_text)
    messages_.fail(place,
                   fmt::format("files that are included again have more than {} bytes in all", max_repeated_text));
  tokens_.push(source);
}

std::string Reader::resolve(const std::string& filename) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  // An absolute name replaces the folder.
  const std::string in_folder = (fs::path(folder_) / filename).string();
  return scene_.files.emplace_back(fs::exists(in_folder, ignored) ? in_folder : filename);
}

GivenName Reader::file_name(ParameterList& p, std::string_view parameter) {
  const std::string name = p.string(parameter, "");
  if (name.empty()) {
    if (const Parameter* given = p.find(ParameterType::string, parameter)) p.value_error(*given, 0, "must name a file");
    return {};
  }
  return {resolve(name), location(p.place_of(ParameterType::string, parameter))};
}

const Source& Reader::open_source(const std::string& filename, const Place& place) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path canonical = fs::weakly_canonical(filename, ignored);
  const std::string key = canonical.empty() ? filename : canonical.string();
  if (const auto known = sources_by_name_.find(key); known != sources_by_name_.end()) return *known->second;
  if (!fs::exists(filename, ignored))
    messages_.fail(place, fmt::format("there is no file \"{}\"", printable(filename)));
  if (!fs::is_regular_file(filename, ignored))
    messages_.fail(place, fmt::format("\"{}\" is not a file", printable(filename)));
  std::string& text = texts_[key];
  try {
    text = read_file_unpacked(filename);
  } catch (const InputError& e) {
    messages_.fail(place, fmt::format("\"{}\" {}", printable(filename), e.diagnostics().front().message));
  }
  sources_.push_back(std::make_unique<Source>(Source{filename, text, static_cast<int>(sources_.size())}));
  return *(sources_by_name_[key] = sources_.back().get());
}

// Spectra by the name of a file: text, in which wavelengths in nm and values follow each other in pairs and # begins a
// comment. A name that is no file's stays, for whoever knows it.
void Reader::read_spectrum_file(Parameter& parameter) {
  const std::string filename = resolve(parameter.strings[0]);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(filename, ignored)) return;
  const auto fault = [&](const std::string& what) {
    messages_.error(parameter.first_value, fmt::format("\"{}\" {}", printable(filename), what));
    parameter.faulty = true;
  };
  std::string text;
  try {
    text = read_file_unpacked(filename);
  } catch (const InputError& e) {
    return fault(e.diagnostics().front().message);
  }
  Messages unheard;
  TokenStream tokens(unheard);
  const Source source{filename, text, 0};
  tokens.push(source);
  std::vector<double> numbers;
  for (double v = 0; tokens.next_number(v);) numbers.push_back(v);
  const Token& end = tokens.peek();
  if (end.kind != Token::Kind::end)
    return fault(fmt::format("is no file of pairs of numbers: line {} has {}", end.place.line, describe(end)));
  if (numbers.empty()) return fault("is a file without any numbers");
  parameter.strings.clear();
  parameter.numbers = std::move(numbers);
}

}  // namespace brume
