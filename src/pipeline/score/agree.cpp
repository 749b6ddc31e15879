// SPDX-License-Identifier: Apache-2.0
#include "pipeline/score/agree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/units.h"
#include "model/school_totals.h"
#include "model/strongest_ping.h"
#include "pipeline/score/score_index.h"
#include "pipeline/score/score_pairs.h"

namespace sonar {
namespace {

using Pairs = std::map<SchoolKey, std::vector<PingPair>>;

/// One reader's result, with what it holds in pings that the other has too.
struct Reader {
  const ScoreSide& side;
  Indexed in;
  Pairs pairs;

  [[nodiscard]] TimeNs time(std::size_t observation, std::int64_t ping) const {
    return side.observations[observation].pings[static_cast<std::size_t>(ping)].time;
  }
  [[nodiscard]] std::string name(const SchoolKey& key) const {
    return school_name(side.observations[key.first].observation, key.second);
  }
  [[nodiscard]] std::string status(const SchoolKey& key) const {
    const auto row = in.schools.find(key);
    return row == in.schools.end() ? "unreviewed" : row->second->status;
  }
};

/// Takes out what lies in pings that the other has not: nothing is known of its answer there.
void keep_common(Reader& own, const Indexed& other) {
  std::erase_if(own.in.masks, [&](const auto& one) {
    return !ping_at(other, own.time(std::get<0>(one.first), std::get<2>(one.first)));
  });
}

/// The least and the largest of a figure.
class Reach {
 public:
  void add(double value) {
    low_ = std::fmin(low_, value);
    high_ = std::fmax(high_, value);
    if (!std::isfinite(value)) return;
    sum_ += value;
    ++known_;
  }
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }
  [[nodiscard]] double mean() const { return known_ > 0 ? sum_ / known_ : kUnknown; }

 private:
  double low_ = kUnknown;
  double high_ = kUnknown;
  double sum_ = 0.0;
  int known_ = 0;
};

double positive(double value) { return value > 0.0 ? value : kUnknown; }

/// Figures of the pings that both schools are in.
struct Figures {
  Reach dice, centre_m, volume_a_m3, volume_b_m3, volume_ratio, backscatter_db;
  PairedMeans volume, backscatter;
  std::int64_t both = 0;

  void add(const SchoolPingRow& a, const SchoolPingRow& b) {
    centre_m.add(distance_m(a, b));
    volume_a_m3.add(a.volume_m3);
    volume_b_m3.add(b.volume_m3);
    volume.add(b.volume_m3, a.volume_m3);
    volume_ratio.add(b.volume_m3 / positive(a.volume_m3));
    backscatter.add(b.backscatter_m2, a.backscatter_m2);
    backscatter_db.add(db_from_linear(positive(b.backscatter_m2)) - db_from_linear(positive(a.backscatter_m2)));
  }
  void put_into(AgreementRow& row) const {
    row.n_pings_both = both;
    std::tie(row.dice, row.dice_low, row.dice_high) = std::tuple(dice.mean(), dice.low(), dice.high());
    row.centre_distance_m = centre_m.mean();
    row.centre_distance_low_m = centre_m.low();
    row.centre_distance_high_m = centre_m.high();
    row.volume_a_m3 = volume_a_m3.mean();
    row.volume_b_m3 = volume_b_m3.mean();
    row.volume_ratio = volume.ratio();
    row.volume_ratio_low = volume_ratio.low();
    row.volume_ratio_high = volume_ratio.high();
    row.backscatter_difference_db = backscatter.error_db();
    row.backscatter_difference_low_db = backscatter_db.low();
    row.backscatter_difference_high_db = backscatter_db.high();
  }
};

/// The ping of `pairs` that is the other's ping; none where the school is not there.
const PingPair* at_ping(const std::vector<PingPair>& pairs, std::size_t observation, std::int64_t ping) {
  const auto found = std::find_if(pairs.begin(), pairs.end(), [&](const PingPair& pair) {
    return pair.found_observation == observation && pair.found_ping == ping;
  });
  return found == pairs.end() ? nullptr : &*found;
}

Figures compare(const SchoolKey& key_a, const std::vector<PingPair>& of_a, const std::vector<PingPair>& of_b) {
  Figures out;
  for (const PingPair& a : of_a) {
    const PingPair* b = at_ping(of_b, key_a.first, a.ping_index);
    out.dice.add(b == nullptr ? 0.0 : dice(*a.truth, *b->truth));
    if (b == nullptr) continue;
    ++out.both;
    if (a.truth_row != nullptr && b->truth_row != nullptr) out.add(*a.truth_row, *b->truth_row);
  }
  for (std::size_t alone = of_b.size() - static_cast<std::size_t>(out.both); alone > 0; --alone) out.dice.add(0.0);
  return out;
}

using FirstVoxel = std::tuple<TimeNs, std::int32_t, std::int32_t>;  ///< time, channel, sample

FirstVoxel first_voxel(const Reader& reader, const SchoolKey& key) {
  const PingPair& first = reader.pairs.at(key).front();
  const Run& run = first.truth->runs.front();
  return {reader.time(key.first, first.ping_index), run.row, run.first_sample};
}

void tell(const Reader& reader, const SchoolKey& key, std::string& school, std::int64_t& pings, std::string& status,
          std::string& operator_name, std::string& species) {
  school = reader.name(key);
  pings = std::ssize(reader.pairs.at(key));
  status = reader.status(key);
  const auto row = reader.in.schools.find(key);
  if (row == reader.in.schools.end()) return;
  operator_name = row->second->operator_name;
  species = row->second->species;
}
void tell_a(const Reader& a, const SchoolKey& key, AgreementRow& row) {
  tell(a, key, row.school_a, row.n_pings_a, row.status_a, row.operator_a, row.species_a);
}
void tell_b(const Reader& b, const SchoolKey& key, AgreementRow& row) {
  tell(b, key, row.school_b, row.n_pings_b, row.status_b, row.operator_b, row.species_b);
}

bool keeps(const std::string& status) { return !status.empty() && status != "rejected"; }
bool decided(const std::string& status) { return !status.empty() && status != "unreviewed"; }

void count_answers(Agreement& out) {
  AnswerCounts schools{};
  AnswerCounts decisions{};
  for (const AgreementRow& row : out.rows) {
    const std::size_t a = keeps(row.status_a) ? 0 : 1;
    const std::size_t b = keeps(row.status_b) ? 0 : 1;
    ++schools[a][b];
    if (decided(row.status_a) && decided(row.status_b)) ++decisions[a][b];
  }
  out.schools = cohen_kappa(schools);
  out.decisions = cohen_kappa(decisions);
}

using PingPlace = std::pair<std::size_t, std::int64_t>;  ///< observation, ping

/// All voxels of a reader that were not rejected, ping by ping.
std::map<PingPlace, PingMask> kept_voxels(const Reader& reader) {
  std::map<PingPlace, PingMask> out;
  for (const auto& [key, mask] : reader.in.masks) {
    const auto& [observation, school, ping] = key;
    if (!keeps(reader.status({observation, school}))) continue;
    PingMask& all = out[{observation, ping}];
    all = unite(all, mask);
  }
  return out;
}

void count_voxels(const Reader& a, const Reader& b, Agreement& out) {
  const auto of_a = kept_voxels(a);
  const auto of_b = kept_voxels(b);
  for (const auto& [at, mask] : of_b) out.voxels_b += std::ssize(mask.confidence);
  for (const auto& [at, mask] : of_a) {
    out.voxels_a += std::ssize(mask.confidence);
    const auto there = ping_at(b.in, a.time(at.first, at.second));
    const auto other = there ? of_b.find(*there) : of_b.end();
    if (other != of_b.end()) out.voxels_both += static_cast<std::int64_t>(overlap(mask, other->second));
  }
  const auto all = static_cast<double>(out.voxels_a + out.voxels_b);
  if (all > 0.0) out.voxel_dice = 2.0 * static_cast<double>(out.voxels_both) / all;
}

std::pair<Reader, Reader> readers_of(const ScoreSide& side_a, const ScoreSide& side_b) {
  Reader a{side_a, index_side(side_a, Rejected::kept), {}};
  Reader b{side_b, index_side(side_b, Rejected::kept), {}};
  keep_common(a, b.in);
  keep_common(b, a.in);
  return {std::move(a), std::move(b)};
}

/// Schools in rows: pairs first, then what only one has.
std::vector<AgreementRow> rows_of(const Reader& a, const Reader& b) {
  std::vector<std::pair<FirstVoxel, AgreementRow>> rows;
  std::set<SchoolKey> paired;
  std::map<SchoolKey, std::optional<SchoolKey>> partners;
  for (const auto& [key, pairs] : b.pairs) partners[key] = track_partner(pairs);
  for (const auto& [key, pairs] : a.pairs) {
    const auto partner = track_partner(pairs);
    AgreementRow row;
    tell_a(a, key, row);
    FirstVoxel first = first_voxel(a, key);
    if (partner && partners[*partner] == key) {
      tell_b(b, *partner, row);
      compare(key, pairs, b.pairs.at(*partner)).put_into(row);
      first = std::min(first, first_voxel(b, *partner));
      paired.insert(*partner);
    } else if (partner) {
      row.lies_in = b.name(*partner);
    }
    rows.emplace_back(first, std::move(row));
  }
  for (const auto& [key, partner] : partners) {
    if (paired.contains(key)) continue;
    AgreementRow row;
    tell_b(b, key, row);
    if (partner) row.lies_in = a.name(*partner);
    rows.emplace_back(first_voxel(b, key), std::move(row));
  }
  std::stable_sort(rows.begin(), rows.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<AgreementRow> out;
  for (auto& [first, row] : rows) {
    row.first_time_utc = std::get<0>(first);
    out.push_back(std::move(row));
  }
  return out;
}

std::set<std::string> hashes(const ScoreSide& side) {
  std::set<std::string> out;
  for (const ObservationProduct& product : side.observations) {
    for (const InputFile& file : product.input_files) out.insert(file.hash);
  }
  return out;
}

PingMask mask_at(const std::map<PingPlace, PingMask>& masks, const PingPlace& place) {
  const auto found = masks.find(place);
  return found == masks.end() ? PingMask{} : found->second;
}

/// A product whose schools are the parts of a comparison.
class Difference {
 public:
  explicit Difference(const ObservationProduct& of) : product_(of) {
    // Where nothing differs the strongest school is seen.
    const auto kept = [](const SchoolRow& school) { return school.status != "rejected"; };
    const SchoolPingRow* strongest = strongest_ping(of, kept);
    const std::int64_t ping = strongest != nullptr ? strongest->ping_index : -1;
    product_.schools.clear();
    product_.school_pings.clear();
    product_.masks.clear();
    if (ping >= 0) show(kInBoth, ping);
    if (product_.grid) row_of_channel_ = product_.grid->grid.row_of_channel();
  }
  /// Masks by channel.
  void add(std::int64_t ping, const PingMask& a, const PingMask& b) {
    const PingMask only_a = subtract(a, b);
    const PingMask only_b = subtract(b, a);
    put(kInBoth, ping, subtract(a, only_a));
    put(kOnlyInA, ping, only_a);
    put(kOnlyInB, ping, only_b);
    const std::size_t differ = only_a.voxels() + only_b.voxels();
    if (differ <= most_) return;
    most_ = differ;
    show(only_a.empty() ? kOnlyInB : kOnlyInA, ping);
  }
  [[nodiscard]] ObservationProduct take() {
    const auto order = [](const SchoolMask& m) { return std::pair(m.school_id, m.ping_index); };
    std::sort(product_.masks.begin(), product_.masks.end(),
              [&](const SchoolMask& x, const SchoolMask& y) { return order(x) < order(y); });
    for (const auto& [id, name] :
         {std::pair(kInBoth, "1: in both"), std::pair(kOnlyInA, "2: only in A"), std::pair(kOnlyInB, "3: only in B")}) {
      SchoolRow row;
      row.observation = product_.observation;
      row.school_id = id;
      row.name = name;
      row.origin = kDifferenceOrigin;
      row.status = "accepted";
      product_.schools.push_back(row);
    }
    return std::move(product_);
  }

 private:
  void show(std::int64_t id, std::int64_t ping) {
    SchoolPingRow row;
    row.observation = product_.observation;
    row.school_id = id;
    row.ping_index = ping;
    product_.school_pings = {row};
  }
  void put(std::int64_t id, std::int64_t ping, const PingMask& by_channel) {
    PingMask mask = with_rows(by_channel, row_of_channel_);
    // Which voxels: how surely is each reader's own matter.
    std::fill(mask.confidence.begin(), mask.confidence.end(), std::uint8_t{255});
    if (!mask.empty()) product_.masks.push_back({id, ping, std::move(mask)});
  }

  ObservationProduct product_;
  std::vector<int> row_of_channel_;
  std::size_t most_ = 0;
};

}  // namespace

Agreement agree(const ScoreSide& side_a, const ScoreSide& side_b) {
  auto [a, b] = readers_of(side_a, side_b);
  a.pairs = pair_pings(b.in, a.in, side_a);
  b.pairs = pair_pings(a.in, b.in, side_b);
  Agreement out;
  out.pings = std::count_if(a.in.pings.begin(), a.in.pings.end(),
                            [&](const auto& ping) { return ping_at(b.in, ping.first).has_value(); });
  out.rows = rows_of(a, b);
  count_answers(out);
  count_voxels(a, b, out);
  return out;
}

Result<void> require_one_survey(const ScoreSide& a, const std::filesystem::path& out_a, const ScoreSide& b,
                                const std::filesystem::path& out_b) {
  if (!share_pings(a, b)) {
    return fail(ErrorCode::mismatch, fmt::format("has no ping at the time of any ping of {}", out_b.string()),
                {.file = out_a.string()});
  }
  const std::set<std::string> of_a = hashes(a);
  const std::set<std::string> of_b = hashes(b);
  const bool known = !of_a.empty() && !of_b.empty();
  const bool shared =
      std::any_of(of_a.begin(), of_a.end(), [&](const std::string& hash) { return of_b.contains(hash); });
  if (!known || shared) return {};
  return fail(ErrorCode::mismatch,
              fmt::format("was made of other raw files than {}: none has the same content", out_b.string()),
              {.file = out_a.string()});
}

std::vector<ObservationProduct> difference_products(const ScoreSide& side_a, const ScoreSide& side_b) {
  const auto [a, b] = readers_of(side_a, side_b);
  const auto of_a = kept_voxels(a);
  const auto of_b = kept_voxels(b);
  std::vector<ObservationProduct> out;
  for (std::size_t o = 0; o < side_a.observations.size(); ++o) {
    Difference difference(side_a.observations[o]);
    for (std::size_t p = 0; p < side_a.observations[o].pings.size(); ++p) {
      const auto ping = static_cast<std::int64_t>(p);
      const auto there = ping_at(b.in, a.time(o, ping));
      if (there) difference.add(ping, mask_at(of_a, {o, ping}), mask_at(of_b, *there));
    }
    out.push_back(difference.take());
  }
  return out;
}

}  // namespace sonar
