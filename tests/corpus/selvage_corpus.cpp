// SPDX-License-Identifier: MIT
//
// selvage-corpus FOLDER...: sends every mesh under the folders through the whole system, each in a process of
// its own so that a crash costs one row of the table. `./run corpus DIR` calls it, archives unpacked.
//
// Exit code: 0 if every mesh was restored exactly or clearly refused as no mesh; 1 otherwise.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/mesh_io/read_mesh.h"
#include "tests/corpus/restore_mesh.h"

namespace {

namespace fs = std::filesystem;

constexpr unsigned kSecondsPerMesh = 900;

enum class Verdict : int { Exact = 0, Refused = 10, Failed = 11 };

std::vector<fs::path> find_meshes(const std::vector<fs::path>& folders) {
  std::vector<fs::path> meshes;
  for (const fs::path& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file() && selvage::is_mesh_file_name(entry.path())) meshes.push_back(entry.path());
    }
  }
  std::sort(meshes.begin(), meshes.end());
  return meshes;
}

void print_row(const std::string& name, const selvage::Restoration& r, const std::string& verdict) {
  fmt::print("{:<44} {:>9} {:>9} {:>7} {:>10} {:>7.2f} {:>7.2f} {:>7.2f}  {}\n", name, r.vertices,
             r.triangles, r.regions, r.pack_bytes,
             8.0 * static_cast<double>(r.pack_bytes) / std::max(r.vertices, 1u), r.pack_seconds,
             r.fetch_seconds, verdict);
}

/// In the child process: restores one mesh, prints its row.
Verdict restore_and_print(const fs::path& path, const std::string& name) {
  std::uint32_t seed = 1;
  for (char c : name) seed = seed * 31 + static_cast<unsigned char>(c);
  const auto result = selvage::restore_mesh(path, seed);
  if (!result) {
    fmt::print("{:<44} refused: {}\n", name, result.error().to_string());
    return Verdict::Refused;
  }
  print_row(name, *result, result->failure.empty() ? "exact" : "FAILED: " + result->failure);
  return result->failure.empty() ? Verdict::Exact : Verdict::Failed;
}

Verdict run_in_child(const fs::path& path, const std::string& name) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    alarm(kSecondsPerMesh);
    const Verdict verdict = restore_and_print(path, name);
    std::fflush(stdout);
    _exit(static_cast<int>(verdict));
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child) return Verdict::Failed;
  if (WIFEXITED(status) && WEXITSTATUS(status) <= static_cast<int>(Verdict::Failed)) {
    return static_cast<Verdict>(WEXITSTATUS(status));
  }
  fmt::print("{:<44} CRASHED: {}\n", name,
             WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "unexpected exit");
  return Verdict::Failed;
}

std::string short_name(const fs::path& path, const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders) {
    const fs::path relative = path.lexically_relative(folder);
    if (!relative.empty() && *relative.begin() != "..") return relative.string();
  }
  return path.string();
}

}  // namespace

int main(int argc, char** argv) try {
  const std::vector<fs::path> folders(argv + 1, argv + argc);
  if (folders.empty()) {
    std::fprintf(stderr, "usage: selvage-corpus FOLDER...\n");
    return 2;
  }
  const std::vector<fs::path> meshes = find_meshes(folders);
  fmt::print("{:<44} {:>9} {:>9} {:>7} {:>10} {:>7} {:>7} {:>7}  {}\n", "mesh", "vertices", "triangles",
             "regions", "bytes", "bits/v", "pack s", "fetch s", "result");
  std::size_t exact = 0, refused = 0, failed = 0;
  for (const fs::path& path : meshes) {
    switch (run_in_child(path, short_name(path, folders))) {
      case Verdict::Exact:
        ++exact;
        break;
      case Verdict::Refused:
        ++refused;
        break;
      case Verdict::Failed:
        ++failed;
        break;
    }
  }
  fmt::print("\n{} meshes: {} restored exactly, {} refused as not valid, {} failed\n", meshes.size(), exact,
             refused, failed);
  if (meshes.empty()) std::fprintf(stderr, "selvage-corpus: no mesh found\n");
  return failed == 0 && !meshes.empty() ? 0 : 1;
} catch (const std::exception& exception) {
  std::fprintf(stderr, "selvage-corpus: %s\n", exception.what());
  return 1;
}
