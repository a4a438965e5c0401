#!/usr/bin/env bash
# Renders the pictures of README.md and docs/ anew, with the release build. Takes some minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/build.sh release brume
mkdir -p docs/images
brume=build/release/bin/brume
"$brume" --example --resolution 720x405 --spp 256 -o docs/images/cloud.png
"$brume" --example --resolution 480x300 --spp 8 --integrator classic -o docs/images/cloud_single.png
"$brume" --example --resolution 480x300 --spp 128 -o docs/images/cloud_multiple.png
"$brume" scenes/surfaces.pbrt --resolution 480x300 --spp 256 -o docs/images/surfaces.png
"$brume" scenes/lamp_in_fog.pbrt --resolution 480x300 --spp 256 -o docs/images/lamp_in_fog.png
"$brume" scenes/two_clouds.pbrt --resolution 480x300 --spp 128 -o docs/images/two_clouds.png
for scene in fire fog liquid; do "$brume" "scenes/$scene.pbrt" -o "docs/images/$scene.png"; done
"$brume" scenes/smoke_by_a_lamp.pbrt --spp 512 -o docs/images/smoke_by_a_lamp.png
volumes=$(mktemp -d)
trap 'rm -rf "$volumes"' EXIT
cp scenes/founding.pbrt "$volumes"
"$brume" make smoke --size 500 -o "$volumes/smoke500.vdb"
"$brume" "$volumes/founding.pbrt" -o docs/images/founding.png
