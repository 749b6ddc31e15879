// SPDX-License-Identifier: Apache-2.0
#include "render/compare_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <system_error>

#include "render/draw_frame.h"

namespace sonar {
namespace {

struct Difference {
  int largest = 0;
  int sum = 0;
};

Difference difference(Rgba8 a, Rgba8 b) {
  if (a.a == 0 && b.a == 0) return {};
  Difference out;
  for (const int d : {std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b), std::abs(a.a - b.a)}) {
    out.largest = std::max(out.largest, d);
    out.sum += d;
  }
  return out;
}

}  // namespace

PictureVerdict compare_pictures(const Image& picture, const Image& reference, const PictureThresholds& thresholds) {
  PictureVerdict out;
  if (picture.size != reference.size) {
    out.largest = 255;
    out.mean = 255.0;
    out.text = fmt::format("not equal: {} x {} pixels, the reference has {} x {}", picture.size.width,
                           picture.size.height, reference.size.width, reference.size.height);
    return out;
  }
  std::int64_t sum = 0;
  for (int y = 0; y < picture.size.height; ++y) {
    for (int x = 0; x < picture.size.width; ++x) {
      const Difference d = difference(picture.at(x, y), reference.at(x, y));
      sum += d.sum;
      if (d.largest > 0) ++out.differing;
      if (d.largest > out.largest) {
        out.largest = d.largest;
        out.worst_x = x;
        out.worst_y = y;
      }
    }
  }
  if (picture.size.count() > 0) out.mean = static_cast<double>(sum) / (4.0 * static_cast<double>(picture.size.count()));
  // Written so that a threshold that is no number is never met.
  out.equal = out.largest <= thresholds.largest && out.mean <= thresholds.mean;
  out.text = fmt::format(
      "{}: largest difference {} (allowed {}) at pixel ({}, {}), mean {:.4f} (allowed {}), {} of {} pixels differ",
      out.equal ? "equal" : "not equal", out.largest, thresholds.largest, out.worst_x, out.worst_y, out.mean,
      thresholds.mean, out.differing, picture.size.count());
  return out;
}

Result<PictureVerdict> compare_with_reference(const Image& picture, const std::filesystem::path& reference,
                                              const PictureThresholds& thresholds) {
  std::error_code code;
  if (!std::filesystem::exists(reference, code)) {
    return fail(ErrorCode::not_found, "there is no such reference picture", {reference.string()});
  }
  const auto image = read_png(reference);
  if (!image) return pass_on(image);
  return compare_pictures(picture, *image, thresholds);
}

Image difference_picture(const Image& picture, const Image& reference) {
  Image out(reference.size);
  for (int y = 0; y < reference.size.height; ++y) {
    for (int x = 0; x < reference.size.width; ++x) {
      const Rgba8 r = reference.at(x, y);
      const int grey = 255 - (255 - (r.r + r.g + r.b) / 3) * r.a / 255 / 4;
      const auto pale = static_cast<std::uint8_t>(std::clamp(grey, 0, 255));
      out.at(x, y) = {pale, pale, pale, 255};
      const bool there = x < picture.size.width && y < picture.size.height;
      const int d = there ? difference(picture.at(x, y), r).largest : 255;
      if (d > 0) {
        // A difference of 1 is seen, too.
        const auto rest = static_cast<std::uint8_t>((255 - d) * 3 / 4);
        out.at(x, y) = {255, rest, rest, 255};
      }
    }
  }
  return out;
}

}  // namespace sonar
