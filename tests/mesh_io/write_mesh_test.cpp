// SPDX-License-Identifier: MIT
#include "common/mesh_io/write_mesh.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <sys/resource.h>
#include <unistd.h>

#include "common/mesh_io/read_mesh.h"
#include "tests/mesh_io/support.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test, with a space in its name.
class Files : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("selvage mesh_io " + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name, std::string_view content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }
  static std::string content_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::size_t file_count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  static void expect_failure(const Result<MeshFile>& result, ErrorCode code, const std::string& message) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, code);
    EXPECT_NE(result.error().message.find(message), std::string::npos) << result.error().message;
  }

  fs::path folder_;
};

using WriteMesh = Files;
using ReadMesh = Files;

/// Makes writes fail beyond `bytes`, as a full disk would, until it goes out of scope.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

/// The volatile is for g++ 12, which from -O2 on folds double -> float -> double of neighbouring values away.
double as_float(double value) {
  const volatile float rounded = static_cast<float>(value);
  return rounded;
}

std::vector<TriangleSoup> generated_shapes() {
  return {shapes::triangle(), shapes::sphere(3), shapes::grid_with_holes(8, 8, 2), shapes::chain_of_tori(2),
          shapes::translated(shapes::torus(9, 17), {4.5e6, 1e-9, -1.0 / 3})};
}

TEST_F(WriteMesh, WhatIsWrittenReadsBackExactly) {
  for (const std::string extension : {"ply", "obj", "off", "om", "PLY"}) {
    for (const TriangleSoup& soup : generated_shapes()) {
      SCOPED_TRACE(extension);
      const fs::path path = folder_ / ("shape." + extension);
      const Result<void> written = write_mesh(path, soup, {.comment = "two\nlines"});
      ASSERT_TRUE(written) << written.error().message;
      const Result<MeshFile> read = read_mesh(path);
      ASSERT_TRUE(read) << read.error().to_string();
      expect_same(read->soup, soup);
      EXPECT_TRUE(read->notes.empty());
    }
  }
}

TEST_F(WriteMesh, StlReadsBackWithTheSameCornersInFloat) {
  for (const TriangleSoup& soup : generated_shapes()) {
    const fs::path path = folder_ / "shape.stl";
    ASSERT_TRUE(write_mesh(path, soup, {.comment = "solid as rock"}));
    const Result<MeshFile> read = read_mesh(path);
    ASSERT_TRUE(read) << read.error().to_string();
    EXPECT_EQ(read->format, "STL binary");
    ASSERT_EQ(read->soup.triangles.size(), soup.triangles.size());
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& written = soup.positions[soup.triangles[t][k]];
        const Vec3& read_back = read->soup.positions[read->soup.triangles[t][k]];
        for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(read_back[axis], as_float(written[axis]));
      }
    }
  }
}

TEST_F(WriteMesh, PutsTheCommentInTheFile) {
  for (const std::string extension : {"ply", "obj", "off", "stl"}) {
    const fs::path path = folder_ / ("c." + extension);
    ASSERT_TRUE(write_mesh(path, shapes::triangle(), {.comment = "model xyz"}));
    EXPECT_NE(content_of(path).find("model xyz"), std::string::npos) << extension;
  }
}

TEST_F(WriteMesh, KeepsDefectsInTheFormatsThatCanHoldThem) {
  const TriangleSoup soup = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}}, {{0, 1, 2}, {0, 1, 2}, {0, 0, 1}}};
  for (const std::string extension : {"ply", "obj", "off"}) {
    ASSERT_TRUE(write_mesh(folder_ / ("d." + extension), soup));
    expect_same(read_mesh(folder_ / ("d." + extension))->soup, soup);
  }
  const Result<void> refused = write_mesh(folder_ / "d.om", soup);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("OpenMesh cannot hold triangle 1"), std::string::npos)
      << refused.error().message;
}

TEST_F(WriteMesh, RefusesWhatItCannotWrite) {
  const Result<void> unknown = write_mesh(folder_ / "a.xyz", shapes::triangle());
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::Unsupported);
  EXPECT_EQ(unknown.error().message.find((folder_ / "a.xyz").string() + ": "), 0u);
  EXPECT_FALSE(write_mesh(folder_ / "a.stl", shapes::translated(shapes::triangle(), {1e300, 0, 0})));
  const Result<void> nowhere = write_mesh(folder_ / "missing" / "a.ply", shapes::triangle());
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, ErrorCode::Io);
  EXPECT_EQ(file_count(), 0u);
}

TEST_F(WriteMesh, AFullDiskLeavesTheOldFileAndNothingElse) {
  const fs::path path = file("a.ply", "what was there");
  {
    const SmallDisk disk(1000);
    const Result<void> written = write_mesh(path, shapes::sphere(3));
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::Io);
    EXPECT_EQ(written.error().message.find(path.string() + ": cannot write: "), 0u)
        << written.error().message;
  }
  EXPECT_EQ(content_of(path), "what was there");
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(WriteMesh, ATargetThatCannotBeReplacedLeavesNothingBehind) {
  fs::create_directories(folder_ / "taken.ply" / "inner");
  EXPECT_FALSE(write_mesh(folder_ / "taken.ply", shapes::triangle()));
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(ReadMesh, ErrorsBeginWithThePath) {
  const fs::path path = file("bad.ply", "ply\nformat ascii 1.0\nelement vertex x\n");
  const Result<MeshFile> result = read_mesh(path);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message.find(path.string() + ": line 3: "), 0u) << result.error().message;
}

TEST_F(ReadMesh, RefusesWhatIsNotThereOrNoMesh) {
  expect_failure(read_mesh(folder_ / "none.ply"), ErrorCode::NotFound, "no such file");
  expect_failure(read_mesh(file("a.txt", "v 0 0 0")), ErrorCode::Unsupported,
                 "unknown mesh format '.txt'; known are .ply");
  expect_failure(read_mesh(file("empty.obj", "")), ErrorCode::BadFile, "the file is empty");
  fs::create_directories(folder_ / "folder.ply");
  expect_failure(read_mesh(folder_ / "folder.ply"), ErrorCode::Io, "not a regular file");
}

TEST_F(ReadMesh, SeesThroughAWrongExtension) {
  ASSERT_TRUE(write_mesh(folder_ / "a.ply", shapes::triangle()));
  fs::copy(folder_ / "a.ply", folder_ / "a.obj");
  expect_failure(read_mesh(folder_ / "a.obj"), ErrorCode::BadFile,
                 "the extension says OBJ, but the content is PLY; rename the file");
  expect_failure(read_mesh(file("b.ply", "# c\nOFF\n3 1 0\n")), ErrorCode::BadFile, "the content is OFF");
  expect_failure(read_mesh(file("c.off", "#VRML V2.0 utf8\n")), ErrorCode::BadFile, "the content is WRL");
  expect_failure(read_mesh(file("d.wrl", "\x1f\x8b\x08")), ErrorCode::BadFile,
                 "the content is gzip; unpack it first");
}

TEST_F(ReadMesh, KnowsMeshFilesByName) {
  for (const char* name : {"a.ply", "b.OBJ", "c.Off", "d.stl", "e.wrl", "f.om"}) {
    EXPECT_TRUE(is_mesh_file_name(name)) << name;
  }
  for (const char* name : {"a.txt", "ply", ".ply", "b.ply.xz", ""})
    EXPECT_FALSE(is_mesh_file_name(name)) << name;
}

}  // namespace
}  // namespace selvage
