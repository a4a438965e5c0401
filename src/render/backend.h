// The seam between a scene and what renders it: the CPU here, a GPU elsewhere.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "compiled/compiled_scene.h"
#include "image/film.h"
#include "render/render_counts.h"

namespace brume {

class Backend {
 public:
  virtual ~Backend() = default;

  // Makes ready to render `scene`, which must outlive this.
  virtual void prepare(const CompiledScene& scene) = 0;

  // After prepare: a place at which shapes that bound a medium were found not to be closed, so that the media which a
  // ray finds around it are not right.
  virtual std::optional<kernel::vec3> open_boundary() const = 0;

  // Adds samples [first, last) of every pixel of the scene's crop to `film`, which has the crop's size, on `threads`
  // threads. Calls keep_going(fraction of these samples done) now and then, on the calling thread; once it returns
  // false the rest is left and this returns false (pixels then have different counts). The film's bits do not depend on
  // the number of threads nor on how the samples are split into calls.
  virtual bool render(int first, int last, int threads, Film& film,
                      const std::function<bool(double fraction)>& keep_going) = 0;

  // Of all that was rendered since prepare.
  virtual RenderCounts counts() const = 0;
};

std::unique_ptr<Backend> make_cpu_backend();

}  // namespace brume
