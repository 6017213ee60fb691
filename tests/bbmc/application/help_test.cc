// help, and the README that shows what it prints.
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bbmc/application/commands/command_table.h"
#include "tests/bbmc/application/support/session.h"

namespace towbench::bbmc {
namespace {

using ::testing::HasSubstr;
using testing::Session;

TEST(Help, KnowsEveryCommandAndEveryOption) {
  Session session;
  const std::string list = session.enter("help");
  const std::string all = session.enter("help all");
  for (const CommandSpec& command : command_table()) {
    const std::string sub =
        command.is_default ? "[" + std::string(command.sub) + "]" : std::string(command.sub);
    const std::string title =
        "  " + std::string(command.word) + (command.sub.empty() ? "" : " " + sub);
    EXPECT_THAT(list, HasSubstr(title));
    EXPECT_THAT(all, HasSubstr(title));
    const std::string one = session.enter("help " + std::string(command.word));
    EXPECT_THAT(one, HasSubstr(title));
    for (const OptionSpec& option : command.options) {
      EXPECT_THAT(one, HasSubstr("    " + std::string(option.name)));
      EXPECT_FALSE(option.meaning.empty()) << option.name;
    }
  }
}

TEST(Help, EveryDefaultIsInsideItsRangeAndEveryBareUnitExists) {
  for (const CommandSpec& command : command_table()) {
    for (const OptionSpec& option : command.options) {
      if (option.kind != OptionKind::kQuantity) {
        continue;
      }
      EXPECT_TRUE(option.presence != Presence::kDefault || !option.default_text.empty() ||
                  option.range.contains(option.default_value))
          << command.word << ' ' << option.name;
      const auto by_text =
          parse_quantity(option.default_text, option.dimension, option.bare_unit, 445'345);
      EXPECT_TRUE(option.default_text.empty() || (by_text && option.range.contains(*by_text)))
          << command.word << ' ' << option.name;
      EXPECT_NE(find_unit(option.dimension, option.bare_unit), nullptr)
          << command.word << ' ' << option.name;
    }
  }
}

TEST(Readme, ShowsWhatHelpAllPrints) {
  Session session;
  std::string help = session.enter("help all");
  std::erase(help, '\r');
  help.resize(help.size() - std::string_view("ok\n").size());
  std::ifstream file("docs/reference/console.md");
  ASSERT_TRUE(file) << "tests run in the root of the sources";
  std::string line;
  while (line != "```text") {
    ASSERT_TRUE(std::getline(file, line));
  }
  std::istringstream printed(help);
  for (std::string expected; std::getline(printed, expected);) {
    ASSERT_TRUE(std::getline(file, line));
    ASSERT_EQ(line, expected);
  }
  ASSERT_TRUE(std::getline(file, line));
  EXPECT_EQ(line, "```");
}

}  // namespace
}  // namespace towbench::bbmc
