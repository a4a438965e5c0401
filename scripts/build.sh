#!/usr/bin/env bash
# scripts/build.sh PRESET [TARGET...]: sets up, configures where that was not done, and builds into build/PRESET.
# Prints little but progress, warnings and errors.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=${1:?usage: scripts/build.sh PRESET [TARGET...]}
shift
folder=build/$preset

if [[ $preset == fuzz ]]; then
  scripts/setup.sh clang libclang-rt-dev
else
  scripts/setup.sh
fi

if [[ ! -f $folder/build.ninja ]]; then
  echo "build: configuring $preset"
  mkdir -p "$folder"
  if ! cmake --preset "$preset" > "$folder/configure.log" 2>&1; then
    cat "$folder/configure.log" >&2
    exit 1
  fi
fi

# A file that includes OpenVDB takes up to 2 GB to compile: as many at a time as there are cores and memory for.
jobs=$(nproc)
by_memory=$(awk '/^MemAvailable:/ { print int($2 / 2097152) }' /proc/meminfo 2> /dev/null || echo "$jobs")
if ((by_memory < jobs)); then jobs=$((by_memory > 1 ? by_memory : 1)); fi

# Ninja's status lines condensed to one a tenth of the whole; all else that it prints goes through.
condense() {
  local line percent shown=0
  while IFS= read -r line; do
    if [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]]; then
      percent=$((100 * BASH_REMATCH[1] / BASH_REMATCH[2]))
      if ((percent >= shown + 10)); then
        shown=$((percent / 10 * 10))
        echo "build: $preset ${shown} %"
      fi
    elif [[ $line != 'ninja: no work to do.' ]]; then
      printf '%s\n' "$line"
    fi
  done
}

build=(cmake --build "$folder" --parallel "$jobs")
if (($#)); then build+=(--target "$@"); fi
if [[ -t 1 ]]; then
  "${build[@]}"  # on a terminal Ninja rewrites one line
else
  "${build[@]}" 2>&1 | condense
fi
