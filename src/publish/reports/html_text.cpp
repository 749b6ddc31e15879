// SPDX-License-Identifier: Apache-2.0
#include "publish/reports/html_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/utf8.h"
#include "io/column_words.h"
#include "publish/reports/report_cells.h"
#include "render/draw_frame.h"

namespace sonar {
namespace {

constexpr double kPixelsOfPrint = 2.0;  ///< about 200 dots an inch over an A4 page

unsigned byte_at(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

std::string cell(std::string_view column, std::string_view field) {
  const ReportCell shown = report_cell(column, field);
  return (shown.number ? "<td class=\"n\">" : "<td>") + html_escaped(shown.text) + "</td>";
}

std::string head_cell(const std::string& name) {
  const ColumnWords* words = words_of(name);
  const std::string title = words == nullptr ? "" : " title=\"" + html_escaped(words->long_name) + "\"";
  std::string shown = html_escaped(name);
  // A long name may break where its words end.
  for (std::size_t at = shown.find('_'); at != std::string::npos; at = shown.find('_', at + 6)) {
    shown.insert(at + 1, "<wbr>");
  }
  return "<th scope=\"col\"" + title + ">" + shown + "</th>";
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string out;
  for (const char c : clean_utf8(text)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = byte_at(bytes, i) << 16U;
    if (left > 1) group |= byte_at(bytes, i + 1) << 8U;
    if (left > 2) group |= byte_at(bytes, i + 2);
    for (std::size_t k = 0; k < 4; ++k) out += k > left ? '=' : kLetters[(group >> (18U - 6U * k)) & 63U];
  }
  return out;
}

std::string html_heading(std::string_view text) { return "<h2>" + html_escaped(text) + "</h2>\n"; }

std::string html_paragraph(std::string_view text) { return "<p>" + html_escaped(text) + "</p>\n"; }

Result<std::string> html_picture(const FrameDescription& frame, std::string_view caption) {
  const auto image = draw_frame(frame, kPixelsOfPrint);
  if (!image) return pass_on(image);
  const auto png = png_bytes(*image);
  if (!png) return pass_on(png);
  const std::string said = html_escaped(caption);
  return fmt::format(
      "<figure><img alt=\"{}\" width=\"{}\" height=\"{}\" src=\"data:image/png;base64,{}\">"
      "<figcaption>{}</figcaption></figure>\n",
      said, frame.size.width, frame.size.height, base64(*png), said);
}

std::string html_table(const CsvTable& table, std::string_view caption, std::size_t most) {
  const std::vector<std::size_t> shown = columns_with_values(table);
  const std::size_t rows = std::min(most, table.records.size());
  std::string out = "<div class=\"wide\"><table><caption>" + html_escaped(caption) + "</caption>\n<thead><tr>";
  for (const std::size_t i : shown) out += head_cell(table.header[i]);
  out += "</tr></thead>\n<tbody>\n";
  for (std::size_t r = 0; r < rows; ++r) {
    out += "<tr>";
    for (const std::size_t i : shown) out += cell(table.header[i], table.records[r].fields[i]);
    out += "</tr>\n";
  }
  out += "</tbody></table></div>\n";
  const std::string left_out = rows_left_out(table, most);
  if (!left_out.empty()) out += html_paragraph(left_out);
  return out;
}

}  // namespace sonar
