// Many rays as structure of arrays: what the stages of volpath pass on.
#pragma once

#include <cstdint>
#include <vector>

namespace brume {

// Room for whole vectors of lanes beyond the last ray.
constexpr std::uint32_t widest_vector = 16;

// Columns of a batch, for code that is compiled for several instruction sets. A ray with t_max = 0 is none.
struct RayColumns {
  float* origin[3] = {};
  float* direction[3] = {};  // unit length; world space
  float* t_max = nullptr;
  // The first number of a ray's first flight through a medium, in [0, 1).
  float* distance_u = nullptr;
  // The stream of the ray's random numbers: words (key, pixel, sample, counter) of kernel/random.inl.
  std::uint32_t* key = nullptr;
  std::uint32_t* pixel = nullptr;
  std::uint32_t* sample = nullptr;
  std::uint32_t* hero = nullptr;  // the channel that decides about collisions
};

// Memory for columns.
class ColumnMemory {
 public:
  explicit ColumnMemory(std::uint32_t rows) : rows_(rows + widest_vector) {}
  float* floats() { return floats_.emplace_back(rows_).data(); }
  std::uint32_t* words() { return words_.emplace_back(rows_).data(); }
  std::int32_t* integers() { return integers_.emplace_back(rows_).data(); }
  void make_floats(float* (&columns)[3]) {
    for (float*& column : columns) column = floats();
  }
  RayColumns rays() {
    RayColumns r;
    make_floats(r.origin);
    make_floats(r.direction);
    r.t_max = floats();
    r.distance_u = floats();
    for (std::uint32_t** column : {&r.key, &r.pixel, &r.sample, &r.hero}) *column = words();
    return r;
  }

  // In all columns.
  void copy_row(std::uint32_t from, std::uint32_t to) {
    const auto copy = [&](auto& columns) {
      for (auto& column : columns) column[to] = column[from];
    };
    copy(floats_);
    copy(words_);
    copy(integers_);
  }

 private:
  std::uint32_t rows_;
  std::vector<std::vector<float>> floats_;
  std::vector<std::vector<std::uint32_t>> words_;
  std::vector<std::vector<std::int32_t>> integers_;
};

}  // namespace brume
