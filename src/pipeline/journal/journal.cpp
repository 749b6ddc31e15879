// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/hash.h"
#include "io/atomic_file.h"
#include "pipeline/journal/journals.h"
#include "pipeline/recipe/json_file.h"

namespace sonar {
namespace {

/// A file's name may be no UTF-8.
std::string one_line(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string checksum(const nlohmann::json& json) {
  return fmt::format("{:08x}", static_cast<std::uint32_t>(hash_text(one_line(json)).low));
}

std::string sealed(nlohmann::json json) {
  json["crc"] = checksum(json);
  return one_line(json);
}

/// Takes the check sum off; empty where it is missing or wrong.
std::optional<nlohmann::json> unsealed(const nlohmann::json& json) {
  if (!json.is_object() || !json.contains("crc") || !json["crc"].is_string()) return std::nullopt;
  nlohmann::json rest = json;
  rest.erase("crc");
  if (checksum(rest) != json["crc"].get<std::string>()) return std::nullopt;
  return rest;
}

std::optional<JournalLine> line_from_json(const nlohmann::json& json) {
  const auto has = [&](const char* member, bool (nlohmann::json::*test)() const noexcept) {
    return json.contains(member) && (json[member].*test)();
  };
  constexpr std::int64_t kMost = std::int64_t{1}
                                 << 53;  // beyond it other programs lose the last digit, and we the next
  const auto n = json.contains("n") ? whole_number(json["n"], 1, kMost) : std::nullopt;
  const auto ping_time = json.contains("ping_time") ? whole_number(json["ping_time"]) : std::nullopt;
  if (!n || !ping_time || !has("cmd", &nlohmann::json::is_string) || !has("args", &nlohmann::json::is_object)) {
    return std::nullopt;
  }
  JournalLine line;
  line.n = *n;
  line.command = json["cmd"].get<std::string>();
  line.ping_time = *ping_time;
  *line.args = json["args"];
  if (json.contains("step")) line.step = whole_number(json["step"]).value_or(0);
  if (has("operator", &nlohmann::json::is_string)) line.operator_name = json["operator"].get<std::string>();
  if (has("t", &nlohmann::json::is_string)) line.decided = time_from_iso(json["t"].get<std::string>()).value_or(0);
  return line;
}

Result<Journal> head_from_json(const nlohmann::json& json) {
  if (!json.is_object()) return fail(ErrorCode::format, "line 1: expected a JSON object with journal_version");
  if (auto version = check_version(json, "journal_version", kJournalVersion); !version) return pass_on(version);
  Journal journal;
  if (json.contains("recipe_hash") && json["recipe_hash"].is_string()) {
    journal.recipe_hash = json["recipe_hash"].get<std::string>();
  }
  if (json.contains("recipe") && json["recipe"].is_object()) journal.recipe = json["recipe"].dump(2) + "\n";
  if (!json.contains("files") || !json["files"].is_array()) return journal;
  for (const auto& file : json["files"]) {
    const bool whole = file.is_object() && file.contains("name") && file["name"].is_string() && file.contains("size") &&
                       file["size"].is_number_unsigned() && file.contains("hash") && file["hash"].is_string();
    if (!whole) continue;
    journal.files.push_back(
        {file["name"].get<std::string>(), file["size"].get<std::uint64_t>(), file["hash"].get<std::string>()});
  }
  return journal;
}

}  // namespace

std::string journal_text(const JournalLine& line) {
  nlohmann::json json = {{"n", line.n},
                         {"t", line.decided == 0 ? std::string{} : iso_time(line.decided)},
                         {"operator", line.operator_name},
                         {"cmd", line.command},
                         {"ping_time", line.ping_time},
                         {"args", *line.args}};
  if (line.step != 0) json["step"] = line.step;
  return sealed(std::move(json));
}

std::string said_of(const JournalLine& line) {
  return fmt::format("choice {} ({}): ", line_title(line.n), line.command);
}

std::string journal_head_text(const Journal& journal) {
  nlohmann::json files = nlohmann::json::array();
  for (const InputFile& file : journal.files) {
    files.push_back({{"name", file.name}, {"size", file.size}, {"hash", file.hash}});
  }
  nlohmann::json head = {
      {"journal_version", kJournalVersion}, {"recipe_hash", journal.recipe_hash}, {"files", std::move(files)}};
  if (auto recipe = parse_json(journal.recipe)) head["recipe"] = std::move(*recipe);
  return sealed(std::move(head));
}

namespace {

Result<Journal> head_of(const Result<nlohmann::json>& json, const std::string& file) {
  auto journal = json ? head_from_json(*json) : Result<Journal>(pass_on(json));
  if (!journal) return fail(journal.error().code, journal.error().text, {file, 0});
  if (!unsealed(*json)) {
    journal->diagnostics.push_back({DiagnosticCode::journal_line, file, 0, -1, "line 1 was changed by another hand"});
  }
  return journal;
}

std::optional<JournalLine> line_of_text(std::string_view text) {
  const auto json = parse_json(text);
  const auto whole = json ? unsealed(*json) : std::nullopt;
  return whole ? line_from_json(*whole) : std::nullopt;
}

}  // namespace

Result<Journal> parse_journal(std::string_view text, const std::string& file) {
  if (text.empty()) return fail(ErrorCode::format, "is empty, expected a journal", {file, 0});
  std::size_t end = std::min(text.find('\n'), text.size());
  const auto json = parse_json(text.substr(0, end));
  auto head = head_of(json, file);
  // What a newer program wrote may mean something else; behind a broken head, as its own check sum tells, the lines have
  // check sums of their own.
  if (!head && head.error().code == ErrorCode::newer_version && json && unsealed(*json)) return head;
  Journal journal = head ? std::move(*head) : Journal{};
  if (!head) {
    journal.diagnostics.push_back(
        {DiagnosticCode::journal_line, file, 0, -1, "line 1, which says the recipe, is broken: " + head.error().text});
  }
  for (int number = 2; end + 1 < text.size(); ++number) {
    const std::size_t begin = end + 1;
    end = std::min(text.find('\n', begin), text.size());
    if (auto line = line_of_text(text.substr(begin, end - begin))) {
      journal.lines.push_back(std::move(*line));
    } else {
      journal.diagnostics.push_back({DiagnosticCode::journal_line, file, static_cast<std::int64_t>(begin), -1,
                                     fmt::format("line {} is broken and was left out", number)});
    }
  }
  if (!head && journal.lines.empty()) return head;
  return journal;
}

Result<Journal> read_journal(const std::string& path) {
  const auto text = read_file(path);
  if (!text) return pass_on(text);
  return parse_journal(*text, path);
}

Result<void> append_journal(const std::string& path, const Journal& head, const JournalLine& line) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0644);
  if (file < 0) return refused_write("could not be written", errno, path);
  struct stat kind {};
  if (::fstat(file, &kind) != 0 || !S_ISREG(kind.st_mode)) {
    ::close(file);
    return fail(ErrorCode::io, "is not a file", {path});
  }
  const off_t size = kind.st_size;
  // A line that a crash cut short must not swallow the next one.
  char last = '\n';
  const bool cut = size > 0 && ::pread(file, &last, 1, size - 1) == 1 && last != '\n';
  const std::string before = size == 0 ? journal_head_text(head) + "\n" : std::string(cut ? "\n" : "");
  const std::string text = before + journal_text(line) + "\n";
  int error = write_all(file, text);
  if (error == 0 && ::fsync(file) != 0) error = errno;
  // Who is refused must find the journal as it was: half a line, or a whole one that nobody knows of, must not stay.
  const bool restored = error == 0 || (size == 0 ? ::unlink(path.c_str()) : ::ftruncate(file, size)) == 0;
  ::close(file);
  if (error == 0) return {};
  auto refused = refused_write("could not be written", error, path);
  if (!restored) refused.value().text += "; its last line may be cut short";
  return refused;
}

std::vector<JournalLine> effective_lines(const std::vector<JournalLine>& lines) {
  std::map<std::int64_t, bool> undone;
  for (const JournalLine& line : lines) {
    if (line.command != "undo" && line.command != "redo") continue;
    const auto target = line.args->contains("target") ? whole_number((*line.args)["target"]) : std::nullopt;
    if (target) undone[*target] = line.command == "undo";
  }
  std::vector<JournalLine> kept;
  for (const JournalLine& line : lines) {
    if (line.command == "undo" || line.command == "redo") continue;
    const auto found = undone.find(line.n);
    if (found == undone.end() || !found->second) kept.push_back(line);
  }
  return kept;
}

}  // namespace sonar
