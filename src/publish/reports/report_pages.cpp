// SPDX-License-Identifier: Apache-2.0
#include "publish/reports/report_pages.h"

#include <fmt/format.h>

#include <algorithm>

#include "publish/picture.h"
#include "publish/reports/report_cells.h"
#include "render/draw_frame.h"
#include "view/composed_figure.h"
#include "view/shapes.h"

namespace sonar {
namespace {

// A4 upright at 96 pixels an inch, as FrameDescription has it.
constexpr PixelSize kPaper{794, 1123};
constexpr double kMargin = 40.0;
constexpr double kWidth = kPaper.width - 2.0 * kMargin;
constexpr double kFoot_px = 16.0;
constexpr double kBottom = kPaper.height - kMargin - kFoot_px;
constexpr double kGap = 10.0;
constexpr double kTitle_px = 19.0;
constexpr double kHeading_px = 14.0;
constexpr double kLower_px = 11.5;
constexpr double kText_px = 10.0;                       ///< 7.5 pt
constexpr double kSmall_px = 8.0;                       ///< of tables, 6 pt
constexpr double kLine = 1.35;                          ///< from line to line, in sizes of the text
constexpr double kBold = 1.12;                          ///< wider than plain text
constexpr double kLeastText_px = 14.0;                  ///< of pictures: 7.7 where a page has two side by side
constexpr double kTallest = kBottom - kMargin - 110.0;  ///< of a picture: heading and caption are on its page
constexpr double kHeads_px = 100.0;                     ///< left below a table's caption: its heads and a first row
constexpr std::size_t kMostLines = 30;                  ///< of a cell of a table

/// Shown as far as a page has room for it.
std::vector<std::string> cell_lines(const std::string& text, double width_px) {
  std::vector<std::string> lines = text_lines(text, width_px, kSmall_px);
  if (lines.size() > kMostLines) {
    lines.resize(kMostLines);
    lines.back() = "\u2026";
  }
  return lines;
}

double heading_height(bool lower) { return lower ? 8.0 + kLine * kLower_px : 16.0 + kLine * kHeading_px; }

}  // namespace

ReportPages::ReportPages() : theme_(light_theme(kPaper)) { begin_page(); }

void ReportPages::begin_page() {
  FrameDescription page;
  page.size = kPaper;
  page.background = theme_.background;
  pages_.push_back(std::move(page));
  y_ = kMargin;
}

bool ReportPages::has_room(double height_px) const { return y_ + height_px <= kBottom; }

void ReportPages::show(const Heading& heading) {
  const double size = heading.lower ? kLower_px : kHeading_px;
  const double top = y_ > kMargin ? 0.0 : heading_height(heading.lower) - kLine * size;  // no gap on top of a page
  y_ += heading_height(heading.lower) - top;
  TextItem text =
      text_item({kMargin, y_ - 0.75 * kLine * size}, elided(heading.text, kBold * size, kWidth), size, theme_.text);
  text.bold = true;
  pages_.back().items.emplace_back(std::move(text));
  if (!heading.lower) {
    pages_.back().items.emplace_back(line_item({kMargin, y_ - 2.0}, {kMargin + kWidth, y_ - 2.0}, theme_.axis, 0.7));
    y_ += 3.0;
  }
}

void ReportPages::keep_together(double height_px) {
  double all = height_px;
  for (const Heading& heading : waiting_) all += heading_height(heading.lower) + 3.0;
  if (y_ > kMargin && !has_room(all)) begin_page();
}

double ReportPages::begin(double height_px) {
  keep_together(height_px);
  for (const Heading& heading : waiting_) show(heading);
  waiting_.clear();
  const double y = y_;
  y_ += height_px;
  return y;
}

void ReportPages::add_lines(const std::string& text, const Line& look) {
  const double height = kLine * look.size_px;
  const double width = kWidth - look.indent_px;
  for (const std::string& line : text_lines(text, width, (look.bold ? kBold : 1.0) * look.size_px)) {
    TextItem item =
        text_item({kMargin + look.indent_px, begin(height) + 0.5 * height}, line, look.size_px, look.colour);
    item.bold = look.bold;
    pages_.back().items.emplace_back(std::move(item));
  }
}

void ReportPages::title(const std::string& text) {
  title_ = text;
  add_lines(text, {kTitle_px, theme_.text, 0.0, true});
  y_ += kGap;
}

void ReportPages::heading(const std::string& text) { waiting_.push_back({text, false}); }

void ReportPages::subheading(const std::string& text) { waiting_.push_back({text, true}); }

void ReportPages::paragraph(const std::string& text) {
  add_lines(text, {kText_px, theme_.text});
  y_ += 0.4 * kText_px;
}

void ReportPages::words(const NamedWords& words) {
  double names_px = 0.0;
  for (const auto& [name, value] : words) names_px = std::max(names_px, text_width_px(name.c_str(), kText_px));
  names_px = std::min(names_px, 0.35 * kWidth) + kGap;
  const double height = kLine * kText_px;
  for (const auto& [name, value] : words) {
    const auto names = text_lines(name, names_px - kGap, kText_px);
    const auto values = text_lines(value, kWidth - names_px, kText_px);
    for (std::size_t i = 0; i < std::max(names.size(), values.size()); ++i) {
      const double y = begin(height) + 0.5 * height;
      auto& items = pages_.back().items;
      if (i < names.size()) items.emplace_back(text_item({kMargin, y}, names[i], kText_px, theme_.muted));
      if (i < values.size()) items.emplace_back(text_item({kMargin + names_px, y}, values[i], kText_px, theme_.text));
    }
  }
}

void ReportPages::begin_pair() { pair_ = true; }

void ReportPages::end_pair() {
  pair_ = false;
  if (!beside_.empty()) add_row(beside_, 0.5 * (kWidth - kGap));
  beside_.clear();
}

Result<void> ReportPages::picture(const FrameDescription& frame, const std::string& caption) {
  beside_.push_back({frame, caption});
  if (pair_ && beside_.size() < 2) return {};
  add_row(beside_, pair_ ? 0.5 * (kWidth - kGap) : kWidth);
  beside_.clear();
  return {};
}

void ReportPages::add_row(std::span<const Captioned> pictures, double cell_px) {
  constexpr double kCaption = kLine * kText_px;
  double tallest = 0.0;
  std::size_t lines = 0;
  for (const Captioned& one : pictures) {
    tallest = std::max(tallest, fitted(one.frame.size, {0.0, 0.0, cell_px, kTallest}).height);
    lines = std::max(lines, text_lines(one.caption, cell_px, kText_px).size());
  }
  double x = kMargin;
  const double y = begin(tallest + kCaption * static_cast<double>(lines) + kGap);
  for (const Captioned& one : pictures) {
    place_frame(pages_.back(), one.frame, {x, y, cell_px, tallest});
    double below = y + tallest + 0.5 * kCaption;
    for (const std::string& line : text_lines(one.caption, cell_px, kText_px)) {
      pages_.back().items.emplace_back(text_item({x, below}, line, kText_px, theme_.muted));
      below += kCaption;
    }
    x += cell_px + kGap;
  }
}

void ReportPages::table(const CsvTable& table, const std::string& caption, std::size_t most) {
  const std::size_t rows = std::min(most, table.records.size());
  const auto blocks = column_blocks(table, rows, kWidth, kSmall_px);
  const double lines = static_cast<double>(text_lines(caption, kWidth, kText_px).size()) + 2.0;
  keep_together(kHeads_px + kLine * kText_px * lines);
  paragraph(caption);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks.size() > 1) {
      const double height = kLine * kText_px;
      keep_together(height + kHeads_px);
      const std::string words = i == 0 ? fmt::format("Columns, part 1 of {}", blocks.size())
                                       : fmt::format("The same rows: columns, part {} of {}", i + 1, blocks.size());
      pages_.back().items.emplace_back(
          text_item({kMargin, begin(height) + 0.5 * height}, words, kSmall_px, theme_.muted));
    }
    add_block(table, rows, blocks[i]);
    y_ += kGap;
  }
  const std::string left_out = rows_left_out(table, most);
  if (!left_out.empty()) paragraph(left_out);
}

void ReportPages::add_block(const CsvTable& table, std::size_t rows, const std::vector<PaperColumn>& block) {
  constexpr double kColumnGap = 4.0;
  const auto laid_out = [&](const auto& cell_of) {
    Row row;
    std::size_t lines = 1;
    for (const PaperColumn& column : block) {
      const ReportCell cell = cell_of(column.index);
      row.cells.push_back(cell_lines(cell.text, column.width_px - kColumnGap));
      row.numbers.push_back(cell.number);
      lines = std::max(lines, row.cells.back().size());
    }
    row.height_px = 1.2 * kSmall_px * static_cast<double>(lines) + 3.0;
    return row;
  };
  const Row head = laid_out([&](std::size_t i) { return ReportCell{table.header[i], false}; });
  bool begun = false;
  for (std::size_t r = 0; r < rows; ++r) {
    const Row row = laid_out([&](std::size_t i) { return report_cell(table.header[i], table.records[r].fields[i]); });
    if (!has_room(row.height_px + (begun ? 0.0 : head.height_px))) {
      begin_page();
      begun = false;
    }
    if (!begun) add_row(head, block, true);
    begun = true;
    add_row(row, block, false);
  }
}

void ReportPages::add_row(const Row& row, const std::vector<PaperColumn>& block, bool head) {
  const double top = begin(row.height_px);
  double width = 0.0;
  for (const PaperColumn& column : block) width += column.width_px;
  auto& items = pages_.back().items;
  if (head) items.emplace_back(rectangle_item({kMargin, top, width, row.height_px}, theme_.plot));
  double x = kMargin;
  for (std::size_t i = 0; i < block.size(); ++i) {
    const double at = row.numbers[i] ? x + block[i].width_px - 4.0 : x + 1.0;
    double y = top + 1.5 + 0.6 * kSmall_px;
    for (const std::string& line : row.cells[i]) {
      items.emplace_back(
          text_item({at, y}, line, kSmall_px, theme_.text, row.numbers[i] ? TextAnchor::right : TextAnchor::left));
      y += 1.2 * kSmall_px;
    }
    x += block[i].width_px;
  }
  const double under = top + row.height_px;
  items.emplace_back(line_item({kMargin, under}, {kMargin + width, under}, theme_.grid, 0.5));
}

void ReportPages::plain_text(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
    const double indent_px = std::min(0.5 * kSmall_px * static_cast<double>(indent), 0.5 * kWidth);
    add_lines(line.substr(indent), {kSmall_px, theme_.text, indent_px});
    at = end + 1;
  }
}

void ReportPages::closing(const std::string& text) {
  y_ += kGap;
  add_lines(text, {kText_px, theme_.muted});
}

std::vector<FrameDescription> ReportPages::pages() && {
  const double y = kPaper.height - kMargin - 0.25 * kFoot_px;
  for (std::size_t i = 0; i < pages_.size(); ++i) {
    pages_[i].title = "Report: " + title_;
    auto& items = pages_[i].items;
    items.emplace_back(text_item({kMargin, y}, elided(title_, kSmall_px, 0.8 * kWidth), kSmall_px, theme_.muted));
    items.emplace_back(text_item({kMargin + kWidth, y}, fmt::format("page {} of {}", i + 1, pages_.size()), kSmall_px,
                                 theme_.muted, TextAnchor::right));
  }
  return std::move(pages_);
}

Result<std::vector<FrameDescription>> report_pages(PictureSource& source, std::span<const std::filesystem::path> paths,
                                                   const PictureOptions& options, Work& work) {
  ReportPages report;
  PictureOptions drawn = options;
  drawn.least_text_px = std::max(drawn.least_text_px, kLeastText_px);
  if (auto written = write_report(report, source, paths, drawn, work); !written) return pass_on(written);
  auto pages = std::move(report).pages();
  pages.front().origin = survey_origin(source);
  return pages;
}

Result<std::string> report_pdf(PictureSource& source, std::span<const std::filesystem::path> paths,
                               const PictureOptions& options, Work& work) {
  const auto pages = report_pages(source, paths, options, work);
  if (!pages) return pass_on(pages);
  return pdf_bytes(*pages);
}

}  // namespace sonar
