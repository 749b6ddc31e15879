// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/work.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"
#include "publish/reports/report_columns.h"
#include "publish/reports/report_contents.h"
#include "view/frame_description.h"
#include "view/theme.h"

namespace sonar {

/// A report on pages of A4 upright, as many as it needs. A table that is wider than a page is cut into blocks of columns,
/// each with the columns that tell its rows; its heads stand on every page. A heading is on the page of what it heads.
class ReportPages : public ReportWriter {
 public:
  ReportPages();
  void title(const std::string& text) override;
  void heading(const std::string& text) override;
  void subheading(const std::string& text) override;
  void paragraph(const std::string& text) override;
  void words(const NamedWords& words) override;
  void begin_pair() override;
  void end_pair() override;
  Result<void> picture(const FrameDescription& frame, const std::string& caption) override;
  void table(const CsvTable& table, const std::string& caption, std::size_t most) override;
  void plain_text(const std::string& text) override;
  void closing(const std::string& text) override;

  /// What was written, each page with its number.
  [[nodiscard]] std::vector<FrameDescription> pages() &&;

 private:
  struct Heading {
    std::string text;
    bool lower = false;
  };
  struct Captioned {
    FrameDescription frame;
    std::string caption;
  };
  struct Line {
    double size_px = 0.0;
    Rgba8 colour{};
    double indent_px = 0.0;
    bool bold = false;
  };
  /// A row of a table as it is drawn: the lines of each cell.
  struct Row {
    std::vector<std::vector<std::string>> cells;
    std::vector<bool> numbers;
    double height_px = 0.0;
  };

  void begin_page();
  void show(const Heading& heading);
  [[nodiscard]] bool has_room(double height_px) const;
  /// Begins a page where this one has no room for the headings that wait and so much below them.
  void keep_together(double height_px);
  /// Where a thing of that height begins: below the headings that wait for it, together with them.
  double begin(double height_px);
  void add_lines(const std::string& text, const Line& look);
  void add_row(std::span<const Captioned> pictures, double cell_px);
  void add_block(const CsvTable& table, std::size_t rows, const std::vector<PaperColumn>& block);
  void add_row(const Row& row, const std::vector<PaperColumn>& block, bool head);

  Theme theme_;
  std::string title_;
  std::vector<FrameDescription> pages_;
  std::vector<Heading> waiting_;
  std::vector<Captioned> beside_;
  bool pair_ = false;
  double y_ = 0.0;
};

/// What write_report() writes, as pages.
/// errors  as write_report()
[[nodiscard]] Result<std::vector<FrameDescription>> report_pages(PictureSource& source,
                                                                 std::span<const std::filesystem::path> paths,
                                                                 const PictureOptions& options, Work& work);

/// The same as a PDF. The same survey gives the same file.
/// errors  as report_pages()
[[nodiscard]] Result<std::string> report_pdf(PictureSource& source, std::span<const std::filesystem::path> paths,
                                             const PictureOptions& options, Work& work);

}  // namespace sonar
