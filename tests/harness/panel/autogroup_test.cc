// A run that was started from a page goes ahead of the browser's session, and nothing of it is left
// behind.
#include "harness/panel/autogroup.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/panel/session.h"
#include "tests/harness/fixtures/temporary_fixtures.h"

namespace towbench::harness {
namespace {

const std::filesystem::path kKernels = "/proc/self/autogroup";

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

TEST(AheadOfOtherSessions, IsAskedForAndGivenBack) {
  const TemporaryFixtures folder;
  const auto file = folder.folder() / "autogroup";
  write(file, "/autogroup-17 nice 3\n");
  {
    const AheadOfOtherSessions ahead(file);
    EXPECT_EQ(text_of(file), "-10");
  }
  EXPECT_EQ(text_of(file), "3");
}

TEST(AheadOfOtherSessions, TakesNothingFromOneThatIsFurtherAhead) {
  const TemporaryFixtures folder;
  const auto file = folder.folder() / "autogroup";
  write(file, "/autogroup-17 nice -15\n");
  { const AheadOfOtherSessions ahead(file); }
  EXPECT_EQ(text_of(file), "/autogroup-17 nice -15");
}

TEST(AheadOfOtherSessions, LeavesAloneWhatItCannotRead) {
  const TemporaryFixtures folder;
  const auto file = folder.folder() / "autogroup";
  { const AheadOfOtherSessions ahead(file); }
  EXPECT_FALSE(std::filesystem::exists(file)) << "a kernel without such groups";
  write(file, "another kernel's words\n");
  { const AheadOfOtherSessions ahead(file); }
  EXPECT_EQ(text_of(file), "another kernel's words");
}

// 0 when the kernel's group of this process was at -10 during a run, or could not be, and is as
// before afterwards. In a session of its own: other tests change theirs meanwhile.
int during_a_run(const std::filesystem::path& folder) {
  if (::setsid() < 0) {
    return 1;
  }
  const auto before = text_of(kKernels);
  std::string possible;
  {
    const AheadOfOtherSessions ahead;
    possible = text_of(kKernels);
  }
  auto session = std::make_unique<Session>(folder);
  session->start({.experiment = "circle", .pace = {.speed = 0, .paused = true}});
  while (session->tap().folder().empty()) {
    std::this_thread::yield();  // it has begun once it has told where it writes
  }
  const auto during = text_of(kKernels);
  session.reset();
  return during == possible && text_of(kKernels) == before ? 0 : 2;
}

TEST(AheadOfOtherSessionsDeathTest, IsHowAPanelsRunIsRun) {
  if (!std::filesystem::exists(kKernels)) {
    GTEST_SKIP() << "a kernel that does not group by session";
  }
  const TemporaryFixtures folder;
  EXPECT_EXIT(std::_Exit(during_a_run(folder.folder())), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace towbench::harness
