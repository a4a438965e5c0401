#include "scene/read_ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/gzip.h"
#include "base/memory.h"
#include "scene/mesh_text.h"

namespace brume {

namespace {

enum class Format { ascii, little_endian, big_endian };

struct Type {
  char kind;  // 'i', 'u' or 'f'
  int size;   // bytes
};

std::optional<Type> type_named(std::string_view name) {
  struct Named {
    std::string_view old_name, name;
    Type type;
  };
  static constexpr Named types[] = {{"char", "int8", {'i', 1}},     {"uchar", "uint8", {'u', 1}},
                                    {"short", "int16", {'i', 2}},   {"ushort", "uint16", {'u', 2}},
                                    {"int", "int32", {'i', 4}},     {"uint", "uint32", {'u', 4}},
                                    {"float", "float32", {'f', 4}}, {"double", "float64", {'f', 8}}};
  for (const Named& t : types)
    if (name == t.old_name || name == t.name) return t.type;
  return std::nullopt;
}

struct Property {
  std::string name;
  Type type;
  std::optional<Type> count_type;  // of a list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;

  int index_of(std::string_view property) const {
    for (std::size_t i = 0; i < properties.size(); ++i)
      if (properties[i].name == property) return static_cast<int>(i);
    return -1;
  }
};

struct Header {
  Format format = Format::ascii;
  std::vector<Element> elements;
};

Type need_type(std::string_view name) {
  if (const auto type = type_named(name)) return *type;
  throw Fault{fmt::format("has a property of an unknown type \"{}\"", name.substr(0, 40))};
}

Property read_property(Text& words) {
  std::string_view type = words.word();
  Property property;
  if (type == "list") {
    property.count_type = need_type(words.word());
    if (property.count_type->kind == 'f') throw Fault{"has a list whose count is not an integer"};
    type = words.word();
  }
  property.type = need_type(type);
  property.name = words.word();
  return property;
}

Header read_header(Text& text) {
  if (text.line() != "ply") throw Fault{"is not a .ply file: it does not begin with the line \"ply\""};
  Header header;
  bool has_format = false;
  for (;;) {
    if (text.rest().empty()) throw Fault{"ends within its header"};
    Text words(text.line());
    const std::string_view keyword = words.word();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      const std::string_view format = words.word();
      has_format = true;
      if (format == "binary_little_endian")
        header.format = Format::little_endian;
      else if (format == "binary_big_endian")
        header.format = Format::big_endian;
      else if (format != "ascii")
        throw Fault{fmt::format("has the unknown format \"{}\"", format.substr(0, 40))};
    } else if (keyword == "element") {
      Element element;
      element.name = words.word();
      const std::string_view count = words.word();
      const auto [end, code] = std::from_chars(count.data(), count.data() + count.size(), element.count);
      if (code != std::errc() || end != count.data() + count.size())
        throw Fault{fmt::format("has an element \"{}\" without a count", element.name.substr(0, 40))};
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) throw Fault{"has a property before any element"};
      header.elements.back().properties.push_back(read_property(words));
    } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      throw Fault{fmt::format("has an unknown line \"{}\" in its header", keyword.substr(0, 40))};
    }
  }
  if (!has_format) throw Fault{"has no line \"format\" in its header"};
  return header;
}

// The values after the header, one after another. Every value takes at least a byte of the file, so what is made of
// them is bounded by its size.
class Values {
 public:
  Values(Text text, Format format) : text_(text), format_(format) {}

  double next(Type type) {
    if (format_ == Format::ascii) return number(text_.word());
    const std::string_view bytes = text_.bytes(static_cast<std::size_t>(type.size));
    if (bytes.empty()) throw Fault{"ends before its last value"};
    std::array<char, 8> b{};
    std::copy(bytes.begin(), bytes.end(), b.begin());
    if ((format_ == Format::big_endian) == (std::endian::native == std::endian::little))
      std::reverse(b.begin(), b.begin() + type.size);
    if (type.kind == 'f') return type.size == 4 ? static_cast<double>(as<float>(b)) : as<double>(b);
    if (type.size == 1) return type.kind == 'i' ? as<std::int8_t>(b) : as<std::uint8_t>(b);
    if (type.size == 2) return type.kind == 'i' ? as<std::int16_t>(b) : as<std::uint16_t>(b);
    return type.kind == 'i' ? as<std::int32_t>(b) : as<std::uint32_t>(b);
  }

 private:
  template <class T>
  static T as(const std::array<char, 8>& bytes) {
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }

  Text text_;
  Format format_;
};

// Reads one element of its kind; `values` gets the properties that are no lists, `list` that with index `list_index`.
void read_element(const Element& element, Values& source, std::vector<double>& values, int list_index,
                  std::vector<double>& list) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const Property& property = element.properties[i];
    values[i] = source.next(property.count_type.value_or(property.type));
    if (!property.count_type) continue;
    if (values[i] < 0 || values[i] != std::floor(values[i])) throw Fault{"has a list with a count below 0"};
    const bool wanted = static_cast<int>(i) == list_index;
    if (wanted) list.clear();
    for (double k = 0; k < values[i]; ++k) {
      const double item = source.next(property.type);
      if (wanted) list.push_back(item);
    }
  }
}

// Of what is claimed only: text can be packed a thousandfold.
void check_count(const Element& element, std::size_t bytes_each) {
  constexpr std::size_t most = std::size_t{1} << 40;
  if (element.count > most || !can_hold(static_cast<std::int64_t>(element.count * bytes_each)))
    throw Fault{
        fmt::format("has {} of element \"{}\", which take more than half of the memory", element.count, element.name)};
}

void read_vertices(const Element& element, Values& source, TriangleMeshShape& mesh) {
  std::array<int, 8> where{};
  static constexpr std::string_view names[] = {"x", "y", "z", "nx", "ny", "nz"};
  for (std::size_t i = 0; i < 6; ++i) where[i] = element.index_of(names[i]);
  static constexpr std::string_view uv_names[][2] = {
      {"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};
  where[6] = where[7] = -1;
  for (const auto& [u, v] : uv_names)
    if (const int i = element.index_of(u), j = element.index_of(v); i >= 0 && j >= 0 && where[6] < 0) {
      where[6] = i;
      where[7] = j;
    }
  if (std::min({where[0], where[1], where[2]}) < 0) throw Fault{"has vertices without x, y and z"};
  const bool has_normals = std::min({where[3], where[4], where[5]}) >= 0;
  std::vector<double> values(element.properties.size()), list;
  const auto at = [&](std::size_t i) { return values[static_cast<std::size_t>(where[i])]; };
  check_count(element, 2 * sizeof(Vector3));
  for (std::size_t i = 0; i < element.count; ++i) {
    read_element(element, source, values, -1, list);
    mesh.positions.push_back(finite(at(0), at(1), at(2)));
    if (has_normals) mesh.normals.push_back(finite(at(3), at(4), at(5)));
    if (where[6] >= 0) mesh.uv.push_back(finite_uv(at(6), at(7)));
  }
}

void read_faces(const Element& element, Values& source, PlyMesh& ply) {
  int corners = element.index_of("vertex_indices");
  if (corners < 0) corners = element.index_of("vertex_index");
  if (corners < 0 || !element.properties[static_cast<std::size_t>(corners)].count_type)
    throw Fault{"has faces without a list vertex_indices"};
  std::vector<double> values(element.properties.size()), list;
  check_count(element, 2 * sizeof(std::array<std::uint32_t, 3>));
  for (std::size_t i = 0; i < element.count; ++i) {
    read_element(element, source, values, corners, list);
    std::array<std::uint32_t, 4> v{};
    if (list.size() != 3 && list.size() != 4) {
      ++ply.skipped_faces;
      continue;
    }
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (!(list[k] >= 0 && list[k] < 4294967296.0 && list[k] == std::floor(list[k])))
        throw Fault{fmt::format("has a face with the vertex {}", list[k])};
      v[k] = static_cast<std::uint32_t>(list[k]);
    }
    ply.mesh.triangles.push_back({v[0], v[1], v[2]});
    if (list.size() == 4) ply.mesh.triangles.push_back({v[0], v[2], v[3]});
  }
}

PlyMesh decode_ply(std::string_view bytes) {
  Text text(bytes);
  const Header header = read_header(text);
  Values values(text, header.format);
  PlyMesh ply;
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    if (element.name == "vertex") {
      read_vertices(element, values, ply.mesh);
    } else if (element.name == "face") {
      read_faces(element, values, ply);
    } else {
      std::vector<double> ignored(element.properties.size()), list;
      for (std::size_t i = 0; i < element.count; ++i) read_element(element, values, ignored, -1, list);
    }
  }
  if (ply.mesh.triangles.empty()) throw Fault{"has no face of three or four corners"};
  for (const auto& triangle : ply.mesh.triangles)
    for (const std::uint32_t v : triangle)
      if (v >= ply.mesh.positions.size())
        throw Fault{fmt::format("has a face with the vertex {}, and {} vertices in all", v, ply.mesh.positions.size())};
  return ply;
}

}  // namespace

PlyMesh read_ply(const std::string& path) { return read_ply_bytes(path, read_file_unpacked(path)); }

PlyMesh read_ply_bytes(const std::string& name, std::string_view bytes) {
  try {
    return read_within_memory(name, [&] { return decode_ply(bytes); });
  } catch (const Fault& fault) {
    throw InputError(name, fault.message);
  }
}

}  // namespace brume
