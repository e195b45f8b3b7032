// SPDX-License-Identifier: MIT
//
// selvage-pack: makes packs and looks into them.
#include <cstdio>
#include <map>
#include <string>

#include <CLI/CLI.hpp>

#include "server/app/build_command.h"
#include "server/app/inspect_command.h"

namespace {

using selvage::BuildCommand;
using selvage::InspectCommand;

void add_segmentation_options(CLI::App& build, selvage::SegmentOptions& segment) {
  const std::map<std::string, selvage::SegmentMode> modes = {{"classic", selvage::SegmentMode::Classic},
                                                             {"zhang", selvage::SegmentMode::Zhang}};
  const char* group = "Segmentation";
  build
      .add_option("--mode", segment.mode,
                  "how parts are found: classic (curvature and concaveness), zhang (curvature alone)")
      ->transform(CLI::CheckedTransformer(modes, CLI::ignore_case))
      ->default_str("classic")
      ->group(group);
  build
      .add_option("--xmr", segment.xmr_rings,
                  "classic: rings of the neighbourhood that curvature is taken on")
      ->check(CLI::Range(1, 5))
      ->capture_default_str()
      ->group(group);
  build
      .add_option("--min-region", segment.min_region_vertices,
                  "merge regions with fewer vertices; 0: 1 % of the model")
      ->capture_default_str()
      ->group(group);
  build
      .add_option("--curvature-factor", segment.thresholds.curvature_factor,
                  "classic: plateau below this share of the lowest curvature")
      ->capture_default_str()
      ->group(group);
  build
      .add_option("--distance-factor", segment.thresholds.distance_factor,
                  "classic: plateau below this share of the deepest concavity")
      ->capture_default_str()
      ->group(group);
  build.add_flag("--prune", segment.prune_branches, "classic: prune branches before regularisation")
      ->group(group);
}

void add_build(CLI::App& app, BuildCommand& command) {
  CLI::App& build = *app.add_subcommand("build", "Segment and encode a mesh into a pack");
  build.add_option("MODEL", command.model, "mesh: .ply .obj .off .stl .wrl .om")->required();
  auto* pack = build.add_option("-o,--output", command.pack,
                                "the pack to write (default: MODEL's name with .selvage)");
  build.add_option("--store", command.store, "put the pack into this folder, which a server serves")
      ->excludes(pack)
      ->check(CLI::ExistingDirectory);
  build.add_flag("--lossless", command.lossless, "keep float32 positions bit for bit");
  build.add_option("--bits", command.bits, "grid planes along the longest side: 2^bits")
      ->check(CLI::Range(8, 24))
      ->capture_default_str();
  build.add_option("--name", command.name, "the model's name for people (default: MODEL's name)");
  build.add_option("--units", command.units, "what one unit of the model is, for instance mm");
  build.add_option("--meta", command.metadata, "key and value that travel with the model; may be repeated");
  build.add_option("--threads", command.threads, "0: all cores; the pack is the same for any number")
      ->capture_default_str();
  build.add_flag("--json", command.json, "print the result as JSON");
  add_segmentation_options(build, command.segment);
  build.footer(
      "Examples:\n"
      "  selvage-pack build bunny.ply\n"
      "  selvage-pack build engine.stl --store packs --bits 16 --units mm --meta author 'R. Roe'\n"
      "  selvage-pack build statue.obj -o statue.selvage --xmr 5 --json");
}

void add_inspect(CLI::App& app, InspectCommand& command) {
  CLI::App& inspect = *app.add_subcommand("inspect", "Say what a pack holds and where its bytes go");
  inspect.add_option("PACK", command.pack, "a .selvage file")->required();
  inspect.add_flag("--json", command.json, "print as JSON");
  inspect.footer("Example:\n  selvage-pack inspect bunny.selvage");
}

int finish(const selvage::Result<void>& result) {
  if (result) return 0;
  std::fprintf(stderr, "selvage-pack: %s\n", result.error().to_string().c_str());
  return result.error().code == selvage::ErrorCode::Cancelled ? 130 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Makes selvage packs: models in regions that stream and decode one by one.", "selvage-pack");
  app.set_version_flag("--version", SELVAGE_VERSION);
  app.require_subcommand(1);
  BuildCommand build;
  InspectCommand inspect;
  add_build(app, build);
  add_inspect(app, inspect);
  CLI11_PARSE(app, argc, argv);
  return finish(app.got_subcommand("build") ? run(build) : run(inspect));
}
