// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_masks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "view/school_look.h"

namespace sonar {
namespace {

int weight_of(double share) { return static_cast<int>(std::lround(255.0 * std::clamp(share, 0.0, 1.0))); }

Result<void> check_mask(const PingMask& mask, const Shape3& shape) {
  std::size_t voxels = 0;
  for (const Run& run : mask.runs) {
    if (run.row < 0 || static_cast<std::size_t>(run.row) >= shape.rows() || run.first_sample < 0 || run.count < 0 ||
        run.count > shape.samples - run.first_sample) {
      return fail(
          ErrorCode::mismatch,
          fmt::format("a mask has samples {} to {} of row {}; the grid has {} rows of {} samples", run.first_sample,
                      run.first_sample + std::int64_t{run.count}, run.row, shape.rows(), shape.samples));
    }
    voxels += static_cast<std::size_t>(run.count);
  }
  if (voxels == mask.confidence.size()) return {};
  return fail(ErrorCode::mismatch,
              fmt::format("a mask has {} voxels and {} confidences", voxels, mask.confidence.size()));
}

/// 0 = in no mask, else (layer + 1) * 256 + confidence.
using MaskWord = std::uint32_t;

/// The words of the voxels that a slice can show, kept only where masks are.
class MaskVoxels {
 public:
  MaskVoxels(const Slice& slice, const Shape3& shape, const std::vector<MaskLayer>& masks)
      : samples_(shape.samples), per_sample_(1.0 / shape.samples), rows_(shape.rows()) {
    const auto* top = std::get_if<TopSlice>(&slice);
    const auto* side = std::get_if<SideSlice>(&slice);
    const auto* range = std::get_if<RangeSlice>(&slice);
    const auto shown = [&](const Run& run) {
      return (top == nullptr || run.row / shape.beams == top->fan) &&
             (side == nullptr || run.row % shape.beams == side->beam) &&
             (range == nullptr || (run.first_sample <= range->sample && range->sample < run.end()));
    };
    for (const MaskLayer& layer : masks) {
      if (layer.mask == nullptr) continue;
      for (const Run& run : layer.mask->runs) {
        if (shown(run) && run.count > 0) reserve(run);
      }
    }
    std::size_t words = 0;
    for (Row& row : rows_) {
      row.offset = words;
      if (row.first < row.end) words += static_cast<std::size_t>(row.end - row.first);
    }
    words_.resize(words);
    for (std::size_t i = 0; i < masks.size(); ++i) {
      if (masks[i].mask != nullptr) lay(*masks[i].mask, static_cast<MaskWord>((i + 1) * 256), shown);
    }
  }

  [[nodiscard]] bool empty() const { return words_.empty(); }
  [[nodiscard]] MaskWord at(std::int32_t voxel) const {
    if (voxel < first_ || voxel >= end_) return 0;
    // Half a sample from any whole number of rows: the product cannot round to the wrong side.
    const auto r = static_cast<std::int32_t>((voxel + 0.5) * per_sample_);
    const Row& row = rows_[static_cast<std::size_t>(r)];
    const std::int32_t sample = voxel - r * samples_;
    if (sample < row.first || sample >= row.end) return 0;
    return words_[row.offset + static_cast<std::size_t>(sample - row.first)];
  }

 private:
  struct Row {
    std::int32_t first = std::numeric_limits<std::int32_t>::max();
    std::int32_t end = 0;
    std::size_t offset = 0;
  };

  void reserve(const Run& run) {
    Row& row = rows_[static_cast<std::size_t>(run.row)];
    row.first = std::min(row.first, run.first_sample);
    row.end = std::max(row.end, run.end());
    first_ = std::min(first_, run.row * samples_ + run.first_sample);
    end_ = std::max(end_, run.row * samples_ + run.end());
  }
  template <class Shown>
  void lay(const PingMask& mask, MaskWord layer, const Shown& shown) {
    std::size_t next = 0;
    for (const Run& run : mask.runs) {
      const auto count = static_cast<std::size_t>(run.count);
      if (shown(run) && run.count > 0) {
        const Row& row = rows_[static_cast<std::size_t>(run.row)];
        const std::size_t at = row.offset + static_cast<std::size_t>(run.first_sample - row.first);
        for (std::size_t i = 0; i < count; ++i) {
          if (mask.confidence[next + i] > 0) words_[at + i] = layer + mask.confidence[next + i];
        }
      }
      next += count;
    }
  }

  std::int32_t samples_;
  double per_sample_;
  std::vector<Row> rows_;  ///< [fan * beams + beam]
  std::vector<MaskWord> words_;
  std::int32_t first_ = std::numeric_limits<std::int32_t>::max();  ///< voxel numbers
  std::int32_t end_ = 0;
};

/// The words of the picture's pixels, as far as an outline looks up and down from the row that is being drawn.
class MaskPixels {
 public:
  /// reach   of an outline: its width
  /// window  of runs_across(), above reach
  MaskPixels(const SliceMap& map, const MaskVoxels& masks, int reach, int window)
      : map_(&map),
        masks_(&masks),
        reach_(reach),
        window_(window),
        depth_(2 * window + 1),
        words_(static_cast<std::size_t>(depth_) * static_cast<std::size_t>(map.size().width)),
        filled_(static_cast<std::size_t>(depth_)) {}

  /// Rows come one after another, from 0. Whether this one has any word.
  [[nodiscard]] bool move_to(int y) {
    for (const int last = std::min(y + window_, map_->size().height - 1); next_ <= last; ++next_) fill(next_);
    return filled_[static_cast<std::size_t>(y % depth_)];
  }
  /// Row within the window.
  [[nodiscard]] std::span<MaskWord> row(int y) {
    const auto width = static_cast<std::size_t>(map_->size().width);
    return std::span(words_).subspan(static_cast<std::size_t>(y % depth_) * width, width);
  }
  [[nodiscard]] MaskWord at(int x, int y) { return row(y)[static_cast<std::size_t>(x)]; }
  /// Whether another layer, or none, lies within reach; beyond the picture's edge all is the same.
  [[nodiscard]] bool on_edge(int x, int y) {
    const PixelSize size = map_->size();
    const MaskWord own = at(x, y) / 256;
    for (int d = 1; d <= reach_; ++d) {
      if (at(std::max(x - d, 0), y) / 256 != own || at(std::min(x + d, size.width - 1), y) / 256 != own ||
          at(x, std::max(y - d, 0)) / 256 != own || at(x, std::min(y + d, size.height - 1)) / 256 != own)
        return true;
    }
    return false;
  }
  /// Whether this is so of any pixel that touches one; beyond the picture's edge all is the same.
  template <class Is>
  [[nodiscard]] bool beside(int x, int y, const Is& is) {
    const PixelSize size = map_->size();
    return is(at(std::max(x - 1, 0), y)) || is(at(std::min(x + 1, size.width - 1), y)) ||
           is(at(x, std::max(y - 1, 0))) || is(at(x, std::min(y + 1, size.height - 1)));
  }
  /// Whether the outline of a pixel's layer goes rather across than down here.
  [[nodiscard]] bool runs_across(int x, int y) {
    const PixelSize size = map_->size();
    const MaskWord own = at(x, y) / 256;
    int right = 0;
    int down = 0;
    int width = 0;
    int height = 0;
    for (int ny = std::max(y - window_, 0); ny <= std::min(y + window_, size.height - 1); ++ny) {
      const std::span<const MaskWord> words = row(ny);
      for (int nx = std::max(x - window_, 0); nx <= std::min(x + window_, size.width - 1); ++nx) {
        if (words[static_cast<std::size_t>(nx)] / 256 != own) continue;
        right += nx - x;
        down += ny - y;
        width += (nx - x) * (nx - x);
        height += (ny - y) * (ny - y);
      }
    }
    // An edge lies across the way to the layer's inside. What is as thin as its outline has no inside.
    if (std::abs(down) != std::abs(right)) return std::abs(down) > std::abs(right);
    return width >= height;
  }

 private:
  void fill(int y) {
    const std::span<MaskWord> words = row(y);
    const std::int32_t* voxels = &map_->voxels()[static_cast<std::size_t>(y) * words.size()];
    MaskWord all = 0;
    for (std::size_t x = 0; x < words.size(); ++x) all |= words[x] = masks_->at(voxels[x]);
    filled_[static_cast<std::size_t>(y % depth_)] = all != 0;
  }

  const SliceMap* map_;
  const MaskVoxels* masks_;
  int reach_;
  int window_;
  int depth_;
  int next_ = 0;                 ///< row that was not filled yet
  std::vector<MaskWord> words_;  ///< [row % depth][width]
  std::vector<bool> filled_;
};

constexpr int kWindow_px = 3;  ///< about an outline's pixel, to tell its direction

/// Dash and gap of each layer's outline.
class Dashes {
 public:
  Dashes(const std::vector<MaskLayer>& masks, const Theme& theme) : of_(masks.size()) {
    for (std::size_t i = 0; i < masks.size(); ++i) {
      const auto lengths = line_dashes(masks[i].line, theme);
      if (lengths.empty()) continue;
      of_[i] = {lengths[0], lengths[0] + lengths[1]};
      any_ = true;
    }
  }
  [[nodiscard]] bool any() const { return any_; }
  /// Whether an outline's pixel belongs to a dash. Dashes are counted along the picture's axis that is nearer to the
  /// outline's direction, so that neighbours agree without the outline having been followed.
  [[nodiscard]] bool drawn(std::size_t layer, MaskPixels& pixels, int x, int y) const {
    const Dash& dash = of_[layer];
    if (dash.period_px <= 0.0) return true;
    return std::fmod(pixels.runs_across(x, y) ? x : y, dash.period_px) < dash.on_px;
  }

 private:
  struct Dash {
    double on_px = 0.0;
    double period_px = 0.0;  ///< 0 = solid
  };
  std::vector<Dash> of_;
  bool any_ = false;
};

Rgba8 layer_colour(const MaskLayer& layer) {
  const auto channel = [](float v) {
    return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(v, 0.0F, 1.0F)));
  };
  return {channel(layer.rgb[0]), channel(layer.rgb[1]), channel(layer.rgb[2]), 255};
}

/// Whether a core's line is drawn here, where it goes through the pixel.
bool has_dot(int x, int y, int line_px) { return (x + y) / line_px % 4 == 0; }

/// Rims the dot of a core's line: dark on one side of the line and light on the other, because one colour alone would be
/// lost in data of some other. Other dots and the school's outline stay as they are.
template <class IsCore>
void rim_dot(Image& image, MaskPixels& pixels, int x, int y, int line_px, const IsCore& is_core, const Theme& theme) {
  for (const auto& [dx, dy] : {std::pair{-1, 0}, std::pair{1, 0}, std::pair{0, -1}, std::pair{0, 1}}) {
    const int nx = x + dx;
    const int ny = y + dy;
    if (nx < 0 || ny < 0 || nx >= image.size.width || ny >= image.size.height) continue;
    const MaskWord word = pixels.at(nx, ny);
    if (word == 0 || pixels.on_edge(nx, ny)) continue;
    if (!is_core(word)) {
      image.at(nx, ny) = with_alpha(theme.text, 255);
    } else if (!has_dot(nx, ny, line_px)) {
      image.at(nx, ny) = with_alpha(theme.background, 255);
    }
  }
}

/// Darkens (on a light theme) the unselected neighbours of an outline's pixel: a line in one colour would be lost over
/// data of the same colour.
void rim(Image& image, MaskPixels& pixels, int x, int y, const Theme& theme) {
  for (const auto& [dx, dy] : {std::pair{-1, 0}, std::pair{1, 0}, std::pair{0, -1}, std::pair{0, 1}}) {
    const int nx = x + dx;
    const int ny = y + dy;
    if (nx < 0 || ny < 0 || nx >= image.size.width || ny >= image.size.height) continue;
    if (pixels.at(nx, ny) == 0) image.at(nx, ny) = with_alpha(theme.text, 255);
  }
}

}  // namespace

Result<void> blend_masks(Image& image, const SliceMap& map, const std::vector<MaskLayer>& masks,
                         const SliceMaskStyle& style, const Theme& theme) {
  const Sector& sector = map.sector();
  const Shape3 shape{sector.fans(), sector.beams(), sector.range().count};
  for (const MaskLayer& layer : masks) {
    if (layer.mask == nullptr) continue;
    if (auto ok = check_mask(*layer.mask, shape); !ok) return ok;
  }
  const MaskVoxels voxels(map.view().slice, shape, masks);
  if (voxels.empty()) return {};
  std::vector<Rgba8> colours(masks.size());
  std::transform(masks.begin(), masks.end(), colours.begin(), layer_colour);
  const int core = weight_of(style.core_strength);
  const int fuzzy = weight_of(style.fuzzy_strength);
  std::array<int, 256> strength{};
  for (std::size_t q = 0; q < strength.size(); ++q) {
    strength[q] = !style.tint ? 0 : static_cast<double>(q) / 255.0 >= style.core_at ? core : fuzzy;
  }
  const auto is_core = [&](MaskWord word) { return static_cast<double>(word % 256) / 255.0 >= style.core_at; };
  const Dashes dashes(masks, theme);
  const int line_px = std::max(1, static_cast<int>(std::lround(theme.line_px)));
  // The neighbours of a pixel look as far as it does.
  MaskPixels pixels(map, voxels, line_px, dashes.any() ? std::max(line_px + 1, kWindow_px) : line_px + 1);
  for (int y = 0; y < image.size.height; ++y) {
    if (!pixels.move_to(y)) continue;
    const std::span<const MaskWord> row = pixels.row(y);
    for (int x = 0; x < image.size.width; ++x) {
      const MaskWord word = row[static_cast<std::size_t>(x)];
      if (word == 0) continue;
      const bool edged = style.outline && pixels.on_edge(x, y) && dashes.drawn(word / 256 - 1, pixels, x, y);
      Rgba8& pixel = image.at(x, y);
      const bool dotted = !style.tint && style.outline && !edged && has_dot(x, y, line_px) && is_core(word) &&
                          pixels.beside(x, y, [&](MaskWord other) { return !is_core(other); });
      pixel = mixed(pixel, colours[word / 256 - 1], edged || dotted ? 255 : strength[word % 256]);
      if (edged) rim(image, pixels, x, y, theme);
      if (dotted) rim_dot(image, pixels, x, y, line_px, is_core, theme);
    }
  }
  return {};
}

}  // namespace sonar
