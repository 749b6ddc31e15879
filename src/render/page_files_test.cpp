// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "render/draw_frame.h"

namespace sonar {
namespace {

/// As PNG has numbers: big-endian.
unsigned big_endian(const std::string& bytes, std::size_t at) {
  unsigned out = 0;
  for (std::size_t i = 0; i < 4; ++i) out = out << 8U | static_cast<unsigned char>(bytes[at + i]);
  return out;
}

// 180 x 120 mm at 300 dots an inch, in the units of each format by hand: 25.4 mm, 96 pixels of SVG, 72 points of PDF.
TEST(PageFiles, APageOfAnyResolutionIsAsLargeOnPaperInEveryFormat) {
  FrameDescription frame;
  frame.size = {2126, 1417};
  frame.dots_per_inch = 300.0;
  const std::string png = picture_bytes(frame, "a.png").value();
  EXPECT_EQ(big_endian(png, 16), 2126U);
  const std::size_t resolution = png.find("pHYs");
  ASSERT_NE(resolution, std::string::npos);
  EXPECT_NEAR(big_endian(png, resolution + 4) * 0.0254, 300.0, 0.02);
  const auto number_behind = [](const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    return at == std::string::npos ? 0.0 : std::atof(text.c_str() + at + words.size());
  };
  const std::string svg = picture_bytes(frame, "a.svg").value();
  EXPECT_NEAR(number_behind(svg, "width=\"") / 96.0 * 25.4, 180.0, 0.05);
  EXPECT_NEAR(number_behind(svg, "height=\"") / 96.0 * 25.4, 120.0, 0.05);
  const std::string pdf = picture_bytes(frame, "a.pdf").value();
  EXPECT_NEAR(number_behind(pdf, "/MediaBox [ 0 0 ") / 72.0 * 25.4, 180.0, 0.05);
}

// One pixel of each colour in turn: where four of them become one, it is their mean, not one of them.
TEST(DrawnImages, AnImageThatIsReducedIsTheMeanOfItsPixels) {
  auto image = std::make_shared<Image>(PixelSize{64, 64}, Rgba8{255, 255, 255, 255});
  for (int y = 0; y < 64; ++y) {
    for (int x = y % 2; x < 64; x += 2) image->at(x, y) = Rgba8{0, 0, 0, 255};
  }
  FrameDescription frame;
  frame.size = {16, 16};
  frame.items.emplace_back(ImageItem{{0.0, 0.0, 16.0, 16.0}, image, false});
  const auto drawn = draw_frame(frame);
  ASSERT_TRUE(drawn);
  for (const PixelPoint at : {PixelPoint{5, 5}, PixelPoint{6, 5}, PixelPoint{8, 11}}) {
    EXPECT_NEAR(drawn->at(static_cast<int>(at.x), static_cast<int>(at.y)).r, 128, 24);
  }
}

}  // namespace
}  // namespace sonar
