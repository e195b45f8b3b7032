// SPDX-License-Identifier: MIT
//
// selvage-client: asks servers for regions, decodes and stitches them, and looks at packs.
#include <cstdio>
#include <map>
#include <string>

#include <CLI/CLI.hpp>

#include "client/app/compare_command.h"
#include "client/app/draw_command.h"
#include "client/app/get_command.h"
#include "client/app/list_command.h"
#include "client/app/publish_command.h"
#include "client/app/publish_cut_options.h"
#include "client/app/status_command.h"
#include "client/app/verify_command.h"

namespace {

using namespace selvage;

void add(CLI::App& app, ListCommand& command) {
  CLI::App& list = *app.add_subcommand("list", "List the models of a server");
  list.add_option("SERVER", command.server, "HOST:PORT")->required();
  list.add_flag("--json", command.json, "print as JSON");
  command.connection.add_to(list);
  list.footer("Example:\n  selvage-client list localhost:7878");
}

void add(CLI::App& app, RegionsCommand& command) {
  CLI::App& regions =
      *app.add_subcommand("regions", "List the regions of a model, and the names of its parts");
  regions.add_option("SOURCE", command.source, "HOST:PORT/MODEL, a URL, or a pack")->required();
  regions.add_flag("--json", command.json, "print as JSON");
  command.connection.add_to(regions);
  regions.footer(
      "Examples:\n  selvage-client regions localhost:7878/bunny\n  selvage-client regions bunny.selvage "
      "--json");
}

void add_output(CLI::App& command, GetCommand& get) {
  command.add_option("-o,--output", get.output, "the mesh to write: .ply .obj .off .stl .om")->required();
  command.add_flag("--json", get.json, "print counts and times as JSON");
  get.selection.add_to(command);
  get.options.add_to(command);
}

void add_get(CLI::App& app, GetCommand& command) {
  CLI::App& get = *app.add_subcommand("get", "Fetch regions from a server and write them as one mesh");
  get.add_option("SOURCE", command.source,
                 "HOST:PORT/MODEL, or http(s)://... for a pack on a web server that supports Range")
      ->required();
  add_output(get, command);
  get.footer(
      "Examples:\n"
      "  selvage-client get localhost:7878/bunny -o bunny.ply\n"
      "  selvage-client get localhost:7878/bunny --regions 3,5-7 -o ears.obj\n"
      "  selvage-client get localhost:7878/car --regions wheel_left,wheel_right -o wheels.ply\n"
      "  selvage-client get localhost:7878/site --box 0,0,0,10,10,3 --joins none -o room.stl\n"
      "  selvage-client get https://example.org/models/bunny.selvage --regions 3,5 -o ears.ply");
}

void add_unpack(CLI::App& app, GetCommand& command) {
  CLI::App& unpack = *app.add_subcommand("unpack", "The same as get, straight from a pack");
  unpack.add_option("PACK", command.source, "a .selvage file")->required()->check(CLI::ExistingFile);
  add_output(unpack, command);
  unpack.footer(
      "Examples:\n"
      "  selvage-client unpack bunny.selvage -o bunny.ply\n"
      "  selvage-client unpack bunny.selvage --regions 3,5-7 --joins none -o ears.obj");
}

void add(CLI::App& app, DrawCommand& command) {
  CLI::App& draw =
      *app.add_subcommand("draw", "Draw a model's regions, in colours and with their numbers, as a PNG");
  const std::map<std::string, UpAxis> axes = {{"y", UpAxis::Y}, {"z", UpAxis::Z}};
  draw.add_option("SOURCE", command.source, "HOST:PORT/MODEL, a URL, or a pack")->required();
  draw.add_option("-o,--output", command.output, "the picture to write")->required();
  draw.add_option("--steps", command.steps, "draw the model as it arrives, in so many pictures")
      ->check(CLI::Range(1, 100));
  draw.add_flag(
          "--levels", command.levels,
          "draw the whole model at each level of detail, at a mix of them, and a seam in it, with the edges "
          "of its triangles")
      ->excludes("--steps");
  draw.add_option("--size", command.size, "pixels of one picture's width")
      ->check(CLI::Range(64, 4096))
      ->capture_default_str();
  draw.add_option("--up", command.up, "the axis that points up")
      ->transform(CLI::CheckedTransformer(axes, CLI::ignore_case))
      ->default_str("y");
  draw.add_flag("!--no-labels", command.labels, "leave region numbers out");
  command.selection.add_to(draw);
  command.options.add_to(draw);
  draw.footer(
      "Examples:\n"
      "  selvage-client draw bunny.selvage -o bunny.png\n"
      "  selvage-client draw localhost:7878/bunny --steps 6 -o arrival.png\n"
      "  selvage-client draw localhost:7878/bunny --levels -o levels.png\n"
      "  selvage-client draw site.selvage --up z --regions 12-20 -o roof.png");
}

void add(CLI::App& app, VerifyCommand& command) {
  CLI::App& verify = *app.add_subcommand("verify", "Check every hash, decode and stitch everything");
  verify.add_option("PACK", command.pack, "a .selvage file")->required();
  verify.add_flag("--json", command.json, "print as JSON");
  verify.footer("Example:\n  selvage-client verify bunny.selvage");
}

void add(CLI::App& app, CompareCommand& command) {
  CLI::App& compare =
      *app.add_subcommand("compare", "Say whether two meshes are the same up to numbering; exit code 0 or 1");
  compare.add_option("A", command.a, "a mesh file or a pack")->required();
  compare.add_option("B", command.b, "a mesh file or a pack")->required();
  compare
      .add_option("--tolerance", command.tolerance, "model units on each axis (default: half a grid step)")
      ->check(CLI::NonNegativeNumber);
  compare.add_option("--bits", command.bits, "grid of A's box, where neither is a pack")
      ->check(CLI::Range(8, 24))
      ->capture_default_str();
  compare.add_flag("--json", command.json, "print as JSON");
  compare.footer(
      "Examples:\n"
      "  selvage-client compare bunny.ply bunny.selvage\n"
      "  selvage-client compare bunny.ply fetched.ply --bits 12");
}

void add(CLI::App& app, PublishCommand& command) {
  CLI::App& publish = *app.add_subcommand("publish", "Upload a mesh, which becomes a model of the server");
  publish.add_option("SERVER", command.server, "HOST:PORT")->required();
  publish.add_option("MODEL", command.model, "a mesh: .ply .obj .off .stl .wrl .om")->required();
  publish.add_option("--name", command.name, "of the model (default: MODEL's name)");
  publish.add_flag("--replace", command.replace,
                   "a model of that name; who has it open keeps it until he opens it again");
  publish.add_flag("--lossless", command.lossless, "keep float32 positions bit for bit");
  publish.add_option("--bits", command.bits, "grid planes along the longest side: 2^bits")
      ->check(CLI::Range(8, 24))
      ->capture_default_str();
  publish.add_option("--units", command.units, "what one unit of the model is, for instance mm");
  publish
      .add_option("--retry-for", command.retry_seconds,
                  "seconds to go on trying to connect again when a connection breaks; 0: never")
      ->check(CLI::Range(0.0, 86'400.0))
      ->capture_default_str();
  publish.add_flag("--json", command.json, "print the result as JSON");
  add_publish_cut_options(publish, command.cut);
  command.connection.add_to(publish);
  publish.footer(
      "The server must be one that grants the scope 'publish' to your token. An upload that was cut off "
      "goes\n"
      "on where it was, at once or when the same command is given again.\n"
      "Examples:\n"
      "  SELVAGE_TOKEN=$(cat token) selvage-client publish localhost:7878 bunny.ply\n"
      "  selvage-client publish models.example.org:7878 engine.stl --tls --token-file token --name engine-2 "
      "--bits 16\n"
      "  selvage-client publish localhost:7878 bunny.ply --replace --token-file token\n"
      "  selvage-client publish localhost:7878 car.obj --segment-by groups --level-ratios 0.3,0.05");
}

void add(CLI::App& app, UnpublishCommand& command) {
  CLI::App& unpublish = *app.add_subcommand("unpublish", "Take a model away from a server");
  unpublish.add_option("SERVER", command.server, "HOST:PORT")->required();
  unpublish.add_option("NAME", command.name, "of the model")->required();
  command.connection.add_to(unpublish);
  unpublish.footer(
      "Who has the model open keeps it until he opens it again.\n"
      "Example:\n  selvage-client unpublish localhost:7878 bunny --token-file token");
}

void add(CLI::App& app, StatusCommand& command) {
  CLI::App& status = *app.add_subcommand("status", "Say how a server is");
  status.add_option("SERVER", command.server, "HOST:PORT")->required();
  status.add_flag("--json", command.json, "print as JSON");
  command.connection.add_to(status);
  status.footer("Example:\n  selvage-client status localhost:7878");
}

/// The exit code; errors go to stderr.
template <class Command>
int finish(const Command& command) {
  auto result = run(command);
  if (!result) {
    std::fprintf(stderr, "selvage-client: %s\n", result.error().to_string().c_str());
    return result.error().code == ErrorCode::Cancelled ? 130 : 2;
  }
  if constexpr (std::is_same_v<decltype(result), Result<bool>>) return *result ? 0 : 1;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Fetches, decodes and stitches regions of selvage models.", "selvage-client");
  app.set_version_flag("--version", SELVAGE_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done (compare: the same), 1 different, 2 failed, 130 interrupted, 100 to 127 bad "
      "options.");
  ListCommand list;
  RegionsCommand regions;
  GetCommand get, unpack;
  DrawCommand draw;
  VerifyCommand verify;
  CompareCommand compare;
  PublishCommand publish;
  UnpublishCommand unpublish;
  StatusCommand status;
  add(app, list);
  add(app, regions);
  add_get(app, get);
  add_unpack(app, unpack);
  add(app, draw);
  add(app, verify);
  add(app, compare);
  add(app, publish);
  add(app, unpublish);
  add(app, status);
  CLI11_PARSE(app, argc, argv);
  if (app.got_subcommand("list")) return finish(list);
  if (app.got_subcommand("regions")) return finish(regions);
  if (app.got_subcommand("get")) return finish(get);
  if (app.got_subcommand("unpack")) return finish(unpack);
  if (app.got_subcommand("draw")) return finish(draw);
  if (app.got_subcommand("verify")) return finish(verify);
  if (app.got_subcommand("publish")) return finish(publish);
  if (app.got_subcommand("unpublish")) return finish(unpublish);
  if (app.got_subcommand("status")) return finish(status);
  return finish(compare);
}
