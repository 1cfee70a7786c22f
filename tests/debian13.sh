#!/usr/bin/env bash
# Builds and tests on Debian 13 (g++ 14, SUNDIALS 7, SuiteSparse 7), in a root that debootstrap makes; for a
# release, not for every change. Says so and skips where it may not make one: no root user, no debootstrap, no
# chroot.
#
# Usage, as root: tests/debian13.sh [folder of the root, kept if given [regular expression of tests, as of ctest -R]]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

skip() {
  echo "skipped: $*"
  exit 0
}
((EUID == 0)) || skip "only root may chroot"
command -v debootstrap >/dev/null || skip "debootstrap is not installed"
chroot / true 2>/dev/null || skip "chroot is not permitted here"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
root=${1:-$scratch/root}
tests=${2:-.}

[[ -x $root/usr/bin/apt-get ]] || debootstrap --variant=minbase trixie "$root" ||
  skip "debootstrap cannot make a root here"
inside() { chroot "$root" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"; }
inside apt-get update -qq
inside apt-get install -qq -y --no-install-recommends g++ cmake ninja-build libeigen3-dev libsundials-dev \
  libsuitesparse-dev libboost-dev libcli11-dev libgtest-dev libgmock-dev pkgconf

# The tree as it is, with what is not committed, and nothing else; what was built there before is built on.
rm -rf "$root/dalembert"
mkdir -p "$root/dalembert"
git ls-files -z --cached --others --exclude-standard | xargs -0 cp --parents -p -t "$root/dalembert" --

build() {
  inside cmake -S /dalembert -B /build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DDALEMBERT_BENCH=OFF \
    -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wpedantic -Wconversion"
  inside cmake --build /build "$@"
}
build --target dalembert
inside cmake --install /build --prefix /usr/local
inside cmake -S /dalembert/tests/consumer -B /consumer -G Ninja
inside cmake --build /consumer
inside /consumer/consumer
build
inside ctest --test-dir /build --output-on-failure --no-tests=error -R "$tests"
