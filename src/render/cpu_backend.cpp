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
#include "render/camera_ray.h"
#include "render/classic.h"
#include "render/open_boundary.h"
#include "render/reference.h"
#include "render/volpath.h"

namespace brume {

namespace {

// Renders tiles with the scene's integrator. One to each worker.
class TileRenderer {
 public:
  TileRenderer(const CompiledScene& scene, const Intersector& intersector, const MediaAlongRay& media,
               const ShadowCache* shadow_cache, const Filter& filter)
      : scene_(scene), filter_(filter) {
    switch (scene.integrator.kind) {
      case CompiledIntegrator::Kind::classic:
        classic_.emplace(scene, intersector, media, shadow_cache);
        break;
      case CompiledIntegrator::Kind::reference:
        reference_.emplace(scene, intersector, media);
        break;
      case CompiledIntegrator::Kind::volpath:
        volpath_.emplace(scene, intersector, media, filter);
        break;
    }
  }

  void render_tile(const PixelBox& tile, int first, int last, Film& film) {
    if (volpath_) return volpath_->render_tile(tile, first, last, film);
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x)
        for (int s = first; s < last; ++s) {
          add_sample(x, y, s);
          if (samples_.size() == sample_batch) render_samples(film);
        }
    render_samples(film);
  }

  std::optional<kernel::vec3> too_many_media() const {
    return classic_     ? classic_->too_many_media()
           : reference_ ? reference_->too_many_media()
                        : volpath_->too_many_media();
  }
  RenderCounts counts() const {
    return volpath_ ? volpath_->counts() : reference_ ? reference_->counts() : classic_->counts();
  }

 private:
  struct Place {
    int x, y;
    float filter_weight;
  };
  static constexpr std::size_t sample_batch = 64;

  // Of pixel (x, y) of the film.
  void add_sample(int x, int y, int index) {
    const int picture_x = scene_.crop.x0 + x, picture_y = scene_.crop.y0 + y;
    RandomStream random(scene_, picture_x, picture_y, index);
    const RandomStream::Pair place = random.next_pair();
    const FilterSample f = filter_.sample(place.u, place.v);
    const double px = picture_x + 0.5 + static_cast<double>(f.x), py = picture_y + 0.5 + static_cast<double>(f.y);
    const RandomStream::Pair lens = scene_.camera.has_lens() ? random.next_pair() : RandomStream::Pair{0.5f, 0.5f};
    samples_.push_back({camera_ray(scene_.camera, px, py, lens.u, lens.v), random, {}, {}});
    places_.push_back({x, y, f.weight});
  }

  void render_samples(Film& film) {
    if (classic_) classic_->render(samples_);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      auto& [ray, random, radiance, seen] = samples_[i];
      if (reference_) radiance = reference_->radiance(ray, random, seen);
      seen.depth *= CameraDepth(scene_.camera).along(ray.direction);
      film.add(places_[i].x, places_[i].y, radiance, seen, places_[i].filter_weight);
    }
    samples_.clear();
    places_.clear();
  }

  const CompiledScene& scene_;
  const Filter& filter_;
  std::optional<ClassicIntegrator> classic_;
  std::optional<ReferenceIntegrator> reference_;
  std::optional<VolpathIntegrator> volpath_;
  std::vector<CameraSample> samples_;  // to be rendered together,
  std::vector<Place> places_;          // and where they belong
};

class CpuBackend : public Backend {
 public:
  void prepare(const CompiledScene& scene) override {
    scene_ = &scene;
    filter_ = std::make_unique<Filter>(scene.filter);
    intersector_ = std::make_unique<Intersector>(scene);
    media_ = std::make_unique<MediaAlongRay>(scene, *intersector_);
    shadow_cache_.reset();
    counts_ = {};
  }

  std::optional<kernel::vec3> open_boundary() const override { return find_open_boundary(*scene_, *media_); }

  RenderCounts counts() const override { return counts_; }

  bool render(int first, int last, int threads, Film& film,
              const std::function<bool(double fraction)>& keep_going) override {
    // Large tiles keep volpath's many paths busy; small ones share the others' work out more evenly.
    const int edge = scene_->integrator.kind == CompiledIntegrator::Kind::volpath ? 32 : 16;
    const int tiles_x = (film.width() + edge - 1) / edge, tiles_y = (film.height() + edge - 1) / edge;
    const int tiles = tiles_x * tiles_y;
    threads = thread_count(threads);
    if (!fill_shadow_cache(threads, keep_going)) return false;
    std::vector<std::unique_ptr<TileRenderer>> renderers;
    for (int i = 0; i < threads; ++i)
      renderers.push_back(
          std::make_unique<TileRenderer>(*scene_, *intersector_, *media_, shadow_cache_.get(), *filter_));
    std::atomic<bool> stopped = false;
    std::atomic<int> done = 0;
    parallel_for(tiles, threads, [&](int tile, int worker) {
      if (stopped) return;
      const int x = edge * (tile % tiles_x), y = edge * (tile / tiles_x);
      renderers[static_cast<std::size_t>(worker)]->render_tile(
          {x, std::min(x + edge, film.width()), y, std::min(y + edge, film.height())}, first, last, film);
      ++done;
      if (worker == 0 && !keep_going(static_cast<double>(done) / tiles)) stopped = true;
    });
    for (const auto& i : renderers) counts_ += i->counts();
    for (const auto& i : renderers) check(i->too_many_media());
    return !stopped;
  }

 private:
  void check(const std::optional<kernel::vec3>& too_many_media) const {
    if (const auto& p = too_many_media)
      throw InputError(scene_->file,
                       fmt::format("more than {} media overlap at ({}, {}, {})", max_active_media, p->x, p->y, p->z));
  }

  // Once for the scene, where it asks for that. False when told to stop.
  bool fill_shadow_cache(int threads, const std::function<bool(double fraction)>& keep_going) {
    if (shadow_cache_ || !scene_->integrator.cached_shadows) return true;
    bool goes_on = true;
    auto cache = std::make_unique<ShadowCache>(*scene_, *intersector_, *media_, threads,
                                               [&] { return goes_on = goes_on && keep_going(0); });
    check(cache->too_many_media());
    if (goes_on) shadow_cache_ = std::move(cache);
    return goes_on;
  }

  const CompiledScene* scene_ = nullptr;
  RenderCounts counts_;
  std::unique_ptr<Filter> filter_;
  std::unique_ptr<Intersector> intersector_;
  std::unique_ptr<MediaAlongRay> media_;
  std::unique_ptr<ShadowCache> shadow_cache_;
};

}  // namespace

std::unique_ptr<Backend> make_cpu_backend() { return std::make_unique<CpuBackend>(); }

}  // namespace brume
