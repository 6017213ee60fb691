// Files that are none, or that are made to hurt whoever reads them.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "harness/files/regular_file.h"
#include "harness/files/toml_nesting.h"
#include "tests/harness/fixtures/temporary_fixtures.h"

namespace towbench::harness {
namespace {

std::string refusal(const std::filesystem::path& path, std::uint64_t largest = 100) {
  const auto read = read_regular_file(path, largest);
  const auto* const refused = std::get_if<Unreadable>(&read);
  return refused == nullptr ? std::string() : refused->what;
}

TEST(RegularFile, ReadsAFileAndNothingElse) {
  TemporaryFixtures files;
  files.write("a.txt", "text");
  EXPECT_EQ(std::get<std::string>(read_regular_file(files.folder() / "a.txt", 4)), "text");
  EXPECT_EQ(refusal(files.folder() / "a.txt", 3), "a file of 4 bytes");
  EXPECT_EQ(refusal(files.folder()), "a directory");
  EXPECT_EQ(refusal(files.folder() / "none"), "a path with no file");
  EXPECT_EQ(refusal("/dev/zero"), "a pipe or a device");
  ASSERT_EQ(::mkfifo((files.folder() / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(refusal(files.folder() / "pipe"), "a pipe or a device");  // and does not wait
}

std::string repeated(std::string_view part, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) {
    text += part;
  }
  return text;
}

TEST(TomlNesting, FindsTheLineOfAKeyOfManyParts) {
  EXPECT_EQ(line_nested_too_deep("a = 1\n" + repeated("a.", 50'000) + "a = 1\n"), 2U);
  EXPECT_EQ(line_nested_too_deep("[" + repeated("\"a\" . ", 50) + "a]\n"), 1U);
  EXPECT_EQ(line_nested_too_deep("\n\nx = " + repeated("[", 5'000)), 3U);
  EXPECT_EQ(line_nested_too_deep("x = " + repeated("{a=", 40)), 1U);
}

TEST(TomlNesting, LeavesNumbersStringsAndCommentsAlone) {
  EXPECT_EQ(line_nested_too_deep("x = [" + repeated("1.5, ", 500) + "2.5]\n"), 0U);
  EXPECT_EQ(line_nested_too_deep("x = \"" + repeated(".", 500) + "\"\n"), 0U);
  EXPECT_EQ(line_nested_too_deep("x = \"\\\"" + repeated("[", 500) + "\"\n"), 0U);
  EXPECT_EQ(line_nested_too_deep("x = '''\n" + repeated("[.", 500) + "'''\n"), 0U);
  EXPECT_EQ(line_nested_too_deep("# " + repeated("a.", 500) + "\nx = 1\n"), 0U);
  EXPECT_EQ(line_nested_too_deep("x = \"not closed\n" + repeated("y.", 50) + "z=1"), 2U);
}

}  // namespace
}  // namespace towbench::harness
