// SPDX-License-Identifier: MIT
//
// selvage-pack: makes packs and looks into them.
#include <cstdio>
#include <map>
#include <string>

#include <CLI/CLI.hpp>

#include "common/app/cut_options.h"
#include "server/app/build_command.h"
#include "server/app/inspect_command.h"
#include "server/app/sample_command.h"
#include "server/app/segment_command.h"
#include "server/app/simplify_command.h"

namespace {

using selvage::BuildCommand;
using selvage::InspectCommand;
using selvage::SampleCommand;
using selvage::SegmentCommand;
using selvage::SimplifyCommand;

void add_build(CLI::App& app, BuildCommand& command) {
  CLI::App& build = *app.add_subcommand("build", "Segment and encode a mesh into a pack");
  auto* pack = build.add_option("-o,--output", command.pack,
                                "the pack to write (default: MODEL's name with .selvage)");
  build.add_option("--store", command.store, "put the pack into this folder, which a server serves")
      ->excludes(pack)
      ->check(CLI::ExistingDirectory);
  build.add_flag("--lossless", command.lossless, "keep float32 positions bit for bit");
  build.add_option("--bits", command.bits, "grid planes along the longest side: 2^bits")
      ->check(CLI::Range(8, 24))
      ->capture_default_str();
  selvage::add_level_options(build, command.levels, command.level_ratios, command.level_errors);
  build.add_option("--name", command.name, "the model's name for people (default: MODEL's name)");
  build.add_option("--units", command.units, "what one unit of the model is, for instance mm");
  build.add_option("--meta", command.metadata, "key and value that travel with the model; may be repeated");
  build.add_option("--threads", command.threads, "0: all cores; the pack is the same for any number")
      ->capture_default_str();
  build.add_flag("--json", command.json, "print the result as JSON");
  command.segmentation.add_to(build);
  build.footer(
      "Examples:\n"
      "  selvage-pack build bunny.ply\n"
      "  selvage-pack build engine.stl --store packs --bits 16 --units mm --meta author 'R. Roe'\n"
      "  selvage-pack build statue.obj -o statue.selvage --regions 12\n"
      "  selvage-pack build fandisk.off --mode cad --max-region 2000\n"
      "  selvage-pack build statue.obj --level-ratios 0.3,0.1,0.02\n"
      "  selvage-pack build engine.stl --level-errors 0.05,0.5\n"
      "  selvage-pack build scan.ply --min-region 500 --max-region 20000 --smooth --json\n"
      "  selvage-pack build car.obj --segment-by groups      then: selvage-client unpack car.selvage "
      "--regions "
      "wheel_left -o wheel.ply\n"
      "  selvage-pack build horse.off --segment-by labels horse.seg");
}

void add_segment(CLI::App& app, SegmentCommand& command) {
  using selvage::SegmentFormat;
  const std::map<std::string, SegmentFormat> formats = {
      {"seg", SegmentFormat::Seg}, {"ply", SegmentFormat::Ply}, {"json", SegmentFormat::Json}};
  const std::map<std::string, selvage::UpAxis> axes = {{"y", selvage::UpAxis::Y}, {"z", selvage::UpAxis::Z}};
  CLI::App& segment = *app.add_subcommand("segment", "Write a mesh's regions, without making a pack");
  segment.add_option("-o,--output", command.output, "one region number a triangle, in the file's order");
  auto* format =
      segment
          .add_option("--format", command.format,
                      "seg: a number a line; ply: the mesh in the regions' colours; json: numbers, names and "
                      "counts (default: what the extension of OUT says, else seg)")
          ->transform(CLI::CheckedTransformer(formats, CLI::ignore_case));
  segment
      .add_flag_callback(
          "--ply", [&command] { command.format = SegmentFormat::Ply; }, "the same as --format ply")
      ->excludes(format);
  segment.add_option("--png", command.png, "draw the regions from several sides, borders in black");
  segment.add_option("--up", command.up, "the axis that points up in pictures")
      ->transform(CLI::CheckedTransformer(axes, CLI::ignore_case))
      ->default_str("y");
  segment.add_option("--size", command.size, "pixels of one picture's width")
      ->check(CLI::Range(64, 4096))
      ->capture_default_str();
  segment.add_flag("--streaming", command.streaming,
                   "the regions that build makes, which are sized for streaming on models above 20,000 "
                   "triangles; without it, as many as the shape has");
  segment.add_flag("--hierarchy", command.hierarchy,
                   "print every merge of regions with its saliency (xmrg, cad)");
  segment.add_option("--threads", command.threads, "0: all cores; the regions are the same for any number")
      ->capture_default_str();
  segment.add_flag("--json", command.json, "print the result as JSON");
  command.segmentation.add_to(segment);
  segment.footer(
      "Polygons count as the triangles of their fan. A triangle between regions takes the region that two of "
      "its\n"
      "corners share; one that repeats a vertex takes its predecessor's.\n"
      "Examples:\n"
      "  selvage-pack segment horse.off -o horse.seg\n"
      "  selvage-pack segment horse.off -o horse.ply --png horse.png --regions 12\n"
      "  selvage-pack segment scan.ply --streaming --png scan.png\n"
      "  selvage-pack segment fandisk.off --mode cad --png fandisk.png --up z\n"
      "  selvage-pack segment car.obj --segment-by groups -o car.json\n"
      "  selvage-pack segment horse.off --hierarchy");
}

void add_inspect(CLI::App& app, InspectCommand& command) {
  CLI::App& inspect = *app.add_subcommand("inspect", "Say what a pack holds and where its bytes go");
  inspect.add_option("PACK", command.pack, "a .selvage file")->required();
  inspect.add_flag("--json", command.json, "print as JSON");
  inspect.footer("Example:\n  selvage-pack inspect bunny.selvage");
}

void add_sample(CLI::App& app, SampleCommand& command) {
  CLI::App& sample =
      *app.add_subcommand("sample", "Write a model that selvage generates itself, to try things with");
  sample.add_option("NAME", command.name, "which; without it, list what there is");
  sample.add_option("-o,--output", command.output, "the mesh to write (default: NAME.ply)");
  sample.add_option("--triangles", command.triangles, "about so many; 0: the sample's own default")
      ->capture_default_str();
  sample.footer(
      "Examples:\n  selvage-pack sample\n  selvage-pack sample waterneck --triangles 400000 -o big.ply");
}

void add_simplify(CLI::App& app, SimplifyCommand& command) {
  using selvage::CollapseCost;
  using selvage::FlipTest;
  const std::map<std::string, CollapseCost> costs = {
      {"md", CollapseCost::PlaneDistance}, {"ea", CollapseCost::EdgeArea}, {"qem", CollapseCost::Quadric}};
  const std::map<std::string, FlipTest> flips = {{"normal", FlipTest::Normal},
                                                 {"concave", FlipTest::Concave}};
  CLI::App& simplify = *app.add_subcommand("simplify", "Write a mesh with fewer triangles");
  simplify.add_option("MODEL", command.model, "mesh: .ply .obj .off .stl .wrl .om")->required();
  simplify.add_option("-o,--output", command.output, "the mesh to write; the extension names the format")
      ->required();
  CLI::Option_group& limit = *simplify.add_option_group("How far", "At least one; the first one met ends it");
  limit.add_option("--ratio", command.ratio, "share of the triangles to keep")->check(CLI::Range(0.0, 1.0));
  limit.add_option("--triangles", command.triangles, "triangles to keep");
  limit.add_option("--error", command.error, "largest deviation of a removed vertex, in units of the model")
      ->check(CLI::NonNegativeNumber);
  limit.require_option(1, 3);
  simplify
      .add_option("--cost", command.options.cost,
                  "what goes first: md (plane distance, gated by deviation), ea (edge curvature and area "
                  "change), qem (quadrics); the last two for comparison")
      ->transform(CLI::CheckedTransformer(costs, CLI::ignore_case))
      ->option_text("md|ea|qem [md]");
  simplify
      .add_option("--flip", command.options.flip,
                  "how turned triangles are prevented: normal, or concave, the usual one of ea")
      ->transform(CLI::CheckedTransformer(flips, CLI::ignore_case))
      ->option_text("normal|concave");
  simplify.add_flag("--json", command.json, "print the result as JSON");
  simplify.footer(
      "Non-manifold places stay as they are. Vertices that are kept keep their coordinates and their order.\n"
      "Examples:\n"
      "  selvage-pack simplify bunny.ply --ratio 0.1 -o bunny_10.ply\n"
      "  selvage-pack simplify engine.stl --error 0.05 -o engine_coarse.stl --json\n"
      "  selvage-pack simplify cow.obj --triangles 500 --cost ea -o cow_500.obj");
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
  SegmentCommand segment;
  InspectCommand inspect;
  SimplifyCommand simplify;
  SampleCommand sample;
  add_build(app, build);
  add_segment(app, segment);
  add_inspect(app, inspect);
  add_sample(app, sample);
  add_simplify(app, simplify);
  CLI11_PARSE(app, argc, argv);
  if (app.got_subcommand("build")) return finish(run(build));
  if (app.got_subcommand("segment")) return finish(run(segment));
  if (app.got_subcommand("inspect")) return finish(run(inspect));
  if (app.got_subcommand("sample")) return finish(run(sample));
  return finish(run(simplify));
}
