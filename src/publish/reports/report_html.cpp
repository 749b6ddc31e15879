// SPDX-License-Identifier: Apache-2.0
#include "publish/reports/report_html.h"

#include <string_view>
#include <utility>

#include "io/recordings.h"
#include "publish/reports/html_text.h"
#include "publish/reports/report_contents.h"

namespace sonar {
namespace {

constexpr std::string_view kStyle = R"(
html{font:15px/1.45 system-ui,sans-serif;color:#1b1f24;background:#fff}
body{max-width:1040px;margin:2em auto;padding:0 1.2em}
h1{font-size:1.6em;margin:0 0 .4em}h2{font-size:1.25em;margin:2em 0 .5em;border-bottom:1px solid #c9d1d9;padding-bottom:.2em}
h3{font-size:1.05em;margin:1.4em 0 .4em}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.15em 1.2em;margin:0}dt{color:#57606a}dd{margin:0;overflow-wrap:anywhere}
figure{margin:1em 0}img{max-width:100%;height:auto}figcaption,caption{color:#57606a;font-size:.9em;text-align:left;padding:.2em 0}
.pair{display:grid;grid-template-columns:repeat(auto-fit,minmax(420px,1fr));gap:0 1em}.pair figure{margin:.4em 0}
.wide{overflow-x:auto}table{border-collapse:collapse;font-size:.8em}th,td{padding:.15em .5em;border-bottom:1px solid #e1e4e8;text-align:left;vertical-align:top}
th{background:#f3f5f7;font-weight:600}td.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
pre{font-size:.8em;background:#f6f8fa;padding:.8em;white-space:pre-wrap;overflow-wrap:anywhere}
footer{margin-top:3em;color:#57606a;font-size:.85em}
@media print{@page{size:A4 landscape;margin:12mm}html{font-size:10px}body{max-width:none;margin:0;padding:0}
.wide{overflow:visible}table{font-size:5.5px}th,td{padding:1px 2px}figure,tr{break-inside:avoid}h2,h3{break-after:avoid}thead{display:table-header-group}}
)";

class HtmlReport : public ReportWriter {
 public:
  [[nodiscard]] std::string page() { return std::move(page_); }

  void title(const std::string& text) override {
    const std::string title = html_escaped(text);
    page_ =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
        title + "</title>\n<style>" + std::string(kStyle) + "</style>\n</head>\n<body>\n<h1>" + title + "</h1>\n";
  }
  void heading(const std::string& text) override { page_ += html_heading(text); }
  void subheading(const std::string& text) override { page_ += "<h3>" + html_escaped(text) + "</h3>\n"; }
  void paragraph(const std::string& text) override { page_ += html_paragraph(text); }
  void words(const NamedWords& words) override {
    page_ += "<dl>\n";
    for (const auto& [name, value] : words) {
      page_ += "<dt>" + html_escaped(name) + "</dt><dd>" + html_escaped(value) + "</dd>\n";
    }
    page_ += "</dl>\n";
  }
  void begin_pair() override { page_ += "<div class=\"pair\">\n"; }
  void end_pair() override { page_ += "</div>\n"; }
  Result<void> picture(const FrameDescription& frame, const std::string& caption) override {
    const auto picture = html_picture(frame, caption);
    if (!picture) return pass_on(picture);
    page_ += *picture;
    return {};
  }
  void table(const CsvTable& table, const std::string& caption, std::size_t most) override {
    page_ += html_table(table, caption, most);
  }
  void plain_text(const std::string& text) override { page_ += "<pre>" + html_escaped(text) + "</pre>\n"; }
  void closing(const std::string& text) override {
    page_ += "<footer>" + html_escaped(text) + "</footer>\n</body>\n</html>\n";
  }

 private:
  std::string page_;
};

}  // namespace

bool is_report_html(const std::filesystem::path& file) { return has_ending(file, ".html") || has_ending(file, ".htm"); }

Result<std::string> report_html(PictureSource& source, std::span<const std::filesystem::path> paths,
                                const PictureOptions& options, Work& work) {
  HtmlReport report;
  if (auto written = write_report(report, source, paths, options, work); !written) return pass_on(written);
  return report.page();
}

}  // namespace sonar
