// Parameter lists: the `"type name" [values]` that follow a directive, read once and then looked up by type and name.
// Every look-up that finds fault notes an error and returns its default, so that all errors of a list are reported;
// finish() reports what nobody looked up.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/colour_space.h"
#include "base/geometry.h"
#include "base/spectrum.h"
#include "scene/tokenizer.h"

namespace brume {

enum class ParameterType {
  float_,
  integer,
  bool_,
  string,
  point2,
  vector2,
  point3,
  vector3,
  normal,
  rgb,
  spectrum,
  blackbody,
  texture,
};
std::string_view type_name(ParameterType type);

struct Parameter {
  ParameterType type = ParameterType::float_;
  std::string name;
  Place place;              // of "type name"
  Place first_value;        // from where place_of_value counts
  bool faulty = false;      // an error was reported for its values
  bool is_default = false;  // from an Attribute directive: may stay unused
  bool used = false;
  ColourSpace space = ColourSpace::srgb;  // of an rgb
  std::vector<double> numbers;            // float, points, vectors, normal, rgb, spectrum pairs, blackbody
  std::vector<std::int64_t> integers;
  std::vector<std::uint8_t> bools;
  std::vector<std::string> strings;  // string, texture, and a spectrum that is named

  std::size_t count() const { return numbers.size() + integers.size() + bools.size() + strings.size(); }
};

// The values that a number may have.
struct Range {
  double lo = -infinity, hi = infinity;
  bool lo_excluded = false, hi_excluded = false;

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static Range any() { return {}; }
  static Range at_least(double lo) { return {lo, infinity, false, false}; }
  static Range above(double lo) { return {lo, infinity, true, false}; }
  static Range from_to(double lo, double hi) { return {lo, hi, false, false}; }
  static Range between(double lo, double hi) { return {lo, hi, true, true}; }
  bool holds(double v) const;
  std::string text() const;  // "must be at least 0"
};

// What a colour is used for, which decides what an rgb, spectrum or blackbody means there (see scene/colour.h).
enum class ColourUse { albedo, coefficient, light };

class ParameterList {
 public:
  // `owner` is what messages call the directive: `Camera "perspective"`.
  ParameterList(std::vector<Parameter> parameters, Messages& messages, std::string owner, Place place);

  const std::string& owner() const { return owner_; }
  const Place& place() const { return place_; }
  void set_owner(std::string owner) { owner_ = std::move(owner); }

  // Adds those of `defaults` that are not given here, whatever their type.
  void add_defaults(const std::vector<Parameter>& defaults);
  // Likewise, but not those that have a default already.
  void add_weaker_defaults(const std::vector<Parameter>& defaults);
  // An old spelling: renames `old_name`, with a warning, where it is there.
  void rename(std::string_view old_name, std::string_view name);

  bool has(ParameterType type, std::string_view name) { return find(type, name) != nullptr; }

  double number(std::string_view name, double fallback, const Range& range = Range::any());
  std::int64_t integer(std::string_view name, std::int64_t fallback, std::int64_t lo, std::int64_t hi);
  bool boolean(std::string_view name, bool fallback);
  std::string string(std::string_view name, const std::string& fallback);
  // The index of the value among `words`; a value that is none of them is an error.
  std::size_t choice(std::string_view name, const std::vector<std::string_view>& words, std::size_t fallback);
  Vector3 triple(ParameterType type, std::string_view name, Vector3 fallback);
  Spectrum colour(std::string_view name, const Spectrum& fallback, ColourUse use);

  // Whole lists; the counts of values are multiples of their type's. Empty where the parameter is missing or faulty.
  std::vector<Vector3> triples(ParameterType type, std::string_view name);
  // The parameter itself, or null; for lists, whose values are checked (and moved away) by the caller.
  Parameter* find(ParameterType type, std::string_view name);

  // Parameters of pbrt's that change nothing here: `ignored` holds "type name" of each.
  void ignore(const std::vector<std::string_view>& ignored);
  void ignore_all();
  // Parameters that ask for what there is not yet: each that is there is an error, or a warning, that says `reason`.
  void refuse(const std::vector<std::string_view>& refused, const std::string& reason);
  void warn(const std::vector<std::string_view>& ineffective, const std::string& reason);

  void error(const Place& place, const std::string& message) { messages_.error(place, message); }
  void warning(const Place& place, const std::string& message) { messages_.warning(place, message); }
  // An error about a parameter's value: `"float fov" of Camera "perspective" MESSAGE`, at the value where it is known.
  void value_error(const Parameter& parameter, std::size_t index, const std::string& message);
  void value_warning(const Parameter& parameter, std::size_t index, const std::string& message);
  // The place of a parameter's first value, or of the directive where there is none.
  Place place_of(ParameterType type, std::string_view name);
  // An error where a parameter that must be there is not; nothing where its values were found faulty.
  void require(ParameterType type, std::string_view name);

  // Reports every parameter that was not looked up.
  void finish();

  std::vector<Parameter> take() { return std::move(parameters_); }

 private:
  struct Asked {
    ParameterType type;
    std::string name;
  };
  Parameter* given(ParameterType type, std::string_view name);
  Parameter* single(ParameterType type, std::string_view name);
  void warn_repeated(const Parameter& parameter);
  void report_unused(const Parameter& parameter);

  Messages& messages_;
  std::string owner_;
  Place place_;
  std::vector<Parameter> parameters_;
  std::vector<Asked> asked_;
};

// The product of a factor and a colour, which must fit floats; `what` is its name in the error.
Spectrum scaled(ParameterList& p, double factor, const Spectrum& colour, std::string_view what);

// The parameters that follow in the stream, as written; faults are noted.
std::vector<Parameter> read_parameters(TokenStream& tokens, Messages& messages);

}  // namespace brume
