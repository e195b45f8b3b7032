// SPDX-License-Identifier: MIT
//
// How near is each mode to human segmentations?
//
//   psb_bench DIR                      Rand error by category for every mode, beside the humans' own
//   psb_bench DIR --all                also Hamming distance and cut discrepancy
//   psb_bench DIR --modes xmrg,classic --set tau=0.02 --set stop=0.2
//   psb_bench DIR --modes xmrg --models   a line a model
//
// DIR is a folder of the Princeton Segmentation Benchmark (psb.h). A model's score is its mean over all
// humans, a category's the mean of its models, the last line the mean of the categories.
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bench/segment/modes.h"
#include "bench/segment/psb.h"
#include "bench/segment/scores.h"
#include "server/segment/check_partition.h"
#include "server/segment/triangle_labels.h"

namespace selvage::bench {
namespace {

constexpr int kMeasures = 3;
constexpr std::array<const char*, kMeasures> kMeasureNames = {"Rand error", "Hamming distance",
                                                              "cut discrepancy"};
using Scores = std::array<double, kMeasures>;

struct Cell {
  Scores sum{};
  int models = 0;
  double mean(int measure) const { return models > 0 ? sum[measure] / models : 0; }
};

struct Command {
  std::filesystem::path folder;
  std::vector<Mode> modes;
  bool measure_all = false, print_models = false;
};

Scores score(const PsbModel& model, const CutDiscrepancy* cuts, const Labels& labels,
             const Labels* left_out) {
  Scores sum{};
  int count = 0;
  for (const Labels& human : model.humans) {
    if (&human == left_out) continue;
    sum[0] += rand_error(labels, human);
    if (cuts != nullptr) {
      sum[1] += hamming_distance(labels, human);
      sum[2] += cuts->between(labels, human);
    }
    ++count;
  }
  for (double& s : sum) s /= std::max(count, 1);
  return sum;
}

Scores score_humans(const PsbModel& model, const CutDiscrepancy* cuts) {
  Scores sum{};
  for (const Labels& human : model.humans) {
    const Scores one = score(model, cuts, human, &human);
    for (int m = 0; m < kMeasures; ++m) sum[m] += one[m] / static_cast<double>(model.humans.size());
  }
  return sum;
}

class Table {
 public:
  explicit Table(const Command& command) : command_(command) {}

  void run() {
    const std::vector<int> ids = list_psb(command_.folder);
    threaded_for(0)(ids.size(), [&](std::size_t i) { run_model(ids[i]); });
    for (int measure = 0; measure < (command_.measure_all ? kMeasures : 1); ++measure) print(measure);
    std::printf("\nloose vertices %.4f %%, violations %d\n", 100.0 * loose_ / std::max(1.0, vertices_),
                violations_);
    for (const auto& [mode, seconds] : seconds_) {
      std::printf("%-10s %7.1f ms per 100k triangles\n", mode.c_str(), 1e8 * seconds / triangles_);
    }
  }

 private:
  void run_model(int id) {
    const auto model = read_psb(command_.folder, id);
    if (!model) std::fprintf(stderr, "%s\n", model.error().to_string().c_str()), std::exit(1);
    const CutDiscrepancy cuts(model->mesh, model->positions);
    const CutDiscrepancy* use_cuts = command_.measure_all ? &cuts : nullptr;
    add(*model, "humans", score_humans(*model, use_cuts));
    add(*model, "one", score(*model, use_cuts, Labels(model->mesh.triangle_count(), 0), nullptr));
    for (const Mode& mode : command_.modes) {
      const SegmentOptions options = mode.for_triangles(model->mesh.triangle_count());
      const auto start = std::chrono::steady_clock::now();
      const Segmentation result = segment(model->mesh, model->positions, options, serial_for());
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
      const Scores scores = score(*model, use_cuts, regions_of_triangles(model->mesh, result), nullptr);
      add(*model, mode.name, scores);
      note(*model, mode, result, taken.count(), scores[0]);
    }
    const std::lock_guard lock(mutex_);
    triangles_ += model->mesh.triangle_count();
  }

  void add(const PsbModel& model, const std::string& mode, const Scores& scores) {
    const std::lock_guard lock(mutex_);
    Cell& cell = cells_[model.category][mode];
    for (int m = 0; m < kMeasures; ++m) cell.sum[m] += scores[m];
    ++cell.models;
  }

  void note(const PsbModel& model, const Mode& mode, const Segmentation& result, double seconds,
            double rand) {
    const auto partition = make_partition(model.mesh, result.region_of_vertex, result.region_count);
    const bool holds = check_partition(model.mesh, partition).has_value();
    const std::lock_guard lock(mutex_);
    seconds_[mode.name] += seconds;
    loose_ += result.loose_vertex_count;
    vertices_ += model.mesh.vertex_count();
    violations_ += !holds;
    if (!command_.print_models) return;
    std::printf("%4d %-10s %-10s %4u regions, Rand error %.4f\n", model.id, model.category.c_str(),
                mode.name.c_str(), result.region_count, rand);
  }

  void print(int measure) const {
    std::vector<std::string> columns = {"humans", "one"};
    for (const Mode& mode : command_.modes) columns.push_back(mode.name);
    std::printf("\n%-12s", kMeasureNames[measure]);
    for (const std::string& column : columns) std::printf("%11s", column.c_str());
    std::map<std::string, double> sum;
    for (const auto& [category, cells] : cells_) {
      std::printf("\n%-12s", category.c_str());
      for (const std::string& column : columns) {
        const double mean = cells.at(column).mean(measure);
        std::printf("%11.4f", mean);
        sum[column] += mean;
      }
    }
    std::printf("\n%-12s", "mean");
    for (const std::string& column : columns)
      std::printf("%11.4f", sum[column] / static_cast<double>(cells_.size()));
    std::printf("\n");
  }

  const Command& command_;
  std::mutex mutex_;
  std::map<std::string, std::map<std::string, Cell>> cells_;  // by category, by mode
  std::map<std::string, double> seconds_;
  double triangles_ = 0, loose_ = 0, vertices_ = 0;
  int violations_ = 0;
};

int usage() {
  std::fprintf(stderr, "usage: psb_bench DIR [--all] [--models] [--modes a,b] [--set name=value]...\n");
  return 2;
}

int run(int argc, char** argv) {
  Command command;
  std::string modes;
  std::vector<std::string> settings;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--all")
      command.measure_all = true;
    else if (argument == "--models")
      command.print_models = true;
    else if (argument == "--modes" && i + 1 < argc)
      modes = argv[++i];
    else if (argument == "--set" && i + 1 < argc)
      settings.push_back(argv[++i]);
    else if (command.folder.empty() && !argument.starts_with("-"))
      command.folder = argument;
    else
      return usage();
  }
  if (command.folder.empty()) return usage();
  command.modes = chosen_modes(modes);
  if (!apply_settings(command.modes, settings)) return usage();
  Table(command).run();
  return 0;
}

}  // namespace
}  // namespace selvage::bench

int main(int argc, char** argv) { return selvage::bench::run(argc, argv); }
