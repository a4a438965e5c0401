#!/usr/bin/env bash
# scripts/coverage.sh: which lines of src the tests run, by gcov, file by file and in all. Left out are the tables of
# transport, which take long and run the same lines as the agreement of the integrators does, and a test that leaves
# the program no room on its disk, where gcov could not write either.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

without='-*Nightly*:*Transport*:*AFullDisk*'
build=build/coverage
tests=(test_scene test_image test_volume test_kernel test_compile test_cli test_render)

scripts/build.sh coverage brume "${tests[@]}"
find "$build" -name '*.gcda' -delete
for test in "${tests[@]}"; do
  echo "coverage: $test"
  "$build/bin/$test" --gtest_brief=1 --gtest_filter="$without"
done

# Files and lines are those of the annotated sources that gcov prints, "count:line:text": "-" has no code, "#####" never
# ran. A line of a header or a template is in several, and has run where any of them ran it.
find "$PWD/$build" -name '*.gcda' -print0 | xargs -0 -n 1 gcov --stdout --relative-only --source-prefix "$PWD" 2> /dev/null |
  awk -F: '
    { gsub(/ /, "", $1); gsub(/ /, "", $2) }
    $2 == 0 { if ($3 == "Source") file = $4; next }
    file !~ /^src\// || $1 == "-" || $2 !~ /^[0-9]+$/ { next }
    !((file, $2) in ran) { ++lines[file]; ran[file, $2] = 0 }
    $1 !~ /^[#=]/ && !ran[file, $2] { ran[file, $2] = 1; ++hits[file] }
    END {
      for (file in lines) {
        printf "%5.1f %%  %5d of %5d  %s\n", 100 * hits[file] / lines[file], hits[file], lines[file], file
        all += lines[file]; run += hits[file]
      }
      printf "%5.1f %%  %5d of %5d  in all\n", 100 * run / all, run, all
    }' | sort -n
