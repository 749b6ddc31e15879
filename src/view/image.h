// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sonar {

/// Width and height of a picture, pixels.
struct PixelSize {
  int width = 0;
  int height = 0;
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  friend bool operator==(const PixelSize&, const PixelSize&) = default;
};

/// A place in a picture: (0, 0) is the upper left corner of the upper left pixel, x right, y down; the centre of that
/// pixel is (0.5, 0.5).
struct PixelPoint {
  double x = 0.0;
  double y = 0.0;
  friend bool operator==(const PixelPoint&, const PixelPoint&) = default;
};

/// Colour in sRGB with straight (not premultiplied) alpha.
struct Rgba8 {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  std::uint8_t a = 255;
  friend bool operator==(const Rgba8&, const Rgba8&) = default;
};

/// A picture of 8 bits a channel, rows from top to bottom, straight alpha.
struct Image {
  PixelSize size;
  std::vector<Rgba8> pixels;  ///< [height][width]

  Image() = default;
  explicit Image(PixelSize s, Rgba8 fill = {}) : size(s), pixels(s.count(), fill) {}
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] Rgba8& at(int x, int y) { return pixels[index(x, y)]; }
  [[nodiscard]] const Rgba8& at(int x, int y) const { return pixels[index(x, y)]; }
  friend bool operator==(const Image&, const Image&) = default;
};

}  // namespace sonar
