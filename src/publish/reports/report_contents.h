// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/work.h"
#include "io/csv_table.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"
#include "view/frame_description.h"

namespace sonar {

/// Names, and what is said of each.
using NamedWords = std::vector<std::pair<std::string, std::string>>;

/// What a report is written with. Whatever comes from data stands in it as text alone.
class ReportWriter {
 public:
  ReportWriter() = default;
  virtual ~ReportWriter() = default;
  ReportWriter(const ReportWriter&) = delete;
  ReportWriter& operator=(const ReportWriter&) = delete;

  virtual void title(const std::string& text) = 0;  ///< once, before all else
  virtual void heading(const std::string& text) = 0;
  virtual void subheading(const std::string& text) = 0;
  virtual void paragraph(const std::string& text) = 0;
  virtual void words(const NamedWords& words) = 0;
  /// Pictures between the two stand side by side.
  virtual void begin_pair() = 0;
  virtual void end_pair() = 0;
  /// errors  as draw_frame()
  virtual Result<void> picture(const FrameDescription& frame, const std::string& caption) = 0;
  /// Numbers to five digits; columns without any value are left out. Of more rows than `most` the first, and a sentence
  /// that tells how many there are.
  virtual void table(const CsvTable& table, const std::string& caption, std::size_t most) = 0;
  virtual void plain_text(const std::string& text) = 0;  ///< its lines stay lines, with their indents
  virtual void closing(const std::string& text) = 0;     ///< once, behind all else
};

/// The whole report of a survey: what it is, map, timeline, charts and strongest schools as pictures, every column of the
/// schools with their uncertainties, the tables of echo integration, the recipe, the raw files, what was noted, and what the
/// columns mean. Without raw files it lacks the pictures of samples. Times are the data's: the same survey gives the same.
/// paths    those that the source was opened with; a work folder's effort.csv, nasc.csv and strata.csv are shown
/// options  as report_page(), but dark and units: pictures are in metres and m/s as the tables are
/// errors   cancelled; format: a table that is none; as validate_options()
[[nodiscard]] Result<void> write_report(ReportWriter& writer, PictureSource& source,
                                        std::span<const std::filesystem::path> paths, const PictureOptions& options,
                                        Work& work);

}  // namespace sonar
