// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "base/work.h"
#include "model/product.h"

namespace sonar {

// School masks of an MS70 as LSSS keeps them in work files: XML in UTF-8, schools / schoolData / schoolMask / pingMask / beam.
// No description of these files is public, and none of them could be had. What is known comes from a public reader of them:
//   known      the elements and attributes of a mask; times of pings, in 100 ns since 1601; that a beam's range is "first count
//              gap count gap count ..." in samples
//   two ways   whether channels and samples count from 1, as that reader has them, or from 0: LsssNumbering
//   inferred   that a channel is the raw file's; that beamCount counts the beams that follow, beamLength all samples of the beam;
//              that species stand as in LSSS's files of echosounders (speciesInterpretationRep frequency, species ID fraction)

/// The number of the first channel, and of the first sample.
enum class LsssNumbering : std::uint8_t { from_one, from_zero };

/// Neighbouring samples of one beam.
struct LsssRun {
  std::int32_t channel = 0;  ///< from 0
  std::int32_t first_sample = 0;
  std::int32_t count = 0;
  friend auto operator<=>(const LsssRun&, const LsssRun&) = default;
};

struct LsssPing {
  TimeNs time = 0;            ///< of the datagrams
  std::vector<LsssRun> runs;  ///< sorted, with gaps between them
};

struct LsssSpecies {
  double frequency_khz = 0.0;
  std::int64_t id = 0;  ///< the institute's number of an acoustic category
  double fraction = 0.0;
};

struct LsssSchool {
  std::int64_t object_number = 0;     ///< 0 = not told
  std::int64_t school_id_number = 0;  ///< 0 = not told
  std::vector<LsssSpecies> species;   ///< empty = not interpreted
  std::vector<LsssPing> pings;        ///< with a run; sorted by time, each once; empty = no mask
};

/// Masks of a work file. What else stands in it (growth parameters, figures) is passed over.
/// text    at most 256 MB, and 8 million elements and attributes: a gigabyte while it is read, at worst
/// file    for messages
/// numbering  empty = what a comment that lsss_work_text() wrote tells, else from one: LSSS itself tells nothing
/// work    null = is never stopped; else within a second, as the XML is taken in one piece
/// errors  format: naming the school, ping and beam, what stands there and what is expected; among them numbers that the
///         numbering does not have. unsupported: the interpretation of an echosounder, which has no beams. cancelled
/// threads pure
[[nodiscard]] Result<std::vector<LsssSchool>> parse_lsss_work(std::string text, const std::string& file,
                                                              std::optional<LsssNumbering> numbering,
                                                              const Work* work = nullptr);

/// The category with the largest share over all frequencies, as text; empty where a school has none.
[[nodiscard]] std::string main_species(const LsssSchool& school);

/// What a school of a work file covers of one ping of an observation.
struct LsssCells {
  std::size_t school = 0;       ///< index in the work file
  std::int64_t ping_index = 0;  ///< in the observation
  std::vector<LsssRun> runs;    ///< of channels in fans; BeamGrid::row_of_channel() tells fan and beam
};

/// The masks of those pings that an observation has: within a millisecond. By school, then ping.
/// sample_count  [fan]
/// times         [ping_index] of the datagrams, rising
/// file          for messages
/// work          null = is never stopped
/// errors        mismatch: a channel that is in no fan, or more samples than its fan has; cancelled
[[nodiscard]] Result<std::vector<LsssCells>> place_lsss(std::span<const LsssSchool> schools, const BeamGrid& grid,
                                                        std::span<const std::int32_t> sample_count,
                                                        std::span<const TimeNs> times, const std::string& file,
                                                        const Work* work = nullptr);

/// The masks of an observation as a work file, which begins with a comment that tells the numbering. A species that is a whole number is taken for a category of LSSS, at the middle
/// of the fans' frequencies; other species are left out. Figures and growth parameters are left out too.
/// product    with its masks and a grid; rejected schools are left out
/// offset_ns  what the product's recipe added to the times of the datagrams
/// out        empty where no school has a mask
[[nodiscard]] std::string lsss_work_text(const ObservationProduct& product, TimeNs offset_ns, LsssNumbering numbering);

}  // namespace sonar
