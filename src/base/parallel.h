// A parallel loop: std::jthread workers that take indices from one atomic counter.
#pragma once

#include <functional>

namespace brume {

// The number of threads that `requested` stands for: itself, or one per core where it is 0.
int thread_count(int requested);

// Calls body(index, worker) once for each index in [0, count), on `threads` workers numbered from 0; returns when all
// are done. Indices are handed out in order. The first exception that a body throws stops the loop and is thrown here.
void parallel_for(int count, int threads, const std::function<void(int index, int worker)>& body);

}  // namespace brume
