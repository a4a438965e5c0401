#include "render/media_along_ray.h"

#include <algorithm>

namespace brume {

using kernel::vec3;

namespace {

// How many times over each medium is there, and since where along the ray. While the set at a ray's origin is summed
// up, the media at the origin and those at the place come to so far are in it.
class ActiveMedia {
 public:
  struct Entry {
    int medium;
    int count;
    float since;
  };

  // Adds `change` to the medium's count at t; calls leave(entry, t) for the stretch that ends there. False when full.
  template <class Leave>
  bool change(int medium, int change, float t, Leave leave) {
    if (medium == no_medium || change == 0) return true;
    Entry* entry = find_or_add(medium, t);
    if (!entry) return false;
    if (entry->count > 0 && t > entry->since) leave(*entry, t);
    entry->count += change;
    entry->since = t;
    if (entry->count == 0) *entry = entries_[--size_];
    return true;
  }

  std::span<Entry> entries() { return {entries_.data(), size_}; }
  bool is_over_limit() const { return size_ > max_active_media; }

 private:
  Entry* find_or_add(int medium, float t) {
    for (std::size_t i = 0; i < size_; ++i)
      if (entries_[i].medium == medium) return &entries_[i];
    if (size_ == entries_.size()) return nullptr;
    entries_[size_] = {medium, 0, t};
    return &entries_[size_++];
  }

  std::array<Entry, 2 * max_active_media> entries_;
  std::size_t size_ = 0;
};

// The part of a ray's [t_begin, t_end] that lies in a region; `direction` becomes that in the region's coordinates.
kernel::BoxSpan span_in(const CompiledRegion& region, const Ray& ray, float t_begin, float t_end, vec3& direction) {
  const auto to_float = [](Vector3 v) {
    return vec3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
  };
  const Transform& m = region.local_from_world;
  const vec3 origin = to_float(m.point({ray.origin.x, ray.origin.y, ray.origin.z}));
  direction = to_float(m.vector({ray.direction.x, ray.direction.y, ray.direction.z}));
  if (region.kind == CompiledRegion::Kind::ball) return kernel::ball_span(origin, direction, t_begin, t_end);
  return kernel::box_span(origin, direction, {region.lo[0], region.lo[1], region.lo[2]},
                          {region.hi[0], region.hi[1], region.hi[2]}, t_begin, t_end);
}

// Adds the part of a span that lies in a region, less what lies in its hole.
void add_span_in_region(const Ray& ray, MediumSpan span, const CompiledRegion& region, const CompiledRegion* hole,
                        std::vector<MediumSpan>& spans) {
  const kernel::BoxSpan within = span_in(region, ray, span.t_begin, span.t_end, span.direction_index);
  if (!(within.t_length > 0)) return;
  span.t_begin = within.t_enter;
  span.t_end = within.t_enter + within.t_length;
  span.entry_index = within.entry;
  if (!hole) {
    spans.push_back(span);
    return;
  }
  vec3 unused(0, 0, 0);
  const kernel::BoxSpan gap = span_in(*hole, ray, span.t_begin, span.t_end, unused);
  if (!(gap.t_length > 0)) {
    spans.push_back(span);
    return;
  }
  MediumSpan before = span, after = span;
  before.t_end = gap.t_enter;
  after.t_begin = gap.t_enter + gap.t_length;
  after.entry_index = within.entry + (after.t_begin - span.t_begin) * span.direction_index;
  for (const MediumSpan& part : {before, after})
    if (part.t_end > part.t_begin) spans.push_back(part);
}

}  // namespace

MediaAlongRay::MediaAlongRay(const CompiledScene& scene, const Intersector& intersector)
    : scene_(scene), intersector_(intersector) {
  const Vector3 eye = scene.camera.world_from_camera.point({});
  const vec3 p(static_cast<float>(eye.x), static_cast<float>(eye.y), static_cast<float>(eye.z));
  bool accounted = scene.camera_medium == no_medium;
  std::vector<std::pair<int, int>> missing;
  for (const auto& [medium, count] : counts_at(p)) {
    accounted = accounted || (medium == scene.camera_medium && count > 0);
    if (count < 0) missing.emplace_back(medium, -count);
  }
  surrounding_ = std::move(missing);
  for (const CompiledVolume& volume : scene.volumes)
    accounted = accounted || (volume.medium == scene.camera_medium && is_in(scene, volume, eye));
  if (!accounted) surrounding_.emplace_back(scene.camera_medium, 1);
}

std::vector<std::pair<int, int>> MediaAlongRay::counts_at(vec3 p, vec3 direction) const {
  const Ray ray{p, normalize(direction), far_away};
  std::vector<Crossing> crossings;
  intersector_.crossings({&ray, 1}, crossings);
  std::vector<std::pair<int, int>> counts;
  const auto add = [&](int medium, int change) {
    if (medium == no_medium) return;
    const auto at = std::find_if(counts.begin(), counts.end(), [&](const auto& c) { return c.first == medium; });
    if (at == counts.end())
      counts.emplace_back(medium, change);
    else
      at->second += change;
  };
  for (const auto& [medium, count] : surrounding_) add(medium, count);
  for (const Crossing& c : crossings) {
    const auto shape = static_cast<std::size_t>(c.shape);
    const CompiledBoundary& b = scene_.boundaries[static_cast<std::size_t>(scene_.shapes[shape].boundary)];
    add(b.inside, c.inwards ? -1 : 1);
    add(b.outside, c.inwards ? 1 : -1);
  }
  std::erase_if(counts, [](const auto& c) { return c.second == 0; });
  std::ranges::sort(counts);
  return counts;
}

std::optional<vec3> MediaAlongRay::find(std::span<const Ray> rays, std::vector<MediumSpan>& spans,
                                        std::vector<Crossing>& scratch) const {
  const std::optional<vec3> too_many = find_bounded(rays, spans, scratch);
  for (std::size_t i = 0; i < rays.size(); ++i)
    for (const CompiledVolume& volume : scene_.volumes)
      add_span_in_region(rays[i], {static_cast<int>(i), volume.medium, 1, 0, rays[i].t_max, {0, 0, 0}, {0, 0, 0}},
                         volume.region,
                         volume.hole < 0 ? nullptr : &scene_.holes[static_cast<std::size_t>(volume.hole)], spans);
  return too_many;
}

std::optional<vec3> MediaAlongRay::find_bounded(std::span<const Ray> rays, std::vector<MediumSpan>& spans,
                                                std::vector<Crossing>& scratch) const {
  spans.clear();
  intersector_.crossings(rays, scratch);
  std::optional<vec3> too_many;
  std::size_t next = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::size_t first = next;
    while (next < scratch.size() && scratch[next].ray == static_cast<int>(i)) ++next;
    if (const auto place = follow(rays[i], static_cast<int>(i), std::span(scratch).subspan(first, next - first), spans))
      too_many = place;
  }
  return too_many;
}

std::optional<vec3> MediaAlongRay::follow(const Ray& ray, int ray_index, std::span<const Crossing> crossings,
                                          std::vector<MediumSpan>& spans) const {
  ActiveMedia active;
  const auto emit = [&](const ActiveMedia::Entry& e, float t) {
    add_span(ray, {ray_index, e.medium, e.count, e.since, t, {0, 0, 0}, {0, 0, 0}}, spans);
  };
  const auto nothing = [](const ActiveMedia::Entry&, float) {};
  const auto boundary = [&](const Crossing& c) -> const CompiledBoundary& {
    const auto shape = static_cast<std::size_t>(c.shape);
    return scene_.boundaries[static_cast<std::size_t>(scene_.shapes[shape].boundary)];
  };

  // At the origin: the surrounding media less all changes ahead.
  for (const auto& [medium, count] : surrounding_) active.change(medium, count, 0, nothing);
  for (const Crossing& c : crossings)
    if (!active.change(boundary(c).inside, c.inwards ? -1 : 1, 0, nothing) ||
        !active.change(boundary(c).outside, c.inwards ? 1 : -1, 0, nothing))
      return ray.at(c.t);
  if (active.is_over_limit()) return ray.origin;
  for (const Crossing& c : crossings) {
    if (c.t >= ray.t_max) break;
    if (!active.change(boundary(c).inside, c.inwards ? 1 : -1, c.t, emit) ||
        !active.change(boundary(c).outside, c.inwards ? -1 : 1, c.t, emit) || active.is_over_limit())
      return ray.at(c.t);
  }
  for (const auto& e : active.entries())
    if (e.count > 0 && ray.t_max > e.since) emit(e, ray.t_max);
  return std::nullopt;
}

void MediaAlongRay::add_span(const Ray& ray, MediumSpan span, std::vector<MediumSpan>& spans) const {
  const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(span.medium)];
  if (medium.grid >= 0) {
    const CompiledGrid& grid = scene_.grids[static_cast<std::size_t>(medium.grid)];
    add_span_in_region(ray, span, {CompiledRegion::Kind::box, medium.index_from_world, grid.bounds_lo, grid.bounds_hi},
                       nullptr, spans);
  } else if (span.t_end > span.t_begin) {
    spans.push_back(span);
  }
}

}  // namespace brume
