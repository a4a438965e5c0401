#!/usr/bin/env bash
# Renders the pictures of README.md and docs/ anew, with the release build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/build.sh release brume
mkdir -p docs/images
build/release/bin/brume --example --resolution 720x405 --spp 16 -o docs/images/cloud.png
