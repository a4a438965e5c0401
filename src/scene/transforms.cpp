// The directives that change the current transformation matrix.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "scene/reader.h"

namespace brume {

namespace {

// Columns whose determinant is smaller than this times the product of their lengths span no volume.
constexpr double flat = 1e-12;

// True where all entries are numbers that a float can hold; of a NaN, false.
bool in_range(const Transform& t) {
  for (const auto& row : t.m)
    for (const double v : row)
      if (!(std::abs(v) <= std::numeric_limits<float>::max())) return false;
  return true;
}

bool singular(const Transform& t) {
  double lengths = 1;
  for (std::size_t c = 0; c < 3; ++c) lengths *= length({t.m[0][c], t.m[1][c], t.m[2][c]});
  return !(std::abs(t.determinant()) > flat * lengths) || !in_range(inverse(t));
}

}  // namespace

Transform Reader::usable_ctm(std::string_view what) {
  if (singular(state_.ctm))
    messages_.error(directive_.place,
                    fmt::format("the current transformation squeezes {} flat; it cannot be inverted", what));
  return state_.ctm;
}

void Reader::multiply(const Transform& t) {
  const Transform product = state_.ctm * t;
  if (!in_range(product)) messages_.fail(directive_.place, "the current transformation goes out of range here");
  set_ctm(product);
}

void Reader::set_ctm(const Transform& t) {
  if (!state_.only_end_is_active) state_.ctm = t;
}

void Reader::identity() { set_ctm(Transform()); }
void Reader::translate_by() { multiply(translate(vector_argument())); }
void Reader::scale_by() { multiply(scale(vector_argument())); }

void Reader::rotate_by() {
  const double degrees = number_argument();
  const Place place = tokens_.peek().place;
  const Vector3 axis = vector_argument();
  if (!(length(axis) > 0)) messages_.fail(place, "the axis of Rotate is 0 0 0");
  multiply(rotate(degrees, axis));
}

void Reader::look_at_point() {
  const Place place = tokens_.peek().place;
  const Vector3 eye = vector_argument(), at = vector_argument(), up = vector_argument();
  const Vector3 forward = normalize(at - eye), right = cross(normalize(up), forward);
  if (!(length(forward) > 0)) messages_.fail(place, "LookAt's eye and the point it looks at are the same");
  if (!(length(right) > flat))
    messages_.fail(place, "LookAt's up vector must be neither 0 0 0 nor along the line of sight");
  multiply(look_at(eye, at, up));
}

// Sixteen numbers in brackets, column by column.
Transform Reader::matrix_argument() {
  const Token open = tokens_.peek();
  if (open.kind != Token::Kind::open)
    messages_.fail(open.place,
                   fmt::format("{} takes 16 numbers in brackets, found {}", directive_.text, describe(open)));
  tokens_.next();
  Transform t;
  for (std::size_t column = 0; column < 4; ++column)
    for (std::size_t row = 0; row < 4; ++row) t.m[row][column] = number_argument();
  const Token& close = tokens_.peek();
  if (close.kind != Token::Kind::close)
    messages_.fail(close.place, fmt::format("expected \"]\" after the 16 numbers of {}, found {}", directive_.text,
                                            describe(close)));
  tokens_.next();
  if (t.m[3] != std::array<double, 4>{0, 0, 0, 1})
    messages_.fail(open.place, "the matrix is not affine: its 4th, 8th, 12th and 16th numbers must be 0, 0, 0 and 1");
  return t;
}

void Reader::transform() { set_ctm(matrix_argument()); }
void Reader::concat_transform() { multiply(matrix_argument()); }

void Reader::coordinate_system() { coordinate_systems_[string_argument("a name")] = state_.ctm; }

void Reader::coord_sys_transform() {
  const Place place = tokens_.peek().place;
  const std::string name = string_argument("a name");
  const auto found = coordinate_systems_.find(name);
  if (found != coordinate_systems_.end()) {
    state_.ctm = found->second;
    return;
  }
  std::vector<std::string_view> names;
  for (const auto& [known, transform] : coordinate_systems_) names.push_back(known);
  messages_.fail(place,
                 fmt::format("there is no coordinate system \"{}\"{}", printable(name), suggestion(name, names, {})));
}

void Reader::active_transform() {
  const Token token = tokens_.next();
  if (token.kind != Token::Kind::word || (token.text != "All" && token.text != "StartTime" && token.text != "EndTime"))
    messages_.fail(token.place,
                   fmt::format("ActiveTransform takes All, StartTime or EndTime, found {}", describe(token)));
  state_.only_end_is_active = token.text == "EndTime";
  if (token.text != "All")
    messages_.warning(token.place, "nothing moves while the shutter is open: things stay where they are when it opens");
}

void Reader::transform_times() {
  number_argument();
  number_argument();
}

void Reader::reverse_orientation() { state_.reverse_orientation = !state_.reverse_orientation; }

}  // namespace brume
