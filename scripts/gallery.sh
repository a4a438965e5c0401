#!/usr/bin/env bash
# scripts/gallery.sh [NAME]: renders the pictures of README.md and docs/ anew, with the release build, in some ten
# minutes; with a NAME only those whose names begin with it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
only=${1:-}

scripts/build.sh release brume
mkdir -p docs/images
brume=build/release/bin/brume

# picture NAME ARGUMENTS...: docs/images/NAME.png, by brume with these arguments
picture() {
  if [[ $1 == "$only"* ]]; then "$brume" "${@:2}" -o "docs/images/$1.png"; fi
}

# variant NAME SCENE LINE: the same of a scene with a line before it
variant() {
  picture "$1" - "scenes/$2.pbrt" <<< "$3"
}

picture cloud --example --resolution 720x405 --spp 256
picture cloud_single --example --resolution 480x300 --spp 8 --integrator classic
picture cloud_multiple --example --resolution 480x300 --spp 512
picture surfaces scenes/surfaces.pbrt --resolution 480x300 --spp 256
picture lens scenes/lens.pbrt
picture rough_glass scenes/rough_glass.pbrt
picture two_balls scenes/two_balls.pbrt

variant steps_coarse steps 'Integrator "classic" "float step" 0.2'
variant steps_fine steps 'Integrator "classic" "float step" 0.02'
variant steps_dda steps 'Integrator "classic" "string traversal" "dda"'
for placement in start random middle-random; do
  variant "placement_$placement" steps "Integrator \"classic\" \"float step\" 0.2 \"string placement\" \"$placement\""
done
for shadows in march cached; do
  variant "shadows_$shadows" steps "Attribute \"medium\" \"float scale\" 4
    Integrator \"classic\" \"float step\" 0.01 \"string volumeshadows\" \"$shadows\""
done

variant phase_backward phase 'Attribute "medium" "string phase" "henyey_greenstein" "float g" -0.65'
variant phase_forward phase 'Attribute "medium" "string phase" "henyey_greenstein" "float g" 0.25'
variant phase_schlick phase 'Attribute "medium" "string phase" "schlick" "float k" -0.86'
variant phase_draine phase 'Attribute "medium" "string phase" "draine" "float g" 0.25 "float alpha" 5'
for phase in isotropic rayleigh mie two_lobe; do
  variant "phase_$phase" phase "Attribute \"medium\" \"string phase\" \"$phase\""
done

for interpolation in nearest linear; do
  variant "voxels_$interpolation" voxels "Attribute \"medium\" \"string interpolation\" \"$interpolation\""
done

picture volume_shadow scenes/volume_shadow.pbrt
variant volume_shadow_binary volume_shadow 'Attribute "medium" "float scale" 100000'
picture dyes scenes/dyes.pbrt

picture lamp_in_fog scenes/lamp_in_fog.pbrt --resolution 480x300 --spp 256 --exposure 0.7
picture smoke_by_a_lamp scenes/smoke_by_a_lamp.pbrt --spp 512
picture fire scenes/fire.pbrt --spp 512
picture fog scenes/fog.pbrt --resolution 480x240 --spp 512
picture liquid scenes/liquid.pbrt --resolution 400x200 --spp 1024
picture two_clouds scenes/two_clouds.pbrt --resolution 480x300 --spp 512

if [[ founding == "$only"* ]]; then
  volumes=$(mktemp -d)
  trap 'rm -rf "$volumes"' EXIT
  cp scenes/founding.pbrt "$volumes"
  "$brume" make smoke --size 500 -o "$volumes/smoke500.vdb"
  picture founding "$volumes/founding.pbrt"
fi
