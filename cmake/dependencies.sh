#!/usr/bin/env bash
# Installs what a bare Debian 12 lacks to build dalembert with its sweeps, and the packages named as arguments.
set -euo pipefail
command -v dpkg-query >/dev/null || exit 0 # elsewhere CMake says what is missing

needed=(git g++ cmake make ninja-build libeigen3-dev libsundials-dev libsuitesparse-dev
  libboost-dev libcli11-dev libgtest-dev libgmock-dev
  libhdf5-dev libtbb-dev libopenmpi-dev openmpi-bin python3-h5py "$@")
missing=()
for package in "${needed[@]}"; do
  [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || missing+=("$package")
done
((${#missing[@]})) || exit 0

install=(apt-get install -y --no-install-recommends "${missing[@]}")
if ((EUID != 0)); then
  echo "Missing packages; install them with:  sudo apt-get update && sudo ${install[*]}" >&2
  exit 1
fi
export DEBIAN_FRONTEND=noninteractive
apt-get update -qq </dev/null
"${install[@]}" -qq </dev/null
