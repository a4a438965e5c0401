#!/usr/bin/env bash
# scripts/acceptance.sh FOLDER: holds this renderer against what lies in a folder outside the repository.
# - Transmittance: tracking against exact optical depths, on rays through each grid of FOLDER/data/*.vdb and *.nvdb.
# - Pictures: renders of FOLDER/peers/*.pbrt against long renders of the same scenes by another renderer,
#   FOLDER/peers/*_ref.exr: the ratio of the means, and whether their differences have structure.
# Takes some minutes; not part of the tests. BUILD names another preset than release.
set -euo pipefail
folder=$(cd "${1:?usage: scripts/acceptance.sh FOLDER}" && pwd)
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${BUILD:-release}
scripts/build.sh "$preset" brume check_transmittance check_block_scores
programs=build/$preset/bin
brume=$programs/brume
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

echo "Transmittance"
shopt -s nullglob
"$programs/check_transmittance" "$folder"/data/*.vdb "$folder"/data/*.nvdb || failed=1

# Scene, samples a pixel, and how far the ratio of the means may be from 1.
echo "Pictures"
while read -r scene samples limit; do
  sed -E -e "s#\"\.\./data/#\"$folder/data/#" -e "s/^Sampler .*/Sampler \"independent\"/" \
    "$folder/peers/$scene.pbrt" > "$work/$scene.pbrt"
  "$brume" "$work/$scene.pbrt" --spp "$samples" --quiet -o "$work/$scene.pfm"
  ratio=$("$brume" compare "$work/$scene.pfm" "$folder/peers/${scene}_ref.exr" --json |
    sed -E 's/^[^}]*"mean_ratio": ([^,]*),.*/\1/')
  verdict=$(awk -v r="$ratio" -v l="$limit" 'BEGIN { d = r - 1; print (d <= l && -d <= l) ? "agrees" : "DIFFERS" }')
  echo "$scene: mean over the reference's $ratio, limit $limit: $verdict"
  [[ $verdict == agrees ]] || failed=1
  echo -n "$scene: scores of blocks: "
  "$programs/check_block_scores" "$work/$scene.pfm" "$folder/peers/${scene}_ref.exr" || failed=1
done <<'END'
cloud 16 0.003
smoke 64 0.003
fog 64 0.01
fog_single 64 0.01
END
exit $failed
