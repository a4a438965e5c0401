// ObjectBegin, ObjectEnd and ObjectInstance.
#include <fmt/format.h>

#include "scene/reader.h"

namespace brume {

void Reader::object_begin() {
  const std::string name = string_argument("a name");
  if (in_object_) messages_.fail(directive_.place, "an object cannot begin within another; ObjectEnd is missing");
  if (objects_by_name_.contains(name))
    messages_.error(argument_, fmt::format("there is an object \"{}\" already", printable(name)));
  push_state("ObjectBegin");
  in_object_ = true;
  objects_by_name_.emplace(name, scene_.objects.size());
  scene_.objects.push_back({name, {}});
}

void Reader::object_end() {
  pop_state("ObjectBegin", "ObjectEnd");
  in_object_ = false;
}

void Reader::object_instance() {
  const std::string name = string_argument("a name");
  if (in_object_) messages_.fail(directive_.place, "an object cannot hold instances of others");
  object_uses_.emplace(name, argument_);
  scene_.instances.push_back({name, usable_ctm("the instance"), location(directive_.place)});
}

void Reader::add_shape(ShapeDescription shape) {
  (in_object_ ? scene_.objects.back().shapes : scene_.shapes).push_back(std::move(shape));
}

void Reader::check_object_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, index] : objects_by_name_) names.push_back(name);
  for (const auto& [name, place] : object_uses_)
    if (!objects_by_name_.contains(name))
      messages_.error(place, fmt::format("there is no object \"{}\"{}", printable(name), suggestion(name, names, {})));
}

}  // namespace brume
