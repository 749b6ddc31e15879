// SPDX-License-Identifier: Apache-2.0
#include "render/draw_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "render/compare_pictures.h"

namespace sonar {
namespace {

constexpr Rgba8 kWhite{255, 255, 255, 255};
constexpr Rgba8 kBlack{0, 0, 0, 255};
constexpr Rgba8 kRed{255, 0, 0, 255};

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "sonar_draw_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] std::string bytes(const std::string& name) const {
    std::ifstream in(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put(const std::string& name, const std::string& content) const {
    std::ofstream(file(name), std::ios::binary) << content;
  }

 private:
  std::filesystem::path folder_;
};
using DrawFrame = Files;
using Png = Files;
using Compare = Files;

FrameDescription blank(PixelSize size) {
  FrameDescription frame;
  frame.size = size;
  return frame;
}

/// A bit of everything.
FrameDescription example() {
  FrameDescription frame = blank({200, 120});
  frame.title = "Fan <3> & more";
  auto image = std::make_shared<Image>(PixelSize{60, 40}, kRed);
  for (int i = 0; i < 40; ++i) image->at(i, i) = {0, 0, 255, 128};
  frame.items.emplace_back(ImageItem{{10, 10, 120, 80}, image, false});
  PathItem path;
  path.parts.push_back({{{20, 20}, {90, 30}, {40, 80}}, true});
  path.fill = {0, 128, 0, 100};
  path.stroke = {kBlack, 2.0, {4.0, 2.0}};
  frame.items.emplace_back(ClipItem{{0, 0, 150, 120}});
  frame.items.emplace_back(path);
  frame.items.emplace_back(ClipItem{});
  TextItem text;
  text.at = {100, 60};
  text.text = "Sv \u221260 dB \u00B0";
  text.halo = kWhite;
  text.turned_deg = -30.0;
  frame.items.emplace_back(text);
  return frame;
}

TEST_F(DrawFrame, NearestImagesKeepTheirBlocks) {
  FrameDescription frame = blank({12, 8});
  auto image = std::make_shared<Image>(PixelSize{2, 2}, kWhite);
  image->at(1, 0) = kRed;
  image->at(0, 1) = kBlack;
  frame.background = {10, 20, 30, 255};
  frame.items.emplace_back(ImageItem{{2, 1, 8, 6}, image, false});
  const auto drawn = draw_frame(frame);
  ASSERT_TRUE(drawn.has_value());
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 12; ++x) {
      const bool inside = x >= 2 && x < 10 && y >= 1 && y < 7;
      const Rgba8 expected = inside ? image->at((x - 2) / 4, (y - 1) / 3) : frame.background;
      ASSERT_EQ(drawn->at(x, y), expected) << x << ' ' << y;
    }
  }
}

TEST_F(DrawFrame, SmoothImagesAreInterpolatedAndKeepTheirRim) {
  FrameDescription frame = blank({20, 4});
  auto image = std::make_shared<Image>(PixelSize{2, 1}, kBlack);
  image->at(1, 0) = kWhite;
  frame.items.emplace_back(ImageItem{{0, 0, 20, 4}, image, true});
  const Image drawn = *draw_frame(frame);
  EXPECT_LT(drawn.at(0, 0).r, 20);
  EXPECT_GT(drawn.at(19, 0).r, 235);
  EXPECT_NEAR(drawn.at(10, 2).r, 134, 25);
  for (int x = 1; x < 20; ++x) EXPECT_GE(drawn.at(x, 1).r, drawn.at(x - 1, 1).r);
}

TEST_F(DrawFrame, ThinUprightLinesCoverWholePixels) {
  FrameDescription frame = blank({20, 20});
  PathItem line;
  line.parts.push_back({{{10, 2}, {10, 18}}, false});
  line.stroke = {kBlack, 1.0, {}};
  frame.items.emplace_back(line);
  const Image drawn = *draw_frame(frame);
  int black = 0;
  for (int x = 0; x < 20; ++x) black += drawn.at(x, 10) == kBlack ? 1 : drawn.at(x, 10) == kWhite ? 0 : 100;
  EXPECT_EQ(black, 1);
}

TEST_F(DrawFrame, FillsAreEvenOddAndClipsEnd) {
  FrameDescription frame = blank({40, 40});
  PathItem rings;
  rings.parts.push_back({{{5, 5}, {35, 5}, {35, 35}, {5, 35}}, true});
  rings.parts.push_back({{{15, 15}, {25, 15}, {25, 25}, {15, 25}}, true});
  rings.fill = kRed;
  frame.items.emplace_back(ClipItem{{0, 0, 30, 40}});
  frame.items.emplace_back(rings);
  frame.items.emplace_back(ClipItem{});
  PathItem dot;
  dot.parts.push_back({{{36, 36}, {39, 36}, {39, 39}, {36, 39}}, true});
  dot.fill = kBlack;
  frame.items.emplace_back(dot);
  const Image drawn = *draw_frame(frame);
  EXPECT_EQ(drawn.at(10, 10), kRed);
  EXPECT_EQ(drawn.at(20, 20), kWhite);  // the hole
  EXPECT_EQ(drawn.at(32, 10), kWhite);  // cut
  EXPECT_EQ(drawn.at(37, 37), kBlack);  // after the clip
}

/// Bounds of what is not white.
struct Ink {
  int left = 1000, right = -1, top = 1000, bottom = -1;
};
Ink ink(const Image& image) {
  Ink out;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      if (image.at(x, y) == kWhite) continue;
      out = {std::min(out.left, x), std::max(out.right, x), std::min(out.top, y), std::max(out.bottom, y)};
    }
  }
  return out;
}

// "H" of DejaVu Sans: 0.729 em high, advance 0.752 em with 0.098 em beside it at both sides.
TEST_F(DrawFrame, TextStandsAtItsAnchor) {
  for (const TextAnchor anchor : {TextAnchor::left, TextAnchor::centre, TextAnchor::right}) {
    FrameDescription frame = blank({200, 100});
    TextItem text;
    text.at = {100, 50};
    text.text = "H";
    text.size_px = 40.0;
    text.anchor = anchor;
    frame.items.emplace_back(text);
    const Ink at = ink(*draw_frame(frame));
    EXPECT_NEAR(at.top, 50 - 0.3645 * 40, 1.5);
    EXPECT_NEAR(at.bottom, 50 + 0.3645 * 40 - 1, 1.5);
    const double shift = anchor == TextAnchor::left ? 0.0 : anchor == TextAnchor::centre ? 0.376 * 40 : 0.752 * 40;
    EXPECT_NEAR(at.left, 100 - shift + 0.098 * 40, 1.5);
    EXPECT_NEAR(at.right, 100 - shift + 0.654 * 40 - 1, 1.5);
  }
}

TEST_F(DrawFrame, ScaleEnlargesEverything) {
  const Image drawn = *draw_frame(example(), 2.0);
  EXPECT_EQ(drawn.size, (PixelSize{400, 240}));
  EXPECT_EQ(drawn.at(200, 60), kRed);
}

TEST_F(DrawFrame, StrangeItemsAreLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  FrameDescription frame = blank({50, 50});
  PathItem path;
  path.parts.push_back({{{nan, 0}, {10, 10}}, false});
  path.parts.push_back({{{-1e30, 25}, {1e30, 25}}, false});
  path.parts.push_back({{}, true});
  path.stroke = {kRed, 1.0, {-1.0, nan}};
  frame.items.emplace_back(path);
  frame.items.emplace_back(ImageItem{{0, 0, 10, 10}, nullptr, false});
  auto lying = std::make_shared<Image>(PixelSize{4, 4});
  lying->size = {400, 400};
  frame.items.emplace_back(ImageItem{{0, 0, 10, 10}, lying, false});
  TextItem text;
  text.at = {nan, 5};
  text.text = "x";
  frame.items.emplace_back(text);
  text.at = {5, 45};
  text.text = "\xFF\xC0";  // no UTF-8
  frame.items.emplace_back(text);
  const auto drawn = draw_frame(frame);
  ASSERT_TRUE(drawn.has_value());
  EXPECT_EQ(drawn->at(25, 25), kRed);
  EXPECT_EQ(drawn->at(5, 5), kWhite);
}

TEST_F(DrawFrame, BadRequestsAreRefused) {
  EXPECT_EQ(draw_frame(blank({0, 10})).error().code, ErrorCode::bad_parameter);
  EXPECT_EQ(draw_frame(blank({16385, 10})).error().code, ErrorCode::bad_parameter);
  EXPECT_EQ(draw_frame(blank({100, 100}), 1000.0).error().code, ErrorCode::bad_parameter);
  EXPECT_EQ(draw_frame(blank({10, 10}), std::numeric_limits<double>::quiet_NaN()).error().code,
            ErrorCode::bad_parameter);
  EXPECT_EQ(picture_bytes(blank({10, 10}), "a.jpg").error().code, ErrorCode::usage);
}

/// Elements nest and close; attributes are quoted. Enough for what Cairo writes.
bool well_formed(const std::string& svg) {
  std::vector<std::string> open;
  for (std::size_t i = svg.find('<'); i != std::string::npos; i = svg.find('<', i + 1)) {
    const std::size_t end = svg.find('>', i);
    if (end == std::string::npos) return false;
    const std::string tag = svg.substr(i + 1, end - i - 1);
    if (tag.front() == '?') continue;
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return false;
    const std::string name =
        tag.substr(tag.front() == '/' ? 1 : 0, tag.find_first_of(" \n/", 1) - (tag.front() == '/'));
    if (tag.front() == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
  }
  return open.empty();
}

TEST_F(DrawFrame, SvgIsWellFormedAndEqualEachTime) {
  const std::string svg = picture_bytes(example(), "a.svg").value();
  ASSERT_TRUE(draw_frame(example()).has_value());  // moves Cairo's counters
  EXPECT_EQ(svg, picture_bytes(example(), "b.svg").value());
  EXPECT_TRUE(well_formed(svg));
  EXPECT_NE(svg.find("<title>Fan &lt;3&gt; &amp; more</title>"), std::string::npos);
  EXPECT_NE(svg.find("width=\"200px\" height=\"120px\""), std::string::npos);
  EXPECT_NE(svg.find("image-rendering:pixelated"), std::string::npos);
  // Every reference has its target.
  for (std::size_t i = svg.find("\"#"); i != std::string::npos; i = svg.find("\"#", i + 1)) {
    const std::string name = svg.substr(i + 2, svg.find('"', i + 2) - i - 2);
    EXPECT_NE(svg.find("id=\"" + name + "\""), std::string::npos) << name;
  }
}

// Letters are outlines; the words lie over them, not seen, as text that can be found. A text outside its clip is none.
TEST_F(DrawFrame, SvgWordsCanBeFound) {
  FrameDescription frame{{200, 120}, {255, 255, 255, 255}, "t", {}};
  TextItem word;
  word.at = {100.0, 50.0};
  word.text = "Sv < -50 & \xFF\x01 dB";
  word.size_px = 10.0;
  word.anchor = TextAnchor::right;
  word.turned_deg = -90.0;
  frame.items.emplace_back(word);
  frame.items.emplace_back(ClipItem{{0.0, 0.0, 20.0, 20.0}});
  word.at = {100.0, 70.0};
  word.text = "no \xEF\xBF\xBE character";  // U+FFFE is none that XML may hold
  frame.items.insert(frame.items.begin(), word);
  word.text = "cut away";
  frame.items.emplace_back(word);
  frame.items.emplace_back(ClipItem{});
  const std::string svg = picture_bytes(frame, "words.svg", 2.0).value();
  EXPECT_TRUE(well_formed(svg));
  EXPECT_NE(svg.find("<g transform=\"scale(2)\" fill-opacity=\"0\""), std::string::npos);
  EXPECT_NE(svg.find(">Sv &lt; -50 &amp; \uFFFD dB</text>"), std::string::npos);
  // Its base line is half of a capital, 0.3645 of its size, below the anchor; it turns about the anchor.
  EXPECT_NE(svg.find("x=\"100\" y=\"53.645\" font-size=\"10\" text-anchor=\"end\" transform=\"rotate(-90 100 50)\""),
            std::string::npos);
  EXPECT_NE(svg.find(">no \uFFFD character</text>"), std::string::npos);
  EXPECT_EQ(svg.find("cut away"), std::string::npos);
}

TEST_F(DrawFrame, PdfIsSoundAndEqualEachTime) {
  const std::string pdf = picture_bytes(example(), "a.pdf").value();
  EXPECT_EQ(pdf, picture_bytes(example(), "b.pdf").value());
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  const std::size_t start = pdf.rfind("startxref\n");
  ASSERT_NE(start, std::string::npos);
  const auto table = static_cast<std::size_t>(std::stoul(pdf.substr(start + 10)));
  EXPECT_EQ(pdf.substr(table, 4), "xref");
  EXPECT_NE(pdf.find("(D:19700101000000"), std::string::npos);
}

TEST_F(Png, OpaquePicturesReadBackEqual) {
  Image image(PixelSize{37, 23});
  for (int y = 0; y < 23; ++y) {
    for (int x = 0; x < 37; ++x) {
      image.at(x, y) = {static_cast<std::uint8_t>(x * 7), static_cast<std::uint8_t>(y * 11),
                        static_cast<std::uint8_t>(x * y), 255};
    }
  }
  put("a.png", png_bytes(image).value());
  EXPECT_EQ(*read_png(file("a.png")), image);
  EXPECT_EQ(bytes("a.png"), png_bytes(image).value());
}

TEST_F(Png, TranslucentPicturesReadBackWithinTheirRounding) {
  Image image(PixelSize{4, 1});
  image.pixels = {{200, 100, 50, 128}, {255, 255, 255, 0}, {1, 2, 3, 255}, {255, 0, 255, 200}};
  put("a.png", png_bytes(image).value());
  const Image back = *read_png(file("a.png"));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(back.pixels[i].a, image.pixels[i].a);
    if (image.pixels[i].a == 0) continue;
    EXPECT_NEAR(back.pixels[i].r, image.pixels[i].r, 2);
    EXPECT_NEAR(back.pixels[i].g, image.pixels[i].g, 2);
  }
}

TEST_F(Png, DamagedFilesAreRefusedInOneLine) {
  const std::string good = png_bytes(Image(PixelSize{300, 200}, kRed)).value();
  EXPECT_EQ(read_png(file("none.png")).error().code, ErrorCode::io);
  put("empty.png", "");
  EXPECT_EQ(read_png(file("empty.png")).error().code, ErrorCode::format);
  put("text.png", std::string(500, 'x'));
  EXPECT_EQ(read_png(file("text.png")).error().code, ErrorCode::format);
  for (std::size_t cut = 1; cut < good.size() - 12; cut += 7) {  // the last 12 bytes only say that it ends
    put("cut.png", good.substr(0, cut));
    const auto image = read_png(file("cut.png"));
    ASSERT_FALSE(image.has_value()) << cut;
    ASSERT_EQ(image.error().code, ErrorCode::format);
    ASSERT_EQ(to_line(image.error()).find('\n'), std::string::npos);
  }
  std::string huge = good;
  huge[16] = 0x7F;  // 2 billion pixels wide
  put("huge.png", huge);
  EXPECT_EQ(read_png(file("huge.png")).error().code, ErrorCode::format);
  std::string wrong = good;
  wrong[60] = static_cast<char>(wrong[60] ^ 0x55);  // in the data: its check sum tells
  put("wrong.png", wrong);
  EXPECT_EQ(read_png(file("wrong.png")).error().code, ErrorCode::format);
  EXPECT_EQ(png_bytes(Image{}).error().code, ErrorCode::bad_parameter);
}

// Two pixels of 20 differ: by 40 in one channel, by 4 in two. Mean (40 + 8) / 80 = 0.6.
TEST_F(Compare, FiguresByHand) {
  const Image reference(PixelSize{5, 4}, {100, 100, 100, 255});
  Image picture = reference;
  picture.at(3, 2).g = 140;
  picture.at(1, 0).r = 104;
  picture.at(1, 0).b = 96;
  const PictureVerdict v = compare_pictures(picture, reference, {40.0, 0.6});
  EXPECT_TRUE(v.equal);
  EXPECT_EQ(v.largest, 40);
  EXPECT_DOUBLE_EQ(v.mean, 0.6);
  EXPECT_EQ(v.differing, 2U);
  EXPECT_EQ(v.worst_x, 3);
  EXPECT_EQ(v.worst_y, 2);
  EXPECT_FALSE(compare_pictures(picture, reference, {39.0, 0.6}).equal);
  EXPECT_FALSE(compare_pictures(picture, reference, {40.0, 0.59}).equal);
  EXPECT_FALSE(compare_pictures(picture, reference, {std::nan(""), 1.0}).equal);
  EXPECT_TRUE(compare_pictures(reference, reference, {}).equal);
  EXPECT_EQ(difference_picture(picture, reference).at(3, 2).r, 255);
  EXPECT_LT(difference_picture(picture, reference).at(3, 2).g, 200);
}

TEST_F(Compare, SizesAndInvisibleColours) {
  EXPECT_FALSE(compare_pictures(Image(PixelSize{2, 2}), Image(PixelSize{2, 3}), {255.0, 255.0}).equal);
  EXPECT_TRUE(compare_pictures(Image(PixelSize{2, 2}, {1, 2, 3, 0}), Image(PixelSize{2, 2}, {9, 9, 9, 0}), {}).equal);
}

TEST_F(Compare, NoReferenceIsAFailure) {
  const Image image(PixelSize{3, 3}, kRed);
  EXPECT_EQ(compare_with_reference(image, file("none.png"), {255.0, 255.0}).error().code, ErrorCode::not_found);
  put("a.png", png_bytes(image).value());
  EXPECT_TRUE(compare_with_reference(image, file("a.png"), {})->equal);
  EXPECT_FALSE(compare_with_reference(Image(PixelSize{3, 3}, kBlack), file("a.png"), {})->equal);
}

}  // namespace
}  // namespace sonar
