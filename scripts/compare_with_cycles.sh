#!/usr/bin/env bash
# scripts/compare_with_cycles.sh FOLDER [options] [SCENE...]: error x time of Brume and of Blender's Cycles on the scenes
# FOLDER/peers/SCENE.pbrt, which FOLDER/peers/cycles_scene.py builds for Cycles. Not part of the tests; blender must be
# installed (apt-get install --no-install-recommends blender).
#   --spp N            samples a pixel, default 16
#   --repetitions N    medians of N measurements, default 1; the two renderers take turns
#   --integrator NAME  passed to brume
# Without scenes: cloud, smoke, fog, fog_single.
#
# A measurement is two renders with different seeds, two threads each. Its error is their relMSE as `brume compare` has it
# (trimmed for fog, whose lamp makes outliers), its time the CPU seconds, user and system, of a render's whole process,
# the mean of the two. From Cycles' time that of Blender starting without a scene is taken off; from Brume's nothing.
set -euo pipefail
usage() {
  sed -n '2,8s/^# //p' "$0" >&2
  exit 2
}
(($#)) || usage
[[ -f $1/peers/cycles_scene.py ]] || { echo "there is no $1/peers/cycles_scene.py" >&2; usage; }
folder=$(cd "$1" && pwd)
shift
spp=16 repetitions=1 integrator=() scenes=()
while (($#)); do
  case $1 in
    --spp) spp=${2:?}; shift 2 ;;
    --repetitions) repetitions=${2:?}; shift 2 ;;
    --integrator) integrator=(--integrator "${2:?}"); shift 2 ;;
    -*) usage ;;
    *) scenes+=("$1"); shift ;;
  esac
done
((${#scenes[@]})) || scenes=(cloud smoke fog fog_single)
command -v blender > /dev/null || { echo "blender is not installed" >&2; exit 1; }
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/build.sh release brume
brume=build/release/bin/brume
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Adds the CPU seconds of a command to `seconds`.
seconds=0
run() {
  local TIMEFORMAT='%U %S'
  { time "$@" > "$work/log" 2>&1; } 2> "$work/time" || { cat "$work/log" >&2; exit 1; }
  seconds=$(awk -v s="$seconds" '{ print s + $1 + $2 }' "$work/time")
}

# Two pictures, 1.exr and 2.exr; Cycles counts bounces after the light's, so that 0 is single scattering.
cycles() {
  local seed name=$1 bounces=100
  [[ $name != fog_single ]] || name=fog bounces=0
  for seed in 1 2; do
    run blender -b --factory-startup -P "$folder/peers/cycles_scene.py" -- \
      "$name" "$spp" "$seed" "$work/$seed.exr" "$bounces" 2
  done
}
brume() {
  local seed
  for seed in 1 2; do
    run "$brume" "$folder/peers/$1.pbrt" --spp "$spp" --seed "$seed" --nthreads 2 --quiet -o "$work/$seed.exr" \
      "${integrator[@]}"
  done
}

# measure RENDERER SCENE: appends "error seconds" to the file $work/RENDERER.
measure() {
  local error=relmse
  [[ $2 != fog ]] || error=trimmed_relmse
  seconds=0
  "$1" "$2"
  "$brume" compare "$work/1.exr" "$work/2.exr" --json |
    sed -E "s/.*\"$error\": ([^,]*),.*/\1/" |
    awk -v s="$seconds" -v start="$([[ $1 == cycles ]] && echo "$start" || echo 0)" '{ print $1, s / 2 - start }' \
      >> "$work/$1"
}

# median COLUMN FILE
median() {
  cut -d ' ' -f "$1" "$2" | sort -g |
    awk '{ v[NR] = $1 } END { print (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2 }'
}

run blender -b --factory-startup --python-expr 'pass'  # fills the file cache
seconds=0
run blender -b --factory-startup --python-expr 'pass'
start=$seconds

echo "$(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -n 1), $(blender --version | head -n 1), $spp samples a pixel, median of $repetitions"
echo "Blender's start, $start CPU s, is taken off. Equal error: the CPU s that Brume takes to Cycles' error, if error x time"
echo "stays the same."
printf '%-11s %-7s %10s %8s %11s %14s %12s\n' scene '' error 'CPU s' 'error x s' 'Brume/Cycles' 'equal error'
for scene in "${scenes[@]}"; do
  rm -f "$work/cycles" "$work/brume"
  for ((i = 0; i < repetitions; ++i)); do
    measure cycles "$scene"
    measure brume "$scene"
  done
  awk -v scene="$scene" -v ce="$(median 1 "$work/cycles")" -v cs="$(median 2 "$work/cycles")" \
    -v be="$(median 1 "$work/brume")" -v bs="$(median 2 "$work/brume")" 'BEGIN {
    printf "%-11s %-7s %10.4g %8.2f %11.4g\n", scene, "Cycles", ce, cs, ce * cs
    printf "%-11s %-7s %10.4g %8.2f %11.4g %14s %10.2f s\n", "", "Brume", be, bs, be * bs,
      sprintf("1/%.3g", ce * cs / (be * bs)), bs * be / ce
  }'
done
