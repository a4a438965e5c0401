#!/usr/bin/env bash
# scripts/acceptance.sh FOLDER: holds renders of FOLDER/peers/*.pbrt against long renders of the same scenes by another
# renderer, FOLDER/peers/*_ref.exr, by the ratio of their means. Takes some minutes; not part of the tests.
set -euo pipefail
folder=$(cd "${1:?usage: scripts/acceptance.sh FOLDER}" && pwd)
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/build.sh release brume
brume=build/release/bin/brume
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# scene, integrator, and how far the ratio of the means may be from 1. The fog has outliers
# near its lamp, and at the scene's 16 samples a pixel its mean may miss the limit by noise.
failed=0
while read -r scene integrator limit; do
  "$brume" "$folder/peers/$scene.pbrt" --integrator "$integrator" --quiet -o "$work/$scene.exr"
  ratio=$("$brume" compare "$work/$scene.exr" "$folder/peers/${scene}_ref.exr" --json |
    sed -E 's/^[^}]*"mean_ratio": ([^,]*),.*/\1/')
  verdict=$(awk -v r="$ratio" -v l="$limit" 'BEGIN { d = r - 1; print (d <= l && -d <= l) ? "agrees" : "DIFFERS" }')
  echo "$scene: $integrator over the reference $ratio, limit $limit: $verdict"
  [[ $verdict == agrees ]] || failed=1
done <<'EOF'
cloud reference 0.003
smoke reference 0.003
fog reference 0.01
fog_single classic 0.01
EOF
exit $failed
