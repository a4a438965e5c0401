// From tokens to parameters: types, brackets and values.
#include <fmt/format.h>

#include "scene/parameters.h"

namespace brume {

namespace {

struct TypeRow {
  std::string_view name;
  ParameterType type;
  std::size_t numbers;     // that make one value; 0 where values are no numbers
  std::string_view value;  // what a message calls a value
};
constexpr std::array<TypeRow, 13> types{{
    {"float", ParameterType::float_, 1, "a number"},
    {"integer", ParameterType::integer, 0, "an integer"},
    {"bool", ParameterType::bool_, 0, "true or false"},
    {"string", ParameterType::string, 0, "a quoted string"},
    {"point2", ParameterType::point2, 2, "a number"},
    {"vector2", ParameterType::vector2, 2, "a number"},
    {"point3", ParameterType::point3, 3, "a number"},
    {"vector3", ParameterType::vector3, 3, "a number"},
    {"normal", ParameterType::normal, 3, "a number"},
    {"rgb", ParameterType::rgb, 3, "a number"},
    {"spectrum", ParameterType::spectrum, 1, "a number or a quoted name"},
    {"blackbody", ParameterType::blackbody, 1, "a number"},
    {"texture", ParameterType::texture, 0, "a quoted name"},
}};
struct OldType {
  std::string_view old_name, name;
};
constexpr std::array<OldType, 3> old_types{{{"color", "rgb"}, {"point", "point3"}, {"vector", "vector3"}}};

const TypeRow& row(ParameterType type) { return types[static_cast<std::size_t>(type)]; }

bool takes_strings(ParameterType type) {
  return type == ParameterType::string || type == ParameterType::texture || type == ParameterType::spectrum;
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

class ListReader {
 public:
  ListReader(TokenStream& tokens, Messages& messages) : tokens_(tokens), messages_(messages) {}

  std::vector<Parameter> read() {
    std::vector<Parameter> parameters;
    while (tokens_.peek().kind == Token::Kind::string) {
      Parameter parameter;
      const bool known = read_declaration(tokens_.next(), parameter);
      parameter.faulty = !known;
      read_values(parameter);
      if (known) parameters.push_back(std::move(parameter));
    }
    return parameters;
  }

 private:
  // `"type name"`. False where it is no such thing; its values are then skipped.
  bool read_declaration(const Token& token, Parameter& parameter) {
    parameter.place = token.place;
    const std::string text = unescaped(token);
    const std::string_view trimmed = trim(text);
    const std::size_t split = trimmed.find_first_of(" \t");
    const std::string_view type = trimmed.substr(0, split);
    const std::string_view name = split == std::string_view::npos ? "" : trim(trimmed.substr(split));
    if (name.empty() || name.find_first_of(" \t") != std::string_view::npos) {
      messages_.error(token.place, fmt::format("expected a parameter's type and name, such as \"float fov\", found {}",
                                               describe(token)));
      return false;
    }
    parameter.name = name;
    return find_type(type, token.place, parameter.type);
  }

  bool find_type(std::string_view name, const Place& place, ParameterType& type) {
    for (const OldType& old : old_types)
      if (name == old.old_name) {
        messages_.old_spelling(place,
                               fmt::format("the parameter type \"{}\" is now called \"{}\"", old.old_name, old.name));
        name = old.name;
      }
    std::vector<std::string_view> names;
    for (const TypeRow& t : types) {
      if (t.name == name) {
        type = t.type;
        return true;
      }
      names.push_back(t.name);
    }
    const std::string all = enumerate({names.begin(), names.end()}, "and");
    messages_.error(place, fmt::format("unknown parameter type \"{}\"{}", printable(name),
                                       suggestion(name, names, "the types are " + all)));
    return false;
  }

  // One value, or any number of them in brackets.
  void read_values(Parameter& parameter) {
    const Token first = tokens_.peek();
    if (first.kind != Token::Kind::open) {
      parameter.first_value = first.place;
      if (first.kind == Token::Kind::end || begins_directive(first)) {
        if (!parameter.faulty)
          messages_.error(first.place,
                          fmt::format("expected {} for \"{} {}\", found {}", row(parameter.type).value,
                                      type_name(parameter.type), printable(parameter.name), describe(first)));
        parameter.faulty = true;
        return;
      }
      // A string with a space is rather the next parameter than this one's value.
      const bool next_parameter = first.kind == Token::Kind::string && !takes_strings(parameter.type) &&
                                  first.text.find(' ') != std::string_view::npos;
      if (next_parameter)
        wrong_value(first, parameter);
      else
        read_value(parameter);
      return;
    }
    tokens_.next();
    parameter.first_value = tokens_.peek().place;
    for (;;) {
      if (!parameter.faulty) read_run(parameter);
      const Token& token = tokens_.peek();
      if (token.kind == Token::Kind::close) break;
      if (token.kind == Token::Kind::end || begins_directive(token)) {
        messages_.error(first.place, "this list has no closing \"]\"");
        parameter.faulty = true;
        return;
      }
      read_value(parameter);
    }
    tokens_.next();
  }

  // As many numbers as follow, without making tokens of them.
  void read_run(Parameter& parameter) {
    // A token was peeked at: the first of the run, or what ended the last one.
    if (tokens_.peek().kind != Token::Kind::number) return;
    read_value(parameter);
    if (parameter.type == ParameterType::integer) {
      for (std::int64_t v = 0; tokens_.next_integer(v);) parameter.integers.push_back(v);
    } else if (row(parameter.type).numbers > 0) {
      for (double v = 0; tokens_.next_number(v);) parameter.numbers.push_back(v);
    }
  }

  void read_value(Parameter& parameter) {
    const Token token = tokens_.next();
    if (parameter.faulty) return;
    if (parameter.type == ParameterType::integer) {
      std::int64_t v = 0;
      if (token.kind == Token::Kind::number && check(read_integer(token.text, v), token, parameter))
        parameter.integers.push_back(v);
      else
        wrong_value(token, parameter);
    } else if (row(parameter.type).numbers > 0 && token.kind == Token::Kind::number) {
      double v = 0;
      if (check(read_number(token.text, v), token, parameter)) parameter.numbers.push_back(v);
    } else if (parameter.type == ParameterType::bool_) {
      read_bool(token, parameter);
    } else if (takes_strings(parameter.type)) {
      if (token.kind == Token::Kind::string)
        parameter.strings.push_back(unescaped(token));
      else
        wrong_value(token, parameter);
    } else {
      wrong_value(token, parameter);
    }
  }

  void read_bool(const Token& token, Parameter& parameter) {
    const bool quoted = token.kind == Token::Kind::string;
    if ((token.kind != Token::Kind::word && !quoted) || (token.text != "true" && token.text != "false")) {
      wrong_value(token, parameter);
      return;
    }
    if (quoted) messages_.old_spelling(token.place, "true and false are now written without quotes");
    parameter.bools.push_back(token.text == "true");
  }

  // True where the status is good; else an error about a number that is none, or is too large.
  bool check(NumberStatus status, const Token& token, Parameter& parameter) {
    if (status == NumberStatus::ok) return true;
    double v = 0;
    if (status == NumberStatus::out_of_range)
      messages_.error(token.place, fmt::format("the number {} is out of range", printable(token.text)));
    else if (parameter.type == ParameterType::integer && read_number(token.text, v) == NumberStatus::ok)
      return false;
    else
      messages_.error(token.place, fmt::format("{} is not a number", printable(token.text)));
    parameter.faulty = true;
    return false;
  }

  void wrong_value(const Token& token, Parameter& parameter) {
    if (!parameter.faulty)
      messages_.error(token.place, fmt::format("expected {} for \"{} {}\", found {}", row(parameter.type).value,
                                               type_name(parameter.type), printable(parameter.name), describe(token)));
    parameter.faulty = true;
  }

  TokenStream& tokens_;
  Messages& messages_;
};

// Numbers come in multiples of what makes one value of the type.
void check_count(Parameter& parameter, Messages& messages) {
  if (parameter.faulty) return;
  const std::size_t each = row(parameter.type).numbers;
  if (parameter.count() == 0) {
    messages.error(parameter.place,
                   fmt::format("\"{} {}\" has no value", type_name(parameter.type), printable(parameter.name)));
    parameter.faulty = true;
  } else if (each > 1 && parameter.numbers.size() % each != 0) {
    messages.error(
        parameter.place,
        fmt::format("\"{} {}\" takes {} numbers{}, found {}", type_name(parameter.type), printable(parameter.name),
                    each, parameter.numbers.size() > each ? " a value" : "", parameter.numbers.size()));
    parameter.faulty = true;
  }
}

}  // namespace

std::string_view type_name(ParameterType type) { return row(type).name; }

std::vector<Parameter> read_parameters(TokenStream& tokens, Messages& messages) {
  std::vector<Parameter> parameters = ListReader(tokens, messages).read();
  for (Parameter& p : parameters) check_count(p, messages);
  return parameters;
}

}  // namespace brume
