// SPDX-License-Identifier: MIT
#include "common/mesh_io/off.h"
#include "tests/fuzz/fuzz_mesh_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return selvage::fuzz_mesh_reader(selvage::parse_off, data, size);
}
