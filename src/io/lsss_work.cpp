// SPDX-License-Identifier: Apache-2.0
#include "io/lsss_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string_view>
#include <utility>
namespace sonar {
namespace {

using Xml = pugi::xml_node;

constexpr std::size_t kMostBytes = 256U << 20U;
// A tree's elements and attributes take far more room than their text: 40 to 130 bytes for as little as four.
constexpr std::ptrdiff_t kMostParts = 8'000'000;
constexpr std::size_t kRunsBetweenLooks = 4096;  ///< whether to stop, among runs of one beam
constexpr std::size_t kBytesBetweenLooks = 4U << 20U;
constexpr std::int64_t kMostSamples = std::numeric_limits<std::int32_t>::max();
constexpr TimeNs kSamePing = kSecondNs / 1000;  ///< a clock that is kept in milliseconds names the same ping

/// What a comment of ours says before the number.
constexpr std::string_view kCounting = "<!-- Channels and samples count from ";

std::int64_t first_number(LsssNumbering numbering) { return numbering == LsssNumbering::from_one ? 1 : 0; }

/// A number that is the whole text.
template <class Number>
std::optional<Number> number_of(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kMostShown = 40;
  return text.size() > kMostShown ? fmt::format("'{}...'", text.substr(0, kMostShown)) : fmt::format("'{}'", text);
}

/// Before the first element, where a name or an attribute that looks alike does not count.
std::optional<LsssNumbering> told_numbering(std::string_view text) {
  const std::string_view before = text.substr(0, text.find("<schools"));
  const std::size_t at = before.find(kCounting);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view number = before.substr(at + kCounting.size());
  if (number.starts_with("0.")) return LsssNumbering::from_zero;
  return number.starts_with("1.") ? std::optional(LsssNumbering::from_one) : std::nullopt;
}

bool stopped(const Work* work) { return work != nullptr && work->cancelled(); }
tl::unexpected<Error> stop() { return fail(ErrorCode::cancelled, "stopped on request"); }

/// Takes one file's masks off its tree, and knows where it is.
class WorkReader {
 public:
  WorkReader(const std::string& file, LsssNumbering numbering, const Work* work)
      : file_(file), first_(first_number(numbering)), work_(work) {}

  Result<std::vector<LsssSchool>> schools(const Xml& root) {
    std::vector<LsssSchool> out;
    for (const Xml& one : root.children("schoolData")) {
      if (stopped(work_)) return stop();
      school_ = static_cast<std::int64_t>(out.size()) + 1;
      ping_ = beam_ = 0;
      auto read = school(one);
      if (!read) return pass_on(read);
      out.push_back(std::move(*read));
    }
    return out;
  }

 private:
  [[nodiscard]] tl::unexpected<Error> wrong(const Xml& at, const std::string& what) const {
    std::string place = fmt::format("school {}: ", school_);
    if (ping_ > 0) place += fmt::format("pingMask {}: ", ping_);
    if (beam_ > 0) place += fmt::format("beam {}: ", beam_);
    return fail(ErrorCode::format, place + what, {.file = file_, .offset = at.offset_debug()});
  }

  /// A whole number of an attribute, from `least` on.
  Result<std::int64_t> whole(const Xml& of, const char* name, std::int64_t least,
                             std::int64_t most = std::numeric_limits<std::int64_t>::max()) const {
    const auto attribute = of.attribute(name);
    const auto value = number_of<std::int64_t>(attribute.value());
    if (value && *value >= least && *value <= most) return *value;
    return wrong(of, fmt::format("{} is {}, not a whole number from {} on", name,
                                 attribute ? quoted(attribute.value()) : "not there", least));
  }

  /// The same, 0 where it is not there.
  Result<std::int64_t> number_if_there(const Xml& of, const char* name) const {
    if (!of.attribute(name)) return 0;
    return whole(of, name, std::numeric_limits<std::int64_t>::min());
  }

  Result<LsssSchool> school(const Xml& of) {
    LsssSchool out;
    const auto object = number_if_there(of, "ObjectNumber");
    if (!object) return pass_on(object);
    const auto id = number_if_there(of, "SchoolIdNumber");
    if (!id) return pass_on(id);
    out.object_number = *object;
    out.school_id_number = *id;
    if (auto read = species(of, out); !read) return pass_on(read);
    for (const Xml& one : of.child("schoolMask").children("pingMask")) {
      if (stopped(work_)) return stop();
      ++ping_;
      beam_ = 0;
      auto read = ping(one);
      if (!read) return pass_on(read);
      if (!read->runs.empty()) out.pings.push_back(std::move(*read));
    }
    std::ranges::sort(out.pings, {}, &LsssPing::time);
    const auto twice = std::ranges::adjacent_find(out.pings, {}, &LsssPing::time);
    if (twice == out.pings.end()) return out;
    ping_ = beam_ = 0;
    return wrong(of, fmt::format("pingNtDate {} stands there twice", filetime_from_time(twice->time)));
  }

  Result<void> species(const Xml& of, LsssSchool& out) const {
    const Xml root = of.child("speciesInterpretationRoot");
    for (const Xml& at_frequency : root.children("speciesInterpretationRep")) {
      const auto frequency = number_of<double>(at_frequency.attribute("frequency").value());
      if (!frequency || !std::isfinite(*frequency) || *frequency <= 0.0) {
        return wrong(at_frequency, fmt::format("frequency is {}, not a number of kHz above 0",
                                               quoted(at_frequency.attribute("frequency").value())));
      }
      for (const Xml& one : at_frequency.children("species")) {
        const auto id = whole(one, "ID", 0);
        if (!id) return pass_on(id);
        const auto fraction = number_of<double>(one.attribute("fraction").value());
        if (!fraction || !(*fraction >= 0.0 && *fraction <= 1.0)) {
          return wrong(
              one, fmt::format("fraction is {}, not a number from 0 to 1", quoted(one.attribute("fraction").value())));
        }
        out.species.push_back({*frequency, *id, *fraction});
      }
    }
    return {};
  }

  Result<LsssPing> ping(const Xml& of) {
    const auto filetime = number_of<std::uint64_t>(of.attribute("pingNtDate").value());
    const auto time = filetime ? time_from_filetime(*filetime) : std::nullopt;
    if (!time) {
      return wrong(of, fmt::format("pingNtDate is {}, not 100 ns since 1601 of a time from 1970 on",
                                   quoted(of.attribute("pingNtDate").value())));
    }
    LsssPing out{*time, {}};
    for (const Xml& one : of.children("beam")) {
      if (stopped(work_)) return stop();
      ++beam_;
      if (auto read = beam(one, out.runs); !read) return pass_on(read);
    }
    const std::int64_t beams = std::exchange(beam_, 0);
    if (of.attribute("beamCount")) {
      const auto count = whole(of, "beamCount", 0);
      if (!count) return pass_on(count);
      if (*count < beams) return wrong(of, fmt::format("beamCount is {}, but {} beams follow", *count, beams));
    }
    return joined(of, std::move(out));
  }

  /// Sorted; what lies next to each other becomes one run.
  Result<LsssPing> joined(const Xml& of, LsssPing ping) const {
    std::ranges::sort(ping.runs);
    std::size_t kept = 0;
    for (const LsssRun& run : ping.runs) {
      LsssRun* const last = kept > 0 && ping.runs[kept - 1].channel == run.channel ? &ping.runs[kept - 1] : nullptr;
      const std::int64_t gap = last != nullptr ? run.first_sample - last->first_sample - last->count : 1;
      if (gap < 0) return wrong(of, fmt::format("samples of channel {} stand there twice", run.channel + first_));
      if (gap == 0) {
        last->count += run.count;
      } else {
        ping.runs[kept++] = run;
      }
    }
    ping.runs.resize(kept);
    return ping;
  }

  Result<void> beam(const Xml& of, std::vector<LsssRun>& runs) const {
    const auto channel = whole(of, "channel", first_, std::numeric_limits<std::int32_t>::max());
    if (!channel) return pass_on(channel);
    const auto length = whole(of, "beamLength", 1, kMostSamples);
    if (!length) return pass_on(length);
    return stretches(of, static_cast<std::int32_t>(*channel - first_), *length, runs);
  }

  /// "first count gap count ..."
  Result<void> stretches(const Xml& of, std::int32_t channel, std::int64_t length, std::vector<LsssRun>& runs) const {
    std::string_view text = of.attribute("range").value();
    const auto expected = [&](std::string_view what, std::string_view said) {
      return wrong(of, fmt::format("range: {} is {}, in {}", what, said,
                                   quoted(std::string_view(of.attribute("range").value()))));
    };
    const auto next = [&text] {
      text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
      const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
      text.remove_prefix(word.size());
      return word;
    };
    std::int64_t at = -first_;
    bool begun = false;
    for (std::string_view word = next(); !word.empty() || !begun; word = next()) {
      if (runs.size() % kRunsBetweenLooks == 0 && stopped(work_)) return stop();
      const auto skip = number_of<std::int64_t>(word);
      const std::int64_t least = begun ? 0 : first_;
      if (!skip || *skip < least || *skip > kMostSamples) {
        return expected(quoted(word),
                        begun ? "no gap of samples" : fmt::format("no number of a first sample from {} on", first_));
      }
      const std::string_view counted = next();
      const auto count = number_of<std::int64_t>(counted);
      if (!count || *count < 1 || *count > kMostSamples) return expected(quoted(counted), "no count of samples");
      at += *skip;
      if (at + *count > length)
        return expected(fmt::format("sample {}", at + *count - 1 + first_), "beyond beamLength");
      runs.push_back({channel, static_cast<std::int32_t>(at), static_cast<std::int32_t>(*count)});
      at += *count;
      begun = true;
    }
    return {};
  }

  const std::string& file_;
  std::int64_t first_;
  const Work* work_;
  std::int64_t school_ = 0;  ///< which one of the file is being read, from 1; 0 = none
  std::int64_t ping_ = 0;
  std::int64_t beam_ = 0;
};

/// The observation's ping at a time; -1 = none.
std::int64_t ping_at(std::span<const TimeNs> times, TimeNs time) {
  const auto found = std::ranges::lower_bound(times, time - kSamePing);
  return found != times.end() && *found <= time + kSamePing ? found - times.begin() : -1;
}

bool is_category(const std::string& species) { return number_of<std::int64_t>(species).value_or(-1) >= 0; }

std::string species_text(const ObservationProduct& product, const SchoolRow& school) {
  const std::vector<double>& fans = product.grid->grid.frequency_hz;
  if (!is_category(school.species) || fans.empty()) return {};
  const auto [low, high] = std::ranges::minmax(fans);
  return fmt::format(
      "    <speciesInterpretationRoot>\n      <speciesInterpretationRep frequency=\"{:.0f}\">\n"
      "        <species ID=\"{}\" fraction=\"1\"/>\n"
      "      </speciesInterpretationRep>\n    </speciesInterpretationRoot>\n",
      (low + high) / 2000.0, school.species);
}

std::string ping_text(const ObservationProduct& product, const SchoolMask& mask, TimeNs offset_ns, std::int64_t first) {
  const BeamGrid& grid = product.grid->grid;
  std::map<int, std::vector<Run>> beams;  // by channel
  for (const Run& run : mask.mask.runs) beams[grid.channel[static_cast<std::size_t>(run.row)]].push_back(run);
  // Unsigned: a foreign file's times may be as far apart as no difference can say.
  const auto time =
      static_cast<TimeNs>(static_cast<std::uint64_t>(product.pings[static_cast<std::size_t>(mask.ping_index)].time) -
                          static_cast<std::uint64_t>(offset_ns));
  std::string out =
      fmt::format("      <pingMask pingNtDate=\"{}\" beamCount=\"{}\">\n", filetime_from_time(time), beams.size());
  for (const auto& [channel, runs] : beams) {
    const auto fan = static_cast<std::size_t>(runs.front().row / grid.beams());
    std::string range;
    std::int64_t end = -first;
    for (const Run& run : runs) {
      range += fmt::format("{}{} {}", range.empty() ? "" : " ", run.first_sample - end, run.count);
      end = run.end();
    }
    out += fmt::format("        <beam channel=\"{}\" beamLength=\"{}\" range=\"{}\"/>\n", channel + first,
                       product.grid->sample_count[fan], range);
  }
  return out + "      </pingMask>\n";
}

}  // namespace

Result<std::vector<LsssSchool>> parse_lsss_work(std::string text, const std::string& file,
                                                std::optional<LsssNumbering> numbering, const Work* work) {
  const auto refused = [&](std::string what, std::int64_t offset = -1) {
    return fail(ErrorCode::format, std::move(what), {.file = file, .offset = offset});
  };
  if (const auto nothing = text.find('\0'); nothing != std::string::npos) {
    return refused("a zero byte, where XML in UTF-8 is expected", static_cast<std::int64_t>(nothing));
  }
  std::ptrdiff_t parts = 0;
  for (std::size_t at = 0; at < text.size(); at += kBytesBetweenLooks) {
    if (stopped(work)) return stop();
    parts += std::ranges::count_if(std::string_view(text).substr(at, kBytesBetweenLooks),
                                   [](char c) { return c == '<' || c == '='; });
  }
  if (text.size() > kMostBytes || parts > kMostParts) {
    return refused(fmt::format("has {} MB and {} elements and attributes; up to {} MB and {} are read",
                               text.size() >> 20U, parts, kMostBytes >> 20U, kMostParts));
  }
  // The tree is made of the text, which is gone then.
  if (!numbering) numbering = told_numbering(text).value_or(LsssNumbering::from_one);
  if (stopped(work)) return stop();
  pugi::xml_document document;
  const auto parsed = document.load_buffer_inplace(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!parsed) return refused(fmt::format("no well-formed XML: {}", parsed.description()), parsed.offset);
  const Xml root = document.document_element();
  if (std::strcmp(root.name(), "regionInterpretation") == 0) {
    return fail(ErrorCode::unsupported, "interprets an echosounder; school masks of an MS70 (schools) are expected",
                {.file = file});
  }
  if (std::strcmp(root.name(), "schools") != 0) {
    return refused(fmt::format("begins with {}, where schools is expected", quoted(root.name())));
  }
  return WorkReader(file, *numbering, work).schools(root);
}

std::string main_species(const LsssSchool& school) {
  std::map<std::int64_t, double> shares;
  for (const LsssSpecies& one : school.species) shares[one.id] += one.fraction;
  if (shares.empty()) return {};
  using Share = std::pair<const std::int64_t, double>;
  return std::to_string(std::ranges::max_element(shares, {}, &Share::second)->first);
}

Result<std::vector<LsssCells>> place_lsss(std::span<const LsssSchool> schools, const BeamGrid& grid,
                                          std::span<const std::int32_t> sample_count, std::span<const TimeNs> times,
                                          const std::string& file, const Work* work) {
  const std::vector<int> row_of_channel = grid.row_of_channel();
  const auto mismatch = [&](std::size_t school, const LsssPing& ping, const std::string& what) {
    return fail(ErrorCode::mismatch, fmt::format("school {}: ping of {}: {}", school + 1, iso_time(ping.time), what),
                {.file = file});
  };
  std::vector<LsssCells> out;
  for (std::size_t i = 0; i < schools.size(); ++i) {
    for (const LsssPing& ping : schools[i].pings) {
      if (stopped(work)) return stop();
      const std::int64_t index = ping_at(times, ping.time);
      if (index < 0) continue;
      for (const LsssRun& run : ping.runs) {
        const bool known = run.channel < std::ssize(row_of_channel);
        const int row = known ? row_of_channel[static_cast<std::size_t>(run.channel)] : -1;
        if (row < 0) return mismatch(i, ping, fmt::format("no fan has channel {} (from 0)", run.channel));
        const std::int32_t samples = sample_count[static_cast<std::size_t>(row / grid.beams())];
        if (run.count > samples - run.first_sample) {
          return mismatch(i, ping,
                          fmt::format("channel {} (from 0) has {} samples, and the mask more", run.channel, samples));
        }
      }
      out.push_back({i, index, ping.runs});
    }
  }
  return out;
}

std::string lsss_work_text(const ObservationProduct& product, TimeNs offset_ns, LsssNumbering numbering) {
  if (!product.grid) return {};
  const std::int64_t first = first_number(numbering);
  std::string schools;
  for (const SchoolRow& school : product.schools) {
    if (school.status == "rejected") continue;
    std::string pings;
    // Masks are sorted by school: of a large survey only this one's are looked at.
    for (const SchoolMask& mask :
         std::ranges::equal_range(product.masks, school.school_id, {}, &SchoolMask::school_id)) {
      if (mask.ping_index < 0 || mask.ping_index >= std::ssize(product.pings) || mask.mask.empty()) continue;
      pings += ping_text(product, mask, offset_ns, first);
    }
    if (pings.empty()) continue;
    schools += fmt::format("  <schoolData ObjectNumber=\"{0}\" SchoolIdNumber=\"{0}\">\n{1}    <schoolMask>\n{2}",
                           school.school_id, species_text(product, school), pings);
    schools += "    </schoolMask>\n  </schoolData>\n";
  }
  if (schools.empty()) return {};
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "{}{}. Elements are those that LSSS is known to write; whether it reads a "
      "file without "
      "growth parameters and figures was not tried. -->\n<schools>\n{}</schools>\n",
      kCounting, first, schools);
}

}  // namespace sonar
