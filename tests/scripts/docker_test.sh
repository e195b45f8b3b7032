#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# docker_test.sh PROGRAM...: what docker/Dockerfile relies on, without an engine: its steps are scripts that are there,
# the packages that runtime_packages.sh names are all that the programs load, the load script of compose.yaml is one.
set -euo pipefail

root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../.." && pwd -P)
failures=0
claim() {
  local what=$1
  shift
  "$@" || {
    echo "not so: $what"
    failures=$((failures + 1))
  }
}

for step in scripts/install_packages.sh docker/runtime_packages.sh run; do
  claim "$step is in the Dockerfile" grep -q -- "$step" "$root/docker/Dockerfile"
  claim "$step can be run" test -x "$root/$step"
done

packages=$("$root/docker/runtime_packages.sh" "$@")
for needed in libc6 libstdc++6 libspdlog; do
  claim "$needed is among the packages" grep -q "^$needed" <<< "$packages"
done
while IFS= read -r package; do
  claim "$package is a package" dpkg-query --status "$package" > /dev/null
done <<< "$packages"
claim "no package twice" test -z "$(uniq -d <<< "$packages")"
claim "nothing for building" test -z "$(grep -E -- '-dev$' <<< "$packages")"

for program in "$@"; do
  [[ $program != */selvage-load ]] || claim "visit.load is a script" "$program" localhost:1 --check --script "$root/docker/visit.load"
done
((failures == 0))
