// docs/guide/console-session.md shows a session; it is what the controller prints on the emulated
// machine, or this fails.
#include "tests/bbmc/support/typed_session.h"

#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

namespace towbench::tests {
namespace {

TEST(Documents, TheTypedSessionIsWhatTheControllerPrints) {
  std::ifstream file("docs/guide/console-session.md");
  ASSERT_TRUE(file) << "tests run in the root of the sources";
  std::string line;
  while (line != "```text") {
    ASSERT_TRUE(std::getline(file, line));
  }
  std::istringstream printed(typed_session());
  for (std::string expected; std::getline(printed, expected);) {
    ASSERT_TRUE(std::getline(file, line));
    ASSERT_EQ(line, expected);
  }
  ASSERT_TRUE(std::getline(file, line));
  EXPECT_EQ(line, "```");
}

}  // namespace
}  // namespace towbench::tests
