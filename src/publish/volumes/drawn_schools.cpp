// SPDX-License-Identifier: Apache-2.0
#include "publish/volumes/drawn_schools.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "model/school_totals.h"
#include "model/strongest_ping.h"
#include "view/school_look.h"

namespace sonar {

namespace {

bool wanted(std::int64_t school_id, std::string_view status, const PictureOptions& options) {
  if (status == "rejected" && !options.display.rejected) return false;
  return options.schools.empty() ||
         std::find(options.schools.begin(), options.schools.end(), school_id) != options.schools.end();
}

}  // namespace

bool wanted(const ObservationProduct& product, std::int64_t school_id, const PictureOptions& options) {
  const auto row = std::find_if(product.schools.begin(), product.schools.end(),
                                [school_id](const SchoolRow& r) { return r.school_id == school_id; });
  return wanted(school_id, row == product.schools.end() ? std::string_view() : row->status, options);
}

std::optional<std::int64_t> strongest_schools_ping(const DrawnObservation& observation, const PictureOptions& options) {
  // The same whether schools are shown or not: a picture without them is to be laid beside the one with them.
  const SchoolPingRow* strongest = strongest_ping(
      observation.product(), [&](const SchoolRow& school) { return wanted(school.school_id, school.status, options); });
  if (strongest == nullptr || strongest->ping_index >= observation.pings()) return std::nullopt;
  return strongest->ping_index;
}

Result<std::int64_t> chosen_ping(const DrawnObservation& observation, const PictureOptions& options) {
  const std::int64_t count = observation.pings();
  if (count == 0) return fail(ErrorCode::usage, observation.name() + " has no pings");
  if (options.ping) {
    if (*options.ping >= 0 && *options.ping < count) return *options.ping;
    return fail(ErrorCode::usage,
                fmt::format("no ping {} in {}: it has pings 0 to {}", *options.ping, observation.name(), count - 1));
  }
  return strongest_schools_ping(observation, options).value_or(count / 2);
}

namespace {

Rgba8 colour_of(std::int64_t school_id, std::string_view status, const PictureOptions& options) {
  return status == "rejected" ? theme_of(options).muted : school_colour(static_cast<int>(school_id));
}
Rgba8 colour_of(const DrawnMask& drawn, const PictureOptions& options) {
  return colour_of(drawn.school_id, drawn.status, options);
}

/// Of something that outlives every picture of it.
template <class T>
std::shared_ptr<const T> borrowed(const T& owned) {
  return std::shared_ptr<const T>(std::shared_ptr<void>(), &owned);
}

}  // namespace

std::vector<DrawnSchoolKey> school_keys(const DrawnPing& ping, const PictureOptions& options) {
  std::vector<DrawnSchoolKey> keys;
  for (const DrawnMask& drawn : ping.masks) {
    if (!wanted(drawn.school_id, drawn.status, options)) continue;
    const char* comma = drawn.status.empty() ? "" : ", ";
    keys.push_back(
        {drawn.school_id, colour_of(drawn, options), drawn.status,
         drawn.part.empty() ? fmt::format("school {}{}{}", drawn.school_id, comma, drawn.status) : drawn.part});
  }
  return keys;
}

std::vector<MaskLayer> mask_layers(const DrawnPing& ping, const PictureOptions& options) {
  return options.display.masks ? chosen_layers(ping, options) : std::vector<MaskLayer>{};
}

std::vector<MaskLayer> chosen_layers(const DrawnPing& ping, const PictureOptions& options) {
  std::vector<MaskLayer> layers;
  for (const DrawnMask& drawn : ping.masks) {
    if (!wanted(drawn.school_id, drawn.status, options)) continue;
    const Rgba8 colour = colour_of(drawn, options);
    const auto share = [](std::uint8_t v) { return static_cast<float>(v) / 255.0F; };
    layers.push_back({drawn.mask, {share(colour.r), share(colour.g), share(colour.b)}, status_line(drawn.status)});
  }
  return layers;
}

std::vector<const PingMask*> casting_shadow(const DrawnPing& ping, const PictureOptions& options) {
  std::vector<const PingMask*> masks;
  for (const DrawnMask& drawn : ping.masks) {
    const bool shown = options.display.masks && wanted(drawn.school_id, drawn.status, options);
    if (shown && drawn.mask && drawn.status != "rejected") masks.push_back(drawn.mask.get());
  }
  return masks;
}

TrailSubject trail_subject(const DrawnObservation& observation, const PictureOptions& options) {
  const ObservationProduct& product = observation.product();
  TrailSubject out{borrowed(product.pings), observation.recipe().navigation.beams_stabilised, {}};
  if (!options.display.masks) return out;
  for (const SchoolRow& row : product.schools) {
    if (!wanted(row.school_id, row.status, options)) continue;
    TrailSchool school{
        borrowed(row), colour_of(row.school_id, row.status, options), options.selected_school == row.school_id, {}};
    // Sorted by school, then by ping.
    const auto found = std::ranges::equal_range(product.masks, row.school_id, {}, &SchoolMask::school_id);
    for (const SchoolMask& mask : found) school.pings.push_back({mask.ping_index, &mask.mask});
    out.schools.push_back(std::move(school));
  }
  return out;
}

std::vector<RefusedMark> drawn_refused(const DrawnObservation& observation, const Sector& sector,
                                       std::int64_t ping_index, const PictureOptions& options) {
  const ObservationProduct& product = observation.product();
  if (!options.display.refused_echoes || !product.grid) return {};
  return refused_marks(product.rejected, ping_index, product.grid->grid, sector);
}

std::optional<MaskMiddle> middle_of_largest(const std::vector<MaskLayer>& masks, int beams) {
  const auto largest = std::max_element(masks.begin(), masks.end(), [](const MaskLayer& a, const MaskLayer& b) {
    return a.mask->voxels() < b.mask->voxels();
  });
  return largest == masks.end() ? std::nullopt : mask_middle(*largest->mask, beams);
}

namespace {

/// Rows of one school continue the first of them that is drawn: what they continued may not be.
void hang_together(std::span<ObservationProduct> products, const PictureOptions& options) {
  std::vector<SchoolRow*> rows;
  for (ObservationProduct& product : products) {
    for (SchoolRow& row : product.schools) rows.push_back(&row);
  }
  const std::vector<int> chains = chains_of(std::vector<const SchoolRow*>(rows.begin(), rows.end()));
  std::map<int, SchoolRow*> heads;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!wanted(rows[i]->school_id, rows[i]->status, options)) continue;
    SchoolRow*& head = heads[chains[i]];
    if (head == nullptr || (rows[i]->continues.empty() && !head->continues.empty())) head = rows[i];
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!wanted(rows[i]->school_id, rows[i]->status, options)) continue;
    const SchoolRow* head = heads[chains[i]];
    rows[i]->continues = rows[i] == head ? std::string{} : school_name(head->observation, head->school_id);
  }
}

}  // namespace

std::vector<ObservationProduct> with_chosen_schools(std::vector<ObservationProduct> products,
                                                    const PictureOptions& options) {
  hang_together(products, options);
  for (ObservationProduct& chosen : products) {
    const auto unwanted = [&](std::int64_t id) { return !options.display.masks || !wanted(chosen, id, options); };
    std::erase_if(chosen.masks, [&](const SchoolMask& mask) { return unwanted(mask.school_id); });
    std::erase_if(chosen.school_pings, [&](const SchoolPingRow& row) { return unwanted(row.school_id); });
    std::erase_if(chosen.schools, [&](const SchoolRow& row) {
      return !options.display.masks || !wanted(row.school_id, row.status, options);
    });
  }
  return products;
}

ObservationProduct with_chosen_schools(const ObservationProduct& product, const PictureOptions& options) {
  return std::move(with_chosen_schools(std::vector{product}, options).front());
}

Result<void> require_schools(const DrawnObservation& observation, const PictureOptions& options) {
  for (const std::int64_t school : options.schools) {
    if (!observation.has_product()) {
      return fail(ErrorCode::usage, fmt::format("school {}: schools stand in products, and none was named", school));
    }
    const bool known = std::any_of(observation.product().schools.begin(), observation.product().schools.end(),
                                   [school](const SchoolRow& row) { return row.school_id == school; });
    if (!known) return fail(ErrorCode::usage, fmt::format("no school {} in {}", school, observation.name()));
  }
  return {};
}

}  // namespace sonar
