// SPDX-License-Identifier: MIT
//
// selvage-client: asks servers for regions, decodes and stitches them, and looks at packs.
#include <cstdio>

#include <CLI/CLI.hpp>

#include "client/app/compare_command.h"
#include "client/app/unpack_command.h"
#include "client/app/verify_command.h"

namespace {

using namespace selvage;

void add(CLI::App& app, UnpackCommand& command) {
  CLI::App& unpack =
      *app.add_subcommand("unpack", "Decode regions straight from a pack and write them as one mesh");
  unpack.add_option("PACK", command.pack, "a .selvage file")->required();
  unpack.add_option("-o,--output", command.output, "the mesh to write: .ply .obj .off .stl .om")->required();
  unpack.add_option("--threads", command.threads, "0: all cores")->capture_default_str();
  command.selection.add_to(unpack);
  unpack.footer(
      "Examples:\n"
      "  selvage-client unpack bunny.selvage -o bunny.ply\n"
      "  selvage-client unpack bunny.selvage --regions 3,5-7 -o ears.obj\n"
      "  selvage-client unpack site.selvage --box 0,0,0,10,10,3 --joins none -o room.stl");
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

/// 0 done, 1 failed or different, as the command says.
template <class Command>
int finish(const Command& command) {
  auto result = run(command);
  if (!result) {
    std::fprintf(stderr, "selvage-client: %s\n", result.error().to_string().c_str());
    return 2;
  }
  if constexpr (std::is_same_v<decltype(result), Result<bool>>) return *result ? 0 : 1;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Fetches, decodes and stitches regions of selvage models.", "selvage-client");
  app.set_version_flag("--version", SELVAGE_VERSION);
  app.require_subcommand(1);
  UnpackCommand unpack;
  VerifyCommand verify;
  CompareCommand compare;
  add(app, unpack);
  add(app, verify);
  add(app, compare);
  CLI11_PARSE(app, argc, argv);
  if (app.got_subcommand("unpack")) return finish(unpack);
  if (app.got_subcommand("verify")) return finish(verify);
  return finish(compare);
}
