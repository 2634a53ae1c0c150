// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/html.h"

#include <gtest/gtest.h>

#include "markup.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

TEST(Html, TextCantBecomeMarkup) {
  EXPECT_EQ(html_text("a<b> & \"c\""), "a&lt;b&gt; &amp; &quot;c&quot;");
  EXPECT_EQ(html_text("ε × 2"), "ε × 2");
}

// RFC 4648, section 10.
TEST(Html, Base64IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xef\xbf"), "/++/");
}

TEST(Html, AnImageIsWithinTheDocument) {
  const std::string image = inline_image("foobar", "image/png", "a \"name\"");
  EXPECT_EQ(image, "<img alt=\"a &quot;name&quot;\" src=\"data:image/png;base64,Zm9vYmFy\">");
  EXPECT_EQ(find_outside_reference(image), "");
  EXPECT_THROW((void)inline_png("missing.png", ""), Error);
}

// The checks that other tests rely on find what they are for.
TEST(Html, ChecksFindFaults) {
  EXPECT_EQ(find_markup_fault("<p>a<br>b</p>", {"br"}), "");
  EXPECT_NE(find_markup_fault("<p>a<b></p>", {}), "");
  EXPECT_NE(find_markup_fault("<p>a", {}), "");
  EXPECT_NE(find_markup_fault("<p title=\"a>b</p>", {}), "");
  EXPECT_EQ(find_outside_reference("<use xlink:href='#a'/>"), "");
  EXPECT_NE(find_outside_reference("<img src=\"a.png\">"), "");
  EXPECT_NE(find_outside_reference("<a href=https://example.org>"), "");
  EXPECT_NE(find_outside_reference("p { background: url(a.png) }"), "");
  EXPECT_NE(find_outside_reference("<script>"), "");
}

}  // namespace
}  // namespace pdsm
