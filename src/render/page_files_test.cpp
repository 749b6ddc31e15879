// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

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

/// How often "/Type /WORD" stands in a PDF, and no longer word that begins so.
std::size_t objects_of(const std::string& pdf, const std::string& word) {
  std::size_t count = 0;
  const std::string type = "/Type /" + word;
  for (std::size_t at = pdf.find(type); at != std::string::npos; at = pdf.find(type, at + 1)) {
    count += std::isalpha(static_cast<unsigned char>(pdf[at + type.size()])) == 0 ? 1U : 0U;
  }
  return count;
}

TEST(PageFiles, APdfHasAsManyPagesAsItIsGivenEachOfItsSize) {
  std::vector<FrameDescription> pages(3);
  pages[0].size = {96, 192};
  pages[1].size = {288, 96};
  pages[2].size = {96, 192};
  pages[0].title = "the first";
  pages[1].title = "the second";
  const auto pdf = pdf_bytes(pages);
  ASSERT_TRUE(pdf) << to_line(pdf.error());
  EXPECT_EQ(objects_of(*pdf, "Page"), 3U);
  EXPECT_NE(pdf->find("/Count 3"), std::string::npos);
  // An inch is 72 points.
  const std::size_t first = pdf->find("/MediaBox [ 0 0 72 144 ]");
  const std::size_t second = pdf->find("/MediaBox [ 0 0 216 72 ]");
  ASSERT_NE(first, std::string::npos);
  ASSERT_NE(second, std::string::npos);
  EXPECT_LT(first, second);
  EXPECT_NE(pdf->find("/MediaBox [ 0 0 72 144 ]", second), std::string::npos);
  EXPECT_NE(pdf->find("the first"), std::string::npos);
  EXPECT_EQ(pdf->find("the second"), std::string::npos);
  EXPECT_EQ(pdf_bytes(pages).value(), *pdf) << "no date, and no counter of the process";
  EXPECT_EQ(pdf_bytes({pages.data(), 1}).value(), picture_bytes(pages[0], "a.pdf").value());
}

TEST(PageFiles, APdfOfNoPageOrOfOneWithoutSizeIsRefused) {
  EXPECT_EQ(pdf_bytes({}).error().code, ErrorCode::bad_parameter);
  std::vector<FrameDescription> pages(2);
  pages[0].size = {96, 96};
  EXPECT_EQ(pdf_bytes(pages).error().code, ErrorCode::bad_parameter);
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
