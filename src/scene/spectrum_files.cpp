// Spectra that scenes give by the name of a file: text, in which wavelengths in nm and values follow each other in pairs
// and # begins a comment.
#include <fmt/format.h>

#include <filesystem>

#include "base/gzip.h"
#include "scene/reader.h"

namespace brume {

// A name that is no file's stays, for whoever knows it.
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
