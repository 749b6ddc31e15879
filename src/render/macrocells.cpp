// SPDX-License-Identifier: Apache-2.0
#include "render/macrocells.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "base/units.h"

namespace sonar {
namespace {

struct Span16 {
  std::int16_t least = 32767;
  std::int16_t largest = kNoData;
};

/// Least and largest of each block of 17 samples (16 and one shared) of one row.
void row_spans(std::span<const std::int16_t> row, std::vector<Span16>& out) {
  const std::size_t last = row.size() - 1;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const std::size_t end = std::min(last, (k + 1) * kCellSamples);
    Span16 span;
    for (std::size_t i = k * kCellSamples; i <= end; ++i) {
      const std::int16_t value = row[i];
      span.least = std::min<std::int16_t>(span.least, value == kNoData ? std::int16_t{32767} : value);
      span.largest = std::max(span.largest, value);
    }
    out[k] = span;
  }
}

/// Where a row has unknown samples, by blocks.
void row_gaps(std::span<const std::uint8_t> row, std::span<std::uint8_t> out) {
  for (std::size_t k = 0; k < out.size(); ++k) {
    const std::size_t end = std::min(row.size() - 1, (k + 1) * kCellSamples);
    for (std::size_t i = k * kCellSamples; i <= end; ++i) out[k] = out[k] | static_cast<std::uint8_t>(1 - row[i]);
  }
}

void find_gaps(const FilledVolume& volume, Macrocells& cells) {
  const auto ranges = static_cast<std::size_t>(cells.ranges);
  cells.gaps.assign(cells.size(), 0);
  const Shape3 shape = volume.sv.shape();
  std::vector<std::uint8_t> gaps(shape.rows() * ranges, 0);
  for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
    row_gaps(volume.known.view().row(row), std::span(gaps).subspan(static_cast<std::size_t>(row) * ranges, ranges));
  }
  std::size_t cell = 0;
  for (int f = 0; f < cells.fans; ++f) {
    for (int b = 0; b < cells.beams; ++b) {
      const std::size_t row = static_cast<std::size_t>(f * shape.beams + b) * ranges;
      const std::size_t above = row + static_cast<std::size_t>(shape.beams) * ranges;
      for (std::size_t k = 0; k < ranges; ++k, ++cell) {
        cells.gaps[cell] = static_cast<std::uint8_t>(gaps[row + k] | gaps[row + ranges + k] | gaps[above + k] |
                                                     gaps[above + ranges + k]);
      }
    }
  }
}

using Row = std::uint8_t*;

/// out[k] = min(out[k], 1 + the least of `from` at k - 1, k, k + 1).
void lower_by(const std::uint8_t* from, int ranges, Row out) {
  const auto step = [](int value) { return std::min(value + 1, 255); };
  for (int k = 0; k < ranges; ++k) {
    const int before = k > 0 ? from[k - 1] : 255;
    const int after = k + 1 < ranges ? from[k + 1] : 255;
    out[k] = static_cast<std::uint8_t>(std::min<int>(out[k], step(std::min({before, int{from[k]}, after}))));
  }
}

void along_range(int ranges, Row out) {
  for (int k = 1; k < ranges; ++k) out[k] = static_cast<std::uint8_t>(std::min<int>(out[k], out[k - 1] + 1));
  for (int k = ranges - 2; k >= 0; --k) out[k] = static_cast<std::uint8_t>(std::min<int>(out[k], out[k + 1] + 1));
}

}  // namespace

Macrocells macrocells(const FilledVolume& volume) {
  const Shape3 shape = volume.sv.shape();
  Macrocells out{shape.fans - 1, shape.beams - 1, (shape.samples - 1 + kCellSamples - 1) / kCellSamples, {}, {}, {}};
  const auto ranges = static_cast<std::size_t>(out.ranges);
  std::vector<std::vector<Span16>> rows(shape.rows(), std::vector<Span16>(ranges));
  for (std::size_t row = 0; row < rows.size(); ++row) {
    row_spans(volume.sv.view().row(static_cast<int>(row)), rows[row]);
  }
  out.least.reserve(out.size());
  out.largest.reserve(out.size());
  for (int f = 0; f < out.fans; ++f) {
    for (int b = 0; b < out.beams; ++b) {
      const auto row = static_cast<std::size_t>(f * shape.beams + b);
      const auto above = row + static_cast<std::size_t>(shape.beams);
      for (std::size_t k = 0; k < ranges; ++k) {
        const Span16 a = rows[row][k];
        const Span16 c = rows[row + 1][k];
        const Span16 d = rows[above][k];
        const Span16 e = rows[above + 1][k];
        out.least.push_back(std::min(std::min(a.least, c.least), std::min(d.least, e.least)));
        out.largest.push_back(std::max(std::max(a.largest, c.largest), std::max(d.largest, e.largest)));
      }
    }
  }
  if (!volume.complete()) {
    find_gaps(volume, out);
  }
  return out;
}

std::vector<std::uint8_t> visible_cells(const Macrocells& cells, const TransferTable& table) {
  std::vector<std::uint8_t> out(cells.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const bool any = cells.least[i] <= cells.largest[i];
    out[i] = any && table.visible(cells.least[i], cells.largest[i]) ? 1 : 0;
  }
  return out;
}

std::vector<std::uint8_t> cells_reaching(const Macrocells& cells, double level_db) {
  std::vector<std::uint8_t> out(cells.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    // One count below, for the renderers' rounding.
    out[i] = cells.largest[i] != kNoData && db_from_counts(cells.largest[i] + 1) >= level_db ? 1 : 0;
  }
  return out;
}

std::vector<std::uint8_t> empty_distance(const Macrocells& cells, const std::vector<std::uint8_t>& set) {
  std::vector<std::uint8_t> out(set.size());
  for (std::size_t i = 0; i < set.size(); ++i) out[i] = set[i] != 0 ? 0 : 255;
  const auto row = [&](int f, int b) {
    return out.data() + static_cast<std::ptrdiff_t>(f * cells.beams + b) * cells.ranges;
  };
  const auto lower = [&](int f, int b, int of, int ob) {
    if (of >= 0 && of < cells.fans && ob >= 0 && ob < cells.beams) lower_by(row(of, ob), cells.ranges, row(f, b));
  };
  // Two passes over the 26 neighbours give the exact Chebyshev distance.
  for (const int sign : {-1, 1}) {
    for (int i = 0; i < cells.fans; ++i) {
      const int f = sign < 0 ? i : cells.fans - 1 - i;
      for (int j = 0; j < cells.beams; ++j) {
        const int b = sign < 0 ? j : cells.beams - 1 - j;
        lower(f, b, f + sign, b - 1);
        lower(f, b, f + sign, b);
        lower(f, b, f + sign, b + 1);
        lower(f, b, f, b + sign);
        along_range(cells.ranges, row(f, b));
      }
    }
  }
  return out;
}

}  // namespace sonar
