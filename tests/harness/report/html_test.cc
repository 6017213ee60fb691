#include "harness/report/html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace towbench::harness::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Html, TurnsMarkupIntoText) {
  EXPECT_EQ(escaped("</script><b a='1' c=\"2\">&"),
            "&lt;/script&gt;&lt;b a=&#39;1&#39; c=&quot;2&quot;&gt;&amp;");
}

TEST(Html, KeepsWellFormedUtf8) {
  EXPECT_EQ(escaped("10 µm ≤ 1 😀"), "10 µm ≤ 1 😀");
}

TEST(Html, ReplacesEveryByteThatIsNotWellFormedUtf8) {
  const std::string replacement = "\xEF\xBF\xBD";
  EXPECT_EQ(escaped("\xff"), replacement);
  EXPECT_EQ(escaped("\xc0\xbc"), replacement + replacement);        // overlong '<'
  EXPECT_EQ(escaped("\xe0\x80\xbc").find('<'), std::string::npos);  // overlong '<' in three
  EXPECT_EQ(escaped("\xed\xa0\x80"), replacement + replacement + replacement);  // surrogate
  EXPECT_EQ(escaped("a\xe2\x82"), "a" + replacement + replacement);             // cut off
  EXPECT_EQ(escaped(std::string("\x1b[0m\0", 5)), replacement + "[0m" + replacement);
  EXPECT_EQ(escaped("a\tb\n"), "a\tb\n");
}

TEST(Html, LetsNoJsonTextEndItsScriptElement) {
  const std::string json = script_json({{"text", "</script><!-- & \xff \u2028"}});
  EXPECT_THAT(json, Not(HasSubstr("<")));
  EXPECT_THAT(json, Not(HasSubstr(">")));
  EXPECT_THAT(json, Not(HasSubstr("&")));
  for (const char character : json) {
    EXPECT_LT(static_cast<unsigned char>(character), 0x80U);
  }
  EXPECT_EQ(nlohmann::json::parse(json)["text"].get<std::string>().substr(0, 9), "</script>");
}

}  // namespace
}  // namespace towbench::harness::report
