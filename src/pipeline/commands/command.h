// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "pipeline/journal/journal.h"
#include "pipeline/journal/manual.h"
#include "pipeline/recipe/recipe.h"

namespace sonar {

// What a human may do, one struct a journal command. A line's ping_time is the ping that it was done on; schools are
// named by any one of their voxels. Each struct holds the outcome of a choice, never the way to it.

/// Most bytes of a text that a human gives, which is one line without control characters.
inline constexpr std::size_t kMostTextBytes = 4096;

/// Voxels of one channel, by their lasting keys.
struct RunKey {
  int channel = 0;
  int sample = 0;  ///< the first
  int count = 1;
  friend bool operator==(const RunKey&, const RunKey&) = default;
};

/// What a growth does to a school.
enum class GrowTo { school, add, take_away, replace };
inline constexpr std::array<std::string_view, 4> kGrowToNames{"new", "add", "take_away", "replace"};

/// `grow`: clicks on one ping, grown and joined: a new school, more or less of one that is there, or what that one has in
/// this ping from now on.
struct GrowCommand {
  GrowTo to = GrowTo::school;
  GrowParams grow;
  TransferFunction growth_curve;
  std::vector<SeedKey> seeds;
  std::optional<SchoolKey> school;  ///< for add, take_away and replace
};

/// `brush`: voxels join a school, or make a new one; whoever had them loses them.
struct BrushCommand {
  std::vector<RunKey> runs;
  std::optional<SchoolKey> school;  ///< empty = a new school
};

/// `erase`: voxels leave a school, or all schools of the ping.
struct EraseCommand {
  std::vector<RunKey> runs;
  std::optional<SchoolKey> school;  ///< empty = every school
};

enum class Reshaping { fill_holes, smooth, largest_part };
inline constexpr std::array<std::string_view, 3> kReshapingNames{"fill_holes", "smooth", "largest_part"};

/// `fill_holes`, `smooth`, `largest_part`: of a school in the line's ping, or in all its pings.
struct ReshapeCommand {
  Reshaping what = Reshaping::fill_holes;
  SchoolKey school;
  bool all_pings = false;
};

/// `merge`: all become the first.
struct MergeCommand {
  std::vector<SchoolKey> schools;  ///< 2 or more
};

/// `split`: without a seed the line's ping and all later ones become a new school; with one the piece that holds it, and
/// the pieces of other pings that lie upon it.
struct SplitCommand {
  SchoolKey school;
  std::optional<SeedKey> seed;
};

/// `hand_over`: what a school has in pings of these times (datagram clock, both included) becomes another's, voxel by voxel.
struct HandOverCommand {
  SchoolKey school;
  std::optional<SchoolKey> to;  ///< empty = a new school
  TimeNs first = 0;
  TimeNs last = 0;
};

/// `delete`: the school is no more.
struct DeleteCommand {
  SchoolKey school;
};

inline constexpr std::array<std::string_view, 4> kStatusNames{"unreviewed", "accepted", "corrected", "rejected"};

/// One school's review. Members that are empty leave what is there.
struct Decision {
  SchoolKey school;
  std::optional<std::string> status;  ///< one of kStatusNames
  std::optional<std::string> species;
  std::optional<std::string> comment;
  std::optional<std::string> name = {};
};

/// `decide`, `species`, `comment`, `rename`: one decision; `bulk_decide`: of several schools, which a human selected or a
/// rule chose.
struct DecideCommand {
  std::vector<Decision> decisions;
  std::string rule;  ///< of bulk_decide, for people; empty = a human selected them
};

inline constexpr std::array<std::string_view, 5> kEventKindNames{"trawl", "station", "noise", "other", "bookmark"};

/// `event`: a mark on the timeline.
struct EventCommand {
  std::string kind = "other";
  TimeNs time = 0;  ///< datagram clock
  std::string text;
  std::string view = {};  ///< of a bookmark: what was looked at, a JSON object; empty = no more than the ping
  friend bool operator==(const EventCommand&, const EventCommand&) = default;
};

/// `bad_ping`, `bad_interval`: pings of these times (datagram clock, both included) take no part in measures.
struct BadPingsCommand {
  TimeNs first = 0;
  TimeNs last = 0;
  friend bool operator==(const BadPingsCommand&, const BadPingsCommand&) = default;
};

/// `remove_event`: a mark with these three members is no more.
struct RemoveEventCommand {
  EventCommand event;
};

/// `good_interval`: pings of these times (datagram clock, both included) take part in measures again.
struct GoodPingsCommand {
  TimeNs first = 0;
  TimeNs last = 0;
};

/// `calibrate`: Sv and measures follow another calibration than the recipe's; masks and decisions stay, and every other
/// line, later ones too, is carried out under the recipe.
struct CalibrateCommand {
  CalibrationParams calibration;
  std::string file;  ///< where it was read, for people
};

/// `detect`: schools of the line's observation are looked for without a human; every other line is laid upon what is found,
/// whether it came before or after.
struct DetectCommand {
  /// How many were found: their numbers are theirs, also before they are found again. 0 = not known.
  std::int64_t schools = 0;
};

using Command = std::variant<PropagateCommand, GrowCommand, BrushCommand, EraseCommand, ReshapeCommand, MergeCommand,
                             SplitCommand, HandOverCommand, DeleteCommand, DecideCommand, EventCommand, BadPingsCommand,
                             RemoveEventCommand, GoodPingsCommand, CalibrateCommand, DetectCommand>;

/// A command as a journal holds it.
struct JournalAct {
  std::int64_t n = 0;
  TimeNs decided = 0;
  std::string operator_name;
  TimeNs ping_time = 0;
  Command command;
};

/// What an act is about, and so where it holds.
enum class About {
  ping,     ///< masks, from the line's ping on: of the observation that has it
  schools,  ///< schools, each named by its own ping
  times,    ///< times on the clock of the datagrams: whoever has them, without a mask
  survey,   ///< all of it, without a mask
};
[[nodiscard]] About about(const Command& command);
/// False: it can be carried out where no ping can be read.
[[nodiscard]] bool needs_masks(const Command& command);

/// Its name in the journal, "propagate" ...
[[nodiscard]] std::string command_name(const Command& command);
/// Whether a command of this name is a DecideCommand.
[[nodiscard]] bool is_decision(std::string_view name);
/// Members of a journal line's args.
[[nodiscard]] nlohmann::json to_json(const Command& command);
/// errors  format, bad_parameter: naming the member; unsupported: a command of another version
[[nodiscard]] Result<Command> command_from_json(std::string_view name, const nlohmann::json& args, TimeNs ping_time);

[[nodiscard]] JournalLine line_of(const JournalAct& act);
/// errors  as command_from_json()
[[nodiscard]] Result<JournalAct> act_of(const JournalLine& line);

/// What an act did, for people: words, then the name of a school where one is meant, then the end.
struct Sentence {
  std::string words;                ///< "take away from"
  std::optional<SchoolKey> school;  ///< that is meant
  bool makes_school = false;        ///< the one that it made is meant
  std::string end;                  ///< " anew"
};
[[nodiscard]] Sentence sentence_of(const Command& command);

/// Where on the clock of the datagrams an act says something.
struct TimeSpan {
  TimeNs first = 0;
  TimeNs last = 0;
};
/// Of what it is about beside its ping: schools, times, the survey.
[[nodiscard]] std::vector<TimeSpan> spoken_times(const Command& command);

/// A line of a journal and what it asks for: whoever needs both reads it once.
struct ReadLine {
  JournalLine line;
  Result<JournalAct> act;
};
[[nodiscard]] ReadLine read_line(const JournalLine& line);

/// Effective lines, each read once. A value: copies share what was read.
class ReadJournal {
 public:
  ReadJournal() = default;
  ReadJournal(std::span<const JournalLine> lines);    // NOLINT(google-explicit-constructor): the same, read
  ReadJournal(const std::vector<JournalLine>& lines)  // NOLINT(google-explicit-constructor)
      : ReadJournal(std::span<const JournalLine>(lines)) {}
  [[nodiscard]] std::span<const ReadLine> lines() const {
    return lines_ ? std::span<const ReadLine>(*lines_) : std::span<const ReadLine>{};
  }

 private:
  std::shared_ptr<const std::vector<ReadLine>> lines_;
};

/// Its ping, and the spoken times of its act.
[[nodiscard]] std::vector<TimeSpan> times_of(const ReadLine& read);

/// Whether effective lines ask for detection in the observation that has these pings.
/// times  [ping_index], datagram times, rising
[[nodiscard]] bool asks_for_detection(std::span<const JournalLine> lines, std::span<const TimeNs> times);
[[nodiscard]] bool asks_for_detection(std::span<const ReadLine> lines, std::span<const TimeNs> times);

}  // namespace sonar
