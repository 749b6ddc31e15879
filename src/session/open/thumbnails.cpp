// SPDX-License-Identifier: Apache-2.0
#include "session/open/thumbnails.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "base/hash.h"
#include "session/words/preferences.h"

namespace sonar {
namespace {

struct Side {
  double first = 0.0;
  double each = 1.0;  ///< pixels of the picture a pixel
  [[nodiscard]] int from(int i) const { return static_cast<int>(first + each * i); }
  [[nodiscard]] int to(int i, int most) const { return std::min(most, std::max(from(i) + 1, from(i + 1))); }
};

Rgba8 mean_of(const Image& image, int x0, int x1, int y0, int y1) {
  std::array<std::uint64_t, 4> sum{};
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const Rgba8 one = image.at(x, y);
      sum[0] += std::uint64_t{one.r} * one.a;
      sum[1] += std::uint64_t{one.g} * one.a;
      sum[2] += std::uint64_t{one.b} * one.a;
      sum[3] += one.a;
    }
  }
  if (sum[3] == 0) return {0, 0, 0, 0};
  const auto count = static_cast<std::uint64_t>(x1 - x0) * static_cast<std::uint64_t>(y1 - y0);
  const auto of_alpha = [&](std::size_t i) { return static_cast<std::uint8_t>((sum[i] + sum[3] / 2) / sum[3]); };
  return {of_alpha(0), of_alpha(1), of_alpha(2), static_cast<std::uint8_t>((sum[3] + count / 2) / count)};
}

}  // namespace

Image reduced(const Image& image, PixelSize size) {
  if (image.pixels.empty()) return {};
  // As much of the middle as has the wanted shape.
  const double each = std::min(1.0 * image.size.width / size.width, 1.0 * image.size.height / size.height);
  const Side x{(image.size.width - each * size.width) / 2.0, each};
  const Side y{(image.size.height - each * size.height) / 2.0, each};
  Image out(size);
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) {
      out.at(column, row) =
          mean_of(image, x.from(column), x.to(column, image.size.width), y.from(row), y.to(row, image.size.height));
    }
  }
  return out;
}

std::filesystem::path thumbnail_file(const std::filesystem::path& cache,
                                     const std::vector<std::filesystem::path>& survey, std::string_view of) {
  if (cache.empty()) return {};
  std::string names;
  for (const std::filesystem::path& path : survey) names += whole_path(path).string() + '\n';
  names += of;
  return cache / (to_hex(hash_text(names)) + ".png");
}

}  // namespace sonar
