// SPDX-License-Identifier: MIT
//
// Runs a fuzz target without libFuzzer: each corpus file as it is, every truncation of it, and every
// single-bit flip (of the first 4096 bytes, so that large seeds stay quick). A target fails by crashing.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

/// A fresh buffer of exactly the input's size, so that a sanitizer sees any read past its end.
void run(const std::uint8_t* data, std::size_t size) {
  const std::vector<std::uint8_t> copy(data, data + size);
  LLVMFuzzerTestOneInput(copy.data(), copy.size());
}

std::size_t replay(std::vector<std::uint8_t> input) {
  constexpr std::size_t kMutatedBytes = 4096;
  run(input.data(), input.size());
  const std::size_t mutated = std::min(input.size(), kMutatedBytes);
  for (std::size_t length = 0; length < mutated; ++length) run(input.data(), length);
  for (std::size_t bit = 0; bit < 8 * mutated; ++bit) {
    input[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
    run(input.data(), input.size());
    input[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
  }
  return 1 + 9 * mutated;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: %s CORPUS_DIR\n", argv[0]), 2;
  std::size_t files = 0, runs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
    std::ifstream in(entry.path(), std::ios::binary);
    runs += replay({std::istreambuf_iterator<char>(in), {}});
    ++files;
  }
  std::printf("%zu files, %zu runs\n", files, runs);
  return files == 0 ? std::fprintf(stderr, "no corpus in %s\n", argv[1]), 1 : 0;
}
