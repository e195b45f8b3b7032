// SPDX-License-Identifier: MIT
//
// Programs whose disk is full: they say so, leave no torn file behind, and go on when there is room again.
// Where no disk can be mounted, files that may not grow have to do.
#include "client/session/blocking_client.h"
#include "tests/operate/process_fixture.h"
#include "tests/support/mesh_text.h"
#include "tests/support/small_disk.h"

namespace selvage {
namespace {

using testing::ProgramOutput;
using testing::quoted;
using testing::run_program;
using testing::ServerProcess;
using testing::SmallDisk;

class FullDisk : public ProcessFixture {
 protected:
  FullDisk() { std::filesystem::create_directory(disk()); }

  /// Where a small disk is mounted.
  std::filesystem::path disk() const { return folder.path() / "disk"; }

  std::string mesh() const { return file("ring.obj", obj_text(ring())); }

  std::vector<std::string> files_on_disk() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(disk()))
      if (entry.is_regular_file()) names.push_back(entry.path().filename().string());
    return names;
  }

  static ProgramOutput run(const std::string& program, const std::vector<std::string>& arguments,
                           const std::string& before = "") {
    std::string line = before + quoted(program);
    for (const std::string& argument : arguments) line += ' ' + quoted(argument);
    return run_program(line);
  }

  std::vector<std::string> with_tokens() const {
    return {"--tokens", file("tokens", std::string(kModeller) + "anonymous read\n")};
  }
};

/// For the shell: no file grows beyond 8 KiB, and to try is an error.
const std::string kSmallFiles = "ulimit -f 16; trap '' XFSZ; exec ";

TEST_F(FullDisk, ToolsWhoseFilesMayNotGrowSayWhichAndLeaveNothing) {
  put_ring(store());
  const std::string ring = (store() / "ring.selvage").string(), model = mesh();
  struct Case {
    std::string program;
    std::vector<std::string> arguments;
    std::string output;
    int code;
  };
  const std::vector<Case> cases = {
      {SELVAGE_PACK, {"build", model, "-o"}, "ring.selvage", 1},
      {SELVAGE_PACK, {"segment", model, "-o"}, "ring.ply", 1},
      {SELVAGE_PACK, {"simplify", model, "--ratio", "0.5", "-o"}, "half.ply", 1},
      {SELVAGE_PACK, {"sample", "waterneck", "-o"}, "sample.ply", 1},
      {SELVAGE_CLIENT, {"unpack", ring, "-o"}, "ring.ply", 2},
      {SELVAGE_CLIENT, {"get", ring, "--cache", "off", "-o"}, "ring.obj", 2},
      {SELVAGE_CLIENT, {"draw", ring, "--cache", "off", "-o"}, "ring.png", 2},
  };
  for (Case made : cases) {
    const std::string output = (disk() / made.output).string();
    std::ofstream(output) << "old";
    made.arguments.push_back(output);
    const ProgramOutput said = run(made.program, made.arguments, kSmallFiles);
    EXPECT_EQ(said.code, made.code) << said.text;
    EXPECT_NE(said.text.find(output + ": cannot write: File too large"), std::string::npos) << said.text;
    EXPECT_EQ(files_on_disk(), std::vector{made.output}) << said.text;
    EXPECT_EQ(std::filesystem::file_size(output), 3u) << "the old file stays";
    std::filesystem::remove(output);
  }
}

TEST_F(FullDisk, AServerWhoseFilesMayNotGrowTellsThePublisherAndLives) {
  std::vector<std::string> arguments = {"-c",
                                        "ulimit -f 200; exec \"$0\" \"$@\"",
                                        SELVAGE_SERVER,
                                        "--store",
                                        store().string(),
                                        "--listen",
                                        "127.0.0.1:0"};
  for (const std::string& more : with_tokens()) arguments.push_back(more);
  ServerProcess server("/bin/sh", arguments, folder.path() / "log");
  const ProgramOutput said = run(SELVAGE_CLIENT, {"publish", server.address().to_string(), mesh(), "--token",
                                                  "hunter2", "--retry-for", "0"});
  EXPECT_EQ(said.code, 2) << said.text;
  EXPECT_NE(said.text.find("the server cannot keep the upload: File too large"), std::string::npos)
      << said.text;
  EXPECT_EQ(run(SELVAGE_CLIENT, {"status", server.address().to_string()}).code, 0);
  EXPECT_EQ(server.end(SIGTERM), 0);
}

TEST_F(FullDisk, BuildLeavesTheDiskAsItWas) {
  SmallDisk small(disk(), 16);
  if (!small.is_there()) GTEST_SKIP() << "nothing can be mounted here";
  const ProgramOutput said = run(SELVAGE_PACK, {"build", mesh(), "--store", disk().string()});
  EXPECT_EQ(said.code, 1);
  EXPECT_NE(said.text.find("No space left on device"), std::string::npos) << said.text;
  EXPECT_EQ(files_on_disk(), std::vector<std::string>());
  ASSERT_TRUE(small.resize(10'000));
  EXPECT_EQ(run(SELVAGE_PACK, {"build", mesh(), "--store", disk().string()}).code, 0);
}

TEST_F(FullDisk, GetDoesWithoutACacheThatIsFull) {
  put_ring(store());
  const auto server = start_on_store();
  SmallDisk small(disk(), 16);
  if (!small.is_there()) GTEST_SKIP() << "nothing can be mounted here";
  const std::string whole = (folder.path() / "ring.ply").string();
  const ProgramOutput got = run(SELVAGE_CLIENT, {"get", server->address().to_string() + "/ring", "--cache",
                                                 disk().string(), "-o", whole});
  EXPECT_EQ(got.code, 0) << got.text;
  EXPECT_EQ(run(SELVAGE_CLIENT, {"compare", mesh(), whole}).code, 0);
  for (const std::string& name : files_on_disk()) EXPECT_FALSE(name.starts_with(".tmp")) << name;
}

/// The upload does not fit, then the pack beside it does not; what was sent is of use once there is room.
TEST_F(FullDisk, AServerGoesOnAndTakesTheModelOnceThereIsRoom) {
  SmallDisk small(disk(), 1000);
  if (!small.is_there()) GTEST_SKIP() << "nothing can be mounted here";
  put_ring(disk());
  std::filesystem::rename(disk() / "ring.selvage", disk() / "other.selvage");
  std::vector<std::string> arguments = with_tokens();
  arguments.insert(arguments.end(), {"--store", disk().string()});
  const auto server = start(arguments);
  const std::string at = server->address().to_string(), model = mesh();
  const std::vector<std::string> publish = {"publish", at, model, "--token", "hunter2", "--retry-for", "0"};

  const ProgramOutput first = run(SELVAGE_CLIENT, publish);
  EXPECT_EQ(first.code, 2);
  EXPECT_NE(first.text.find("the server cannot keep the upload: No space left on device"), std::string::npos)
      << first.text;
  EXPECT_EQ(run(SELVAGE_CLIENT,
                {"get", at + "/other", "--cache", "off", "-o", (folder.path() / "other.ply").string()})
                .code,
            0);

  const std::size_t upload_kib = std::filesystem::file_size(model) / 1024;
  const std::size_t other_kib = std::filesystem::file_size(disk() / "other.selvage") / 1024;
  ASSERT_TRUE(small.resize(upload_kib + other_kib + 32));
  const ProgramOutput second = run(SELVAGE_CLIENT, publish);
  EXPECT_EQ(second.code, 2);
  EXPECT_NE(second.text.find("the server cannot keep the pack: cannot write: No space left on device"),
            std::string::npos)
      << second.text;
  EXPECT_FALSE(std::filesystem::exists(disk() / "ring.selvage"));

  ASSERT_TRUE(small.resize(100'000));
  const ProgramOutput third = run(SELVAGE_CLIENT, publish);
  EXPECT_EQ(third.code, 0) << third.text;
  auto names = files_on_disk();
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"other.selvage", "ring.selvage"})) << "uploads are gone";
  EXPECT_EQ(server->end(SIGTERM), 0);
}

}  // namespace
}  // namespace selvage
