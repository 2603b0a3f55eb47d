#!/usr/bin/env bash
# Installs the Debian packages Hysteron is built from, only those that are missing. Root or sudo.
#     scripts/setup.sh [PACKAGE ...]     further ones
set -euo pipefail
packages=(g++ cmake ninja-build pkg-config npm libeigen3-dev libfmt-dev libcli11-dev nlohmann-json3-dev
  libtomlplusplus-dev zlib1g-dev libhdf5-dev libmatio-dev libnlopt-dev libboost-dev libsqlite3-dev libzip-dev libexpat1-dev
  librandom123-dev libgtest-dev libbenchmark-dev python3 python3-openpyxl "$@")
missing=()
for package in "${packages[@]}"; do
  # npm may also come with another installation of Node.js.
  [ "$package" = npm ] && command -v npm >/dev/null && continue
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0
echo "installing: ${missing[*]}" >&2
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "error: ${missing[*]} must be installed; run as root or install sudo" >&2; exit 1; }
  as_root=(sudo)
fi
"${as_root[@]}" apt-get update -qq
DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
