#include <algorithm>
#include <atomic>
#include <memory>
#include <vector>

#include "base/diagnostics.h"
#include "base/parallel.h"
#include "image/filter.h"
#include "render/backend.h"
#include "render/classic.h"

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

class CpuBackend : public Backend {
 public:
  void prepare(const CompiledScene& scene) override {
    scene_ = &scene;
    const CompiledFilter& f = scene.filter;
    filter_ =
        std::make_unique<Filter>(f.gaussian ? FilterKind::gaussian : FilterKind::box, f.x_radius, f.y_radius, f.sigma);
    intersector_ = std::make_unique<Intersector>(scene);
    media_ = std::make_unique<MediaAlongRay>(scene, *intersector_);
  }

  bool render(int first, int last, int threads, Film& film,
              const std::function<bool(double fraction)>& keep_going) override {
    const int tiles_x = (film.width() + tile_edge - 1) / tile_edge,
              tiles_y = (film.height() + tile_edge - 1) / tile_edge;
    const int tiles = tiles_x * tiles_y;
    threads = thread_count(threads);
    std::vector<std::unique_ptr<ClassicIntegrator>> integrators;
    for (int i = 0; i < threads; ++i)
      integrators.push_back(std::make_unique<ClassicIntegrator>(*scene_, *intersector_, *media_));
    std::atomic<bool> stopped = false;
    std::atomic<int> done = 0;
    parallel_for(tiles, threads, [&](int tile, int worker) {
      if (stopped) return;
      render_tile(tile % tiles_x, tile / tiles_x, first, last, *integrators[static_cast<std::size_t>(worker)], film);
      ++done;
      if (worker == 0 && !keep_going(static_cast<double>(done) / tiles)) stopped = true;
    });
    if (std::any_of(integrators.begin(), integrators.end(), [](const auto& i) { return !i->complete(); }))
      throw InputError("scene",
                       "more than 16 media overlap somewhere along a ray; at most 16 can be active at one point");
    return !stopped;
  }

 private:
  void render_tile(int tile_x, int tile_y, int first, int last, ClassicIntegrator& integrator, Film& film) const {
    const int x_end = std::min((tile_x + 1) * tile_edge, film.width()),
              y_end = std::min((tile_y + 1) * tile_edge, film.height());
    for (int y = tile_y * tile_edge; y < y_end; ++y)
      for (int x = tile_x * tile_edge; x < x_end; ++x)
        for (int s = first; s < last; ++s) film.add(x, y, sample_pixel(x, y, s, integrator));
  }

  Spectrum sample_pixel(int x, int y, int index, ClassicIntegrator& integrator) const {
    const auto pixel =
        static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(scene_->width) + static_cast<std::uint32_t>(x);
    RandomStream random(scene_->seed, pixel, static_cast<std::uint32_t>(index));
    const double px = x + 0.5 + static_cast<double>(filter_->sample_x(random.next()));
    const double py = y + 0.5 + static_cast<double>(filter_->sample_y(random.next()));
    return integrator.radiance(camera_ray(scene_->camera, px, py), random);
  }

  const CompiledScene* scene_ = nullptr;
  std::unique_ptr<Filter> filter_;
  std::unique_ptr<Intersector> intersector_;
  std::unique_ptr<MediaAlongRay> media_;
};

}  // namespace

std::unique_ptr<Backend> make_cpu_backend() { return std::make_unique<CpuBackend>(); }

}  // namespace brume
