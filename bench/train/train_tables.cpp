// SPDX-License-Identifier: MIT
//
// Regenerates the codec's constants:
//   build/release/bin/train_tables FOLDER... --exclude REGEX > common/codec/trained_tables.inc
// The same folders and the same tables before give the same file: where regions take lists of values depends
// on the latter, so new kinds of symbols want two rounds. Archives among them have to be unpacked first.
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "bench/train/trainer.h"

int main(int argc, char** argv) {
  CLI::App app{"Trains the codec's tables on every mesh under some folders"};
  std::vector<std::filesystem::path> folders;
  std::string excluded;
  app.add_option("folders", folders, "folders of meshes")->required();
  app.add_option("--exclude", excluded, "regular expression of names to leave out");
  CLI11_PARSE(app, argc, argv);
  const auto models = selvage::bench::read_models(folders, excluded);
  std::vector<const selvage::bench::Model*> all;
  for (const auto& model : models) all.push_back(&model);
  std::fprintf(stderr, "training on %zu models\n", all.size());
  std::fputs(selvage::bench::to_source(selvage::bench::train(all)).c_str(), stdout);
}
