// Whether this is a build with AddressSanitizer or ThreadSanitizer. They look for other faults than means do, and are
// slow: statistical tests take fewer samples there.
#pragma once

namespace brume {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

}  // namespace brume
