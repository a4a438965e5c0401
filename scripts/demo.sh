#!/usr/bin/env bash
# Sets up, builds Brume and renders the built-in example, a cloud over a ground, to cloud.png and cloud.exr in the
# current folder. Arguments go to brume: scripts/demo.sh --spp 64
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

"$root/scripts/build.sh" release brume
"$root/build/release/bin/brume" --example -o cloud.png -o cloud.exr "$@"
