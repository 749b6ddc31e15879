// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/taken_lines.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

#include "io/atomic_file.h"
#include "pipeline/journal/journals.h"
#include "pipeline/journal/named_lock.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// What tells a choice from others, whatever its number.
auto identity_of(const JournalLine& line) {
  return std::tuple(line.decided, line.ping_time, line.operator_name, line.command, line.args->dump());
}

/// Those that the journals of a place do not have.
std::vector<JournalLine> lacking(const JournalPlace& place, std::vector<JournalLine> lines) {
  std::set<decltype(identity_of(JournalLine{}))> known;
  for (const JournalLine& line : place.lines) known.insert(identity_of(line));
  std::erase_if(lines, [&](const JournalLine& line) { return known.contains(identity_of(line)); });
  return lines;
}

/// The first that nobody has, held so that nobody begins it meanwhile.
Result<fs::path> next_journal(const fs::path& folder, const JournalLine& first, NamedLock& lock) {
  for (std::int64_t number = 1; number <= kMostJournals; ++number) {
    fs::path path = journal_name(folder, number);
    std::error_code absent;
    if (fs::exists(fs::symlink_status(path, absent))) continue;
    const auto taken = lock.take(journal_lock(path), first.operator_name, first.decided);
    if (!taken) return pass_on(taken);
    if (taken->held_by.empty() && !fs::exists(fs::symlink_status(path, absent))) return path;
    lock.let_go();
  }
  return fail(ErrorCode::io, "has no room for one more journal", {folder.string()});
}

/// The whole file at once: half of what somebody decided is nothing to work on.
std::string text_of(const Journal& head, std::vector<JournalLine> lines) {
  std::string text = journal_head_text(head) + "\n";
  std::int64_t n = 0;
  for (JournalLine& line : lines) {
    line.n = ++n;
    line.step = 1;
    text += journal_text(line) + "\n";
  }
  return text;
}

}  // namespace

Result<TakenLines> take_lines(const JournalPlace& place, const fs::path& from,
                              const std::function<bool(TimeNs)>& has_ping) {
  const auto session = read_session(from);
  if (!session) return pass_on(session);
  const std::vector<JournalLine> theirs = effective_lines(session->lines);
  if (std::ranges::none_of(theirs, [&](const JournalLine& line) { return has_ping(line.ping_time); })) return {};
  if (lacking(place, theirs).empty()) return {};
  const JournalLine& first = theirs.front();
  NamedLock taking;
  const auto alone = taking.take(journal_lock(place.folders.back() / "taking"), first.operator_name, first.decided);
  if (!alone) return pass_on(alone);
  if (!alone->held_by.empty()) return {};  // another window takes them
  JournalPlace now = place;
  (void)now.read_ours();
  (void)now.read_lines();  // another may have taken them meanwhile
  std::vector<JournalLine> lines = lacking(now, theirs);
  if (lines.empty()) return {};
  std::set<std::string> operators;
  for (const JournalLine& line : lines) operators.insert(line.operator_name);
  NamedLock lock;
  auto path = next_journal(place.folders.back(), first, lock);
  if (!path) return pass_on(path);
  const std::string text = text_of(place.journal, lines);
  if (auto written = write_file(*path, text, Beside::own_folder); !written) return pass_on(written);
  return TakenLines{lines.size(), std::move(*path), {operators.begin(), operators.end()}};
}

}  // namespace sonar
