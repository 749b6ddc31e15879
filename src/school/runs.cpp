// SPDX-License-Identifier: Apache-2.0
#include "school/runs.h"

#include <cstddef>
#include <numeric>

namespace sonar {
namespace {

class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[at(i)] != i) {
      parent_[at(i)] = parent_[at(parent_[at(i)])];
      i = parent_[at(i)];
    }
    return i;
  }
  /// The smaller index stays root, so that a component's root is its first run.
  void join(int a, int b) {
    a = root(a);
    b = root(b);
    if (a != b) parent_[at(std::max(a, b))] = std::min(a, b);
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  std::vector<int> parent_;
};

/// Joins the touching runs of two rows: [a, a_end) and [b, b_end), each sorted.
void join_rows(std::span<const Run> runs, int a, int a_end, int b, int b_end, int widen, Sets& sets) {
  while (a < a_end && b < b_end) {
    const Run& p = runs[static_cast<std::size_t>(a)];
    const Run& q = runs[static_cast<std::size_t>(b)];
    if (p.first_sample < q.end() + widen && q.first_sample < p.end() + widen) sets.join(a, b);
    if (p.end() < q.end()) {
      ++a;
    } else {
      ++b;
    }
  }
}

}  // namespace

IndexBox box_of(const PingMask& mask, int beams) {
  if (mask.runs.empty()) return {};
  const Run& first = mask.runs.front();
  IndexBox box{first.row / beams, first.row / beams,  first.row % beams,
               first.row % beams, first.first_sample, first.end() - 1};
  for (const Run& run : mask.runs) {
    box.first_fan = std::min(box.first_fan, run.row / beams);
    box.last_fan = std::max(box.last_fan, run.row / beams);
    box.first_beam = std::min(box.first_beam, run.row % beams);
    box.last_beam = std::max(box.last_beam, run.row % beams);
    box.first_sample = std::min(box.first_sample, run.first_sample);
    box.last_sample = std::max(box.last_sample, run.end() - 1);
  }
  return box;
}

NeighbourRows neighbour_rows(int row, const Shape3& shape, Connectivity connectivity) {
  const int fan = row / shape.beams;
  const int beam = row % shape.beams;
  NeighbourRows rows;
  for (int df = -1; df <= 1; ++df) {
    for (int db = -1; db <= 1; ++db) {
      if (df == 0 && db == 0) continue;
      if (connectivity == Connectivity::faces && df != 0 && db != 0) continue;
      const int f = fan + df;
      const int b = beam + db;
      if (f < 0 || f >= shape.fans || b < 0 || b >= shape.beams) continue;
      rows.row[rows.count++] = f * shape.beams + b;
    }
  }
  return rows;
}

std::vector<Run> merged_runs(std::span<const Run> runs) {
  std::vector<Run> apart;
  for (const Run& run : runs) {
    Run* last = apart.empty() ? nullptr : &apart.back();
    if (last != nullptr && last->row == run.row && run.first_sample <= last->end()) {
      last->count = std::max(last->end(), run.end()) - last->first_sample;
    } else {
      apart.push_back(run);
    }
  }
  return apart;
}

std::vector<int> index_rows(std::span<const Run> runs, std::size_t rows) {
  std::vector<int> first(rows + 1, 0);
  for (const Run& run : runs) ++first[static_cast<std::size_t>(run.row) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

Components label_runs(std::span<const Run> runs, const Shape3& shape, Connectivity connectivity) {
  const std::vector<int> first = index_rows(runs, shape.rows());
  const int widen = connectivity == Connectivity::all ? 1 : 0;
  Sets sets(runs.size());
  for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
    const auto r = static_cast<std::size_t>(row);
    if (first[r] == first[r + 1]) continue;
    const NeighbourRows around = neighbour_rows(row, shape, connectivity);
    for (int n = 0; n < around.count; ++n) {
      if (around.row[n] > row) continue;  // each pair of rows once
      const auto other = static_cast<std::size_t>(around.row[n]);
      join_rows(runs, first[other], first[other + 1], first[r], first[r + 1], widen, sets);
    }
  }
  Components components;
  components.label.resize(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const int root = sets.root(static_cast<int>(i));
    components.label[i] =
        root == static_cast<int>(i) ? components.count++ : components.label[static_cast<std::size_t>(root)];
  }
  return components;
}

}  // namespace sonar
