#!/usr/bin/env bash
# scripts/test.sh [release|asan|tsan|all|nightly]...: sets up, builds and runs the tests by CTest, preset by preset; stops
# at the first preset with a failure. Without arguments: release and asan (AddressSanitizer and
# UndefinedBehaviorSanitizer; without the twins with planted faults, since sanitizers do not change what a test can
# see). nightly: the long tests, which the others leave out, in release.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

presets=()
for name in "${@:-default}"; do
  case $name in
    release | asan | tsan | nightly) presets+=("$name") ;;
    default) presets+=(release asan) ;;
    all) presets+=(release asan tsan) ;;
    *)
      echo "usage: scripts/test.sh [release|asan|tsan|all|nightly]..." >&2
      exit 2
      ;;
  esac
done

export ASAN_OPTIONS=strict_string_checks=1:detect_stack_use_after_return=1:check_initialization_order=1
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS=second_deadlock_stack=1

for preset in "${presets[@]}"; do
  scripts/build.sh "${preset/nightly/release}"
  ctest --preset "$preset" --parallel "$(nproc)"
done
