// SPDX-License-Identifier: MIT
#include "bench/segment/psb.h"

#include <algorithm>
#include <array>
#include <fstream>

#include "common/mesh_io/read_mesh.h"

namespace selvage::bench {
namespace {

/// Twenty models a category, in this order.
std::string category_of(int id) {
  constexpr std::array kNames = {"human",     "cup",   "glasses", "airplane", "ant",  "chair",  "octopus",
                                 "table",     "teddy", "hand",    "plier",    "fish", "bird",   "spring",
                                 "armadillo", "bust",  "mech",    "bearing",  "vase", "fourleg"};
  const auto at = static_cast<std::size_t>((id - 1) / 20);
  return at < kNames.size() ? kNames[at] : "other";
}

Result<Labels> read_labels(const std::filesystem::path& path, std::size_t triangles) {
  std::ifstream in(path);
  Labels labels;
  for (std::uint32_t label; in >> label;) labels.push_back(label);
  if (labels.size() != triangles)
    return fail(ErrorCode::BadFile, path.string() + ": not one label a triangle");
  return labels;
}

}  // namespace

std::vector<int> list_psb(const std::filesystem::path& folder) {
  std::vector<int> ids;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "off")) {
    if (entry.path().extension() == ".off") ids.push_back(std::stoi(entry.path().stem().string()));
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

Result<PsbModel> read_psb(const std::filesystem::path& folder, int id) {
  const std::string name = std::to_string(id);
  auto file = read_mesh(folder / "off" / (name + ".off"));
  if (!file) return forward_error(file);
  PsbModel model{id, category_of(id), {}, std::move(file->soup.positions), {}};
  model.mesh = build_corner_table(file->soup.triangles, static_cast<std::uint32_t>(model.positions.size()));
  for (const auto& entry : std::filesystem::directory_iterator(folder / "seg" / name)) {
    auto labels = read_labels(entry.path(), model.mesh.triangle_count());
    if (!labels) return forward_error(labels);
    model.humans.push_back(std::move(*labels));
  }
  return model;
}

}  // namespace selvage::bench
