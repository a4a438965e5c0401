#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "base/diagnostics.h"
#include "base/parallel.h"
#include "image/filter.h"
#include "render/backend.h"
#include "render/classic.h"
#include "render/reference.h"

namespace brume {

namespace {

constexpr int tile_edge = 16;

Ray camera_ray(const CompiledCamera& camera, double x, double y) {
  const Vector3 origin = camera.world_from_camera.point({});
  const Vector3 direction =
      normalize(camera.world_from_camera.vector({camera.x0 + x * camera.dx, camera.y0 + y * camera.dy, 1}));
  const auto to_float = [](Vector3 v) {
    return kernel::vec3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
  };
  return {to_float(origin), to_float(direction), far_away};
}

// The integrators of one worker, of which a scene uses one.
class Integrators {
 public:
  Integrators(const CompiledScene& scene, const Intersector& intersector, const MediaAlongRay& media)
      : kind_(scene.integrator.kind), classic_(scene, intersector, media), reference_(scene, intersector, media) {}

  Spectrum radiance(const Ray& ray, RandomStream& random) {
    switch (kind_) {
      case CompiledIntegrator::Kind::classic:
        return classic_.radiance(ray, random);
      case CompiledIntegrator::Kind::reference:
        return reference_.radiance(ray, random);
    }
    return {};
  }
  std::optional<kernel::vec3> too_many_media() const {
    return kind_ == CompiledIntegrator::Kind::classic ? classic_.too_many_media() : reference_.too_many_media();
  }
  std::int64_t majorant_violations() const { return reference_.majorant_violations(); }

 private:
  CompiledIntegrator::Kind kind_;
  ClassicIntegrator classic_;
  ReferenceIntegrator reference_;
};

class CpuBackend : public Backend {
 public:
  void prepare(const CompiledScene& scene) override {
    scene_ = &scene;
    filter_ = std::make_unique<Filter>(scene.filter);
    intersector_ = std::make_unique<Intersector>(scene);
    media_ = std::make_unique<MediaAlongRay>(scene, *intersector_);
    majorant_violations_ = 0;
  }

  std::int64_t majorant_violations() const override { return majorant_violations_; }

  bool render(int first, int last, int threads, Film& film,
              const std::function<bool(double fraction)>& keep_going) override {
    const int tiles_x = (film.width() + tile_edge - 1) / tile_edge,
              tiles_y = (film.height() + tile_edge - 1) / tile_edge;
    const int tiles = tiles_x * tiles_y;
    threads = thread_count(threads);
    std::vector<std::unique_ptr<Integrators>> integrators;
    for (int i = 0; i < threads; ++i)
      integrators.push_back(std::make_unique<Integrators>(*scene_, *intersector_, *media_));
    std::atomic<bool> stopped = false;
    std::atomic<int> done = 0;
    parallel_for(tiles, threads, [&](int tile, int worker) {
      if (stopped) return;
      render_tile(tile % tiles_x, tile / tiles_x, first, last, *integrators[static_cast<std::size_t>(worker)], film);
      ++done;
      if (worker == 0 && !keep_going(static_cast<double>(done) / tiles)) stopped = true;
    });
    for (const auto& i : integrators) majorant_violations_ += i->majorant_violations();
    for (const auto& i : integrators)
      if (const auto p = i->too_many_media())
        throw InputError("scene",
                         fmt::format("more than {} media overlap at ({}, {}, {})", max_active_media, p->x, p->y, p->z));
    return !stopped;
  }

 private:
  void render_tile(int tile_x, int tile_y, int first, int last, Integrators& integrators, Film& film) const {
    const int x_end = std::min((tile_x + 1) * tile_edge, film.width()),
              y_end = std::min((tile_y + 1) * tile_edge, film.height());
    for (int y = tile_y * tile_edge; y < y_end; ++y)
      for (int x = tile_x * tile_edge; x < x_end; ++x)
        for (int s = first; s < last; ++s) film.add(x, y, sample_pixel(x, y, s, integrators));
  }

  Spectrum sample_pixel(int x, int y, int index, Integrators& integrators) const {
    RandomStream random(*scene_, x, y, index);
    const RandomStream::Pair place = random.next_pair();
    const FilterSample f = filter_->sample(place.u, place.v);
    const double px = x + 0.5 + static_cast<double>(f.x), py = y + 0.5 + static_cast<double>(f.y);
    return f.weight * integrators.radiance(camera_ray(scene_->camera, px, py), random);
  }

  const CompiledScene* scene_ = nullptr;
  std::int64_t majorant_violations_ = 0;
  std::unique_ptr<Filter> filter_;
  std::unique_ptr<Intersector> intersector_;
  std::unique_ptr<MediaAlongRay> media_;
};

}  // namespace

std::unique_ptr<Backend> make_cpu_backend() { return std::make_unique<CpuBackend>(); }

}  // namespace brume
