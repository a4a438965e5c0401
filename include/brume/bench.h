// How fast this machine is at what rendering is made of.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace brume {

struct BenchResult {
  std::string measured;                        // "tracking", "paths", "marching" or "surface rays"
  std::string unit;                            // what is counted: "events", "look-ups" or "rays"
  std::string grid, storage, instruction_set;  // "256" or "1024 sparse", "16 bits", "AVX-512"; empty: play no part
  double per_second = 0;                       // of one thread's CPU time, the best of five rounds
};

struct BenchOptions {
  // Voxels along the sides of a ball of noise, a tenth of it in use, 8 to 2048; it is made with at most 256, and
  // enlarged beyond. The first is measured with every instruction set of the machine and every storage, the others with
  // the best set and 16 bits.
  std::vector<int> sizes = {256, 512};
  // Voxels along the sides of volumes of scattered puffs, a tenth of whose bricks are occupied, 8 to 2048; measured
  // with the best set and 16 bits.
  std::vector<int> sparse_sizes = {1024};
  double seconds = 0.5;  // for each result
  int threads = 0;       // to make the volumes with; 0: one per core
};

// "AMD EPYC 9355, 2 cores, Brume 0.1.0": what the results are of.
std::string bench_machine();

// Calls on_result with each result as it is known. Paths are followed through a white furnace: a volume of optical
// depth 100 across at its densest, albedo 1, henyey_greenstein with g = 0.85; an event is a step through a cell of
// majorants or a look-up of the density. Tracking is the search for the collisions of such paths alone. Marching is the
// integral of the density with linear interpolation along straight rays. Surface rays are single rays against 130,000
// triangles. Throws Error.
void bench(const BenchOptions& options, const std::function<void(const BenchResult&)>& on_result);

}  // namespace brume
