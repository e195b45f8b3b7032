// SPDX-License-Identifier: MIT
//
// Clients that share a cache without knowing of each other.
#include "server/ingest/ingest.h"
#include "tests/operate/process_fixture.h"
#include "tests/support/mesh_text.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

using testing::ChildProcess;
using testing::quoted;
using testing::run_program;

class SharedCache : public ProcessFixture {};

/// Larger than the cache may be, so that they also throw out what the others are about to read.
TEST_F(SharedCache, ServesProcessesAtTheSameTime) {
  const TriangleSoup soup = shapes::torus(200, 250);
  for (const std::string name : {"ring", "band"}) {
    const auto model = ingest(soup, {.name = name, .bits = name == "ring" ? 24 : 23}, serial_for(),
                              [](const std::string&, double) { return true; });
    ASSERT_TRUE(model) << model.error().message;
    std::ofstream(store() / (name + ".selvage"), std::ios::binary)
        .write(reinterpret_cast<const char*>(model->pack.data()),
               static_cast<std::streamsize>(model->pack.size()));
  }
  const std::string original = file("original.obj", obj_text(soup));
  const auto server = start_on_store();
  const std::string at = server->address().to_string(), cache = (folder.path() / "cache").string();
  for (int round = 0; round < 3; ++round) {
    std::vector<std::unique_ptr<ChildProcess>> clients;
    std::vector<std::string> outputs;
    for (const std::string name : {"ring", "band", "ring", "band"}) {
      const std::string number = std::to_string(clients.size());
      outputs.push_back((folder.path() / (number + ".ply")).string());
      const std::vector<std::string> arguments = {
          "get", at + "/" + name, "--cache", cache, "--cache-size", "1", "-o", outputs.back()};
      clients.push_back(std::make_unique<ChildProcess>(SELVAGE_CLIENT, arguments, folder.path() / number));
    }
    for (const auto& client : clients) EXPECT_EQ(client->end(0), 0) << client->log();
    for (const std::string& output : outputs) {
      const auto same =
          run_program(quoted(SELVAGE_CLIENT) + " compare " + quoted(original) + ' ' + quoted(output));
      EXPECT_EQ(same.code, 0) << same.text;
    }
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(cache))
    EXPECT_FALSE(entry.path().filename().string().starts_with(".tmp")) << entry.path();
}

}  // namespace
}  // namespace selvage
