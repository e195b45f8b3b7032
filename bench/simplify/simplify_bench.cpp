// SPDX-License-Identifier: MIT
//
// How near does the simplified surface stay, in what time and memory, against other simplifiers in the same
// run?
//
//   simplify_bench MODEL...                      at a tenth of the triangles
//   simplify_bench --ratio 0.05 --ratio 0.2 MODEL...
//   simplify_bench --only md,meshopt MODEL...
//   simplify_bench --table31 horse.ply bunny.ply dodge.ply spider.ply cow.obj beethoven.ply
//   simplify_bench --special                     (Fig. 3.17 and 3.18: a lamp with an open shade, a box with a
//                                                 handle)
//   simplify_bench --curve bunny.ply --plot fig316.png > fig316.tsv
//                                                (dissertation Fig. 3.16: error over resolution)
//
// CPU times are the least of three runs; memory is what the heap holds at most beyond the input. Distances
// are two-sided, in % of the diagonal (metro.h). "x md" is md's figure over the other's, its geometric mean
// last.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "bench/simplify/error_plot.h"
#include "bench/simplify/figures.h"
#include "bench/simplify/metro.h"
#include "bench/simplify/peers.h"
#include "common/render/png.h"
#include "tests/simplify/simplify_support.h"

namespace selvage::bench {
namespace {

struct Command {
  std::vector<double> ratios;
  std::vector<std::string> models;
  std::string only, plot;
  bool table31 = false, curve = false, special = false;
};

std::vector<Simplifier> chosen(const Command& command) {
  std::vector<Simplifier> simplifiers = all_simplifiers();
  if (!command.only.empty()) {
    std::erase_if(simplifiers, [&](const Simplifier& s) {
      return ("," + command.only + ",").find("," + s.name + ",") == std::string::npos;
    });
  }
  return simplifiers;
}

void compare(const Command& command, const std::vector<BenchMesh>& meshes, double ratio) {
  const std::vector<Simplifier> simplifiers = chosen(command);
  std::map<std::string, Ratios> over;
  std::printf("at %g of the triangles\n%-16s %-9s %9s %11s %9s %9s %8s\n", ratio, "model", "by", "triangles",
              "hausdorff %", "mean %", "CPU s", "MiB");
  for (const BenchMesh& mesh : meshes) {
    Figures first;
    for (const Simplifier& simplifier : simplifiers) {
      const Figures f = measure(simplifier, mesh, ratio);
      std::printf("%-16s %-9s %9zu %11.4f %9.5f %9.4f %8.2f\n", mesh.name.c_str(), simplifier.name.c_str(),
                  f.triangles, f.hausdorff, f.mean, f.seconds, f.megabytes);
      std::fflush(stdout);
      if (&simplifier == &simplifiers.front()) first = f;
      over[simplifier.name].add(first, f);
    }
  }
  std::printf("\ngeometric mean of %s over the other\n", simplifiers.front().name.c_str());
  for (const Simplifier& simplifier : simplifiers) {
    const Figures r = over[simplifier.name].mean();
    std::printf("%-16s hausdorff %5.2f  mean %5.2f  CPU %6.2f  memory %5.2f\n", simplifier.name.c_str(),
                r.hausdorff, r.mean, r.seconds, r.megabytes);
  }
  std::printf("\n");
}

/// What the dissertation printed: seconds on a Pentium III at 733 MHz, models taken down to nothing.
struct Published {
  double qslim, pr, ea;
};
const std::map<std::string, Published> kTable31 = {
    {"horse", {12.125, 11.487, 14.688}}, {"bunny", {7.547, 6.953, 9.525}},
    {"dodge", {1.891, 1.587, 2.657}},    {"spider", {0.992, 0.886, 1.448}},
    {"cow", {0.638, 0.565, 0.893}},      {"beethoven", {0.562, 0.519, 0.786}},
};

void print_table31(const std::vector<BenchMesh>& meshes) {
  std::printf("Table 3.1, seconds to the fewest triangles; published: PIII 733 MHz; ours: this machine\n");
  std::printf("%-12s %8s %8s | %8s %8s %8s | %8s %8s %8s %8s | EA/PR published, ours\n", "model", "vertices",
              "faces", "QSlim", "PR", "EA", "qem", "PR", "EA", "md");
  for (const BenchMesh& mesh : meshes) {
    const auto published = kTable31.find(mesh.name.substr(0, mesh.name.find('.')));
    if (published == kTable31.end()) continue;
    std::map<std::string, double> seconds;
    for (const Simplifier& simplifier : all_simplifiers()) {
      for (int repeat = 0; repeat < 3; ++repeat) {
        const double s = simplifier.run(mesh, 0).seconds;
        double& least = seconds[simplifier.name];
        least = repeat == 0 ? s : std::min(least, s);
      }
    }
    const auto& [qslim, pr, ea] = published->second;
    std::printf("%-12s %8zu %8zu | %8.3f %8.3f %8.3f | %8.3f %8.3f %8.3f %8.3f | %.2f, %.2f\n",
                published->first.c_str(), mesh.soup.positions.size(), mesh.soup.triangles.size(), qslim, pr,
                ea, seconds["qem"], seconds["melax"], seconds["ea"], seconds["md"], ea / pr,
                seconds["ea"] / seconds["melax"]);
  }
}

bool print_curve(const Command& command, const BenchMesh& mesh) {
  const std::vector<Simplifier> simplifiers = chosen(command);
  const std::vector<double> percents = {80, 60, 40, 20, 10, 5, 2, 1};
  std::vector<ErrorCurve> curves;
  std::printf("percent");
  for (const Simplifier& simplifier : simplifiers) {
    std::printf("\t%s", simplifier.name.c_str());
    curves.push_back({simplifier.name, {}});
  }
  std::printf("\n");
  for (const double percent : percents) {
    std::printf("%g", percent);
    for (std::size_t i = 0; i < simplifiers.size(); ++i) {
      curves[i].error.push_back(measure(simplifiers[i], mesh, percent / 100, 1).hausdorff);
      std::printf("\t%.4f", curves[i].error.back());
    }
    std::printf("\n");
    std::fflush(stdout);
  }
  if (command.plot.empty()) return true;
  const auto written = write_png(command.plot, plot_errors(mesh.name, percents, curves));
  if (!written) std::fprintf(stderr, "%s\n", written.error().to_string().c_str());
  return written.has_value();
}

/// What each makes of shapes with a thin handle and with an open sheet at a thirtieth of the triangles.
void print_special() {
  for (const auto& [name, soup] :
       {std::pair("lamp", lamp(48)), std::pair("box with handle", box_with_handle())}) {
    const auto count = static_cast<std::uint32_t>(soup.positions.size());
    const BenchMesh mesh{name, build_corner_table(soup.triangles, count), soup};
    const Topology input = topology_of(soup.triangles, count);
    for (const Simplifier& simplifier : all_simplifiers()) {
      const TriangleSoup coarse = simplifier.run(mesh, soup.triangles.size() / 30).soup;
      const bool is_manifold = manifold_violation(coarse.triangles, count).empty();
      const bool is_same = is_manifold && topology_of(coarse.triangles, count) == input;
      const SurfaceDistance distance = surface_distance(soup, coarse);
      std::printf("%-16s %-9s %5zu of %zu triangles, hausdorff %8.4f %%, %s\n", name, simplifier.name.c_str(),
                  coarse.triangles.size(), soup.triangles.size(), 100 * distance.largest / diagonal_of(soup),
                  is_same       ? "topology kept"
                  : is_manifold ? "topology changed"
                                : "not a manifold");
    }
  }
}

int run(const Command& command) {
  if (command.special) return print_special(), 0;
  std::vector<BenchMesh> meshes;
  for (const std::string& path : command.models) {
    BenchMesh mesh;
    if (!load(path, mesh)) return 1;
    meshes.push_back(std::move(mesh));
  }
  if (command.table31) return print_table31(meshes), 0;
  if (command.curve) {
    for (const BenchMesh& mesh : meshes) {
      if (!print_curve(command, mesh)) return 1;
    }
    return 0;
  }
  for (const double ratio : command.ratios) compare(command, meshes, ratio);
  return 0;
}

}  // namespace
}  // namespace selvage::bench

int main(int argc, char** argv) {
  selvage::bench::Command command;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--ratio" && i + 1 < argc) {
      command.ratios.push_back(std::stod(argv[++i]));
    } else if (argument == "--only" && i + 1 < argc) {
      command.only = argv[++i];
    } else if (argument == "--plot" && i + 1 < argc) {
      command.plot = argv[++i];
    } else if (argument == "--table31") {
      command.table31 = true;
    } else if (argument == "--special") {
      command.special = true;
    } else if (argument == "--curve") {
      command.curve = true;
    } else {
      command.models.push_back(argument);
    }
  }
  if (command.ratios.empty()) command.ratios.push_back(0.1);
  if (command.models.empty() && !command.special)
    return std::fprintf(stderr, "usage: see the top of simplify_bench.cpp\n"), 2;
  return selvage::bench::run(command);
}
