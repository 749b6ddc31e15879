// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the fuzz targets do with their input; the plain tests replay the corpora through the same functions.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/hash.h"
#include "io/child_process.h"
#include "io/csv.h"
#include "io/csv_table.h"
#include "io/echoview_reader.h"
#include "io/fuzz_choices.h"
#include "io/index_cache.h"
#include "io/lsss_work.h"
#include "io/nav_series.h"
#include "io/nmea.h"
#include "io/ping_source.h"
#include "io/product_example.h"
#include "io/raw_index.h"
#include "io/sealed_file.h"
#include "io/simrad/con1.h"
#include "io/simrad/last_datagrams.h"
#include "io/wire.h"
#include "model/integration.h"
#include "model/school.h"

namespace sonar::fuzz {

/// Any bytes make an index; it is the same when they come in two pieces, survives its cache, and every ping of it can
/// be read. Nor do they lead astray whoever walks back from their end.
inline void simrad_raw(std::span<const std::byte> bytes) {
  const MemorySource whole("fuzz", bytes);
  const auto index = index_raw(whole);
  SONAR_CHECK(index.has_value());
  const std::vector<std::byte> encoded = encode_index(*index);
  const auto decoded = decode_index(encoded);
  SONAR_CHECK(decoded.has_value() && encode_index(*decoded) == encoded);
  const auto growing = std::make_shared<MemorySource>("fuzz", bytes.first(bytes.size() / 2));
  const auto pings = ping_source(growing);
  SONAR_CHECK(pings->refresh().has_value());
  growing->append(bytes.subspan(bytes.size() / 2));
  SONAR_CHECK(pings->finish().has_value() && pings->final());
  SONAR_CHECK(encode_index(pings->index()) == encoded);
  for (const PingEntry& entry : index->pings) {
    const auto ping = read_ping(whole, entry);
    SONAR_CHECK(ping.has_value() && !ping->channels.empty());
  }
  const auto last = simrad::last_datagrams(whole, bytes.size(), 0, true);
  SONAR_CHECK(last.has_value());
  std::uint64_t before = 0;
  for (const simrad::Extent& one : *last) {
    SONAR_CHECK(one.offset >= before && one.size >= 20 && one.offset + one.size <= bytes.size());
    before = one.offset + one.size;
  }
}

/// Whatever a sentence says, only possible values go into the series.
inline void nmea(std::string_view text) {
  const auto sentence = parse_nmea(text);
  if (!sentence) return;
  std::vector<NavSeries> series;
  add_sentence(series, *sentence, 1'577'836'800 * kSecondNs);
  for (const NavSeries& s : series) {
    for (const NavSample& sample : s.samples) {
      SONAR_CHECK(std::isfinite(sample.first) && !std::isinf(sample.second));
      if (s.quantity == NavQuantity::position) {
        SONAR_CHECK(std::abs(sample.first) <= 90.0 && std::abs(sample.second) <= 180.0);
      }
      if (s.quantity == NavQuantity::heading) SONAR_CHECK(sample.first >= 0.0 && sample.first < 360.0);
    }
  }
}

/// Angles are taken whole or not at all.
inline void con1(std::string_view xml) {
  SounderConfig config;
  config.beams.resize(3);
  const simrad::Con1Outcome outcome = simrad::apply_con1(simrad::parse_con1(xml), config);
  SONAR_CHECK(outcome.used == outcome.problem.empty());
  for (const BeamConfig& beam : config.beams) {
    SONAR_CHECK(std::isfinite(beam.direction_deg[0]) && std::isfinite(beam.direction_deg[1]));
  }
}

/// A table that is taken has full records only, and says the same when it is written and read again.
inline void csv(std::string_view text) {
  const auto table = parse_csv(text, "fuzz");
  if (!table) return;
  std::string written;
  const auto add = [&](const std::vector<std::string>& fields) {
    for (std::size_t i = 0; i < fields.size(); ++i) written += (i > 0 ? "," : "") + csv_field(fields[i]);
    written += "\r\n";
  };
  add(table->header);
  for (const CsvRecord& record : table->records) {
    SONAR_CHECK(record.fields.size() == table->header.size());
    add(record.fields);
  }
  // A record of one empty field is an empty line, which is passed over.
  const auto again = parse_csv(written, "fuzz");
  SONAR_CHECK(table->header.size() < 2 || (again.has_value() && again->records.size() == table->records.size()));
  for (const CsvRecord& record : table->records) {
    if (const auto number = table->number(record, 0)) {
      SONAR_CHECK(std::isfinite(*number) || (std::isnan(*number) && record.fields[0].empty()));
    }
  }
}

/// Rows that are taken say the same when they are written and read again. What the tables of truth and result are.
template <class Row>
void table_rows(const CsvTable& table) {
  const auto rows = csv_rows<Row>(table);
  if (!rows) return;
  SONAR_CHECK(rows->size() == table.records.size());
  // The first writing cuts times to milliseconds.
  const auto rewritten = [](const std::string& text) {
    const auto again = parse_csv(text, "fuzz");
    SONAR_CHECK(again.has_value());
    const auto read = csv_rows<Row>(*again);
    SONAR_CHECK(read.has_value());
    return csv_text(*read);
  };
  const std::string once = rewritten(csv_text(*rows));
  SONAR_CHECK(rewritten(once) == once);
}

/// A table that a verb wrote and another reads: schools, school_pings, and those of echo integration.
inline void school_tables(std::string_view text) {
  const auto table = parse_csv(text, "fuzz");
  if (!table) return;
  table_rows<SchoolRow>(*table);
  table_rows<SchoolPingRow>(*table);
  table_rows<EffortRow>(*table);
  table_rows<NascRow>(*table);
  table_rows<StratumRow>(*table);
}

/// Masks of a work file lie apart, in order, and within the grid that they are placed in; written, they are the same.
inline void lsss_work(std::string_view text) {
  ObservationProduct product = example::empty("obs-0001", 4);
  product.schools.resize(1);
  std::vector<TimeNs> times;
  for (const PingNavigation& ping : product.pings) times.push_back(ping.time);
  const GridRecord& record = *product.grid;
  const std::vector<int> row_of_channel = record.grid.row_of_channel();
  const auto placed = [&](std::string work, LsssNumbering numbering) {
    const auto schools = parse_lsss_work(std::move(work), "fuzz", numbering);
    if (!schools) return std::vector<LsssCells>{};
    return place_lsss(*schools, record.grid, record.sample_count, times, "fuzz").value_or(std::vector<LsssCells>{});
  };
  for (const LsssNumbering numbering : {LsssNumbering::from_one, LsssNumbering::from_zero}) {
    for (const LsssCells& cells : placed(std::string(text), numbering)) {
      SONAR_CHECK(cells.ping_index >= 0 && cells.ping_index < std::ssize(product.pings) && !cells.runs.empty());
      PingMask mask;
      LsssRun before{-1, 0, 0};
      for (const LsssRun& run : cells.runs) {
        SONAR_CHECK(run.channel > before.channel ||
                    (run.channel == before.channel && run.first_sample > before.first_sample + before.count));
        const int row = row_of_channel.at(static_cast<std::size_t>(run.channel));
        const std::int32_t samples = record.sample_count.at(static_cast<std::size_t>(row / record.grid.beams()));
        SONAR_CHECK(run.first_sample >= 0 && run.count > 0 && run.first_sample + run.count <= samples);
        mask.runs.push_back({row, run.first_sample, run.count});
        before = run;
      }
      std::ranges::sort(mask.runs);
      product.masks = {{0, cells.ping_index, mask}};
      const auto again = placed(lsss_work_text(product, 0, numbering), numbering);
      SONAR_CHECK(again.size() == 1 && again[0].ping_index == cells.ping_index && again[0].runs == cells.runs);
    }
  }
}

/// A stored index is taken whole or not at all; so are the same bytes behind a right check sum, which no mutation would make.
inline void index_cache(std::span<const std::byte> bytes) {
  const auto take = [](std::span<const std::byte> stored) {
    const auto index = decode_index(stored);
    if (index) SONAR_CHECK(decode_index(encode_index(*index)).has_value());
  };
  take(bytes);
  constexpr std::size_t kMagicAndVersion = 12;
  std::vector<std::byte> sealed = encode_index({});
  sealed.resize(kMagicAndVersion);
  const Hash128 sum = hash_bytes(bytes);
  wire::put(sealed, sum.high);
  wire::put(sealed, sum.low);
  sealed.insert(sealed.end(), bytes.begin(), bytes.end());
  take(sealed);
}

/// Regions that are taken have corners, and lie somewhere at the time of each, from above to below; notes tell cells that exist.
inline void evr(std::string_view text) {
  const auto regions = parse_evr(text, "fuzz");
  if (!regions) return;
  for (const EchoviewRegion& region : *regions) {
    SONAR_CHECK(!region.corners.empty());
    for (const EchoviewCorner& corner : region.corners) {
      SONAR_CHECK(std::isfinite(corner.depth_m));
      for (const DepthSpan& span : depths_at(region.corners, corner.time)) SONAR_CHECK(span.first_m <= span.last_m);
    }
    const auto cells = cells_of(region, "fuzz");
    if (!cells) continue;
    for (const EchoviewCells::InPing& ping : cells->pings) {
      for (const EchoviewCells::InBeam& run : ping.runs) {
        SONAR_CHECK(run.beam >= 0 && run.first_sample >= 0 && run.end() > run.first_sample);
      }
    }
  }
}

/// A line that is taken goes forward in time.
inline void evl(std::string_view text) {
  const auto points = parse_evl(text, "fuzz");
  if (!points) return;
  for (std::size_t i = 0; i < points->size(); ++i) {
    SONAR_CHECK(std::isfinite((*points)[i].depth_m));
    SONAR_CHECK(i == 0 || (*points)[i].time >= (*points)[i - 1].time);
  }
}

/// A head of a sealed file that says of its blocks what the choices say, under a right check sum.
inline std::vector<std::byte> forged_seal(std::string_view key, Choices& in) {
  std::vector<std::byte> head;
  for (const char c : std::string_view("SONARBLK")) head.push_back(static_cast<std::byte>(c));
  const std::size_t blocks = in.byte() % 8;
  const Hash128 of_key = hash_text(key);
  for (const std::uint64_t number : {std::uint64_t{1}, static_cast<std::uint64_t>(blocks), of_key.high, of_key.low}) {
    wire::put(head, number);
  }
  for (std::size_t i = 0; i < blocks; ++i) {
    for (int number = 0; number < 3; ++number) wire::put(head, static_cast<std::uint64_t>(in.whole()));
  }
  const Hash128 sum = hash_bytes(head);
  wire::put(head, sum.high);
  wire::put(head, sum.low);
  return head;
}

/// A file of the cache is read as it was written or not at all, whatever of it was changed; what a right check sum says of
/// blocks that are not there is not believed.
/// folder  to write into
inline void sealed_file(std::span<const std::byte> bytes, const std::filesystem::path& folder) {
  const std::string key = "fuzz";
  const std::filesystem::path file = folder / "sealed";
  const auto write = [&](std::span<const std::byte> all) {
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(all.data()), static_cast<std::streamsize>(all.size()));
  };
  const auto read_all = [&] {
    std::vector<std::vector<std::byte>> read;
    const auto opened = SealedFile::open(file, key);
    for (std::size_t i = 0; opened && i <= opened->blocks(); ++i) {
      if (auto block = opened->block(i)) read.push_back(std::move(*block));
    }
    return read;
  };
  Choices in(bytes);
  std::vector<std::byte> forged = forged_seal(key, in);
  forged.insert(forged.end(), bytes.begin(), bytes.end());
  write(forged);
  (void)read_all();
  const std::vector<std::vector<std::byte>> blocks{{bytes.begin(), bytes.end()}, {}, {std::byte{7}}};
  std::filesystem::remove(file);
  SealedFile::store(file, key, blocks);
  SONAR_CHECK(read_all() == blocks);
  std::fstream change(file, std::ios::in | std::ios::out | std::ios::binary);
  change.seekp(static_cast<std::streamoff>(in.below(static_cast<std::size_t>(std::filesystem::file_size(file)))));
  change.put(static_cast<char>(in.byte()));
  change.close();
  for (const auto& block : read_all()) SONAR_CHECK(std::ranges::find(blocks, block) != blocks.end());
}

/// Whatever a reading child answers is something, within what was asked for, or nothing.
inline void wire(std::span<const std::byte> bytes) {
  const auto texts = wire::decoded<std::vector<std::string>>(bytes);
  if (texts) SONAR_CHECK(std::ranges::equal(wire::encoded(*texts), bytes));
  const auto numbers = wire::decoded<std::vector<double>>(bytes);
  SONAR_CHECK(numbers.has_value() == (bytes.size() % sizeof(double) == 0));
  constexpr std::uint64_t kMost = 1000;
  const auto child = ChildProcess::start([&](int stream) { (void)say_all(stream, bytes); }, "fuzz");
  if (!child) return;
  const auto said = wire::hear(*child, kMost);
  if (said) SONAR_CHECK(said->size() <= kMost);
}

}  // namespace sonar::fuzz
