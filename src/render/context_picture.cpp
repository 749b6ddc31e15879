// SPDX-License-Identifier: Apache-2.0
#include "render/context_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/check.h"
#include "render/over_pixel.h"

namespace sonar {
namespace {

constexpr int kSubPixels = 2;       ///< a side
constexpr double kNear_m = 0.1;     ///< nearer things are cut off
constexpr double kFaintLine = 0.3;  ///< share of a line's alpha that is drawn before the volume
constexpr int kBandRows = 32;

/// A corner on the sub-pixel raster; `inverse` = 1 / depth, which is linear on the screen.
struct Corner {
  double x, y, inverse;
};

/// Colours (premultiplied) and depths of a band of sub-pixel rows.
struct Band {
  int first_row, rows, width;
  std::vector<std::array<float, 4>> rgba;
  std::vector<float> inverse;  ///< of the nearest opaque thing; 0 = infinitely far

  Band(int first, int count, int w)
      : first_row(first),
        rows(count),
        width(w),
        rgba(static_cast<std::size_t>(count) * static_cast<std::size_t>(w)),
        inverse(rgba.size()) {}
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - first_row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// What reaches the screen of a scene: convex polygons of up to four corners.
struct Piece {
  std::array<Corner, 4> corners;
  int count;
  std::array<float, 4> colour;
};

class Screen {
 public:
  Screen(const Camera& camera, PixelSize size)
      : basis_(basis(camera, {size.width * kSubPixels, size.height * kSubPixels})) {}

  [[nodiscard]] const CameraBasis& camera() const { return basis_; }

  [[nodiscard]] double depth(const Point<Sonar>& p) const {
    const Point<Sonar> d = p - basis_.eye;
    return d.x * basis_.forward.x + d.y * basis_.forward.y + d.z * basis_.forward.z;
  }

  [[nodiscard]] Corner corner(const Point<Sonar>& p) const {
    const auto seen = basis_.project(p);
    return {seen->pixel.x, seen->pixel.y, 1.0 / seen->depth_m};
  }

  /// A triangle without what is behind or too near the eye.
  [[nodiscard]] std::vector<Point<Sonar>> cut(std::span<const Point<Sonar>> polygon) const {
    std::vector<Point<Sonar>> out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point<Sonar>& a = polygon[i];
      const Point<Sonar>& b = polygon[(i + 1) % polygon.size()];
      const double da = depth(a) - kNear_m;
      const double db = depth(b) - kNear_m;
      if (da >= 0.0) out.push_back(a);
      if ((da >= 0.0) != (db >= 0.0)) out.push_back(a + (b - a) * (da / (da - db)));
    }
    return out;
  }

 private:
  CameraBasis basis_;
};

std::vector<Piece> pieces(const std::vector<SceneTriangle>& triangles, const Screen& screen) {
  std::vector<Piece> out;
  for (const SceneTriangle& triangle : triangles) {
    const auto polygon = screen.cut(triangle.corners);
    if (polygon.size() < 3) continue;
    Piece piece{{}, static_cast<int>(polygon.size()), premultiplied(triangle.colour)};
    for (std::size_t i = 0; i < polygon.size(); ++i) piece.corners[i] = screen.corner(polygon[i]);
    out.push_back(piece);
  }
  return out;
}

/// A line as pale as its middle.
Rgba8 faded(const SceneLine& line, const Screen& screen, const DepthCue& cue) {
  const double pale = cue.pale(screen.depth((line.from + line.to) * 0.5));
  const auto mixed = [pale](std::uint8_t own, std::uint8_t ground) {
    return static_cast<std::uint8_t>(std::lround(own + pale * (ground - own)));
  };
  const Rgba8& c = line.colour;
  return {mixed(c.r, cue.background.r), mixed(c.g, cue.background.g), mixed(c.b, cue.background.b), c.a};
}

/// Lines become quads as wide as they are on the screen.
std::vector<Piece> pieces(const std::vector<SceneLine>& lines, const Screen& screen, const DepthCue& cue,
                          double share) {
  std::vector<Piece> out;
  for (const SceneLine& line : lines) {
    const double d0 = screen.depth(line.from) - kNear_m;
    const double d1 = screen.depth(line.to) - kNear_m;
    if (d0 < 0.0 && d1 < 0.0) continue;
    const Point<Sonar> at = line.from + (line.to - line.from) * (d0 == d1 ? 0.0 : d0 / (d0 - d1));
    const Corner a = screen.corner(d0 < 0.0 ? at : line.from);
    const Corner b = screen.corner(d1 < 0.0 ? at : line.to);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 1e-9)) continue;
    const double half = 0.5 * line.width_px * kSubPixels;
    const double nx = -(b.y - a.y) / length * half;
    const double ny = (b.x - a.x) / length * half;
    out.push_back({{Corner{a.x + nx, a.y + ny, a.inverse},
                    {b.x + nx, b.y + ny, b.inverse},
                    {b.x - nx, b.y - ny, b.inverse},
                    {a.x - nx, a.y - ny, a.inverse}},
                   4,
                   premultiplied(faded(line, screen, cue), share)});
  }
  return out;
}

/// Fills the sub-pixels whose centres lie in a triangle; `visit(x, y, inverse depth)`.
template <class Visit>
void fill(const Corner& a, const Corner& b, const Corner& c, const Band& band, const Visit& visit) {
  const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (!(std::abs(area) > 1e-12)) return;
  const auto bound = [](double v, int low, int high) { return static_cast<int>(std::clamp(v, 1.0 * low, 1.0 * high)); };
  const int x0 = bound(std::floor(std::min({a.x, b.x, c.x})), 0, band.width);
  const int x1 = bound(std::ceil(std::max({a.x, b.x, c.x})), 0, band.width);
  const int y0 = bound(std::floor(std::min({a.y, b.y, c.y})), band.first_row, band.first_row + band.rows);
  const int y1 = bound(std::ceil(std::max({a.y, b.y, c.y})), band.first_row, band.first_row + band.rows);
  for (int y = y0; y < y1; ++y) {
    const double py = y + 0.5;
    // Where the row's middle crosses the triangle, a sub-pixel wider: long thin lines have boxes as large as the picture.
    double left = 1e300;
    double right = -1e300;
    for (const auto& [p, q] : {std::pair{&a, &b}, std::pair{&b, &c}, std::pair{&c, &a}}) {
      if (std::min(p->y, q->y) > py || std::max(p->y, q->y) < py) continue;
      const double x = p->y == q->y ? p->x : p->x + (q->x - p->x) * (py - p->y) / (q->y - p->y);
      left = std::min({left, x, p->y == q->y ? q->x : x});
      right = std::max({right, x, p->y == q->y ? q->x : x});
    }
    if (left > right) continue;
    const int end = bound(std::ceil(right) + 1.0, x0, x1);
    for (int x = bound(std::floor(left) - 1.0, x0, x1); x < end; ++x) {
      const double px = x + 0.5;
      const double wa = ((b.x - px) * (c.y - py) - (c.x - px) * (b.y - py)) / area;
      const double wb = ((c.x - px) * (a.y - py) - (a.x - px) * (c.y - py)) / area;
      const double wc = 1.0 - wa - wb;
      if (wa >= 0.0 && wb >= 0.0 && wc >= 0.0) visit(x, y, wa * a.inverse + wb * b.inverse + wc * c.inverse);
    }
  }
}

/// Most pieces reach few bands.
bool reaches(const Piece& piece, const Band& band) {
  const auto corners = std::span(piece.corners).first(static_cast<std::size_t>(piece.count));
  const auto [top, low] = std::ranges::minmax(corners, {}, &Corner::y);
  return low.y >= band.first_row && top.y <= band.first_row + band.rows;
}

template <class Visit>
void fill(const Piece& piece, const Band& band, const Visit& visit) {
  if (!reaches(piece, band)) return;
  for (int i = 1; i + 1 < piece.count; ++i) {
    const auto at = [&](int k) -> const Corner& { return piece.corners[static_cast<std::size_t>(k)]; };
    fill(at(0), at(i), at(i + 1), band, visit);
  }
}

void draw_opaque(const std::vector<Piece>& drawn, Band& band) {
  for (const Piece& piece : drawn) {
    fill(piece, band, [&](int x, int y, double inverse) {
      const std::size_t i = band.index(x, y);
      if (inverse <= static_cast<double>(band.inverse[i])) return;
      band.inverse[i] = static_cast<float>(inverse);
      band.rgba[i] = piece.colour;
    });
  }
}

/// Over what is there, where no opaque thing is nearer; `depths` those of the opaque things.
void draw_over(const std::vector<Piece>& drawn, const Band& depths, Band& band) {
  for (const Piece& piece : drawn) {
    fill(piece, band, [&](int x, int y, double inverse) {
      const std::size_t i = band.index(x, y);
      // A line that lies on a face must not flicker through it.
      if (inverse * 1.001 >= static_cast<double>(depths.inverse[i])) blend(band.rgba[i], piece.colour);
    });
  }
}

/// filled_with  of the band, before
Rgba8 pixel_of(const Band& band, int x, int y, Rgba8 filled_with, const Premultiplied& filled) {
  static_assert(kSubPixels == 2);
  const std::size_t top = band.index(x * kSubPixels, y * kSubPixels);
  const std::size_t low = band.index(x * kSubPixels, y * kSubPixels + 1);
  if (band.rgba[top] == filled && band.rgba[top + 1] == filled && band.rgba[low] == filled &&
      band.rgba[low + 1] == filled) {
    return filled_with;
  }
  std::array<float, 4> sum{};
  for (int sy = 0; sy < kSubPixels; ++sy) {
    for (int sx = 0; sx < kSubPixels; ++sx) {
      const auto& sub = band.rgba[band.index(x * kSubPixels + sx, y * kSubPixels + sy)];
      for (std::size_t i = 0; i < 4; ++i) sum[i] += sub[i] / (kSubPixels * kSubPixels);
    }
  }
  if (sum[3] <= 0.0F) return {0, 0, 0, 0};
  const auto byte = [&](float v) { return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0F, 1.0F) * 255.0F)); };
  return {byte(sum[0] / sum[3]), byte(sum[1] / sum[3]), byte(sum[2] / sum[3]), byte(sum[3])};
}

/// Metres along the pixel's ray to the nearest opaque thing in it.
float ray_metres(const Band& band, int x, int y, const CameraBasis& camera) {
  float nearest = 0.0F;
  for (int sy = 0; sy < kSubPixels; ++sy) {
    for (int sx = 0; sx < kSubPixels; ++sx) {
      nearest = std::max(nearest, band.inverse[band.index(x * kSubPixels + sx, y * kSubPixels + sy)]);
    }
  }
  if (nearest <= 0.0F) return std::numeric_limits<float>::infinity();
  const Point<Sonar> d = camera.ray({(x + 0.5) * kSubPixels, (y + 0.5) * kSubPixels}).direction;
  const double cosine = d.x * camera.forward.x + d.y * camera.forward.y + d.z * camera.forward.z;
  return static_cast<float>(1.0 / (static_cast<double>(nearest) * cosine));
}

}  // namespace

ContextPicture draw_context(const ContextScene& scene, const Camera& camera, PixelSize size, const DepthCue& cue,
                            double surface_z_m, Work& work) {
  const Screen screen(camera, size);
  const bool above = camera.eye.z < surface_z_m;
  const std::vector<Piece> opaque = pieces(scene.opaque, screen);
  const std::vector<Piece> translucent = pieces(scene.translucent, screen);
  const std::vector<Piece> ground = pieces(scene.ground, screen);
  const std::vector<Piece> lines = pieces(scene.lines, screen, cue, 1.0);
  const std::vector<Piece> faint = pieces(scene.lines, screen, cue, kFaintLine);
  const std::vector<Piece> under = pieces(scene.under, screen, cue, 1.0);
  ContextPicture out{Image(size), Image(size, {0, 0, 0, 0}), nullptr};
  const Premultiplied filled = premultiplied(cue.background);
  std::vector<float> metres(opaque.empty() ? 0 : size.count());
  work.for_each((size.height + kBandRows - 1) / kBandRows, [&](std::int64_t number) {
    const int first = static_cast<int>(number) * kBandRows;
    const int rows = std::min(kBandRows, size.height - first);
    Band behind(first * kSubPixels, rows * kSubPixels, size.width * kSubPixels);
    std::fill(behind.rgba.begin(), behind.rgba.end(), filled);
    draw_opaque(opaque, behind);
    Band front(behind.first_row, behind.rows, behind.width);
    draw_over(ground, behind, behind);
    draw_over(translucent, behind, above ? front : behind);
    draw_over(under, behind, behind);
    draw_over(lines, behind, behind);
    draw_over(faint, behind, front);
    for (int y = first; y < first + rows; ++y) {
      for (int x = 0; x < size.width; ++x) {
        out.behind.at(x, y) = pixel_of(behind, x, y, cue.background, filled);
        out.front.at(x, y) = pixel_of(front, x, y, {0, 0, 0, 0}, {});
        if (!metres.empty()) metres[out.behind.index(x, y)] = ray_metres(behind, x, y, screen.camera());
      }
    }
  });
  if (!metres.empty()) out.opaque_m = std::make_shared<const std::vector<float>>(std::move(metres));
  return out;
}

Image over(const Image& top, const Image& below) {
  SONAR_CHECK(top.size == below.size);
  Image out(top.size);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = over_pixel(top.pixels[i], below.pixels[i]);
  return out;
}

Image between(const ContextPicture& context, const RayImage& rays, Work& work) {
  SONAR_CHECK(rays.size == context.behind.size && rays.size == context.front.size);
  Image out(rays.size);
  const int rows = rays.size.height;
  work.for_each((rows + kBandRows - 1) / kBandRows, [&](std::int64_t number) {
    const int first = static_cast<int>(number) * kBandRows;
    const std::size_t end = out.index(0, std::min(rows, first + kBandRows));
    for (std::size_t i = out.index(0, first); i < end; ++i) {
      out.pixels[i] = over_pixel(context.front.pixels[i], over_pixel(rays.rgba[i], context.behind.pixels[i]));
    }
  });
  return out;
}

}  // namespace sonar
