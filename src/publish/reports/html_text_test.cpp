// SPDX-License-Identifier: Apache-2.0
#include "publish/reports/html_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sonar {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(HtmlText, TextStaysText) {
  EXPECT_EQ(html_escaped("<b>&\"'</b>"), "&lt;b&gt;&amp;&quot;&#39;&lt;/b&gt;");
  EXPECT_EQ(html_escaped("sei \u2212 \u00F8"), "sei \u2212 \u00F8");
  EXPECT_EQ(html_escaped(std::string_view("a\0b\x1B\tc\n", 7)), "a\uFFFDb\uFFFD\tc\n");
}

// Bytes that are no UTF-8, by the table of Unicode 15, 3.9: each bad byte becomes U+FFFD, and what follows is read again.
TEST(HtmlText, WhatIsNoUtf8IsReplaced) {
  EXPECT_EQ(html_escaped("st\xF8r"), "st\uFFFDr") << "Latin 1";
  EXPECT_EQ(html_escaped("\xC0\xBC"), "\uFFFD\uFFFD") << "an overlong <";
  EXPECT_EQ(html_escaped("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD") << "a surrogate";
  EXPECT_EQ(html_escaped("\xE2\x88<"), "\uFFFD\uFFFD&lt;") << "cut off before markup";
  EXPECT_EQ(html_escaped("a\xEF\xBF\xBE\xEF\xBF\xBFz"), "a\uFFFD\uFFFD\uFFFD\uFFFD\uFFFD\uFFFDz") << "no characters";
  EXPECT_EQ(html_escaped("\xF4\x90\x80\x80"), "\uFFFD\uFFFD\uFFFD\uFFFD") << "beyond U+10FFFF";
  EXPECT_EQ(html_escaped("\xF0\x9F\x90\x9F"), "\xF0\x9F\x90\x9F") << "a fish";
}

// Five digits of what is small too, though it has as many decimals as a place.
TEST(HtmlText, PlacesAreToldToAMetreAndFiguresToFiveDigits) {
  const auto table = parse_csv("mass_latitude,sigma\n59.12345678,0.00123456\n", "a test");
  ASSERT_TRUE(table);
  const std::string text = html_table(*table, "", 1);
  EXPECT_THAT(text, HasSubstr("<td class=\"n\">59.12346</td><td class=\"n\">0.0012346</td>"));
}

TEST(HtmlText, Base64HasTheVectorsOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xFB\xFF"), "+/8=");
}

TEST(HtmlText, TablesLeaveOutWhatIsEmptyAndTellWhatIsCut) {
  const auto table = parse_csv("sv_mean_db,empty,name\n-45.123456,,<i>\n-1e-7,,b\n7,,c\n", "a test");
  ASSERT_TRUE(table);
  const std::string text = html_table(*table, "A & B", 2);
  EXPECT_THAT(text, HasSubstr("<caption>A &amp; B</caption>"));
  EXPECT_THAT(text, HasSubstr("<td class=\"n\">-45.123</td><td>&lt;i&gt;</td>"));
  EXPECT_THAT(text, HasSubstr("<td class=\"n\">-1e-07</td>"));
  EXPECT_THAT(text, Not(HasSubstr("empty")));
  EXPECT_THAT(text, Not(HasSubstr("<td>c</td>")));
  EXPECT_THAT(text, HasSubstr("The first 2 of 3 rows."));
  EXPECT_THAT(html_table(*table, "", 3), Not(HasSubstr("The first")));
}

}  // namespace
}  // namespace sonar
