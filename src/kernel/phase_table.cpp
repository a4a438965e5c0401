#include "kernel/phase_table.h"

#define KERNEL_TABLES
#include "kernel/scalar.h"

namespace brume {

std::span<const PhaseEntry> phase_functions() {
#define PHASE(name) {kernel::name##_table, kernel::name##_prepare},
  static constexpr PhaseEntry entries[] = {
#include "kernel/phase_list.inl"
  };
#undef PHASE
  return entries;
}

int phase_kind(std::string_view name) {
  const auto entries = phase_functions();
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (entries[i].table.name == name) return static_cast<int>(i);
  return -1;
}

}  // namespace brume
