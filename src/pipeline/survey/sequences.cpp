// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "pipeline/survey/observations.h"

namespace sonar {
namespace {

std::string file_name(const SurveyFile& file) { return file.path.filename().string(); }

bool same_content(const RawIndex& a, const RawIndex& b) {
  return a.size == b.size && a.hash == b.hash &&
         std::equal(a.pings.begin(), a.pings.end(), b.pings.begin(), b.pings.end(),
                    [](const PingEntry& p, const PingEntry& q) { return p.time == q.time && p.offset == q.offset; });
}

/// Marks files that are whole copies of another. The first by name stays.
std::vector<bool> find_copies(SurveyFiles& survey) {
  const auto& files = survey.files;
  std::map<std::string, std::vector<std::size_t>> by_hash;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!files[i].index.pings.empty()) by_hash[files[i].index.hash].push_back(i);
  }
  std::vector<bool> copy(files.size(), false);
  for (auto& [hash, group] : by_hash) {
    std::sort(group.begin(), group.end(), [&](std::size_t a, std::size_t b) {
      const auto key = [&](std::size_t i) { return std::pair(file_name(files[i]), i); };
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

/// Channels of a ping's parts that are taken so far.
struct Taken {
  SurveyPing first;
  std::size_t channels = 0;
  std::set<std::size_t> seen;  ///< channels of the parts' settings: at least those that are there
  std::size_t repeated = 0;    ///< channels that a further part has again
};

std::set<std::size_t> channels_seen(const TransmitSet& set) {
  std::set<std::size_t> channels;
  for (std::size_t c = 0; c < set.size(); ++c) {
    if (set[c].seen()) channels.insert(c);
  }
  return channels;
}

/// Takes what another part of the same instant adds; false where it adds nothing. The index knows how many channels a
/// part has, and which its setting has over all pings.
bool take_part(SurveyFiles& survey, const SurveyPing& part, Taken& taken) {
  const auto& configs = survey.files[taken.first.file].index.configs;
  const SounderConfig& config = configs[survey.entry(taken.first).config];
  const SounderConfig& other = survey.files[part.file].index.configs[survey.entry(part).config];
  const std::size_t channels = survey.entry(part).channels;
  const bool whole = !config.beams.empty() && taken.channels >= config.beams.size();
  if (whole || identity(config) != identity(other)) return false;
  std::set<std::size_t> seen = channels_seen(survey.transmit(part));
  seen.insert(taken.seen.begin(), taken.seen.end());
  if (seen == taken.seen && taken.channels == taken.seen.size()) return false;
  const std::size_t together = std::min(seen.size(), taken.channels + channels);
  taken.repeated += taken.channels + channels - together;
  taken.channels = together;
  taken.seen = std::move(seen);
  survey.further_parts[taken.first].push_back(part);
  return true;
}

/// Keeps each instant once: the ping with the most channels, else the one that comes first; other places add the
/// channels that it lacks.
void join_instants(SurveyFiles& survey, SounderSequence& sequence) {
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
  Taken taken;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const SurveyPing& ping = pings[order[k]];
    if (k == 0 || survey.entry(ping).time != survey.entry(taken.first).time) {
      taken = {ping, survey.entry(ping).channels, {}, 0};
      continue;
    }
    if (taken.seen.empty()) taken.seen = channels_seen(survey.transmit(taken.first));
    drop[order[k]] = true;
    const std::size_t repeated = taken.repeated;
    if (!take_part(survey, ping, taken) || taken.repeated > repeated) ++repeats[{ping.file, taken.first.file}];
  }
  for (const auto& [files, count] : repeats) {
    const SurveyFile& other = survey.files[files.second];
    survey.diagnostics.push_back(
        {DiagnosticCode::repeated_ping, survey.files[files.first].index.name, -1, -1,
         fmt::format("{} pings repeat time and channels of others in {}", count, file_name(other))});
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
  std::map<std::pair<bool, Sounder>, SounderSequence> sequences;
  for (std::uint32_t f = 0; f < survey.files.size(); ++f) {
    if (copy[f]) continue;
    const RawIndex& index = survey.files[f].index;
    std::vector<SounderSequence*> of_config;
    for (const SounderConfig& config : index.configs) {
      auto& sequence = sequences[{config.kind != SounderKind::ms70, sounder_of(config)}];
      sequence.sounder = sounder_of(config);
      of_config.push_back(&sequence);
    }
    for (std::uint32_t e = 0; e < index.pings.size(); ++e) of_config[index.pings[e].config]->pings.push_back({f, e});
  }
  std::vector<SounderSequence> result;
  for (auto& [key, sequence] : sequences) {
    join_instants(survey, sequence);
    if (!sequence.pings.empty()) result.push_back(std::move(sequence));
  }
  return result;
}

}  // namespace sonar
