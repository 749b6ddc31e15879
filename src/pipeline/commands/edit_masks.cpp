// SPDX-License-Identifier: Apache-2.0
// Commands on the voxels of one ping.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/units.h"
#include "pipeline/commands/edit.h"
#include "school/grow/grow.h"
#include "school/grow/mask_edit.h"

namespace sonar {
namespace {

/// Lowest Sv that could be a member, dB; NaN where opacity decides.
double threshold_of(const GrowCommand& command, const CommandContext& context, const FilteredPing& ping) {
  if (command.grow.mode == GrowMode::paper) return kUnknown;
  const std::vector<int> rows = context.grid->row_of_channel();
  double lowest = kUnknown;
  for (const SeedKey& seed : command.seeds) {  // growing has refused seeds outside the grid
    const auto row = ping.volume->counts.view().row(rows[static_cast<std::size_t>(seed.channel)]);
    const double level_db = db_from_counts(row[static_cast<std::size_t>(seed.sample)]);
    lowest = std::fmin(lowest, level_db - command.grow.tolerance_db);
  }
  return lowest;
}

SchoolMasks one_ping(std::int64_t ping_index, PingMask mask, double threshold_db) {
  SchoolMasks school;
  school.decided.origin = "manual";
  school.pings.push_back({ping_index, std::move(mask), threshold_db});
  return school;
}

Result<PingMask> reshaped(Reshaping what, const PingMask& mask, const FilteredPing& ping) {
  const auto flags = ping.volume->flags.view();
  switch (what) {
    case Reshaping::fill_holes:
      return fill_holes(mask, flags);
    case Reshaping::smooth:
      return smoothed(mask, flags);
    case Reshaping::largest_part:
      break;
  }
  return largest_part(mask, flags.shape(), Connectivity::faces);
}

}  // namespace

Result<void> carry_out(Edit& edit, const GrowCommand& command) {
  std::optional<std::size_t> school;
  if (command.school) {
    const auto found = edit.find(*command.school);
    if (!found) return pass_on(found);
    school = *found;
  }
  const bool anew = command.to == GrowTo::replace;
  if (anew && edit.mask(*school, edit.ping()).empty()) {
    return fail(ErrorCode::bad_parameter, "the school is not in this ping");
  }
  auto ping = edit.context().ping(edit.ping());
  if (!ping) return pass_on(ping);
  const bool away = command.to == GrowTo::take_away;
  ping->taken = away ? PingMask{} : edit.taken(edit.ping(), school);
  auto grown = grow_seeds(edit.context(), *ping, command.seeds, command.growth_curve, command.grow);
  if (!grown) return pass_on(grown);
  if (grown->empty()) return fail(ErrorCode::bad_parameter, "all voxels there belong to other schools");
  if (away) {
    edit.touch(*school);
    edit.set_mask(*school, edit.ping(), subtract(edit.mask(*school, edit.ping()), *grown));
    return {};
  }
  const double threshold_db = threshold_of(command, edit.context(), *ping);
  const auto before = school ? edit.state().schools[*school]->grown : nullptr;
  if (school) {
    edit.touch(*school);
    if (anew) edit.set_mask(*school, edit.ping(), {});  // its threshold goes with it
    edit.set_mask(*school, edit.ping(), unite(edit.mask(*school, edit.ping()), *grown), threshold_db);
  } else {
    school = edit.add(one_ping(edit.ping(), *grown, threshold_db));
  }
  const bool again = anew && before && before->ping_index == edit.ping();
  if (again || !command.school) {
    // Grown again, it keeps what followed until that is done again too.
    edit.set_grown(*school, std::make_shared<const GrownFrom>(GrownFrom{
                                edit.ping(), command, again ? before->followed : std::vector<PropagateCommand>{}}));
  }
  edit.take(edit.ping(), *grown, *school, true);
  return {};
}

namespace {

/// What brush and eraser pass over in the line's ping: voxels that can belong to a school.
Result<PingMask> stroke_of(Edit& edit, const std::vector<RunKey>& runs) {
  const auto ping = edit.context().ping(edit.ping());
  if (!ping) return pass_on(ping);
  auto rows = edit.rows_of(runs, ping->volume->flags.shape());
  if (!rows) return pass_on(rows);
  return brushed(std::move(*rows), ping->volume->flags.view());
}

}  // namespace

Result<void> carry_out(Edit& edit, const BrushCommand& command) {
  std::optional<std::size_t> school;
  if (command.school) {
    const auto found = edit.find(*command.school);
    if (!found) return pass_on(found);
    school = *found;
  }
  const auto made = stroke_of(edit, command.runs);
  if (!made) return pass_on(made);
  const PingMask& stroke = *made;
  if (stroke.empty()) return fail(ErrorCode::bad_parameter, "no voxel there can belong to a school");
  if (school) {
    edit.touch(*school);
    edit.set_mask(*school, edit.ping(), unite(edit.mask(*school, edit.ping()), stroke));
  } else {
    school = edit.add(one_ping(edit.ping(), stroke, kUnknown));
  }
  edit.take(edit.ping(), stroke, *school, false);
  return {};
}

Result<void> carry_out(Edit& edit, const EraseCommand& command) {
  std::optional<std::size_t> school;
  if (command.school) {
    const auto found = edit.find(*command.school);
    if (!found) return pass_on(found);
    school = *found;
  }
  const auto made = stroke_of(edit, command.runs);
  if (!made) return pass_on(made);
  const PingMask& stroke = *made;
  for (std::size_t i = 0; i < edit.state().schools.size(); ++i) {
    if ((school && i != *school) || overlap(edit.mask(i, edit.ping()), stroke) == 0) continue;
    edit.touch(i);
    edit.set_mask(i, edit.ping(), subtract(edit.mask(i, edit.ping()), stroke));
  }
  return {};
}

Result<void> carry_out(Edit& edit, const ReshapeCommand& command) {
  const auto school = edit.find(command.school);
  if (!school) return pass_on(school);
  std::vector<std::int64_t> pings;
  for (const SchoolMasks::InPing& there : edit.masks(*school).pings) {
    if (command.all_pings || there.ping_index == edit.ping()) pings.push_back(there.ping_index);
  }
  if (pings.empty()) return fail(ErrorCode::bad_parameter, "the school is not in this ping");
  edit.touch(*school);
  for (const std::int64_t ping_index : pings) {
    const auto ping = edit.context().ping(ping_index);
    if (!ping) return pass_on(ping);
    auto mask = reshaped(command.what, edit.mask(*school, ping_index), *ping);
    if (!mask) return pass_on(mask);
    const PingMask added = subtract(*mask, edit.mask(*school, ping_index));
    edit.set_mask(*school, ping_index, std::move(*mask));
    edit.take(ping_index, added, *school, false);
  }
  return {};
}

}  // namespace sonar
