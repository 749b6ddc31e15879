// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/journals.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "pipeline/journal/session_recipe.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kApart = std::int64_t{1} << 40;

/// A number that somebody made up to overflow stays as it is.
std::int64_t sum(std::int64_t n, std::int64_t by) {
  std::int64_t moved = 0;
  return __builtin_add_overflow(n, by, &moved) ? n : moved;
}

JournalLine moved(JournalLine line, std::int64_t by) {
  if (by == 0) return line;
  line.n = sum(line.n, by);
  if (line.step != 0) line.step = sum(line.step, by);
  if (const auto target = line.args->find("target"); target != line.args->end() && target->is_number_integer()) {
    *target = sum(target->get<std::int64_t>(), by);
  }
  return line;
}

/// Of session.jsonl 1, of session-17.jsonl 17.
std::optional<std::int64_t> journal_number(std::string_view name) {
  constexpr std::string_view kBegin = "session";
  constexpr std::string_view kEnd = ".jsonl";
  if (!name.starts_with(kBegin) || !name.ends_with(kEnd) || name.size() < kBegin.size() + kEnd.size()) return {};
  name = name.substr(kBegin.size(), name.size() - kBegin.size() - kEnd.size());
  if (name.empty()) return 1;
  if (name.front() != '-') return {};
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(name.data() + 1, name.data() + name.size(), number);
  const bool whole = error == std::errc{} && end == name.data() + name.size() && name[1] != '0';
  return whole && number >= 2 && number <= kMostJournals ? std::optional(number) : std::nullopt;
}

}  // namespace

fs::path journal_name(const fs::path& folder, std::int64_t number) {
  return folder / (number == 1 ? "session.jsonl" : fmt::format("session-{}.jsonl", number));
}

fs::path journal_lock(const fs::path& journal) {
  return journal.parent_path() / kLocks / (journal.filename().string() + ".lock");
}

std::vector<OneJournal> journals_in(std::span<const fs::path> folders) {
  std::vector<OneJournal> journals;
  for (std::int64_t f = 0; f < std::ssize(folders); ++f) {
    const fs::path& folder = folders[static_cast<std::size_t>(f)];
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
      const auto number = journal_number(it->path().filename().string());
      if (number) journals.push_back({it->path(), f * kMostJournals + *number - 1});
    }
  }
  std::ranges::sort(journals, {}, &OneJournal::place);
  return journals;
}

std::int64_t place_of(std::int64_t n) { return (n - 1) / kApart; }
std::int64_t first_number(std::int64_t place) { return place * kApart + 1; }

JournalLine among_all(JournalLine line, std::int64_t place) { return moved(std::move(line), place * kApart); }
JournalLine as_written(JournalLine line, std::int64_t place) { return moved(std::move(line), -place * kApart); }

std::string line_title(std::int64_t n) {
  const std::int64_t place = place_of(n);
  return place <= 0 ? std::to_string(n) : fmt::format("{}:{}", place + 1, n - place * kApart);
}

std::vector<JournalLine> joined(std::vector<std::vector<JournalLine>> lines) {
  if (lines.size() == 1) return std::move(lines.front());
  std::vector<JournalLine> all;
  std::vector<std::size_t> next(lines.size(), 0);
  for (;;) {
    std::size_t first = lines.size();
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (next[i] == lines[i].size()) continue;
      if (first == lines.size() || lines[i][next[i]].decided < lines[first][next[first]].decided) first = i;
    }
    if (first == lines.size()) return all;
    all.push_back(std::move(lines[first][next[first]++]));
  }
}

Result<Journal> read_one(const fs::path& path) {
  std::error_code absent;
  if (fs::is_symlink(fs::symlink_status(path, absent))) {
    return fail(ErrorCode::io, "is a link: nothing is written through it", {path.string()});
  }
  if (fs::exists(path, absent) && fs::file_size(path, absent) == 0) return Journal{};
  return read_journal(path.string());
}

namespace {

Result<Journal> read_journals(const fs::path& folder) {
  const std::vector<OneJournal> journals = journals_in(std::span(&folder, 1));
  if (journals.empty()) return fail(ErrorCode::not_found, "holds no journal (session.jsonl)", {folder.string()});
  Journal session;
  std::vector<std::vector<JournalLine>> lines;
  for (const OneJournal& one : journals) {
    auto journal = read_one(one.path);
    if (!journal) return pass_on(journal);
    for (JournalLine& line : journal->lines) line = among_all(std::move(line), one.place);
    lines.push_back(std::move(journal->lines));
    session.diagnostics.insert(session.diagnostics.end(), journal->diagnostics.begin(), journal->diagnostics.end());
    if (!session.recipe.empty()) continue;
    session.recipe = journal->recipe;
    session.recipe_hash = journal->recipe_hash;
    session.files = journal->files;
  }
  session.lines = joined(std::move(lines));
  return session;
}

}  // namespace

Result<Journal> read_session(const fs::path& path) {
  std::error_code absent;
  const bool whole = fs::is_directory(path, absent);
  auto session = whole ? read_journals(path) : read_journal(path.string());
  if (!session) return session;
  const fs::path folder = whole ? path : path.parent_path();
  const auto chosen = kept_recipe(std::span(&folder, 1));
  if (!chosen) return pass_on(chosen);
  if (*chosen) {
    Recipe recipe = **chosen;
    recipe.automatic = false;  // the session's lines say where schools are detected
    session->recipe = recipe_text(recipe);
    session->recipe_hash = recipe_hash(recipe);
  }
  return session;
}

}  // namespace sonar
