#!/usr/bin/env bash
# Installs the Debian packages of packages.txt that are missing, and any others named as arguments, saying first which.
# With nothing missing it is done at once.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

wanted=("$@")
while read -r name _; do
  [[ -z $name || $name == '#'* ]] || wanted+=("$name")
done < packages.txt

if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
  echo "setup: no apt here, so nothing is installed. Brume needs what these Debian packages hold:"
  printf '  %s\n' "${wanted[@]}"
  exit 0
fi

installed=" $(dpkg-query -W -f='${db:Status-Status}:${Package} ' "${wanted[@]}" 2> /dev/null || true) "
missing=()
for name in "${wanted[@]}"; do
  [[ $installed == *" installed:$name "* ]] || missing+=("$name")
done
((${#missing[@]})) || exit 0

echo "setup: to be installed by apt-get (this takes some minutes): ${missing[*]}"
as_root=()
if ((EUID != 0)); then
  if ! command -v sudo > /dev/null; then
    echo "setup: that takes root or sudo, and here is neither. As root, run" >&2
    echo "  apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 -q)
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# Where the lists cannot be refreshed, those of an earlier time may still do.
"${apt[@]}" update > "$log" 2>&1 || { cat "$log" >&2; echo "setup: apt-get update failed; going on without" >&2; }
"${apt[@]}" install -y --no-install-recommends "${missing[@]}" > "$log" 2>&1 || {
  tail -n 40 "$log" >&2
  echo "setup: apt-get install failed; its last lines are above" >&2
  exit 1
}
echo "setup: done"
