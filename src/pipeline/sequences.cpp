// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>

#include "pipeline/observations.h"

namespace sonar {
namespace {

std::string file_name(const SurveyFile& file) { return file.path.filename().string(); }

bool same_content(const RawIndex& a, const RawIndex& b) {
  return a.size == b.size && a.hash == b.hash &&
         std::equal(a.pings.begin(), a.pings.end(), b.pings.begin(), b.pings.end(),
                    [](const PingEntry& p, const PingEntry& q) { return p.time == q.time && p.offset == q.offset; });
}

/// Marks files that are whole copies of another. The one with the shortest name stays: copies are named "x (copy)",
/// "x-old".
std::vector<bool> find_copies(SurveyFiles& survey) {
  const auto& files = survey.files;
  std::map<std::string, std::vector<std::size_t>> by_hash;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!files[i].index.pings.empty()) by_hash[files[i].index.hash].push_back(i);
  }
  std::vector<bool> copy(files.size(), false);
  for (auto& [hash, group] : by_hash) {
    std::sort(group.begin(), group.end(), [&](std::size_t a, std::size_t b) {
      const auto key = [&](std::size_t i) {
        const std::string name = file_name(files[i]);
        return std::tuple(name.size(), name, i);
      };
      return key(a) < key(b);
    });
    for (std::size_t k = 1; k < group.size(); ++k) {
      if (!same_content(files[group[0]].index, files[group[k]].index)) continue;
      copy[group[k]] = true;
      survey.diagnostics.push_back({DiagnosticCode::duplicate_file, files[group[k]].index.name, -1, -1,
                                    fmt::format("the same content as {}", file_name(files[group[0]]))});
    }
  }
  return copy;
}

/// Keeps each instant once: the ping with the most channels, else the one that comes first.
void drop_repeats(SurveyFiles& survey, SounderSequence& sequence) {
  auto& pings = sequence.pings;
  std::vector<std::size_t> order(pings.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const PingEntry& p = survey.entry(pings[a]);
    const PingEntry& q = survey.entry(pings[b]);
    return std::tuple(p.time, -int{p.channels}, a) < std::tuple(q.time, -int{q.channels}, b);
  });
  std::vector<bool> drop(pings.size(), false);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::int64_t> repeats;  // (dropped, kept) file -> pings
  std::size_t kept = 0;
  for (std::size_t k = 1; k < order.size(); ++k) {
    const SurveyPing& ping = pings[order[k]];
    if (survey.entry(ping).time != survey.entry(pings[order[kept]]).time) {
      kept = k;
      continue;
    }
    drop[order[k]] = true;
    ++repeats[{ping.file, pings[order[kept]].file}];
  }
  for (const auto& [files, count] : repeats) {
    const SurveyFile& other = survey.files[files.second];
    survey.diagnostics.push_back(
        {DiagnosticCode::repeated_ping, survey.files[files.first].index.name, -1, -1,
         fmt::format("{} pings have the time stamps of others in {}", count, file_name(other))});
  }
  std::size_t to = 0;
  for (std::size_t i = 0; i < pings.size(); ++i) {
    if (!drop[i]) pings[to++] = pings[i];
  }
  pings.resize(to);
}

}  // namespace

std::vector<SounderSequence> sequences_of(SurveyFiles& survey) {
  const std::vector<bool> copy = find_copies(survey);
  // MS70 first, the others by kind and name.
  std::map<std::tuple<bool, SounderKind, std::string>, SounderSequence> sequences;
  for (std::uint32_t f = 0; f < survey.files.size(); ++f) {
    if (copy[f]) continue;
    const RawIndex& index = survey.files[f].index;
    std::vector<SounderSequence*> of_config;
    for (const SounderConfig& config : index.configs) {
      auto& sequence = sequences[{config.kind != SounderKind::ms70, config.kind, config.sounder_name}];
      sequence.kind = config.kind;
      sequence.sounder = config.sounder_name;
      of_config.push_back(&sequence);
    }
    for (std::uint32_t e = 0; e < index.pings.size(); ++e) of_config[index.pings[e].config]->pings.push_back({f, e});
  }
  std::vector<SounderSequence> result;
  for (auto& [key, sequence] : sequences) {
    drop_repeats(survey, sequence);
    if (!sequence.pings.empty()) result.push_back(std::move(sequence));
  }
  return result;
}

}  // namespace sonar
