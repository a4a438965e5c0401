#include "scene/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace brume {

namespace {

constexpr std::size_t max_nesting = 10000;  // of attribute blocks
constexpr std::size_t max_defaults = 256;   // of a kind of thing: each thing of the kind looks through them

}  // namespace

Reader::Reader(Messages& messages) : messages_(messages), tokens_(messages) {}

SceneDescription Reader::read(const std::vector<File>& files) {
  if (!files.empty()) scene_.file = files.front().name;
  try {
    for (const File& file : files) {
      open(file);
      read_directives();
    }
    check_whole();
  } catch (const Abandon&) {
  } catch (const TooManyErrors&) {
  }
  return std::move(scene_);
}

void Reader::open(const File& file) {
  sources_.push_back(std::make_unique<Source>(Source{file.name, file.text, static_cast<int>(sources_.size())}));
  Source& source = *sources_.back();
  if (file.text.starts_with("\xff\xfe") || file.text.starts_with("\xfe\xff"))
    messages_.fail({&source, 0, 0, 0}, "is UTF-16 text: save it as UTF-8");
  if (file.text.starts_with("\xef\xbb\xbf")) source.text.remove_prefix(3);
  std::error_code ignored;
  sources_by_name_[std::filesystem::weakly_canonical(file.name, ignored).string()] = &source;
  folder_ = file.folder;
  tokens_.push(source);
}

const std::vector<Reader::Directive>& Reader::directives() {
  static const std::vector<Directive> all = {
      {"WorldBegin", Block::options, &Reader::world_begin},
      {"WorldEnd", Block::both, &Reader::world_end},
      {"AttributeBegin", Block::world, &Reader::attribute_begin},
      {"AttributeEnd", Block::world, &Reader::attribute_end},
      {"TransformBegin", Block::world, &Reader::transform_begin},
      {"TransformEnd", Block::world, &Reader::transform_end},
      {"Attribute", Block::both, &Reader::attribute},
      {"Include", Block::both, &Reader::include},
      {"Identity", Block::both, &Reader::identity},
      {"Translate", Block::both, &Reader::translate_by},
      {"Scale", Block::both, &Reader::scale_by},
      {"Rotate", Block::both, &Reader::rotate_by},
      {"LookAt", Block::both, &Reader::look_at_point},
      {"Transform", Block::both, &Reader::transform},
      {"ConcatTransform", Block::both, &Reader::concat_transform},
      {"CoordinateSystem", Block::both, &Reader::coordinate_system},
      {"CoordSysTransform", Block::both, &Reader::coord_sys_transform},
      {"ActiveTransform", Block::both, &Reader::active_transform},
      {"TransformTimes", Block::options, &Reader::transform_times},
      {"ReverseOrientation", Block::world, &Reader::reverse_orientation},
      {"Camera", Block::options, &Reader::camera},
      {"Film", Block::options, &Reader::film},
      {"Sampler", Block::options, &Reader::sampler},
      {"PixelFilter", Block::options, &Reader::pixel_filter},
      {"Integrator", Block::options, &Reader::integrator},
      {"Accelerator", Block::options, &Reader::accelerator},
      {"ColorSpace", Block::both, &Reader::color_space},
      {"Option", Block::both, &Reader::option},
      {"MakeNamedMedium", Block::both, &Reader::make_named_medium},
      {"MediumInterface", Block::both, &Reader::medium_interface},
      {"Shape", Block::world, &Reader::shape},
      {"Material", Block::world, &Reader::material},
      {"MakeNamedMaterial", Block::world, &Reader::make_named_material},
      {"NamedMaterial", Block::world, &Reader::named_material},
      {"LightSource", Block::world, &Reader::light_source},
      {"AreaLightSource", Block::world, &Reader::area_light_source},
      {"Texture", Block::world, &Reader::texture},
      {"ObjectBegin", Block::world, &Reader::object_begin},
      {"ObjectEnd", Block::world, &Reader::object_end},
      {"ObjectInstance", Block::world, &Reader::object_instance},
      {"Import", Block::world, &Reader::import},
  };
  return all;
}

void Reader::read_directives() {
  for (;;) try {
      const Token token = tokens_.next();
      while (!imports_.empty() && !tokens_.is_open(imports_.back().depth)) end_import();
      if (token.kind == Token::Kind::end) return;
      if (token.kind != Token::Kind::word)
        messages_.fail(token.place, fmt::format("expected a directive, found {}", describe(token)));
      read_directive(token);
    } catch (const Abandon&) {
      tokens_.skip_to_directive();
    }
}

void Reader::read_directive(const Token& word) {
  directive_ = word;
  for (const Directive& d : directives())
    if (d.name == word.text) {
      check_block(d);
      (this->*d.read)();
      return;
    }
  std::vector<std::string_view> names;
  for (const Directive& d : directives()) names.push_back(d.name);
  messages_.fail(word.place,
                 fmt::format("unknown directive \"{}\"{}", printable(word.text), suggestion(word.text, names, {})));
}

void Reader::check_block(const Directive& directive) {
  if (in_world_ && directive.name == "WorldBegin")
    messages_.fail(directive_.place, "this WorldBegin is the second one");
  if (in_world_ && directive.block == Block::options)
    messages_.fail(directive_.place, fmt::format("{} belongs before WorldBegin", directive.name));
  // One message is enough about a WorldBegin that was left out.
  if (directive.block == Block::world && !in_world_ && !early_) {
    messages_.error(directive_.place, fmt::format("{} belongs after WorldBegin", directive.name));
    early_ = true;
  }
}

void Reader::world_begin() {
  in_world_ = true;
  state_.ctm = Transform();
  state_.only_end_is_active = false;
  coordinate_systems_["world"] = Transform();
}

void Reader::world_end() { messages_.old_spelling(directive_.place, "WorldEnd is no longer needed"); }

void Reader::push_state(std::string_view begin) {
  if (stack_.size() >= max_nesting)
    messages_.fail(directive_.place, fmt::format("{} is nested more than {} deep", begin, max_nesting));
  stack_.push_back({state_, begin, directive_.place});
}

void Reader::pop_state(std::string_view begin, std::string_view end) {
  if (stack_.size() <= (imports_.empty() ? 0 : imports_.back().stack_size))
    messages_.fail(directive_.place, fmt::format("{} without {}", end, begin));
  const Saved& saved = stack_.back();
  if (saved.begin != begin)
    messages_.error(directive_.place, fmt::format("{} closes the {} of line {}", end, saved.begin, saved.place.line));
  state_ = std::move(stack_.back().state);
  stack_.pop_back();
}

void Reader::attribute_begin() { push_state("AttributeBegin"); }
void Reader::attribute_end() { pop_state("AttributeBegin", "AttributeEnd"); }
void Reader::transform_begin() {
  messages_.old_spelling(directive_.place, "TransformBegin is now called AttributeBegin, and saves all attributes");
  push_state("TransformBegin");
}
void Reader::transform_end() { pop_state("TransformBegin", "TransformEnd"); }

void Reader::attribute() {
  const Place place = tokens_.peek().place;
  const std::string target = string_argument("a kind of thing");
  const std::vector<std::string_view> targets = {"shape", "light", "material", "medium", "texture"};
  if (std::find(targets.begin(), targets.end(), target) == targets.end())
    messages_.fail(place,
                   fmt::format("unknown Attribute \"{}\"; it is \"shape\", \"light\", \"material\", \"medium\" or "
                               "\"texture\"",
                               printable(target)));
  std::vector<Parameter> added = read_list();
  const auto before = state_.defaults.find(target);
  std::vector<Parameter> all = before != state_.defaults.end() ? *before->second : std::vector<Parameter>();
  for (Parameter& p : added) {
    std::erase_if(all, [&](const Parameter& old) { return old.name == p.name; });
    if (all.size() >= max_defaults)
      messages_.fail(p.place, fmt::format("more than {} parameters are set for \"{}\"", max_defaults, target));
    all.push_back(std::move(p));
  }
  state_.defaults[target] = std::make_shared<const std::vector<Parameter>>(std::move(all));
}

void Reader::refused() { messages_.fail(directive_.place, fmt::format("{} is not supported yet", directive_.text)); }

std::string Reader::string_argument(std::string_view what) {
  const Token& token = tokens_.peek();
  if (token.kind != Token::Kind::string)
    messages_.fail(token.place, fmt::format("{} takes {} in quotes, found {}", directive_.text, what, describe(token)));
  argument_ = token.place;
  return unescaped(tokens_.next());
}

double Reader::number_argument() {
  const Token& token = tokens_.peek();
  if (token.kind != Token::Kind::number)
    messages_.fail(token.place, fmt::format("expected a number for {}, found {}", directive_.text, describe(token)));
  double value = 0;
  const NumberStatus status = read_number(token.text, value);
  if (status == NumberStatus::malformed)
    messages_.fail(token.place, fmt::format("{} is not a number", printable(token.text)));
  if (status == NumberStatus::out_of_range)
    messages_.fail(token.place, fmt::format("the number {} is out of range", printable(token.text)));
  tokens_.next();
  return value;
}

Vector3 Reader::vector_argument() {
  Vector3 v;
  for (int axis = 0; axis < 3; ++axis) v[axis] = number_argument();
  return v;
}

std::vector<Parameter> Reader::read_list() {
  std::vector<Parameter> list = read_parameters(tokens_, messages_);
  for (Parameter& p : list) {
    p.space = state_.colour_space;
    if (p.type == ParameterType::spectrum && p.strings.size() == 1) read_spectrum_file(p);
  }
  return list;
}

ParameterList Reader::parameters(const std::string& owner, const std::string& target) {
  ParameterList list(read_list(), messages_, owner, directive_.place);
  if (const auto defaults = state_.defaults.find(target); defaults != state_.defaults.end())
    list.add_defaults(*defaults->second);
  return list;
}

void Reader::modernise(std::string& given, std::string_view old_name, std::string_view name) {
  if (given != old_name) return;
  messages_.old_spelling(directive_.place,
                         fmt::format("{} \"{}\" is now called \"{}\"", directive_.text, old_name, name));
  given = name;
}

void Reader::unknown_type(const Place& place, std::string_view what, std::string_view type,
                          const std::vector<std::string_view>& read_here,
                          const std::vector<std::string_view>& of_pbrt) {
  std::vector<std::string> quoted;
  for (const std::string_view name : read_here) quoted.push_back(fmt::format("\"{}\"", name));
  const std::string known = "it can be " + enumerate(quoted, "or");
  if (std::find(of_pbrt.begin(), of_pbrt.end(), type) != of_pbrt.end())
    messages_.fail(place, fmt::format("{} \"{}\" is not supported yet; {}", what, type, known));
  messages_.fail(place, fmt::format("unknown {} \"{}\"{}", what, printable(type), suggestion(type, read_here, known)));
}

void Reader::check_whole() {
  const Place end = tokens_.peek().place;
  for (const Saved& open : stack_) messages_.error(open.place, fmt::format("this {} has no end", open.begin));
  if (!in_world_ && !early_) messages_.error(end, "the scene has no WorldBegin");
  check_media_names();
  check_object_names();
  check_volumes();
  scene_.sampler.seed = sampler_seed_ ? *sampler_seed_ : global_seed_.value_or(scene_.sampler.seed);
}

void Reader::check_media_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, medium] : media_by_name_) names.push_back(name);
  for (const auto& [name, place] : medium_uses_)
    if (!name.empty() && !media_tried_.contains(name))
      messages_.error(place, fmt::format("there is no medium \"{}\"{}", printable(name), suggestion(name, names, {})));
  if (messages_.any_error()) return;  // the one that was to use it may be it
  for (const auto& [name, medium] : media_by_name_)
    if (!medium_uses_.contains(name))
      messages_.warning(medium.place,
                        fmt::format("medium \"{}\" is not used: no MediumInterface names it", printable(name)));
}

}  // namespace brume
