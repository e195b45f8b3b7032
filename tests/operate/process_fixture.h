// SPDX-License-Identifier: MIT
#pragma once

#include <fstream>
#include <memory>

#include <gtest/gtest.h>

#include "server/ingest/ingest.h"
#include "tests/support/server_process.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace selvage {

/// A folder with a store in it, and servers on that.
class ProcessFixture : public ::testing::Test {
 protected:
  ProcessFixture() { std::filesystem::create_directory(store()); }

  std::filesystem::path store() const { return folder.path() / "store"; }
  std::string file(const std::string& name, const std::string& text) const {
    const auto path = folder.path() / name;
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }
  std::unique_ptr<testing::ServerProcess> start(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--listen", "127.0.0.1:0"});
    return std::make_unique<testing::ServerProcess>(SELVAGE_SERVER, std::move(arguments),
                                                    folder.path() / "log");
  }
  std::unique_ptr<testing::ServerProcess> start_on_store(std::vector<std::string> arguments = {}) const {
    arguments.insert(arguments.end(), {"--store", store().string()});
    return start(std::move(arguments));
  }

  /// Something of a few MiB as text, and of some tens of KiB as a pack, or more than 96 if lossless.
  static TriangleSoup ring() {
    auto soup = shapes::torus(180, 240);
    for (Vec3& at : soup.positions)
      at = {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
    return soup;
  }
  /// ring() as a model: WHERE/ring.selvage.
  static void put_ring(const std::filesystem::path& where, bool lossless = false) {
    IngestOptions options;
    options.name = "ring";
    options.lossless = lossless;
    const auto model = ingest(ring(), options, serial_for(), [](const std::string&, double) { return true; });
    std::ofstream(where / "ring.selvage", std::ios::binary)
        .write(reinterpret_cast<const char*>(model->pack.data()),
               static_cast<std::streamsize>(model->pack.size()));
  }

  /// printf %s hunter2 | sha256sum
  static constexpr const char* kModeller =
      "modeller read,publish sha256:f52fbd32b2b3b86ff88ef6c490628285f482af15ddcb29541f94bcf526a3f6c7\n";

  TempFolder folder;
};

}  // namespace selvage
