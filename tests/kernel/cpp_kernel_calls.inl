// kernel_calls.inl for the two C++ builds, and the table of its functions.
struct KernelCall {
  const char* name;
  int inputs, outputs;
  void (*function)(const F* a, F* r, const TestGrid& grid);
};

#define KERNEL inline
#define KERNEL_CALL(name) \
  inline void call_##name([[maybe_unused]] const F* a, [[maybe_unused]] F* r, [[maybe_unused]] const TestGrid& grid)
#define EVAL(name, mu, p) name##_eval(mu, p)
#define SAMPLE(name, u, p) name##_sample(u, p)
#define MEAN_COSINE(name, p) name##_mean_cosine(p)
#include "kernel/kernel_calls.inl"
#undef KERNEL
#undef KERNEL_CALL
#undef EVAL
#undef SAMPLE
#undef MEAN_COSINE

constexpr KernelCall kernel_calls[] = {
#define CALL(name, inputs, outputs) {#name, inputs, outputs, call_##name},
#include "kernel/kernel_call_list.inl"
#undef CALL
};
