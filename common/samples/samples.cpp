// SPDX-License-Identifier: MIT
#include "common/samples/samples.h"

#include <algorithm>
#include <array>

#include "common/samples/assembly.h"
#include "common/samples/bracket.h"
#include "common/samples/dumbbell.h"
#include "common/samples/waterneck.h"

namespace selvage {
namespace {

struct Sample {
  std::string_view name, description;
  TriangleSoup (*make)(std::uint32_t about_triangles);
  std::uint32_t default_triangles, least_triangles;  // with fewer, thin parts would break
};

constexpr std::array kSamples = {
    Sample{"waterneck", "a smooth vessel with foot, body, neck, lip, spout and handle; genus 1",
           make_waterneck, 100'000, 8'000},
    Sample{"bracket", "an angle bracket as CAD exports it, with holes, a rib and a boss; genus 7",
           make_bracket, 5'000, 1'000},
    Sample{"assembly", "the bracket with bolts, washers and nuts; 19 components", make_assembly, 20'000,
           5'000},
    Sample{"dumbbell", "two balls and a bar", make_dumbbell, 5'000, 1'000},
};
constexpr std::uint32_t kMost = 4'000'000;

const Sample* find(std::string_view name) {
  const auto* found = std::ranges::find(kSamples, name, &Sample::name);
  return found == kSamples.end() ? nullptr : found;
}

}  // namespace

std::vector<std::string> sample_names() {
  std::vector<std::string> names;
  for (const Sample& sample : kSamples) names.emplace_back(sample.name);
  return names;
}

std::string_view describe_sample(std::string_view name) {
  const Sample* sample = find(name);
  return sample == nullptr ? std::string_view() : sample->description;
}

Result<TriangleSoup> make_sample(std::string_view name, std::uint32_t about_triangles) {
  const Sample* sample = find(name);
  if (sample == nullptr) {
    std::string message = "there is no sample '" + std::string(name) + "'; there are";
    for (const Sample& s : kSamples) message.append(" ").append(s.name);
    return fail(ErrorCode::NotFound, std::move(message));
  }
  const std::uint32_t triangles = about_triangles == 0 ? sample->default_triangles : about_triangles;
  if (triangles < sample->least_triangles || triangles > kMost) {
    const std::string range = std::to_string(sample->least_triangles) + " to " + std::to_string(kMost);
    return fail(ErrorCode::InvalidArgument, "sample '" + std::string(name) + "' has " + range +
                                                " triangles, not " + std::to_string(triangles));
  }
  return sample->make(triangles);
}

}  // namespace selvage
