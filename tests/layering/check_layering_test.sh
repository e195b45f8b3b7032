#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# check_layering.sh must name the file and line of every kind of violation, and be silent about what is allowed.
set -euo pipefail

check=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/check_layering.sh
tree=$(mktemp --directory)
trap 'rm -rf -- "$tree"' EXIT
failures=0

# Writes one source file with one include, on its second line.
plant() {
  mkdir -p -- "$tree/$(dirname -- "$1")"
  printf '// a file\n#include %s\n' "$2" > "$tree/$1"
}

refuses() {
  plant "$1" "$2"
  if [[ $("$check" "$tree" 2> /dev/null) != *"$1:2:#include $2"* ]]; then
    echo "not refused: $1 includes $2"
    failures=$((failures + 1))
  fi
  rm -- "${tree:?}/$1"
}

allows() {
  plant "$1" "$2"
  "$check" "$tree" || failures=$((failures + 1))
  rm -- "${tree:?}/$1"
}

mkdir -p -- "$tree/common" "$tree/server" "$tree/client"

refuses server/app/a.cpp '"client/session/session.h"'
refuses client/app/a.cpp '"server/store/pack_store.h"'
refuses common/net/a.h '"server/session/session.h"'
refuses server/session/a.cpp '"server/encode/region_encoder.h"'
refuses server/session/a.cpp '"server/segment/segment.h"'
refuses server/session/a.h '"common/mesh/corner_table.h"'
refuses server/segment/a.cpp '<tbb/parallel_for.h>'
refuses client/decode/a.cpp '<unistd.h>'
refuses server/encode/a.cpp '<thread>'
refuses common/codec/a.cpp '"common/base/log.h"'
refuses server/ingest/a.cpp '<OpenMesh/Core/IO/MeshIO.hh>'
refuses server/simplify/a.cpp '<OpenMesh/Tools/Decimater/DecimaterT.hh>'
refuses server/store/a.cpp '<boost/asio/awaitable.hpp>'
refuses common/net/frame.cpp '"messages.pb.h"'
refuses server/session/a.cpp '<google/protobuf/message.h>'
refuses server/app/a.cpp '<spdlog/spdlog.h>'
refuses common/mesh/a.cpp '"corner_table.h"'

allows server/session/a.cpp '"server/store/pack_store.h"'
allows server/session/b.cpp '<boost/asio/awaitable.hpp>'
allows server/encode/a.cpp '"common/codec/clers.h"'
allows server/encode/b.cpp '<algorithm>'
allows client/stitch/a.cpp '<mutex>'
allows common/mesh_io/a.cpp '<OpenMesh/Core/IO/MeshIO.hh>'
allows common/net/messages.cpp '"messages.pb.h"'
allows common/net/publish_messages.cpp '"messages.pb.h"'
allows common/base/log.cpp '<spdlog/spdlog.h>'

rm -r -- "${tree:?}/common" "${tree:?}/server" "${tree:?}/client"
if "$check" "$tree" 2> /dev/null; then
  echo "an empty tree passed"
  failures=$((failures + 1))
fi
((failures == 0))
