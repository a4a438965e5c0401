#include "scene/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scene/colour.h"

namespace brume {

namespace {

// Names of one or two letters are near to every other; nobody mistypes a very long one, and comparing it takes time.
constexpr std::size_t min_suggested_name = 3, max_suggested_name = 60;

std::string declaration(ParameterType type, std::string_view name) {
  return fmt::format("\"{} {}\"", type_name(type), printable(name));
}
std::string declaration(const Parameter& p) { return declaration(p.type, p.name); }

bool is(const Parameter& p, std::string_view type_and_name) {
  const std::size_t space = type_and_name.find(' ');
  return type_name(p.type) == type_and_name.substr(0, space) && p.name == type_and_name.substr(space + 1);
}

// The place of a list's value, found by reading the list's tokens again.
Place place_of_value(const Parameter& p, std::size_t index) {
  if (index == 0 || !p.first_value.source) return p.first_value.source ? p.first_value : p.place;
  Messages unheard;
  TokenStream tokens(unheard);
  Source rest = *p.first_value.source;
  rest.text.remove_prefix(std::min(p.first_value.offset, rest.text.size()));
  tokens.push(rest);
  Token token;
  for (std::size_t i = 0; i <= index; ++i) {
    token = tokens.next();
    if (token.kind != Token::Kind::number) return p.first_value;  // the list goes on in another file
  }
  Place place = p.first_value;
  place.offset += token.place.offset;
  place.column = token.place.line == 1 ? place.column + token.place.column - 1 : token.place.column;
  place.line += token.place.line - 1;
  return place;
}

}  // namespace

bool Range::holds(double v) const { return (lo_excluded ? v > lo : v >= lo) && (hi_excluded ? v < hi : v <= hi); }

std::string Range::text() const {
  const std::string low = fmt::format("{}{}", lo_excluded ? "above " : "at least ", lo);
  if (hi == infinity) return "must be " + low;
  if (!lo_excluded && !hi_excluded) return fmt::format("must be from {} to {}", lo, hi);
  return fmt::format("must be {} and {}{}", low, hi_excluded ? "below " : "at most ", hi);
}

ParameterList::ParameterList(std::vector<Parameter> parameters, Messages& messages, std::string owner, Place place)
    : messages_(messages), owner_(std::move(owner)), place_(place), parameters_(std::move(parameters)) {}

void ParameterList::add_defaults(const std::vector<Parameter>& defaults) {
  for (const Parameter& d : defaults) {
    const bool given_here = std::any_of(parameters_.begin(), parameters_.end(),
                                        [&](const Parameter& p) { return p.name == d.name && !p.is_default; });
    if (given_here) continue;
    parameters_.push_back(d);
    parameters_.back().is_default = true;
    parameters_.back().used = false;
  }
}

void ParameterList::add_weaker_defaults(const std::vector<Parameter>& defaults) {
  std::vector<Parameter> missing = defaults;
  std::erase_if(missing, [&](const Parameter& d) {
    return std::any_of(parameters_.begin(), parameters_.end(), [&](const Parameter& p) { return p.name == d.name; });
  });
  add_defaults(missing);
}

void ParameterList::rename(std::string_view old_name, std::string_view name) {
  for (Parameter& p : parameters_)
    if (p.name == old_name) {
      messages_.old_spelling(p.place, fmt::format("the parameter \"{}\" is now called \"{}\"", old_name, name));
      p.name = name;
    }
}

Parameter* ParameterList::given(ParameterType type, std::string_view name) {
  Parameter* found = nullptr;
  for (Parameter& p : parameters_)
    if (p.type == type && p.name == name) {
      if (found && !p.is_default && !found->is_default) warn_repeated(p);
      p.used = true;
      found = &p;
    }
  return found;
}

void ParameterList::warn_repeated(const Parameter& p) {
  messages_.warning(p.place, fmt::format("{} is given more than once; the last one counts", declaration(p)));
}

Parameter* ParameterList::find(ParameterType type, std::string_view name) {
  asked_.push_back({type, std::string(name)});
  Parameter* p = given(type, name);
  return p && !p->faulty ? p : nullptr;
}

// A parameter that takes one value.
Parameter* ParameterList::single(ParameterType type, std::string_view name) {
  Parameter* p = find(type, name);
  if (!p) return nullptr;
  const bool triple = type == ParameterType::point3 || type == ParameterType::vector3 || type == ParameterType::rgb;
  const std::size_t expected = triple ? 3 : 1;
  if (p->count() == expected) return p;
  value_error(*p, p->numbers.empty() && p->integers.empty() ? 0 : expected,
              fmt::format("takes {}, found {}", triple ? "3 numbers" : "one value", p->count()));
  return nullptr;
}

double ParameterList::number(std::string_view name, double fallback, const Range& range) {
  const Parameter* p = single(ParameterType::float_, name);
  if (!p) return fallback;
  if (range.holds(p->numbers[0])) return p->numbers[0];
  value_error(*p, 0, fmt::format("{}, found {}", range.text(), p->numbers[0]));
  return fallback;
}

std::int64_t ParameterList::integer(std::string_view name, std::int64_t fallback, std::int64_t lo, std::int64_t hi) {
  const Parameter* p = single(ParameterType::integer, name);
  if (!p) return fallback;
  if (p->integers[0] >= lo && p->integers[0] <= hi) return p->integers[0];
  value_error(*p, 0, fmt::format("must be from {} to {}, found {}", lo, hi, p->integers[0]));
  return fallback;
}

bool ParameterList::boolean(std::string_view name, bool fallback) {
  const Parameter* p = single(ParameterType::bool_, name);
  return p ? p->bools[0] != 0 : fallback;
}

std::string ParameterList::string(std::string_view name, const std::string& fallback) {
  const Parameter* p = single(ParameterType::string, name);
  return p ? p->strings[0] : fallback;
}

std::size_t ParameterList::choice(std::string_view name, const std::vector<std::string_view>& words,
                                  std::size_t fallback) {
  const Parameter* p = single(ParameterType::string, name);
  if (!p) return fallback;
  const auto word = std::find(words.begin(), words.end(), p->strings[0]);
  if (word != words.end()) return static_cast<std::size_t>(word - words.begin());
  std::vector<std::string> quoted;
  for (const std::string_view w : words) quoted.push_back(fmt::format("\"{}\"", w));
  value_error(*p, 0,
              fmt::format("must be {}, found \"{}\"{}", enumerate(quoted, "or"), printable(p->strings[0]),
                          suggestion(p->strings[0], words, {})));
  return fallback;
}

Vector3 ParameterList::triple(ParameterType type, std::string_view name, Vector3 fallback) {
  const Parameter* p = single(type, name);
  return p ? Vector3{p->numbers[0], p->numbers[1], p->numbers[2]} : fallback;
}

std::vector<Vector3> ParameterList::triples(ParameterType type, std::string_view name) {
  std::vector<Vector3> values;
  const Parameter* p = find(type, name);
  if (!p) return values;
  values.reserve(p->numbers.size() / 3);
  for (std::size_t i = 0; i + 2 < p->numbers.size(); i += 3)
    values.push_back({p->numbers[i], p->numbers[i + 1], p->numbers[i + 2]});
  return values;
}

Spectrum ParameterList::colour(std::string_view name, const Spectrum& fallback, ColourUse use) {
  const Parameter* found = nullptr;
  bool faulty = false;
  for (const ParameterType type : {ParameterType::rgb, ParameterType::spectrum, ParameterType::blackbody}) {
    if (type == ParameterType::blackbody && use != ColourUse::light) continue;
    asked_.push_back({type, std::string(name)});
    const Parameter* p = given(type, name);
    if (!p) continue;
    faulty = faulty || p->faulty;
    if (!found)
      found = p;
    else
      value_error(*p, 0, fmt::format("gives a colour that {} gives already", declaration(*found)));
  }
  if (!found || faulty) return fallback;
  Spectrum colour;
  const ColourFault fault = parameter_colour(*found, use, colour);
  if (fault.message.empty()) {
    if (!fault.warning.empty())
      messages_.warning(found->place, fmt::format("{} of {} {}", declaration(*found), owner_, fault.warning));
    return colour;
  }
  value_error(*found, fault.index, fault.message);
  return fallback;
}

void ParameterList::ignore(const std::vector<std::string_view>& ignored) {
  for (const std::string_view declared : ignored)
    for (Parameter& p : parameters_)
      if (is(p, declared)) p.used = true;
}

void ParameterList::ignore_all() {
  for (Parameter& p : parameters_) p.used = true;
}

void ParameterList::refuse(const std::vector<std::string_view>& refused, const std::string& reason) {
  for (Parameter& p : parameters_)
    for (const std::string_view declared : refused)
      if (is(p, declared) && !p.used) {
        p.used = true;
        messages_.error(p.place, fmt::format("{} of {} {}", declaration(p), owner_, reason));
      }
}

void ParameterList::warn(const std::vector<std::string_view>& ineffective, const std::string& reason) {
  for (Parameter& p : parameters_)
    for (const std::string_view declared : ineffective)
      if (is(p, declared) && !p.used) {
        p.used = true;
        messages_.warning(p.place, fmt::format("{} of {} {}", declaration(p), owner_, reason));
      }
}

void ParameterList::value_error(const Parameter& parameter, std::size_t index, const std::string& message) {
  messages_.error(place_of_value(parameter, index),
                  fmt::format("{} of {} {}", declaration(parameter), owner_, message));
}

void ParameterList::value_warning(const Parameter& parameter, std::size_t index, const std::string& message) {
  messages_.warning(place_of_value(parameter, index),
                    fmt::format("{} of {} {}", declaration(parameter), owner_, message));
}

Place ParameterList::place_of(ParameterType type, std::string_view name) {
  const Parameter* p = given(type, name);
  return p ? p->first_value : place_;
}

void ParameterList::require(ParameterType type, std::string_view name) {
  if (!given(type, name)) messages_.error(place_, fmt::format("{} needs {}", owner_, declaration(type, name)));
}

void ParameterList::finish() {
  for (const Parameter& p : parameters_)
    if (!p.used && !p.is_default && !p.faulty) report_unused(p);
}

void ParameterList::report_unused(const Parameter& p) {
  std::vector<std::string> other_types, valid;
  std::vector<std::string_view> names;
  for (const Asked& a : asked_) {
    if (const std::string other = declaration(a.type, a.name);
        a.name == p.name && std::find(other_types.begin(), other_types.end(), other) == other_types.end())
      other_types.push_back(other);
    // A name that takes several types (a colour's) is listed once.
    if (std::find(names.begin(), names.end(), a.name) == names.end()) valid.push_back(declaration(a.type, a.name));
    names.push_back(a.name);
  }
  if (!other_types.empty()) {
    messages_.error(p.place, fmt::format("{} of {} has the wrong type; it must be {}", declaration(p), owner_,
                                         enumerate(other_types, "or")));
    return;
  }
  std::string hint = valid.empty() ? "; it takes no parameters" : "; it takes " + enumerate(valid, "and");
  if (p.name.size() >= min_suggested_name && p.name.size() <= max_suggested_name) {
    const std::string_view nearest = nearest_name(p.name, names);
    for (const Asked& a : asked_)
      if (!nearest.empty() && a.name == nearest) {
        hint = fmt::format("; did you mean {}?", declaration(a.type, a.name));
        break;
      }
  }
  messages_.error(p.place, fmt::format("{} has no parameter {}{}", owner_, declaration(p), hint));
}

Spectrum scaled(ParameterList& p, double factor, const Spectrum& colour, std::string_view what) {
  Spectrum product;
  for (int c = 0; c < channel_count; ++c) {
    const double v = factor * static_cast<double>(colour[c]);
    if (v > std::numeric_limits<float>::max()) {
      p.error(p.place(), fmt::format("{} of {} times its scale is out of range", what, p.owner()));
      return {};
    }
    product[c] = static_cast<float>(v);
  }
  return product;
}

}  // namespace brume
