#!/usr/bin/env bash
# scripts/lint.sh [format|tidy|all|fix]: checks the C++ files with clang-format (.clang-format), with clang-tidy
# (.clang-tidy), or with both, as it does without an argument; every finding is an error. fix: formats the files.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# The files that git has or would take, of the given names, each with a zero byte after it.
sources() {
  git ls-files -z --cached --others --exclude-standard -- "$@" | while IFS= read -r -d '' file; do
    [[ ! -f $file ]] || printf '%s\0' "$file"
  done
}

format() { sources '*.cpp' '*.h' '*.inl' | xargs -0 clang-format "$@"; }

# The flags of each file, and the kernel's generated lists, are those of the release build.
tidy() {
  cmake --preset release > /dev/null
  sources '*.cpp' | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p build/release --quiet \
    2> >(grep -v -E '^[0-9]+ warnings? (and [0-9]+ errors? )?generated|^Suppressed|^Use -header-filter' >&2)
}

what=${1:-all}
[[ $what =~ ^(format|tidy|all|fix)$ ]] || {
  echo "usage: scripts/lint.sh [format|tidy|all|fix]" >&2
  exit 2
}
scripts/setup.sh clang-format clang-tidy
case $what in
  fix) format -i ;;
  format) format --dry-run -Werror ;;
  tidy) tidy ;;
  all)
    format --dry-run -Werror
    tidy
    ;;
esac
echo "lint: $what done, no fault left"
